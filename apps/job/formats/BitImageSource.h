// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelBitImageSource_h
#define medialvoxelBitImageSource_h

#include "BitStore.h"
#include "ImageGeometry.h"

#include "itkImage.h"
#include "itkImageSource.h"

namespace medialvoxel
{

/** Writes 0 or 1 for \a count voxels of the store, from \a firstVoxel on. */
void
ExpandBits(const BitStore & bits, std::uint64_t firstVoxel, std::uint64_t count, unsigned char * pixels);

/** \class BitImageSource
 * \brief The start of a pipeline: an image of zeros and ones, any region of which is made from a BitStore. */
template <unsigned int VDimension>
class BitImageSource : public itk::ImageSource<itk::Image<unsigned char, VDimension>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(BitImageSource);

  using Self = BitImageSource;
  using ImageType = itk::Image<unsigned char, VDimension>;
  using Superclass = itk::ImageSource<ImageType>;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(BitImageSource);
#else
  itkTypeMacro(BitImageSource, ImageSource);
#endif

  void
  SetGeometry(const VolumeGeometry & geometry)
  {
    m_Geometry = geometry;
    this->Modified();
  }

  /** The store must outlive the source and hold all voxels before the first update. */
  void
  SetBits(const BitStore & bits)
  {
    m_Bits = &bits;
    this->Modified();
  }

protected:
  BitImageSource() = default;
  ~BitImageSource() override = default;

  void
  GenerateOutputInformation() override
  {
    SetImageGeometry(m_Geometry, *this->GetOutput());
  }

  void
  GenerateData() override
  {
    ImageType & output = *this->GetOutput();
    output.SetBufferedRegion(output.GetRequestedRegion());
    output.Allocate();
    const auto          region = output.GetBufferedRegion();
    const std::uint64_t rowLength = region.GetSize(0);
    const std::uint64_t numberOfRows = rowLength == 0 ? 0 : region.GetNumberOfPixels() / rowLength;
    unsigned char *     pixels = output.GetBufferPointer();
    // Rows that follow each other in the store are expanded together.
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    for (std::uint64_t row = 0; row < numberOfRows; ++row)
    {
      const std::uint64_t begin = this->GetFirstVoxel(region, row);
      if (begin != first + count)
      {
        ExpandBits(*m_Bits, first, count, pixels);
        pixels += count;
        first = begin;
        count = 0;
      }
      count += rowLength;
    }
    ExpandBits(*m_Bits, first, count, pixels);
  }

private:
  /** Number in the whole volume of the voxel that a row of a region begins with. */
  std::uint64_t
  GetFirstVoxel(const typename ImageType::RegionType & region, std::uint64_t row) const
  {
    auto          voxel = static_cast<std::uint64_t>(region.GetIndex(0));
    std::uint64_t stride = m_Geometry.size[0];
    for (unsigned int axis = 1; axis < VDimension; ++axis)
    {
      voxel += (static_cast<std::uint64_t>(region.GetIndex(axis)) + row % region.GetSize(axis)) * stride;
      row /= region.GetSize(axis);
      stride *= m_Geometry.size[axis];
    }
    return voxel;
  }

  VolumeGeometry   m_Geometry;
  const BitStore * m_Bits{ nullptr };
};

} // end namespace medialvoxel

#endif
