// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelReaderPool_h
#define medialvoxelReaderPool_h

#include "ValueReader.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** \class ReaderPool
 * \brief Readers of a volume that streams, one for each thread that reads. */
class ReaderPool
{
public:
  ReaderPool(const VolumeHeader & header, Interpolation interpolation);

  /** Parts of a box that are read one after the other: slices, or rows where a slice is large and several threads read.
   */
  std::vector<itk::MedialVoxelBox>
  CutIntoParts(const itk::MedialVoxelBox & box) const;

  /** Reads a part and calls function(values), with values of the pixel type of the header. */
  template <typename TFunction>
  void
  Read(const itk::MedialVoxelBox & part, TFunction && function)
  {
    Lane lane = this->TakeLane();
    lane.values.resize(static_cast<std::size_t>(part.NumberOfVoxels()) * m_BytesPerVoxel);
    lane.reader->Read(part, lane.values.data());
    function(static_cast<const std::byte *>(lane.values.data()));
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_FreeLanes.push_back(std::move(lane));
  }

  bool
  IsParallel() const
  {
    return m_IsParallel;
  }

  std::uint64_t
  GetNumberOfBytesRead() const;

private:
  /** What a thread needs to read. */
  struct Lane
  {
    ValueReader *          reader{ nullptr };
    std::vector<std::byte> values; // of a part
  };

  /** The lane that was used last goes on, so that one thread reads ahead in the file. */
  Lane
  TakeLane();

  VolumeHeader                              m_Header;
  Interpolation                             m_Interpolation;
  std::size_t                               m_BytesPerVoxel;
  bool                                      m_IsParallel;
  std::mutex                                m_Mutex; // of what follows
  std::vector<std::unique_ptr<ValueReader>> m_Readers;
  std::vector<Lane>                         m_FreeLanes;
};

} // end namespace medialvoxel

#endif
