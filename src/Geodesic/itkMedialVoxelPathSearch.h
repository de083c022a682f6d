// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelPathSearch_h
#define itkMedialVoxelPathSearch_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelGuidedQueue.h"

#include "MedialVoxelExport.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** \class MedialVoxelPathSearch
 * \brief Searches a short path between two boundary points, straight on the bits of a small box.
 *
 * A search towards the end (A*), without the points that no short path can use. A path that is short enough ends it.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelPathSearch
{
public:
  /** Rows of a box are not longer. */
  static constexpr std::int64_t LongestRow = MedialVoxelBits::BitsPerWord - 2;

  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  private:
    friend class MedialVoxelPathSearch;

    struct Node
    {
      double        length; // of the shortest path so far
      double        rest;   // lower bound of the path to the end
      std::uint32_t search; // that the others are of
    };

    /** Number of a search over so many nodes, which no node has. */
    std::uint32_t
    BeginSearch(const std::size_t nodes)
    {
      if (++m_Search == 0)
      {
        m_Nodes.clear();
        m_Search = 1;
      }
      m_Nodes.resize(std::max(m_Nodes.size(), nodes));
      return m_Search;
    }

    std::vector<std::uint64_t>           m_Rows;
    std::vector<Node>                    m_Nodes; // of all searches, as few are met by each
    std::uint32_t                        m_Search{ 0 };
    MedialVoxelGuidedQueue<std::int32_t> m_Queue;
  };

  explicit MedialVoxelPathSearch(const MedialVoxelGrid & grid);

  /** Length of a path from \a a to \a b inside \a box: of any one that is shorter than \a enough, otherwise of the
   * shortest one, otherwise, when that exceeds \a most, infinity. Sums of edge lengths in floating point.
   *
   * The box of \a boundary holds \a box, and that holds \a a and \a b, which are boundary points. */
  double
  FindLength(const MedialVoxelBits &  boundary,
             const MedialVoxelBox &   box,
             const MedialVoxelIndex & a,
             const MedialVoxelIndex & b,
             double                   enough,
             double                   most,
             Workspace &              workspace) const;

private:
  /** To the points of a cube of 3 x 3 x 3 from its middle one, which is among them; x first. */
  static constexpr unsigned int NumberOfDirections = 27;

  struct Raster;

  double
  FreeSpaceLength(const std::array<std::int32_t, 3> & a, const std::array<std::int32_t, 3> & b) const;

  MedialVoxelGrid                        m_Grid;
  std::array<double, 8>                  m_EdgeLengths; // by the axes that change
  std::array<double, NumberOfDirections> m_LengthsOfDirections;
};

} // end namespace itk

#endif
