// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelHoleFinder_h
#define itkMedialVoxelHoleFinder_h

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <limits>

#if defined(__unix__) || defined(__APPLE__)
#  include <fcntl.h>
#  include <unistd.h>
#endif

namespace itk
{

/** Requests for less are read without asking for holes. */
constexpr std::uint64_t MinimumHoleSize = std::uint64_t{ 1 } << 16;

/** Bytes of a file that are alike: in a hole, which reads as zeros, or not. */
struct FileStretch
{
  bool          isHole{ false };
  std::uint64_t numberOfBytes{ 0 };
};

/** \class HoleFinder
 * \brief Finds bytes of a file that lie in holes, where the system knows: reading them would fill its cache. */
class HoleFinder
{
public:
  explicit HoleFinder(const std::filesystem::path & fileName)
    : m_FileName(fileName)
  {}
  HoleFinder(const HoleFinder &) = delete;
  HoleFinder &
  operator=(const HoleFinder &) = delete;

#ifdef SEEK_HOLE
  ~HoleFinder()
  {
    if (m_Descriptor >= 0)
    {
      close(m_Descriptor);
    }
  }

  /** The stretch at an offset, cut off after a number of bytes. */
  FileStretch
  Find(std::uint64_t offset, std::uint64_t numberOfBytes)
  {
    if (numberOfBytes < MinimumHoleSize || !this->Open())
    {
      return { false, numberOfBytes };
    }
    if (offset < m_DataBegin || offset >= m_DataEnd)
    {
      m_DataBegin = this->Seek(offset, SEEK_DATA);
      m_DataEnd = this->Seek(m_DataBegin, SEEK_HOLE);
    }
    const bool          isHole = offset < m_DataBegin;
    const std::uint64_t end = isHole ? m_DataBegin : m_DataEnd;
    // Reading will report an offset behind the end of the file.
    return { isHole, end > offset ? std::min(numberOfBytes, end - offset) : numberOfBytes };
  }

private:
  bool
  Open()
  {
    if (m_Descriptor < 0)
    {
      m_Descriptor = open(m_FileName.c_str(), O_RDONLY | O_CLOEXEC);
    }
    return m_Descriptor >= 0;
  }

  /** The next hole or data after an offset; the end of the file, but not less than the offset, when there is none. */
  std::uint64_t
  Seek(std::uint64_t offset, int what) const
  {
    off_t found = lseek(m_Descriptor, static_cast<off_t>(offset), what);
    if (found < 0 && errno == ENXIO)
    {
      found = lseek(m_Descriptor, 0, SEEK_END);
    }
    else if (found < 0 && what == SEEK_HOLE)
    {
      // Nothing is known of holes: the rest is read.
      found = std::numeric_limits<off_t>::max();
    }
    return std::max(offset, static_cast<std::uint64_t>(std::max<off_t>(found, 0)));
  }

  int           m_Descriptor{ -1 };
  std::uint64_t m_DataBegin{ 0 };
  std::uint64_t m_DataEnd{ 0 };
#else
  FileStretch
  Find(std::uint64_t, std::uint64_t numberOfBytes) const
  {
    return { false, numberOfBytes };
  }

private:
#endif
  std::filesystem::path m_FileName;
};

} // end namespace itk

#endif
