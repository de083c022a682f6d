// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "RandomVolume.h"

#include "itk_zlib.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace medialvoxel
{
namespace
{

using Index = std::array<int, 3>;

int
GetExtent(const RandomVolume & volume, unsigned int axis)
{
  return axis < volume.size.size() ? static_cast<int>(volume.size[axis]) : 1;
}

/** Gives a value to the voxels for which the function says so. */
void
SetWhere(RandomVolume & volume, double value, const std::function<bool(const Index &)> & isInside)
{
  std::size_t at = 0;
  for (int z = 0; z < GetExtent(volume, 2); ++z)
  {
    for (int y = 0; y < GetExtent(volume, 1); ++y)
    {
      for (int x = 0; x < GetExtent(volume, 0); ++x, ++at)
      {
        volume.values[at] = isInside({ x, y, z }) ? value : volume.values[at];
      }
    }
  }
}

Index
DrawIndex(const RandomVolume & volume, Dice & dice)
{
  return { dice.Roll(0, GetExtent(volume, 0) - 1),
           dice.Roll(0, GetExtent(volume, 1) - 1),
           dice.Roll(0, GetExtent(volume, 2) - 1) };
}

void
AddBoxes(RandomVolume & volume, Dice & dice)
{
  for (int box = dice.Roll(1, 25); box > 0; --box)
  {
    const Index lower = DrawIndex(volume, dice);
    const Index extent{ dice.Roll(1, 25), dice.Roll(1, 25), dice.Roll(1, 25) };
    SetWhere(volume, dice.OneIn(4) ? 0.0 : 100.0, [&](const Index & v) {
      return v[0] >= lower[0] && v[0] < lower[0] + extent[0] && v[1] >= lower[1] && v[1] < lower[1] + extent[1] &&
             v[2] >= lower[2] && v[2] < lower[2] + extent[2];
    });
  }
}

void
AddShells(RandomVolume & volume, Dice & dice)
{
  for (int shell = dice.Roll(1, 4); shell > 0; --shell)
  {
    const Index  center = DrawIndex(volume, dice);
    const double outer = dice.Roll(4, 30);
    const double inner = outer - dice.Roll(1, 12);
    SetWhere(volume, 100.0, [&](const Index & v) {
      const double radius = std::hypot(v[0] - center[0], v[1] - center[1], v[2] - center[2]);
      return radius >= inner && radius < outer;
    });
  }
}

void
AddNoise(RandomVolume & volume, Dice & dice)
{
  const int cases = dice.Pick<int>({ 2, 10, 100, 1000 });
  for (double & value : volume.values)
  {
    value = dice.OneIn(cases) ? 100.0 - value : value;
  }
}

void
AddNotANumber(RandomVolume & volume, Dice & dice)
{
  for (double & value : volume.values)
  {
    value = dice.OneIn(50) ? std::numeric_limits<double>::quiet_NaN() : value;
  }
}

std::string
ToBytes(const RandomVolume & volume, bool isSwapped)
{
  return DispatchPixelType(volume.pixelType, [&](auto zero) {
    std::string bytes(volume.values.size() * sizeof(zero), '\0');
    for (std::size_t i = 0; i < volume.values.size(); ++i)
    {
      const auto value = static_cast<decltype(zero)>(volume.values[i]);
      std::memcpy(&bytes[i * sizeof(zero)], &value, sizeof(zero));
      if (isSwapped)
      {
        std::reverse(&bytes[i * sizeof(zero)], &bytes[i * sizeof(zero)] + sizeof(zero));
      }
    }
    return bytes;
  });
}

/** A stream of zlib, or of gzip when its header is asked for. */
std::string
Compress(const std::string & bytes, bool isGzip)
{
  constexpr int windowBits = 15;
  constexpr int gzipHeader = 16;
  constexpr int memoryLevel = 8;
  z_stream      stream = {};
  if (deflateInit2(&stream, 1, Z_DEFLATED, windowBits + (isGzip ? gzipHeader : 0), memoryLevel, Z_DEFAULT_STRATEGY) !=
      Z_OK)
  {
    throw std::runtime_error("zlib does not start");
  }
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef *>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END)
  {
    throw std::runtime_error("zlib does not end");
  }
  return packed;
}

template <typename TValue>
std::string
Join(const std::vector<TValue> & values)
{
  std::ostringstream text;
  for (const TValue & value : values)
  {
    text << ' ' << value;
  }
  return text.str();
}

std::string
MakeMetaHeader(const RandomVolume & volume, const std::string & dataFile, bool isCompressed)
{
  std::ostringstream header;
  header << "ObjectType = Image\nNDims = " << volume.size.size()
         << "\nBinaryData = True\nCompressedData = " << (isCompressed ? "True" : "False")
         << "\nElementSpacing =" << Join(volume.spacing) << "\nDimSize =" << Join(volume.size)
         << "\nElementType = " << GetTraits(volume.pixelType).metaName << "\nElementDataFile = " << dataFile << '\n';
  return header.str();
}

std::string
MakeNrrdHeader(const RandomVolume & volume, const std::string & dataFile, bool isSwapped, bool isCompressed)
{
  std::ostringstream header;
  header << "NRRD0004\ntype: " << (volume.pixelType == PixelType::Float32 ? "float" : GetTraits(volume.pixelType).name)
         << "\ndimension: " << volume.size.size() << "\nsizes:" << Join(volume.size)
         << "\nspacings:" << Join(volume.spacing) << "\nendian: " << (isSwapped ? "big" : "little")
         << "\nencoding: " << (isCompressed ? "gzip" : "raw") << '\n'
         << (dataFile.empty() ? "" : "data file: " + dataFile + "\n") << '\n';
  return header.str();
}

} // namespace

RandomVolume
DrawVolume(Dice & dice)
{
  RandomVolume       volume;
  const unsigned int dimension = dice.OneIn(4) ? 2 : 3;
  const int          longest = dimension == 2 ? 300 : 70;
  std::size_t        voxels = 1;
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    volume.size.push_back(static_cast<std::uint64_t>(dice.Roll(1, longest)));
    voxels *= volume.size.back();
  }
  const bool isIsotropic = dice.OneIn(2);
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    volume.spacing.push_back(isIsotropic ? 0.5 : 0.25 * dice.Roll(2, 8));
  }
  volume.pixelType = dice.Pick<PixelType>({ PixelType::UInt8, PixelType::Int16, PixelType::Float32 });
  volume.values.assign(voxels, dice.OneIn(6) ? 100.0 : 0.0);
  const int kind = dice.Roll(1, 5);
  if (kind != 2)
  {
    AddBoxes(volume, dice);
  }
  if (kind >= 2)
  {
    AddShells(volume, dice);
  }
  if (kind >= 4)
  {
    AddNoise(volume, dice);
  }
  if (volume.pixelType == PixelType::Float32)
  {
    AddNotANumber(volume, dice);
  }
  return volume;
}

VolumeFile
WriteVolume(const RandomVolume & volume, int format, const TemporaryFolder & folder)
{
  switch (format)
  {
    case 0:
      folder.Write("in.mha", MakeMetaHeader(volume, "LOCAL", false) + ToBytes(volume, false));
      return { (folder / "in.mha").string(), {} };
    case 1:
      folder.Write("in1.bytes", ToBytes(volume, false));
      folder.Write("in1.mhd", MakeMetaHeader(volume, "in1.bytes", false));
      return { (folder / "in1.mhd").string(), {} };
    case 2:
      folder.Write("in2.mha", MakeMetaHeader(volume, "LOCAL", true) + Compress(ToBytes(volume, false), false));
      return { (folder / "in2.mha").string(), {} };
    case 3:
      folder.Write("in3.nrrd", MakeNrrdHeader(volume, "", false, false) + ToBytes(volume, false));
      return { (folder / "in3.nrrd").string(), {} };
    case 4:
      folder.Write("in4.bytes", ToBytes(volume, true));
      folder.Write("in4.nhdr", MakeNrrdHeader(volume, "in4.bytes", true, false));
      return { (folder / "in4.nhdr").string(), {} };
    case 5:
      folder.Write("in5.nrrd", MakeNrrdHeader(volume, "", true, true) + Compress(ToBytes(volume, true), true));
      return { (folder / "in5.nrrd").string(), {} };
    case 6:
      folder.Write("in6.raw", ToBytes(volume, false));
      return { (folder / "in6.raw").string(), RawDescription{ volume.size, volume.pixelType }, volume.spacing };
    case 7:
      folder.Write("in7.raw", "seven b" + ToBytes(volume, true));
      return { (folder / "in7.raw").string(),
               RawDescription{ volume.size, volume.pixelType, 7, true },
               volume.spacing };
    default:
      throw std::invalid_argument("no such format");
  }
}

} // end namespace medialvoxel
