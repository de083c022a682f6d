// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceTrimmer_h
#define itkMedialVoxelSurfaceTrimmer_h

#include "itkMedialVoxelSurfaceBuilder.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelSurfaceTrimmer
 * \brief Takes single quadrilaterals off the rims and corners of a medial surface before it is built.
 *
 * Two kinds go, all at once, so the result depends on no order:
 * - a fin has one side with more than one other quadrilateral and no others at its other sides;
 * - a scrap has no others at any side, but shares a cell with another part of the surface, which it touched there.
 *
 * A quadrilateral that is all of its component stays. Whether one goes follows from the vertices of its four cells,
 * which lie in two slices: one slice waits for the next.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceTrimmer
{
public:
  /** \param builder  gets the rest */
  explicit MedialVoxelSurfaceTrimmer(MedialVoxelSurfaceBuilder & builder);

  /** As MedialVoxelSurfaceBuilder::AddSlice(). */
  void
  AddSlice(std::int64_t z, std::vector<MedialVoxelSurfaceCell> cells);

  /** Hand on the rest, and finish the builder. */
  void
  Finish();

private:
  struct Slice
  {
    std::int64_t                                      z{ 0 };
    std::vector<MedialVoxelSurfaceCell>               cells;
    std::vector<MedialVoxelSurfaceTopology::EdgeMask> trimmed; // of each vertex; empty: of none
  };

  /** A vertex of a quadrilateral. */
  struct Corner
  {
    Slice *     slice;
    std::size_t position;
  };

  using Corners = std::array<Corner, 4>;

  void
  TrimAtVerticesOf(const Slice & slice);

  Corners
  FindCorners(const MedialVoxelIndex & voxel, unsigned int axis);

  static bool
  IsToBeTrimmed(const Corners & corners, unsigned int axis);

  static bool
  IsAloneInCell(const Corner & corner);

  void
  HandOnBefore();

  MedialVoxelSurfaceBuilder & m_Builder;
  Slice                       m_Before;
  Slice                       m_Newest;
};

} // end namespace itk

#endif
