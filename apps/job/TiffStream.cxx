// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "TiffCodecs.h"
#include "TiffStack.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class TiffStream
 * \brief Unpacks one strip after the other. */
class TiffStream : public VoxelStream
{
public:
  explicit TiffStream(const std::filesystem::path & fileName)
    : m_Stack(ReadTiffStack(fileName))
    , m_File(OpenRegularFile(fileName))
  {}

  void
  Read(void * destination, std::uint64_t numberOfBytes) override
  {
    auto * position = static_cast<unsigned char *>(destination);
    while (numberOfBytes > 0)
    {
      if (m_Done == m_Unpacked.size())
      {
        this->NextStrip();
      }
      const std::uint64_t count = std::min<std::uint64_t>(numberOfBytes, m_Unpacked.size() - m_Done);
      position = std::copy_n(m_Unpacked.data() + m_Done, count, position);
      m_Done += count;
      numberOfBytes -= count;
    }
  }

  void
  CheckEnd() override
  {}

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

private:
  void
  NextStrip()
  {
    const TiffStrip & strip = m_Stack.strips.at(m_NextStrip++);
    m_Packed.resize(strip.packedBytes);
    m_File.seekg(static_cast<std::streamoff>(strip.offset));
    m_File.read(reinterpret_cast<char *>(m_Packed.data()), static_cast<std::streamsize>(m_Packed.size()));
    if (!m_File.good())
    {
      Fail(ExitStatus::CorruptInput, m_Stack.fileName.string(), ": its compressed voxels end early");
    }
    m_BytesRead += strip.packedBytes;
    m_Unpacked.assign(strip.bytes, 0);
    m_Done = 0;
    if (!this->Unpack())
    {
      Fail(ExitStatus::CorruptInput,
           m_Stack.fileName.string(),
           ": its compressed voxels are damaged or end early at offset ",
           strip.offset);
    }
    if (m_Stack.differences)
    {
      SumDifferences(m_Unpacked, m_Stack.width, GetTraits(m_Stack.pixelType).bytes, m_Stack.bigEndian);
    }
  }

  bool
  Unpack()
  {
    switch (m_Stack.compression)
    {
      case TiffCompression::Lzw:
        return UnpackLzw(m_Packed, m_Unpacked);
      case TiffCompression::PackBits:
        return UnpackPackBits(m_Packed, m_Unpacked);
      default:
        return UnpackDeflate(m_Packed, m_Unpacked);
    }
  }

  TiffStack                  m_Stack;
  std::ifstream              m_File;
  size_t                     m_NextStrip{ 0 };
  std::vector<unsigned char> m_Packed;
  std::vector<unsigned char> m_Unpacked;
  std::uint64_t              m_Done{ 0 };
  std::uint64_t              m_BytesRead{ 0 };
};

} // namespace

std::unique_ptr<VoxelStream>
OpenTiffStream(const std::filesystem::path & fileName)
{
  return std::make_unique<TiffStream>(fileName);
}

} // end namespace medialvoxel
