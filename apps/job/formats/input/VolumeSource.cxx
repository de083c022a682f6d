// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeSource.h"

#include "InputVolume.h"
#include "ThreadedTasks.h"
#include "VoxelSource.h"

#include <chrono>
#include <cstddef>

namespace medialvoxel
{

/** \class VolumeSource::Lease
 * \brief A reader that no other thread has meanwhile. The one that was used last goes on, so that one thread reads
 * ahead in the file. */
class VolumeSource::Lease
{
public:
  explicit Lease(VolumeSource & source)
    : m_Source(source)
  {
    const std::lock_guard<std::mutex> lock(source.m_Mutex);
    if (source.m_FreeReaders.empty())
    {
      source.m_Readers.push_back(source.m_Readers.front()->MakeAnother());
      source.m_FreeReaders.push_back(source.m_Readers.back().get());
    }
    m_Reader = source.m_FreeReaders.back();
    source.m_FreeReaders.pop_back();
  }

  Lease(const Lease &) = delete;
  Lease &
  operator=(const Lease &) = delete;

  ~Lease()
  {
    const std::lock_guard<std::mutex> lock(m_Source.m_Mutex);
    m_Source.m_FreeReaders.push_back(m_Reader);
  }

  ValueReader *
  operator->() const
  {
    return m_Reader;
  }

private:
  VolumeSource & m_Source;
  ValueReader *  m_Reader;
};

VolumeSource::VolumeSource(const VolumeHeader & header, Interpolation interpolation, std::uint64_t bytesToKeep)
  : m_Header(header)
{
  m_Readers.push_back(MakeValueReader(header, interpolation, bytesToKeep));
  m_FreeReaders.push_back(m_Readers.front().get());
}

VolumeSource::~VolumeSource() = default;

itk::MedialVoxelValueType
VolumeSource::GetValueType() const
{
  return m_Header.GetValueType();
}

itk::MedialVoxelSourceThreads
VolumeSource::GetSourceThreads() const
{
  return InputVolume::IsReadInParallel(m_Header) ? itk::MedialVoxelSourceThreads::Several
                                                 : itk::MedialVoxelSourceThreads::Calling;
}

std::int64_t
VolumeSource::GetRowsReadTogether() const
{
  return m_Readers.front()->GetRowsReadTogether();
}

std::int64_t
VolumeSource::GetSlicesReadTogether() const
{
  const auto & chunks = m_Header.GetStored().chunks;
  return chunks ? static_cast<std::int64_t>(chunks->size[2]) : 1;
}

template <typename TFunction>
void
VolumeSource::MeasureReading(TFunction && function)
{
  const auto start = std::chrono::steady_clock::now();
  function();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double       before = m_ReadSeconds.load();
  while (!m_ReadSeconds.compare_exchange_weak(before, before + seconds))
  {
  }
}

void
VolumeSource::WithBox(const itk::MedialVoxelBox & box, const ViewFunction & function)
{
  const auto bytes = static_cast<std::size_t>(box.NumberOfVoxels()) * GetTraits(m_Header.GetValueType()).bytes;
  const std::unique_ptr<std::byte[]> values(new std::byte[bytes]);
  this->MeasureReading([&] { Lease(*this)->Read(box, values.get()); });
  function({ values.get(), { 1, box.Extent(0), box.Extent(0) * box.Extent(1) } });
}

void
VolumeSource::ForEachSpan(const itk::MedialVoxelBox & box, const SpanFunction & function)
{
  const Lease reader(*this);
  reader->ForEachSpan(box, [&](const itk::MedialVoxelBox & part) {
    ValueView view;
    this->MeasureReading([&] { view = reader->Look(part); });
    function(part, view);
  });
}

auto
VolumeSource::CutIntoSpans(const itk::MedialVoxelBox & box, std::size_t bytesPerVoxel) const -> Boxes
{
  return medialvoxel::CutIntoSpans(box, bytesPerVoxel, true);
}

void
VolumeSource::ForEach(const Boxes & boxes, unsigned int mostThreads, const Work & work)
{
  const bool isParallel = this->GetSourceThreads() == itk::MedialVoxelSourceThreads::Several;
  const auto most = !isParallel ? 1 : mostThreads > 0 ? mostThreads : static_cast<unsigned int>(boxes.size());
  RunInThreads(boxes.size(), [&](const std::size_t number) { work(boxes[number]); }, most);
}

std::uint64_t
VolumeSource::GetNumberOfBytesRead() const
{
  // All readers share the unpacked volume, and its bytes.
  if (const auto & unpacked = m_Header.GetStored().unpacked)
  {
    return unpacked->GetNumberOfBytesRead();
  }
  std::uint64_t bytes = 0;
  for (const auto & reader : m_Readers)
  {
    bytes += reader->GetNumberOfBytesRead();
  }
  return bytes;
}

} // end namespace medialvoxel
