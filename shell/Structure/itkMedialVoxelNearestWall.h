// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNearestWall_h
#define itkMedialVoxelNearestWall_h

#include "itkMedialVoxelSheetTree.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelNearestWall
 * \brief The wall of the point of a sheet that is nearest to a place; of equally near points, that of the first.
 *
 * It takes less memory than MedialVoxelFindWalls() did for the same points.
 * \ingroup MedialVoxel
 */
class MedialVoxelNearestWall
{
public:
  using Point = MedialVoxelVector3;

  /** \param wallOf of each point, as MedialVoxelSheetWalls has them */
  MedialVoxelNearestWall(std::vector<Point> points, std::vector<std::uint32_t> wallOf);

  /** 0: the nearest point has no wall, or there is none. From any threads. */
  std::uint32_t
  Find(const Point & place) const;

  // The tree knows where the points are.
  MedialVoxelNearestWall(const MedialVoxelNearestWall &) = delete;
  MedialVoxelNearestWall &
  operator=(const MedialVoxelNearestWall &) = delete;

private:
  std::vector<Point>         m_Points;
  std::vector<std::uint32_t> m_WallOf;
  MedialVoxelSheetTree       m_Tree;
};

} // end namespace itk

#endif
