// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGray_h
#define itkMedialVoxelGray_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace itk
{

/** \class MedialVoxelGray
 * \brief Values of a box of voxels that moves over the image, x fastest, in single precision.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGray
{
public:
  /** Bytes of the values of a box. */
  static std::uint64_t
  GetBytes(const MedialVoxelBox & box);

  /** Bytes taken, at most, during and after a Reframe(). */
  std::uint64_t
  GetBytesToReframe(const MedialVoxelBox & box, const MedialVoxelBox & largestBox) const;

  /** Move to \a box and keep the shared values. New memory suffices for \a largestBox too. */
  void
  Reframe(const MedialVoxelBox & box, const MedialVoxelBox & largestBox);

  /** Set the box; its values are undefined. New memory suffices for \a largestBox too. */
  void
  Frame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox);

  /** Copy the slices and rows of \a rows from \a source. Several threads may copy different rows. */
  void
  CopyRows(const MedialVoxelGray & source, const MedialVoxelBox & rows);

  /** Bytes that the values have after a Frame(). */
  std::uint64_t
  GetBytesToFrame(const MedialVoxelBox & box, const MedialVoxelBox & largestBox) const;

  /** Memory that the values have now; it does not shrink with them. */
  std::uint64_t
  GetReservedBytes() const
  {
    return m_NumberOfValues * sizeof(float);
  }

  const MedialVoxelBox &
  GetBox() const
  {
    return m_Box;
  }

  /** The row of these y and z, from the first x of the box. */
  float *
  GetRow(std::int64_t y, std::int64_t z)
  {
    return m_Values.get() + this->OffsetOf(m_Box.lower[0], y, z);
  }

  const float *
  GetRow(std::int64_t y, std::int64_t z) const
  {
    return m_Values.get() + this->OffsetOf(m_Box.lower[0], y, z);
  }

  /** The value of a voxel of the box. */
  float
  Get(const MedialVoxelIndex & voxel) const
  {
    return m_Values[this->OffsetOf(voxel[0], voxel[1], voxel[2])];
  }

private:
  std::size_t
  OffsetOf(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    return static_cast<std::size_t>(((z - m_Box.lower[2]) * m_Box.Extent(1) + (y - m_Box.lower[1])) * m_Box.Extent(0) +
                                    (x - m_Box.lower[0]));
  }

  /** True when rows and slices of a box lie as now and fit the memory. */
  bool
  IsInPlace(const MedialVoxelBox & box) const;

  MedialVoxelBox m_Box;
  // No vector, which one thread would fill with zeros.
  std::unique_ptr<float[]> m_Values;
  std::size_t              m_NumberOfValues{ 0 };
};

} // end namespace itk

#endif
