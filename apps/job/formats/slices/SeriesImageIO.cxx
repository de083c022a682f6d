// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SeriesImageIO.h"

#include "HeaderParsing.h"
#include "SliceCache.h"
#include "SliceSeries.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace medialvoxel
{
namespace
{

/** Each thread decodes one, or copies from one, and the next thread may come back to the one before. */
std::size_t
GetCapacity(unsigned int threads)
{
  return threads + 1;
}

/** \class SeriesImageIO
 * \brief The reader of MakeSeriesImageIO(). */
class SeriesImageIO : public itk::StreamingRawImageIO
{
public:
  using Self = SeriesImageIO;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  void
  SetSeries(std::shared_ptr<const SliceSeries> series)
  {
    m_Series = std::move(series);
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_NumberOfBytesRead;
  }

  /** Slices are checked when they are read. */
  void
  ReadImageInformation() override
  {}

  void
  Read(void * buffer) override
  {
    const itk::ImageIORegion & region = this->GetIORegion();
    const bool                 isVolume = region.GetImageDimension() > 2;
    const auto                 first = isVolume ? static_cast<std::uint64_t>(region.GetIndex(2)) : 0;
    const std::uint64_t        count = isVolume ? region.GetSize(2) : 1;
    auto *                     destination = static_cast<char *>(buffer);
    for (std::uint64_t number = first; number < first + count; ++number)
    {
      destination = this->CopyRegion(*this->GetSlice(number), region, destination);
    }
  }

private:
  SliceCache::Slice
  GetSlice(std::uint64_t number)
  {
    const SliceHeader & header = m_Series->slices[number];
    const std::size_t   capacity = GetCapacity(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads());
    return m_Series->cache->Get(number, capacity, [&]() -> SliceCache::Slice {
      auto voxels = std::make_shared<std::vector<char>>(header.GetDataSize());
      try
      {
        m_Series->format->readVoxels(header, voxels->data());
      }
      catch (const HeaderError & error)
      {
        Fail(ExitStatus::CorruptInput, error.what());
      }
      std::error_code unknown;
      const auto      bytes = std::filesystem::file_size(header.fileName, unknown);
      m_NumberOfBytesRead += unknown ? 0 : bytes;
      return voxels;
    });
  }

  /** \return the end of the written values */
  char *
  CopyRegion(const std::vector<char> & slice, const itk::ImageIORegion & region, char * destination) const
  {
    const std::uint64_t bytes = this->GetComponentSize();
    const std::uint64_t bytesPerRow = this->GetDimensions(0) * bytes;
    const std::uint64_t bytesToCopy = region.GetSize(0) * bytes;
    const char *        source = slice.data() + static_cast<std::uint64_t>(region.GetIndex(1)) * bytesPerRow +
                          static_cast<std::uint64_t>(region.GetIndex(0)) * bytes;
    for (std::uint64_t row = 0; row < region.GetSize(1); ++row)
    {
      std::memcpy(destination, source, bytesToCopy);
      source += bytesPerRow;
      destination += bytesToCopy;
    }
    return destination;
  }

  std::shared_ptr<const SliceSeries> m_Series;
  std::uint64_t                      m_NumberOfBytesRead{ 0 };
};

} // namespace

itk::StreamingRawImageIO::Pointer
MakeSeriesImageIO(const VolumeHeader & header)
{
  const auto imageIO = SeriesImageIO::New();
  imageIO->SetSeries(header.series);
  return imageIO.GetPointer();
}

std::uint64_t
GetSeriesMemory(const VolumeHeader & header, unsigned int threads)
{
  const SliceSeries & series = *header.series;
  std::uint64_t       decoderMemory = 0;
  for (const SliceHeader & slice : series.slices)
  {
    decoderMemory = std::max(decoderMemory, slice.decoderMemory);
  }
  // A thread may still copy from a slice that is no longer kept.
  const std::uint64_t slices =
    std::min<std::uint64_t>(GetCapacity(threads) + threads - 1, series.slices.size() + threads);
  return series.format->libraryMemory + slices * series.slices.front().GetDataSize() + threads * decoderMemory;
}

} // end namespace medialvoxel
