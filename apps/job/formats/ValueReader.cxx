// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ValueReader.h"

#include "VolumeFormats.h"

#include "itkMultiThreaderBase.h"

#include <array>
#include <vector>

namespace medialvoxel
{
namespace
{

itk::StreamingRawImageIO::Pointer
OpenImageIO(const VolumeHeader & header)
{
  const itk::StreamingRawImageIO::Pointer imageIO = header.format->input.makeReader(header);
  const unsigned int                      dimension = header.geometry.GetDimension();
  imageIO->SetNumberOfDimensions(dimension);
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    imageIO->SetDimensions(axis, header.geometry.size[axis]);
  }
  imageIO->SetComponentType(DispatchPixelType(
    header.pixelType, [](auto zero) { return itk::ImageIOBase::MapPixelType<decltype(zero)>::CType; }));
  imageIO->SetHeaderSize(static_cast<itk::ImageIOBase::SizeType>(header.dataOffset));
  imageIO->SetRefuseTrailingBytes(false);
  imageIO->SetSegments(header.segments);
  imageIO->SetByteOrder(header.bigEndian ? itk::IOByteOrderEnum::BigEndian : itk::IOByteOrderEnum::LittleEndian);
  imageIO->SetFileName(header.dataFile.string());
  imageIO->ReadImageInformation();
  return imageIO;
}

/** \class StoredValues
 * \brief Values as they are in the file. */
class StoredValues : public ValueReader
{
public:
  explicit StoredValues(const VolumeHeader & header)
    : m_Dimension(header.geometry.GetDimension())
    , m_ImageIO(OpenImageIO(header))
  {}

  void
  Read(const itk::MedialVoxelBox & box, void * values) override
  {
    itk::ImageIORegion region(m_Dimension);
    for (unsigned int axis = 0; axis < m_Dimension; ++axis)
    {
      region.SetIndex(axis, static_cast<itk::IndexValueType>(box.lower[axis]));
      region.SetSize(axis, static_cast<itk::SizeValueType>(box.Extent(axis)));
    }
    m_ImageIO->SetIORegion(region);
    m_ImageIO->Read(values);
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_ImageIO->GetNumberOfBytesRead();
  }

private:
  unsigned int                      m_Dimension;
  itk::StreamingRawImageIO::Pointer m_ImageIO;
};

/** \class ResampledValues
 * \brief Values at equal spacing, made as doubles of the voxels of the file that have a share in them. */
template <typename TStored>
class ResampledValues : public ValueReader
{
public:
  ResampledValues(const VolumeHeader & header, Interpolation interpolation)
    : m_LastX(header.geometry.size[0] - 1)
    , m_Resampling(header, interpolation)
    , m_Reader(*header.stored)
  {}

  void
  Read(const itk::MedialVoxelBox & box, void * values) override
  {
    const itk::MedialVoxelBox stored = this->GetStored(box);
    m_Stored.resize(static_cast<std::size_t>(stored.NumberOfVoxels()));
    m_Reader.Read(stored, m_Stored.data());
    const auto rowOf = [&](std::uint64_t y, std::uint64_t z) {
      return m_Stored.data() + stored.OffsetOf({ { 0, static_cast<std::int64_t>(y), static_cast<std::int64_t>(z) } });
    };
    const auto rowsOfSlice = static_cast<std::uint64_t>(box.Extent(1));
    const auto makeRow = [&](std::uint64_t row) {
      m_Resampling.MakeRow(rowOf,
                           static_cast<std::uint64_t>(box.lower[1]) + row % rowsOfSlice,
                           static_cast<std::uint64_t>(box.lower[2]) + row / rowsOfSlice,
                           static_cast<std::uint64_t>(box.lower[0]),
                           static_cast<std::uint64_t>(box.upper[0]),
                           static_cast<double *>(values) + row * static_cast<std::uint64_t>(box.Extent(0)));
    };
    m_Threader->ParallelizeArray(0, rowsOfSlice * static_cast<std::uint64_t>(box.Extent(2)), makeRow, nullptr);
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Reader.GetNumberOfBytesRead();
  }

private:
  /** The voxels of the file that a box is made of, in whole rows, so that each has a first voxel. */
  itk::MedialVoxelBox
  GetStored(const itk::MedialVoxelBox & box) const
  {
    itk::MedialVoxelBox stored;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const std::uint64_t first = axis == 0 ? 0 : static_cast<std::uint64_t>(box.lower[axis]);
      const std::uint64_t last = axis == 0 ? m_LastX : static_cast<std::uint64_t>(box.upper[axis] - 1);
      const auto          ends = m_Resampling.GetStored(axis, first, last);
      stored.lower[axis] = static_cast<std::int64_t>(ends[0]);
      stored.upper[axis] = static_cast<std::int64_t>(ends[1]) + 1;
    }
    return stored;
  }

  std::uint64_t                   m_LastX;
  Resampling                      m_Resampling;
  StoredValues                    m_Reader;
  std::vector<TStored>            m_Stored; ///< of a box
  itk::MultiThreaderBase::Pointer m_Threader = itk::MultiThreaderBase::New();
};

} // namespace

std::unique_ptr<ValueReader>
MakeValueReader(const VolumeHeader & header, Interpolation interpolation)
{
  if (!header.stored)
  {
    return std::make_unique<StoredValues>(header);
  }
  return DispatchPixelType(header.stored->pixelType, [&](auto zero) -> std::unique_ptr<ValueReader> {
    return std::make_unique<ResampledValues<decltype(zero)>>(header, interpolation);
  });
}

} // end namespace medialvoxel
