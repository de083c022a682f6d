// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectRegion.h"

#include "itkMedialVoxelRows.h"

#include <algorithm>
#include <limits>

namespace itk
{
namespace
{

/** The voxels at most \a reach from a box, in the image. */
MedialVoxelBox
Enlarge(MedialVoxelBox box, std::int64_t reach, const MedialVoxelBox & image)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = std::max(box.lower[axis] - reach, image.lower[axis]);
    box.upper[axis] = std::min(box.upper[axis] + reach, image.upper[axis]);
  }
  return box;
}

/** Steps along one axis from a box to a voxel, at most. */
std::int64_t
StepsTo(const MedialVoxelBox & box, const MedialVoxelIndex & voxel)
{
  std::int64_t steps = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    steps = std::max({ steps, box.lower[axis] - voxel[axis], voxel[axis] - box.upper[axis] + 1 });
  }
  return steps;
}

} // namespace

MedialVoxelObjectRegion::MedialVoxelObjectRegion(MedialVoxelObjectMap & map, const MedialVoxelIndex & size)
  : m_Map(map)
  , m_Image{ {}, size }
{}

void
MedialVoxelObjectRegion::Read(const MedialVoxelBox & region)
{
  m_Box = region;
  m_Corners.assign(1, 0);
  std::size_t stride = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_Box.upper[axis] = std::min(region.upper[axis] + 1, m_Image.upper[axis]);
    // An axis with one voxel drops out of the cells.
    const std::size_t known = m_Image.Extent(axis) > 1 ? m_Corners.size() : 0;
    for (std::size_t i = 0; i < known; ++i)
    {
      m_Corners.push_back(m_Corners[i] + stride);
    }
    stride *= static_cast<std::size_t>(m_Box.Extent(axis));
  }
  m_Objects.resize(static_cast<std::size_t>(m_Box.NumberOfVoxels()));
  m_Map.ReadObjects(m_Box, m_Objects.data());
}

MedialVoxelObjectNumber
MedialVoxelObjectRegion::FindObjectOfPore(const MedialVoxelIndex & lowest, const unsigned int pass) const
{
  const MedialVoxelBox    cell = Enlarge({ lowest, { { lowest[0] + 2, lowest[1] + 2, lowest[2] + 2 } } }, 0, m_Image);
  MedialVoxelObjectNumber nearest = 0;
  MedialVoxelBox          read{};
  for (std::int64_t reach = 4; nearest == 0 && read != m_Image; reach *= 2)
  {
    read = Enlarge(cell, reach, m_Image);
    std::vector<MedialVoxelObjectNumber> objects(static_cast<std::size_t>(read.NumberOfVoxels()));
    m_Map.ReadObjects(read, objects.data());
    std::int64_t fewest = std::numeric_limits<std::int64_t>::max();
    MedialVoxelForEachRow(read,
                          { 1, read.Extent(0), read.Extent(0) * read.Extent(1) },
                          [&](const std::int64_t offset, const MedialVoxelBox & row) {
                            MedialVoxelIndex voxel = row.lower;
                            for (auto at = static_cast<std::size_t>(offset); voxel[0] < row.upper[0]; ++voxel[0], ++at)
                            {
                              if (objects[at] > 0 && m_Map.GetPass(objects[at]) == pass &&
                                  StepsTo(cell, voxel) < fewest)
                              {
                                fewest = StepsTo(cell, voxel);
                                nearest = objects[at];
                              }
                            }
                          });
  }
  return nearest;
}

} // end namespace itk
