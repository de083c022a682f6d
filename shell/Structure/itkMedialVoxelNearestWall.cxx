// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNearestWall.h"

#include <utility>

namespace itk
{
namespace
{

/** Triangles whose corners are one point each. */
std::vector<MedialVoxelSheetTree::Triangle>
MakeTriangles(const std::size_t count)
{
  std::vector<MedialVoxelSheetTree::Triangle> triangles(count);
  for (MedialVoxelSheetTree::Index point = 0; point < count; ++point)
  {
    triangles[point].fill(point);
  }
  return triangles;
}

} // namespace

MedialVoxelNearestWall::MedialVoxelNearestWall(std::vector<Point> points, std::vector<std::uint32_t> wallOf)
  : m_Points(std::move(points))
  , m_WallOf(std::move(wallOf))
  , m_Tree(m_Points, MakeTriangles(m_Points.size()), std::vector<MedialVoxelSheetTree::Index>(m_Points.size()))
{}

std::uint32_t
MedialVoxelNearestWall::Find(const Point & place) const
{
  return m_Points.empty() ? 0 : m_WallOf[m_Tree.Find(place, 0).triangle];
}

} // end namespace itk
