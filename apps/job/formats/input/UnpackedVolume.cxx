// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "UnpackedVolume.h"

#include "Zeros.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <new>
#include <vector>

namespace medialvoxel
{
namespace
{

/** Unpacked at once, between two looks whether to stop. */
constexpr std::uint64_t StepSize = std::uint64_t{ 1 } << 20;

/** Zeros are left out in blocks of this size. */
constexpr std::uint64_t BlockSize = std::uint64_t{ 1 } << 14;

} // namespace

UnpackedVolume::UnpackedVolume(const VolumeHeader &          header,
                               const std::filesystem::path & scratchFolder,
                               const ProgressSink &          sink)
  : m_Header(header)
  , m_NumberOfBytes(header.GetDataSize())
  , m_Sink(sink)
{
  if (scratchFolder.empty())
  {
    // Zeros take no memory before something is written.
    m_Memory.reset(static_cast<char *>(std::calloc(m_NumberOfBytes, 1)));
    if (!m_Memory)
    {
      throw std::bad_alloc();
    }
  }
  else
  {
    m_File.emplace(scratchFolder);
    m_File->SetSize(m_NumberOfBytes);
  }
  m_Thread = std::thread([this] { this->Unpack(); });
}

UnpackedVolume::~UnpackedVolume()
{
  m_IsStopped = true;
  m_Thread.join();
}

void
UnpackedVolume::Read(std::uint64_t offset, void * destination, std::uint64_t numberOfBytes)
{
  if (m_Done < offset + numberOfBytes)
  {
    this->WaitFor(offset + numberOfBytes);
  }
  if (m_File)
  {
    m_File->ReadAt(offset, destination, numberOfBytes);
    return;
  }
  std::memcpy(destination, m_Memory.get() + offset, numberOfBytes);
}

void
UnpackedVolume::Unpack()
try
{
  const auto        source = OpenVoxelSource(m_Header);
  std::vector<char> step;
  for (std::uint64_t begin = 0; begin < m_NumberOfBytes && !m_IsStopped; begin += step.size())
  {
    step.resize(std::min(StepSize, m_NumberOfBytes - begin));
    source->Read(begin, step.data(), step.size());
    this->Store(begin, step.data(), step.size());
    m_NumberOfBytesRead = source->GetNumberOfBytesRead();
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Done = begin + step.size();
    m_HasMore.notify_all();
  }
}
catch (...)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Error = std::current_exception();
  m_HasMore.notify_all();
}

void
UnpackedVolume::Store(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes)
{
  for (std::uint64_t begin = 0; begin < numberOfBytes; begin += BlockSize)
  {
    const std::uint64_t count = std::min(BlockSize, numberOfBytes - begin);
    if (IsAllZero(data + begin, count))
    {
      continue;
    }
    if (m_File)
    {
      m_File->WriteAt(offset + begin, data + begin, count);
      continue;
    }
    std::memcpy(m_Memory.get() + offset + begin, data + begin, count);
  }
}

void
UnpackedVolume::WaitFor(std::uint64_t end)
{
  constexpr auto               patience = std::chrono::milliseconds(100);
  std::unique_lock<std::mutex> lock(m_Mutex);
  while (m_Done < end)
  {
    if (m_Error)
    {
      std::rethrow_exception(m_Error);
    }
    m_HasMore.wait_for(lock, patience);
    lock.unlock();
    itk::MedialVoxelCheckAbort();
    ThrowIfStopRequested(m_Sink); // nobody polls in threads that measure before the engine runs
    lock.lock();
  }
}

VolumeHeader
UnpackVolume(const VolumeHeader & header, const std::filesystem::path & scratchFolder, const ProgressSink & sink)
{
  VolumeHeader unpacked = header;
  if (header.compressed)
  {
    VolumeHeader stored = header.GetStored();
    stored.unpacked = std::make_shared<UnpackedVolume>(stored, scratchFolder, sink);
    if (!header.stored)
    {
      return stored;
    }
    unpacked.stored = std::make_shared<const VolumeHeader>(stored);
  }
  return unpacked;
}

} // end namespace medialvoxel
