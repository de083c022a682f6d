// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelInflateReader_h
#define medialvoxelInflateReader_h

#include <cstdint>
#include <filesystem>
#include <memory>

namespace medialvoxel
{

/** \class InflateReader
 * \brief Unpacks a zlib or gzip stream of a file from front to back in bounded memory. */
class InflateReader
{
public:
  /** \param isBare the stream has neither the header nor the checksum of zlib or gzip
   * \throw JobError Failure when the file cannot be opened. */
  InflateReader(const std::filesystem::path & fileName, std::uint64_t offset, bool isBare = false);
  ~InflateReader();
  InflateReader(const InflateReader &) = delete;
  InflateReader &
  operator=(const InflateReader &) = delete;

  /** Unpacks exactly \a numberOfBytes. \throw JobError CorruptInput when the stream is damaged or ends early. */
  void
  Read(void * destination, std::uint64_t numberOfBytes);

  /** Unpacks \a numberOfBytes and drops them. */
  void
  Skip(std::uint64_t numberOfBytes);

  /** To be called after the last voxel: goes on to the end of the stream, where its checksum is compared.
   * \throw JobError CorruptInput as Read(), and when there is more to unpack. */
  void
  CheckEnd();

  /** Packed bytes read from the file so far. */
  std::uint64_t
  GetNumberOfBytesRead() const;

private:
  struct State;
  std::unique_ptr<State> m_State;
};

} // end namespace medialvoxel

#endif
