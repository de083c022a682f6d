// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFileStart_h
#define medialvoxelFileStart_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <streambuf>

namespace medialvoxel
{

/** \class FileStart
 * \brief The first bytes of a file as a stream: GDCM would believe what follows the image to be elements. */
class FileStart : public std::streambuf
{
public:
  FileStart(const char * fileName, std::uint64_t end)
    : m_End(static_cast<std::streamoff>(end))
  {
    m_File.open(fileName, std::ios::in | std::ios::binary);
  }

protected:
  int_type
  underflow() override
  {
    const std::streamoff wanted = std::min<std::streamoff>(static_cast<std::streamoff>(m_Bytes.size()), m_End - m_Next);
    const std::streamsize found = wanted > 0 ? m_File.sgetn(m_Bytes.data(), wanted) : 0;
    m_Next += found;
    setg(m_Bytes.data(), m_Bytes.data(), m_Bytes.data() + found);
    return found > 0 ? traits_type::to_int_type(m_Bytes.front()) : traits_type::eof();
  }

  pos_type
  seekoff(off_type offset, std::ios::seekdir from, std::ios::openmode which) override
  {
    const std::streamoff here = m_Next - (egptr() - gptr());
    const std::streamoff base = from == std::ios::beg ? 0 : (from == std::ios::cur ? here : m_End);
    return this->seekpos(base + offset, which);
  }

  pos_type
  seekpos(pos_type position, std::ios::openmode) override
  {
    const std::streamoff target = position;
    if (target < 0 || target > m_End)
    {
      return pos_type(off_type(-1));
    }
    const std::streamoff begin = m_Next - (egptr() - eback());
    if (target >= begin && target < m_Next)
    {
      setg(eback(), eback() + (target - begin), egptr());
      return position;
    }
    setg(m_Bytes.data(), m_Bytes.data(), m_Bytes.data());
    m_Next = target;
    return m_File.pubseekpos(position, std::ios::in) == position ? position : pos_type(off_type(-1));
  }

private:
  std::filebuf              m_File;
  std::streamoff            m_End;
  std::streamoff            m_Next{ 0 }; ///< of the file, behind what is in memory
  std::array<char, 1 << 16> m_Bytes{};
};

} // end namespace medialvoxel

#endif
