// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectRegion.h"

#include <algorithm>
#include <cstdlib>

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

MedialVoxelIndex
GetIndex(const MedialVoxelBox & box, std::int64_t offset)
{
  const std::int64_t row = offset / box.Extent(0);
  return {
    { box.lower[0] + offset % box.Extent(0), box.lower[1] + row % box.Extent(1), box.lower[2] + row / box.Extent(1) }
  };
}

/** Calls function(index) for a voxel and its neighbors in the box. */
template <typename TFunction>
void
ForEachAround(const MedialVoxelIndex & center, const MedialVoxelBox & box, TFunction && function)
{
  const MedialVoxelBox around = Enlarge({ center, { { center[0] + 1, center[1] + 1, center[2] + 1 } } }, 1, box);
  MedialVoxelIndex     index;
  for (index[2] = around.lower[2]; index[2] < around.upper[2]; ++index[2])
  {
    for (index[1] = around.lower[1]; index[1] < around.upper[1]; ++index[1])
    {
      for (index[0] = around.lower[0]; index[0] < around.upper[0]; ++index[0])
      {
        function(index);
      }
    }
  }
}

/** The component of a voxel of no object. */
struct Component
{
  std::uint64_t           voxels{ 0 };
  MedialVoxelObjectNumber object{ 0 }; ///< beside it
};

/** \param objects of the box; 0 for hidden ones
 * \param most voxels that are followed */
Component
FollowComponent(const MedialVoxelBox &                       box,
                const std::vector<MedialVoxelObjectNumber> & objects,
                const MedialVoxelIndex &                     start,
                std::uint64_t                                most)
{
  Component                     component;
  std::vector<bool>             isKnown(objects.size());
  std::vector<MedialVoxelIndex> open(1, start);
  isKnown[static_cast<std::size_t>(box.OffsetOf(start))] = true;
  while (!open.empty() && component.voxels <= most)
  {
    const MedialVoxelIndex voxel = open.back();
    open.pop_back();
    ++component.voxels;
    ForEachAround(voxel, box, [&](const MedialVoxelIndex & index) {
      const auto offset = static_cast<std::size_t>(box.OffsetOf(index));
      if (objects[offset] > 0)
      {
        component.object = objects[offset];
      }
      else if (!isKnown[offset])
      {
        isKnown[offset] = true;
        open.push_back(index);
      }
    });
  }
  return component;
}

} // namespace

MedialVoxelObjectRegion::MedialVoxelObjectRegion(MedialVoxelObjectMap &   map,
                                                 const MedialVoxelIndex & size,
                                                 const std::uint64_t      maximumPoreSize)
  : m_Map(map)
  , m_MaximumPoreSize(maximumPoreSize)
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
  const MedialVoxelBox cell = Enlarge({ lowest, { { lowest[0] + 2, lowest[1] + 2, lowest[2] + 2 } } }, 0, m_Image);
  // Most pores are small; a pore is in the box when no voxel more of it is in the next larger one.
  for (std::int64_t reach = 4;; reach *= 2)
  {
    const MedialVoxelBox                 box = Enlarge(cell, reach, m_Image);
    std::vector<MedialVoxelObjectNumber> objects(static_cast<std::size_t>(box.NumberOfVoxels()));
    m_Map.ReadObjects(box, objects.data());
    std::replace_if(
      objects.begin(),
      objects.end(),
      [&](MedialVoxelObjectNumber object) { return object > 0 && m_Map.GetPass(object) != pass; },
      MedialVoxelObjectNumber{ 0 });
    const bool isAll = static_cast<std::uint64_t>(reach) > m_MaximumPoreSize + 1;
    for (std::int64_t corner = 0; corner < cell.NumberOfVoxels(); ++corner)
    {
      const Component component = FollowComponent(box, objects, GetIndex(cell, corner), m_MaximumPoreSize);
      const bool      isWithin = isAll || component.voxels <= static_cast<std::uint64_t>(reach);
      if (component.voxels <= m_MaximumPoreSize && isWithin)
      {
        return component.object;
      }
    }
    if (isAll)
    {
      return 0;
    }
  }
}

} // end namespace itk
