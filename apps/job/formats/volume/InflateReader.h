// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInflateReader_h
#define medialvoxelInflateReader_h

#include "VolumeHeader.h"
#include "VoxelStream.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace medialvoxel
{

/** \class InflateReader
 * \brief Unpacks a zlib or gzip stream of a file from front to back in bounded memory. */
class InflateReader : public VoxelStream
{
public:
  /** \param isBare the stream has neither the header nor the checksum of zlib or gzip
   * \throw JobError Failure when the file cannot be opened. */
  InflateReader(const std::filesystem::path & fileName, std::uint64_t offset, bool isBare = false);
  ~InflateReader() override;
  InflateReader(const InflateReader &) = delete;
  InflateReader &
  operator=(const InflateReader &) = delete;

  void
  Read(void * destination, std::uint64_t numberOfBytes) override;

  /** Unpacks \a numberOfBytes and drops them. */
  void
  Skip(std::uint64_t numberOfBytes);

  /** Goes on to the end of the stream, where its checksum is compared.
   * \throw JobError CorruptInput as Read(), and when there is more to unpack. */
  void
  CheckEnd() override;

  std::uint64_t
  GetNumberOfBytesRead() const override;

private:
  struct State;
  std::unique_ptr<State> m_State;
};

/** Opens a volume that ReadVolumeHeader() has checked, whose voxels are one stream, packed by zlib or gzip. */
std::unique_ptr<VoxelStream>
OpenInflatedStream(const VolumeHeader & header);

} // end namespace medialvoxel

#endif
