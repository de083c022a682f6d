// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ReaderPool.h"

#include "InputVolume.h"

#include "itkMedialVoxelEngineClient.h"

namespace medialvoxel
{

ReaderPool::ReaderPool(const VolumeHeader & header, Interpolation interpolation)
  : m_Header(header)
  , m_Interpolation(interpolation)
  , m_BytesPerVoxel(GetTraits(header.pixelType).bytes)
  , m_IsParallel(InputVolume::IsReadInParallel(header))
{
  m_Readers.push_back(MakeValueReader(m_Header, m_Interpolation));
  m_FreeLanes.push_back({ m_Readers.front().get(), {} });
}

std::vector<itk::MedialVoxelBox>
ReaderPool::CutIntoParts(const itk::MedialVoxelBox & box) const
{
  const auto bytesPerSlice = static_cast<std::uint64_t>(box.Extent(0) * box.Extent(1)) * m_BytesPerVoxel;
  if (!m_IsParallel || bytesPerSlice <= InputVolume::BytesPerPart)
  {
    return itk::MedialVoxelEngineClient::CutForPull(box, m_BytesPerVoxel);
  }
  std::vector<itk::MedialVoxelBox> parts;
  for (itk::MedialVoxelBox slice = box; slice.lower[2] < box.upper[2]; ++slice.lower[2])
  {
    slice.upper[2] = slice.lower[2] + 1;
    const auto rows = itk::MedialVoxelEngineClient::CutForPull(slice, m_BytesPerVoxel);
    parts.insert(parts.end(), rows.begin(), rows.end());
  }
  return parts;
}

std::uint64_t
ReaderPool::GetNumberOfBytesRead() const
{
  std::uint64_t bytes = 0;
  for (const auto & reader : m_Readers)
  {
    bytes += reader->GetNumberOfBytesRead();
  }
  return bytes;
}

auto
ReaderPool::TakeLane() -> Lane
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (m_FreeLanes.empty())
  {
    m_Readers.push_back(MakeValueReader(m_Header, m_Interpolation));
    return { m_Readers.back().get(), {} };
  }
  Lane lane = std::move(m_FreeLanes.back());
  m_FreeLanes.pop_back();
  return lane;
}

} // end namespace medialvoxel
