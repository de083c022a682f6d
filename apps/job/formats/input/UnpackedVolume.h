// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelUnpackedVolume_h
#define medialvoxelUnpackedVolume_h

#include "Progress.h"
#include "ScratchFile.h"
#include "VoxelSource.h"

#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace medialvoxel
{

/** \class UnpackedVolume
 * \brief Unpacks a volume once, in a thread of its own, for readers of any part.
 *
 * Readers wait for voxels that are not unpacked yet. Zeros take neither memory nor disk. */
class UnpackedVolume : public VoxelSource
{
public:
  /** \param scratchFolder of a file without a name that keeps the numbers; empty: they are in memory
   * \param sink asked by readers that wait
   * \throw JobError Refused when the folder cannot be written. */
  UnpackedVolume(const VolumeHeader & header, const std::filesystem::path & scratchFolder, const ProgressSink & sink);

  /** Stops unpacking. */
  ~UnpackedVolume() override;

  /** From any thread. \throw StoppedBySignal when the sink asks to stop; JobError as the base class, and Failure when
   * the scratch file fails */
  void
  Read(std::uint64_t offset, void * destination, std::uint64_t numberOfBytes) override;

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_NumberOfBytesRead;
  }

private:
  struct Freer
  {
    void
    operator()(char * memory) const
    {
      std::free(memory);
    }
  };

  void
  Unpack();

  void
  Store(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes);

  void
  WaitFor(std::uint64_t end);

  VolumeHeader                   m_Header;
  std::uint64_t                  m_NumberOfBytes;
  const ProgressSink &           m_Sink;
  std::unique_ptr<char[], Freer> m_Memory;
  std::optional<ScratchFile>     m_File; ///< in place of memory
  std::atomic<std::uint64_t>     m_NumberOfBytesRead{ 0 };
  std::atomic<std::uint64_t>     m_Done{ 0 }; ///< bytes that can be read
  std::atomic<bool>              m_IsStopped{ false };
  std::mutex                     m_Mutex;
  std::condition_variable        m_HasMore;
  std::exception_ptr             m_Error;
  std::thread                    m_Thread; ///< ends before the members that it uses
};

/** The same volume, and compressed, whose numbers are being unpacked; others stay as they are. Arguments as of
 * UnpackedVolume; the sink must outlive the reading. */
VolumeHeader
UnpackVolume(const VolumeHeader & header, const std::filesystem::path & scratchFolder, const ProgressSink & sink);

} // end namespace medialvoxel

#endif
