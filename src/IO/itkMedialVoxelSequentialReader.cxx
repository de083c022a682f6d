// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSequentialReader.h"

#include "itkMedialVoxelHoleFinder.h"

#include <algorithm>

namespace itk
{
namespace
{

#if defined(_POSIX_ADVISORY_INFO) && _POSIX_ADVISORY_INFO > 0

/** Linux cuts requests off at the read-ahead of the device, which is this much unless somebody changed it. */
constexpr std::uint64_t RequestSize = std::uint64_t{ 1 } << 17;

/** More would only displace other data from the cache. */
constexpr std::uint64_t MaximumReadAhead = std::uint64_t{ 1 } << 28;

/** Asks for a part of a file; a system that ignores it reads later. */
void
AskForPart(const std::filesystem::path & fileName, const std::uint64_t begin, const std::uint64_t end)
{
  const int descriptor = open(fileName.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    return;
  }
  HoleFinder holes(fileName);
  for (std::uint64_t position = begin; position < end;)
  {
    const FileStretch   stretch = holes.Find(position, end - position);
    const std::uint64_t stretchEnd = position + stretch.numberOfBytes;
    for (; position < stretchEnd && !stretch.isHole; position += RequestSize)
    {
      const std::uint64_t count = std::min(RequestSize, stretchEnd - position);
      posix_fadvise(descriptor, static_cast<off_t>(position), static_cast<off_t>(count), POSIX_FADV_WILLNEED);
    }
    position = stretchEnd;
  }
  close(descriptor);
}

/** Asks for bytes of a volume that lies in segments, as far as there are any. */
void
RequestReadAhead(const std::vector<MedialVoxelFileSegment> & segments,
                 const std::uint64_t                         begin,
                 const std::uint64_t                         numberOfBytes)
{
  const std::uint64_t end = begin + std::min(numberOfBytes, MaximumReadAhead);
  std::uint64_t       segmentBegin = 0;
  for (const MedialVoxelFileSegment & segment : segments)
  {
    const std::uint64_t first = std::max(begin, segmentBegin) - segmentBegin;
    const std::uint64_t last = std::min(std::max(end, segmentBegin) - segmentBegin, segment.numberOfBytes);
    if (first < last)
    {
      AskForPart(segment.fileName, segment.offset + first, segment.offset + last);
    }
    segmentBegin += segment.numberOfBytes;
  }
}

#else

void
RequestReadAhead(const std::vector<MedialVoxelFileSegment> &, std::uint64_t, std::uint64_t)
{}

#endif

} // namespace

void
MedialVoxelSequentialReader::Read(const MedialVoxelFileRegion &               region,
                                  const std::vector<MedialVoxelFileSegment> & segments,
                                  void *                                      buffer)
{
  region.Read(segments, buffer);
  m_NumberOfBytesRead += region.GetNumberOfBytes();
  const std::uint64_t begin = region.GetRunOffset(0);
  if (region.GetNumberOfRuns() == 1)
  {
    const std::uint64_t end = begin + region.GetBytesPerRun();
    if (begin == m_End)
    {
      RequestReadAhead(segments, end, end - begin);
    }
    m_End = end;
  }
}

} // end namespace itk
