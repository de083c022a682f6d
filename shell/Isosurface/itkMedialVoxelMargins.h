// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelMargins_h
#define itkMedialVoxelMargins_h

#include "itkMedialVoxelGrid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelMargins
 * \brief How far values are within the threshold of the object, for the last slices that were put: not negative in the
 * object, negative outside, NaN where it is not known. Of masks it is 1/2 and -1/2.
 * \ingroup MedialVoxel
 */
class MedialVoxelMargins
{
public:
  /** \param size of the image \param numberOfSlices that are kept, at least 1 */
  MedialVoxelMargins(const MedialVoxelIndex & size, std::int64_t numberOfSlices)
    : m_Size(size)
    , m_NumberOfSlices(numberOfSlices)
    , m_Values(static_cast<std::size_t>(size[0] * size[1] * numberOfSlices))
  {}

  static std::uint64_t
  GetBytes(const MedialVoxelIndex & size, std::int64_t numberOfSlices)
  {
    return static_cast<std::uint64_t>(size[0] * size[1] * numberOfSlices) * sizeof(float);
  }

  const MedialVoxelIndex &
  GetSize() const
  {
    return m_Size;
  }

  /** The row of these y and z, from x = 0. Takes the place of that of the slice z - GetNumberOfSlices(). */
  float *
  GetRow(std::int64_t y, std::int64_t z)
  {
    return m_Values.data() + this->OffsetOf(y, z);
  }
  const float *
  GetRow(std::int64_t y, std::int64_t z) const
  {
    return m_Values.data() + this->OffsetOf(y, z);
  }

  float
  Get(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    return this->GetRow(y, z)[x];
  }

private:
  std::size_t
  OffsetOf(std::int64_t y, std::int64_t z) const
  {
    return static_cast<std::size_t>((z % m_NumberOfSlices * m_Size[1] + y) * m_Size[0]);
  }

  MedialVoxelIndex   m_Size;
  std::int64_t       m_NumberOfSlices;
  std::vector<float> m_Values;
};

} // end namespace itk

#endif
