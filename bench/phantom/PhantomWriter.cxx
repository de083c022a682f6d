// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "PhantomWriter.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace phantom
{
namespace
{
bool
IsBigEndian()
{
  const std::uint16_t one = 1;
  unsigned char       first;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

template <typename TPixel>
bool
Holds(double value)
{
  return value >= static_cast<double>(std::numeric_limits<TPixel>::lowest()) &&
         value <= static_cast<double>(std::numeric_limits<TPixel>::max()) &&
         (!std::numeric_limits<TPixel>::is_integer || value == std::floor(value));
}

bool
HoldsAs(PixelType type, double value)
{
  return type == PixelType::UInt8    ? Holds<std::uint8_t>(value)
         : type == PixelType::UInt16 ? Holds<std::uint16_t>(value)
                                     : Holds<float>(value);
}

std::string
MetaImageHeader(const OutputParameters & p, const Size & size)
{
  const char *       types[] = { "MET_UCHAR", "MET_USHORT", "MET_FLOAT" };
  std::ostringstream header;
  header.precision(17);
  header << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = "
         << (IsBigEndian() ? "True" : "False") << "\nCompressedData = False\nElementSpacing = " << p.spacing.x << ' '
         << p.spacing.y << ' ' << p.spacing.z << "\nDimSize = " << size[0] << ' ' << size[1] << ' ' << size[2]
         << "\nElementType = " << types[static_cast<int>(p.type)] << "\nElementDataFile = LOCAL\n";
  return header.str();
}

std::string
NrrdHeader(const OutputParameters & p, const Size & size)
{
  const char *       types[] = { "uint8", "uint16", "float" };
  std::ostringstream header;
  header.precision(17);
  header << "NRRD0004\ntype: " << types[static_cast<int>(p.type)]
         << "\ndimension: 3\nspace dimension: 3\nsizes: " << size[0] << ' ' << size[1] << ' ' << size[2]
         << "\nspace directions: (" << p.spacing.x << ",0,0) (0," << p.spacing.y << ",0) (0,0," << p.spacing.z
         << ")\nspace origin: (0,0,0)\nkinds: domain domain domain\nendian: " << (IsBigEndian() ? "big" : "little")
         << "\nencoding: raw\n\n";
  return header.str();
}

std::string
HeaderOf(const OutputParameters & parameters, const Size & size)
{
  const std::string extension = std::filesystem::path(parameters.fileName).extension().string();
  if (extension == ".raw")
  {
    return {};
  }
  if (extension == ".mha")
  {
    return MetaImageHeader(parameters, size);
  }
  if (extension == ".nrrd")
  {
    return NrrdHeader(parameters, size);
  }
  throw std::invalid_argument("\"" + parameters.fileName + "\": the extension must be .raw, .mha or .nrrd");
}
} // namespace

VolumeWriter::VolumeWriter(const OutputParameters & parameters, const Size & size)
  : m_Parameters(parameters)
{
  const std::string header = HeaderOf(parameters, size);
  if (!HoldsAs(parameters.type, parameters.background) || !HoldsAs(parameters.type, parameters.object))
  {
    throw std::invalid_argument("the pixel type cannot hold the background or object value");
  }
  m_File.reset(std::fopen(parameters.fileName.c_str(), "wb"));
  if (!m_File)
  {
    Fail();
  }
  Write(header.data(), header.size());
}

void
VolumeWriter::Append(const std::vector<unsigned char> & mask)
{
  switch (m_Parameters.type)
  {
    case PixelType::UInt8:
      return AppendAs<std::uint8_t>(mask);
    case PixelType::UInt16:
      return AppendAs<std::uint16_t>(mask);
    case PixelType::Float32:
      return AppendAs<float>(mask);
  }
}

void
VolumeWriter::Close()
{
  if (std::fclose(m_File.release()) != 0)
  {
    Fail();
  }
}

template <typename TPixel>
void
VolumeWriter::AppendAs(const std::vector<unsigned char> & mask)
{
  constexpr std::size_t chunk = 1 << 16;
  const TPixel values[2] = { static_cast<TPixel>(m_Parameters.background), static_cast<TPixel>(m_Parameters.object) };
  std::vector<TPixel> pixels(chunk);
  for (std::size_t begin = 0; begin < mask.size(); begin += chunk)
  {
    const std::size_t count = std::min(chunk, mask.size() - begin);
    std::transform(mask.begin() + static_cast<std::ptrdiff_t>(begin),
                   mask.begin() + static_cast<std::ptrdiff_t>(begin + count),
                   pixels.begin(),
                   [&values](unsigned char inside) { return values[inside]; });
    Write(pixels.data(), count * sizeof(TPixel));
  }
}

void
VolumeWriter::Write(const void * bytes, std::size_t count)
{
  if (std::fwrite(bytes, 1, count, m_File.get()) != count)
  {
    Fail();
  }
}

void
VolumeWriter::Fail() const
{
  throw std::runtime_error("cannot write \"" + m_Parameters.fileName + "\": " + std::strerror(errno));
}
} // namespace phantom
