// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallPieces_h
#define itkMedialVoxelWallPieces_h

#include "itkMedialVoxelSheetGraph.h"
#include "itkMedialVoxelTasks.h"

#include <map>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelWallPieces
 * \brief The wall of each node of a sheet, as MedialVoxelFindWalls() has it, and where walls touch.
 * \ingroup MedialVoxel
 */
class MedialVoxelWallPieces
{
public:
  using Index = MedialVoxelSheetGraph::Index;
  using Set = std::vector<Index>;

  /** A node beside one of another wall. */
  struct Contact
  {
    Index               node;
    Set                 walls;   ///< that have a share of the sheet around it, in order
    std::vector<double> cosines; ///< of the angle between each two, in the order 1-2, 1-3, ..., 2-3, ...
  };

  MedialVoxelWallPieces(const MedialVoxelSheetGraph & graph, const MedialVoxelRunTasks & runTasks);

  /** Of a node, any numbers below the number of nodes; None: it is of no wall. */
  Index
  GetWall(const Index node) const
  {
    return m_Walls[node];
  }

  /** By node. */
  const std::vector<Contact> &
  GetContacts() const
  {
    return m_Contacts;
  }

private:
  /** Calls function(k, disk) for all k below a count, in threads. */
  template <typename TFunction>
  void
  ForEachIndex(std::size_t count, TFunction && function) const;

  void
  FindCores();

  void
  Grow();

  void
  FindContacts();

  bool
  JoinStraightOnes();

  bool
  IsContact(Index node) const;

  Contact
  Describe(Index node, const std::vector<Index> & disk) const;

  const MedialVoxelSheetGraph & m_Graph;
  const MedialVoxelRunTasks &   m_RunTasks;
  std::vector<Index>            m_Walls;
  std::vector<Contact>          m_Contacts;
};

} // end namespace itk

#endif
