// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrid_h
#define itkMedialVoxelGrid_h

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace itk
{

/** Voxel index in image coordinates: 0 is the first voxel of the whole image, whatever its start index. */
using MedialVoxelIndex = std::array<std::int64_t, 3>;

/** \struct MedialVoxelBox
 * \brief Half-open box [lower, upper) of voxel indices; 2-D images have the extent 1 along z.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelBox
{
  MedialVoxelIndex lower{ { 0, 0, 0 } };
  MedialVoxelIndex upper{ { 0, 0, 0 } };

  std::int64_t
  Extent(unsigned int axis) const
  {
    return upper[axis] - lower[axis];
  }

  bool
  IsEmpty() const
  {
    return Extent(0) <= 0 || Extent(1) <= 0 || Extent(2) <= 0;
  }

  std::int64_t
  NumberOfVoxels() const
  {
    return IsEmpty() ? 0 : Extent(0) * Extent(1) * Extent(2);
  }

  /** True when every voxel of \a other is in this box; an empty box is in every box. */
  bool
  Contains(const MedialVoxelBox & other) const;

  bool
  Contains(const MedialVoxelIndex & index) const;

  /** Position of a voxel in an array of all voxels of the box, x fastest. */
  std::size_t
  OffsetOf(const MedialVoxelIndex & index) const
  {
    return static_cast<std::size_t>(((index[2] - lower[2]) * Extent(1) + (index[1] - lower[1])) * Extent(0) +
                                    (index[0] - lower[0]));
  }

  /** Box grown by \a margin voxels on both sides of each axis. */
  MedialVoxelBox
  Expanded(const MedialVoxelIndex & margin) const;

  MedialVoxelBox
  Intersection(const MedialVoxelBox & other) const;

  /** Smallest box that holds both; an empty box adds nothing. */
  MedialVoxelBox
  Union(const MedialVoxelBox & other) const;
};

MedialVoxel_EXPORT bool
operator==(const MedialVoxelBox & a, const MedialVoxelBox & b);

inline bool
operator!=(const MedialVoxelBox & a, const MedialVoxelBox & b)
{
  return !(a == b);
}

/** \class MedialVoxelGrid
 * \brief Size and spacing of the whole image, and the metric that follows from them.
 *
 * Axes of length 1 are inactive: they have no neighbors and no cell corners, and their spacings do not count. When the
 * spacings of the active axes are equal, squared distances are compared in index units: they are integers, so ties are
 * exact. Otherwise they are compared in physical units. Formats round spacings, so nearly equal ones become equal.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrid
{
public:
  using SpacingType = std::array<double, 3>;

  /** Spacings that differ by this share or less are equal. */
  static constexpr double EqualSpacing = 1e-6;

  MedialVoxelGrid() = default;

  /** \a size at least 1 and \a spacing positive and finite along every axis. */
  MedialVoxelGrid(const MedialVoxelIndex & size, const SpacingType & spacing);

  const MedialVoxelIndex &
  GetSize() const
  {
    return m_Size;
  }

  /** The spacing of the constructor; nearly equal values become the first of them. */
  const SpacingType &
  GetSpacing() const
  {
    return m_Spacing;
  }

  /** Spacing in which squared distances are compared: 1 when the spacings of the active axes are equal. */
  const SpacingType &
  GetMetricSpacing() const
  {
    return m_MetricSpacing;
  }

  /** Physical length of one metric unit. */
  double
  GetMetricUnit() const
  {
    return m_MetricUnit;
  }

  bool
  HasEqualSpacing() const
  {
    return m_HasEqualSpacing;
  }

  bool
  IsActive(unsigned int axis) const
  {
    return m_Size[axis] > 1;
  }

  unsigned int
  GetNumberOfActiveAxes() const
  {
    return (this->IsActive(0) ? 1u : 0u) + (this->IsActive(1) ? 1u : 0u) + (this->IsActive(2) ? 1u : 0u);
  }

  /** Voxels of the whole image. */
  MedialVoxelBox
  GetVoxelBox() const
  {
    return { { { 0, 0, 0 } }, m_Size };
  }

  /** Dual cells of the whole image, by the index of their lowest corner; empty when no axis is active. */
  MedialVoxelBox
  GetCellBox() const;

  /** One along active axes, zero along the others. */
  MedialVoxelIndex
  GetUnitMargin() const;

  /** Physical length of the edge that changes the axes of \a mask (bit 0 x, bit 1 y, bit 2 z); 0 for no axis. */
  double
  GetEdgeLength(unsigned int mask) const
  {
    return m_EdgeLength[mask];
  }

  /** Longest edge that the grid has. */
  double
  GetLongestEdge() const
  {
    return m_LongestEdge;
  }

  /** Shortest edge of the grid; infinite when no axis is active. */
  double
  GetShortestEdge() const
  {
    return m_ShortestEdge;
  }

  /** Squared length of a displacement in metric units, evaluated as ((dx sx)^2 + (dy sy)^2) + (dz sz)^2. */
  double
  SquaredMetricLength(std::int64_t dx, std::int64_t dy, std::int64_t dz) const
  {
    const double x = static_cast<double>(dx) * m_MetricSpacing[0];
    const double y = static_cast<double>(dy) * m_MetricSpacing[1];
    const double z = static_cast<double>(dz) * m_MetricSpacing[2];
    return (x * x + y * y) + z * z;
  }

  /** Smallest number of voxels per axis that covers the metric \a length: 0 along inactive axes. */
  MedialVoxelIndex
  MarginForMetricLength(double length) const;

private:
  /** The spacing of an axis, or the nearly equal spacing of an axis before it. */
  double
  FindEqualSpacing(unsigned int axis) const;

  MedialVoxelIndex      m_Size{ { 1, 1, 1 } };
  SpacingType           m_Spacing{ { 1.0, 1.0, 1.0 } };
  SpacingType           m_MetricSpacing{ { 1.0, 1.0, 1.0 } };
  double                m_MetricUnit{ 1.0 };
  bool                  m_HasEqualSpacing{ true };
  std::array<double, 8> m_EdgeLength{};
  double                m_LongestEdge{ 0.0 };
  double                m_ShortestEdge{ 0.0 };
};

} // end namespace itk

#endif
