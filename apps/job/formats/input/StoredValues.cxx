// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ValueReader.h"

#include "InputVolume.h"
#include "VolumeFormat.h"
#include "VoxelSource.h"

#include "itkMedialVoxelEngineClient.h"
#include "itkMultiThreaderBase.h"

#include <array>
#include <cstring>
#include <utility>
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

/** \class CopiedValues
 * \brief Reads parts into memory of its own: whole slices, as many as fit a megabyte, or rows of large slices where
 * several threads may read. */
template <typename TValue>
class CopiedValues : public ValueReader
{
public:
  explicit CopiedValues(bool isParallel)
    : m_IsParallel(isParallel)
  {}

  void
  ForEachSpan(const itk::MedialVoxelBox & box, const SpanFunction & function) const override
  {
    const auto parts = CutIntoSpans(box, sizeof(TValue), m_IsParallel);
    std::for_each(parts.begin(), parts.end(), function);
  }

  ValueView
  Look(const itk::MedialVoxelBox & part) override
  {
    m_Values.resize(static_cast<std::size_t>(part.NumberOfVoxels()));
    this->Read(part, m_Values.data());
    return { m_Values.data(), { 1, part.Extent(0), part.Extent(0) * part.Extent(1) } };
  }

private:
  bool                m_IsParallel;
  std::vector<TValue> m_Values;
};

/** \class StoredValues
 * \brief Values as they are in the file. */
template <typename TValue>
class StoredValues : public CopiedValues<TValue>
{
public:
  explicit StoredValues(const VolumeHeader & header)
    : CopiedValues<TValue>(InputVolume::IsReadInParallel(header))
    , m_Header(header)
    , m_Dimension(header.geometry.GetDimension())
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

  std::unique_ptr<ValueReader>
  MakeAnother() const override
  {
    return std::make_unique<StoredValues>(m_Header);
  }

private:
  VolumeHeader                      m_Header;
  unsigned int                      m_Dimension;
  itk::StreamingRawImageIO::Pointer m_ImageIO;
};

/** \class UnpackedValues
 * \brief Values of a compressed file. */
template <typename TValue>
class UnpackedValues : public CopiedValues<TValue>
{
public:
  UnpackedValues(const VolumeGeometry & geometry, std::shared_ptr<VoxelSource> source)
    : CopiedValues<TValue>(true)
    , m_Geometry(geometry)
    , m_Source(std::move(source))
  {}

  void
  Read(const itk::MedialVoxelBox & box, void * values) override
  {
    std::vector<std::uint64_t> index;
    std::vector<std::uint64_t> extent;
    for (unsigned int axis = 0; axis < m_Geometry.GetDimension(); ++axis)
    {
      index.push_back(static_cast<std::uint64_t>(box.lower[axis]));
      extent.push_back(static_cast<std::uint64_t>(box.Extent(axis)));
    }
    const itk::MedialVoxelFileRegion region(m_Geometry.size, index, extent, sizeof(TValue));
    auto *                           place = static_cast<char *>(values);
    for (std::uint64_t run = 0; run < region.GetNumberOfRuns(); ++run, place += region.GetBytesPerRun())
    {
      m_Source->Read(region.GetRunOffset(run), place, region.GetBytesPerRun());
    }
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Source->GetNumberOfBytesRead();
  }

  std::unique_ptr<ValueReader>
  MakeAnother() const override
  {
    return std::make_unique<UnpackedValues>(m_Geometry, m_Source);
  }

private:
  VolumeGeometry               m_Geometry;
  std::shared_ptr<VoxelSource> m_Source;
};

/** \class ScaledValues
 * \brief Values that are made of the numbers in the file. */
template <typename TStored>
class ScaledValues : public CopiedValues<double>
{
public:
  ScaledValues(const VolumeHeader & header, std::unique_ptr<ValueReader> reader)
    : CopiedValues<double>(InputVolume::IsReadInParallel(header))
    , m_Header(header)
    , m_Reader(std::move(reader))
  {}

  /** The numbers come to the end of the memory for the values, which overtake none of them. */
  void
  Read(const itk::MedialVoxelBox & box, void * values) override
  {
    const auto count = static_cast<std::size_t>(box.NumberOfVoxels());
    auto *     value = static_cast<char *>(values);
    auto *     number = value + count * (sizeof(double) - sizeof(TStored));
    m_Reader->Read(box, number);
    for (std::size_t i = 0; i < count; ++i, value += sizeof(double), number += sizeof(TStored))
    {
      TStored stored;
      std::memcpy(&stored, number, sizeof(TStored));
      const double scaled = m_Header.scale->slope * static_cast<double>(stored) + m_Header.scale->intercept;
      std::memcpy(value, &scaled, sizeof(double));
    }
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Reader->GetNumberOfBytesRead();
  }

  std::unique_ptr<ValueReader>
  MakeAnother() const override
  {
    return std::make_unique<ScaledValues>(m_Header, m_Reader->MakeAnother());
  }

private:
  VolumeHeader                 m_Header;
  std::unique_ptr<ValueReader> m_Reader;
};

/** A reader of the numbers in a file. */
std::unique_ptr<ValueReader>
OpenNumbers(const VolumeHeader & header, std::uint64_t bytesToKeep)
{
  if (header.format->input.makeChunkReader != nullptr)
  {
    return header.format->input.makeChunkReader(header, bytesToKeep);
  }
  return DispatchPixelType(header.pixelType, [&](auto zero) -> std::unique_ptr<ValueReader> {
    using Value = decltype(zero);
    if (header.compressed)
    {
      const auto source = header.unpacked ? header.unpacked : OpenVoxelSource(header);
      return std::make_unique<UnpackedValues<Value>>(header.geometry, source);
    }
    return std::make_unique<StoredValues<Value>>(header);
  });
}

/** A reader of a volume as its file describes it. */
std::unique_ptr<ValueReader>
OpenStoredValues(const VolumeHeader & header, std::uint64_t bytesToKeep)
{
  std::unique_ptr<ValueReader> numbers = OpenNumbers(header, bytesToKeep);
  if (!header.scale)
  {
    return numbers;
  }
  return DispatchPixelType(header.pixelType, [&](auto zero) -> std::unique_ptr<ValueReader> {
    return std::make_unique<ScaledValues<decltype(zero)>>(header, std::move(numbers));
  });
}

/** \class ResampledValues
 * \brief Values at equal spacing, made as doubles of the voxels of the file that have a share in them. */
template <typename TStored>
class ResampledValues : public CopiedValues<double>
{
public:
  ResampledValues(const VolumeHeader & header, Interpolation interpolation, std::unique_ptr<ValueReader> reader)
    : CopiedValues<double>(false)
    , m_Header(header)
    , m_Interpolation(interpolation)
    , m_Resampling(header, interpolation)
    , m_Reader(std::move(reader))
  {}

  void
  Read(const itk::MedialVoxelBox & box, void * values) override
  {
    const itk::MedialVoxelBox stored = this->GetStored(box);
    m_Stored.resize(static_cast<std::size_t>(stored.NumberOfVoxels()));
    m_Reader->Read(stored, m_Stored.data());
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
    return m_Reader->GetNumberOfBytesRead();
  }

  std::unique_ptr<ValueReader>
  MakeAnother() const override
  {
    return std::make_unique<ResampledValues>(m_Header, m_Interpolation, m_Reader->MakeAnother());
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
      const std::uint64_t last =
        axis == 0 ? m_Header.geometry.size[0] - 1 : static_cast<std::uint64_t>(box.upper[axis] - 1);
      const auto ends = m_Resampling.GetStored(axis, first, last);
      stored.lower[axis] = static_cast<std::int64_t>(ends[0]);
      stored.upper[axis] = static_cast<std::int64_t>(ends[1]) + 1;
    }
    return stored;
  }

  VolumeHeader                    m_Header;
  Interpolation                   m_Interpolation;
  Resampling                      m_Resampling;
  std::unique_ptr<ValueReader>    m_Reader;
  std::vector<TStored>            m_Stored; ///< of a box
  itk::MultiThreaderBase::Pointer m_Threader = itk::MultiThreaderBase::New();
};

} // namespace

std::vector<itk::MedialVoxelBox>
CutIntoSpans(const itk::MedialVoxelBox & box, std::size_t bytesPerVoxel, bool takesRows)
{
  const auto         bytesPerSlice = static_cast<std::uint64_t>(box.Extent(0) * box.Extent(1)) * bytesPerVoxel;
  const std::int64_t slices = takesRows && bytesPerSlice > InputVolume::SpanSize ? 1 : box.Extent(2);
  std::vector<itk::MedialVoxelBox> parts;
  for (itk::MedialVoxelBox some = box; some.lower[2] < box.upper[2]; some.lower[2] += slices)
  {
    some.upper[2] = some.lower[2] + slices;
    const auto pulls = itk::MedialVoxelValueSource::CutForPull(some, bytesPerVoxel);
    parts.insert(parts.end(), pulls.begin(), pulls.end());
  }
  return parts;
}

std::unique_ptr<ValueReader>
MakeValueReader(const VolumeHeader & header, Interpolation interpolation, std::uint64_t bytesToKeep)
{
  std::unique_ptr<ValueReader> reader = OpenStoredValues(header.GetStored(), bytesToKeep);
  if (!header.stored)
  {
    return reader;
  }
  return DispatchPixelType(header.stored->GetValueType(), [&](auto zero) -> std::unique_ptr<ValueReader> {
    return std::make_unique<ResampledValues<decltype(zero)>>(header, interpolation, std::move(reader));
  });
}

} // end namespace medialvoxel
