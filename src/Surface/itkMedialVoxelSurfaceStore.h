// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceStore_h
#define itkMedialVoxelSurfaceStore_h

#include "itkMedialVoxelSurfaceBranches.h"
#include "itkMedialVoxelSurfaceBuilder.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelSurfaceStore
 * \brief Keeps a surface in memory until all of it is known, and removes short branches and small components.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceStore
  : public MedialVoxelSurfaceConsumer
  , private MedialVoxelSurfaceFaces
{
public:
  /** \param roundsToFloat  whether lengths are between vertices rounded to 32 bits, as in most files */
  explicit MedialVoxelSurfaceStore(bool roundsToFloat)
    : m_RoundsToFloat(roundsToFloat)
  {}

  void
  AddVertices(const std::vector<MedialVoxelSurfaceVertex> & vertices) override;

  void
  AddQuads(const std::vector<MedialVoxelSurfaceQuad> & quads) override;

  /** Take out the branches of MedialVoxelSurfaceBranches that are shorter than \a length. */
  void
  RemoveBranches(double length);

  /** Take out the connected components of fewer than \a smallest quadrilaterals. */
  void
  RemoveSmallComponents(std::uint64_t smallest);

  /** Hand on the rest. */
  void
  HandOn(MedialVoxelSurfaceConsumer & consumer) const;

private:
  void
  ForEachFace(bool backwards, const Visitor & visit) const override;

  /** Remove the faces that are not kept, and number the vertices anew. */
  template <typename TIsVertexKept, typename TIsQuadKept, typename TNumberOf>
  void
  Keep(TIsVertexKept && isVertexKept, TIsQuadKept && isQuadKept, TNumberOf && numberOf);

  bool                                  m_RoundsToFloat;
  std::vector<MedialVoxelSurfaceVertex> m_Vertices;
  std::vector<MedialVoxelSurfaceQuad>   m_Quads;
};

} // end namespace itk

#endif
