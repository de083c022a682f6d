// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFileRegion.h"

#include "itkMedialVoxelHoleFinder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

#if defined(__unix__) || defined(__APPLE__)
#  include <fcntl.h>
#  include <unistd.h>
#endif
#if defined(_POSIX_ADVISORY_INFO) && _POSIX_ADVISORY_INFO > 0
#  define MEDIALVOXEL_CAN_RESERVE
#endif

namespace itk
{
namespace
{

/** One request may have fewer bytes than some systems' limit of 2 GiB. */
constexpr std::uint64_t RequestSize = std::uint64_t{ 1 } << 30;

template <typename... TParts>
[[noreturn]] void
Fail(const TParts &... parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw std::runtime_error(message.str());
}

/** \class PositionedFile
 * \brief A file without a buffer, so that a short run does not read a whole buffer. */
class PositionedFile
{
public:
  PositionedFile(const std::filesystem::path & fileName, std::ios::openmode mode)
    : m_FileName(fileName)
    , m_Holes(fileName)
  {
    m_File.rdbuf()->pubsetbuf(nullptr, 0);
    m_File.open(fileName, mode | std::ios::binary);
    if (!m_File.is_open())
    {
      Fail("Cannot open ", fileName.string(), ": ", std::strerror(errno));
    }
  }

  /** Holes become zeros without a read. */
  void
  Read(std::uint64_t offset, char * data, std::uint64_t numberOfBytes)
  {
    for (std::uint64_t done = 0; done < numberOfBytes;)
    {
      const FileStretch stretch = m_Holes.Find(offset + done, numberOfBytes - done);
      if (stretch.isHole)
      {
        std::memset(data + done, 0, stretch.numberOfBytes);
      }
      else
      {
        this->ReadData(offset + done, data + done, stretch.numberOfBytes);
      }
      done += stretch.numberOfBytes;
    }
  }

  void
  Write(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes)
  {
    errno = 0;
    m_File.seekp(static_cast<std::streamoff>(offset));
    this->Transfer(numberOfBytes, [&](std::uint64_t done, std::streamsize count) { m_File.write(data + done, count); });
    if (!m_File.good())
    {
      Fail("Cannot write ", numberOfBytes, this->At(offset), ": ", std::strerror(errno));
    }
  }

  void
  Close()
  {
    errno = 0;
    m_File.close();
    if (m_File.fail())
    {
      Fail("Cannot complete the writing of ", m_FileName.string(), ": ", std::strerror(errno));
    }
  }

private:
  void
  ReadData(std::uint64_t offset, char * data, std::uint64_t numberOfBytes)
  {
    m_File.seekg(static_cast<std::streamoff>(offset));
    this->Transfer(numberOfBytes, [&](std::uint64_t done, std::streamsize count) { m_File.read(data + done, count); });
    if (!m_File.good())
    {
      Fail("Cannot read ", numberOfBytes, this->At(offset), ": the file ends early or the device fails");
    }
  }

  template <typename TRequest>
  void
  Transfer(std::uint64_t numberOfBytes, TRequest && request)
  {
    for (std::uint64_t done = 0; done < numberOfBytes && m_File.good(); done += RequestSize)
    {
      request(done, static_cast<std::streamsize>(std::min(RequestSize, numberOfBytes - done)));
    }
  }

  std::string
  At(std::uint64_t offset) const
  {
    return " bytes at offset " + std::to_string(offset) + " of " + m_FileName.string();
  }

  std::filesystem::path m_FileName;
  HoleFinder            m_Holes;
  std::fstream          m_File;
};

template <typename TUnsigned>
void
SwapRange(void * buffer, std::uint64_t numberOfBytes)
{
  auto * const bytes = static_cast<char *>(buffer);
  for (std::uint64_t position = 0; position < numberOfBytes; position += sizeof(TUnsigned))
  {
    TUnsigned value{};
    std::memcpy(&value, bytes + position, sizeof(value));
    TUnsigned swapped = 0;
    for (size_t byte = 0; byte < sizeof(value); ++byte)
    {
      swapped = static_cast<TUnsigned>((swapped << 8) | ((value >> (8 * byte)) & 0xFF));
    }
    std::memcpy(bytes + position, &swapped, sizeof(swapped));
  }
}

/** 0, or the number of the error. */
int
ReserveSpace([[maybe_unused]] const std::filesystem::path & fileName, [[maybe_unused]] std::uint64_t numberOfBytes)
{
#ifdef MEDIALVOXEL_CAN_RESERVE
  const int descriptor = open(fileName.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    return errno;
  }
  const int error = posix_fallocate(descriptor, 0, static_cast<off_t>(numberOfBytes));
  close(descriptor);
  // A file system that cannot reserve is asked again with every write.
  return error == EOPNOTSUPP || error == EINVAL ? 0 : error;
#else
  return 0;
#endif
}

} // namespace

MedialVoxelFileRegion::MedialVoxelFileRegion(const std::vector<std::uint64_t> & size,
                                             const std::vector<std::uint64_t> & index,
                                             const std::vector<std::uint64_t> & extent,
                                             std::uint64_t                      bytesPerVoxel)
  : m_BytesPerRun(bytesPerVoxel)
{
  bool          contiguous = true;
  std::uint64_t stride = bytesPerVoxel;
  for (size_t axis = 0; axis < size.size(); ++axis)
  {
    m_Start += index[axis] * stride;
    if (contiguous)
    {
      m_BytesPerRun *= extent[axis];
      contiguous = extent[axis] == size[axis];
    }
    else
    {
      m_Counts.push_back(extent[axis]);
      m_Strides.push_back(stride);
    }
    stride *= size[axis];
  }
}

std::uint64_t
MedialVoxelFileRegion::GetNumberOfRuns() const
{
  return std::accumulate(m_Counts.begin(), m_Counts.end(), std::uint64_t{ 1 }, std::multiplies<>());
}

std::uint64_t
MedialVoxelFileRegion::GetRunOffset(std::uint64_t run) const
{
  std::uint64_t offset = m_Start;
  for (size_t axis = 0; axis < m_Counts.size(); ++axis)
  {
    offset += (run % m_Counts[axis]) * m_Strides[axis];
    run /= m_Counts[axis];
  }
  return offset;
}

void
MedialVoxelFileRegion::Read(const std::vector<MedialVoxelFileSegment> & segments, void * buffer) const
{
  const std::uint64_t numberOfRuns = this->GetNumberOfRuns();
  std::uint64_t       segmentBegin = 0;
  std::uint64_t       run = 0;
  std::uint64_t       runDone = 0;
  auto *              destination = static_cast<char *>(buffer);
  for (const MedialVoxelFileSegment & segment : segments)
  {
    // Offsets of the runs grow, so each file is opened at most once, and only if a run reaches into it.
    const std::uint64_t segmentEnd = segmentBegin + segment.numberOfBytes;
    if (run < numberOfRuns && this->GetRunOffset(run) + runDone < segmentEnd)
    {
      PositionedFile file(segment.fileName, std::ios::in);
      while (run < numberOfRuns && this->GetRunOffset(run) + runDone < segmentEnd)
      {
        const std::uint64_t position = this->GetRunOffset(run) + runDone;
        const std::uint64_t count = std::min(m_BytesPerRun - runDone, segmentEnd - position);
        file.Read(segment.offset + (position - segmentBegin), destination, count);
        destination += count;
        runDone += count;
        if (runDone == m_BytesPerRun)
        {
          ++run;
          runDone = 0;
        }
      }
    }
    segmentBegin = segmentEnd;
  }
  if (run < numberOfRuns)
  {
    Fail("A region ends after the ", segmentBegin, " bytes of its volume");
  }
}

void
MedialVoxelFileRegion::Write(const MedialVoxelFileSegment & segment, const void * buffer) const
{
  PositionedFile      file(segment.fileName, std::ios::in | std::ios::out);
  const auto *        source = static_cast<const char *>(buffer);
  const std::uint64_t numberOfRuns = this->GetNumberOfRuns();
  for (std::uint64_t run = 0; run < numberOfRuns; ++run)
  {
    file.Write(segment.offset + this->GetRunOffset(run), source, m_BytesPerRun);
    source += m_BytesPerRun;
  }
  file.Close();
}

std::uint64_t
CheckedFileSize(const std::vector<std::uint64_t> & factors)
{
  constexpr auto limit = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  std::uint64_t  product = 1;
  for (const std::uint64_t factor : factors)
  {
    if (factor == 0 || product > limit / factor)
    {
      return 0;
    }
    product *= factor;
  }
  return product;
}

void
CreateFileOfSize(const std::filesystem::path & fileName, std::uint64_t numberOfBytes, bool reserve)
{
  PositionedFile(fileName, std::ios::out | std::ios::trunc).Close();
  const int       reserveError = reserve && numberOfBytes > 0 ? ReserveSpace(fileName, numberOfBytes) : 0;
  std::error_code error(reserveError, std::generic_category());
  if (!error)
  {
    std::filesystem::resize_file(fileName, numberOfBytes, error);
  }
  if (error)
  {
    std::error_code ignored;
    std::filesystem::remove(fileName, ignored);
    Fail("Cannot create ", fileName.string(), " with ", numberOfBytes, " bytes: ", error.message());
  }
}

void
SwapComponentBytes(void * buffer, std::uint64_t numberOfBytes, unsigned int bytesPerComponent)
{
  switch (bytesPerComponent)
  {
    case 2:
      return SwapRange<std::uint16_t>(buffer, numberOfBytes);
    case 4:
      return SwapRange<std::uint32_t>(buffer, numberOfBytes);
    case 8:
      return SwapRange<std::uint64_t>(buffer, numberOfBytes);
    default:
      return;
  }
}

bool
MachineIsBigEndian()
{
  const std::uint16_t one = 1;
  unsigned char       firstByte = 0;
  std::memcpy(&firstByte, &one, 1);
  return firstByte == 0;
}

} // end namespace itk
