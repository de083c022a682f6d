// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BinaryHeader.h"
#include "FormatRows.h"
#include "HeaderParsing.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace medialvoxel
{
namespace
{

/** Offsets of the fields that are used. */
enum Field : std::size_t
{
  Size = 0,
  Mode = 12,
  Start = 16,
  Intervals = 28,
  Cell = 40,
  Angles = 52,
  AxisOrder = 64,
  SpaceGroup = 88,
  ExtendedHeaderSize = 92,
  ImodStamp = 152,
  ImodFlags = 156,
  Origin = 196,
  Map = 208,
  MachineStamp = 212
};

constexpr std::size_t HeaderSize = 1024;

constexpr double AngstromsPerMillimeter = 1e7;

using Whole = std::array<std::int32_t, 3>;
using Real = std::array<double, 3>;

std::vector<unsigned char>
ReadBytes(const std::filesystem::path & fileName)
{
  std::vector<unsigned char> bytes(HeaderSize);
  std::ifstream              file = OpenRegularFile(fileName);
  file.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.good())
  {
    RefuseHeader(fileName, "it is shorter than a header of MRC, " + std::to_string(HeaderSize) + " bytes");
  }
  constexpr std::array<char, 3> map{ 'M', 'A', 'P' };
  if (!std::equal(map.begin(), map.end(), bytes.begin() + Map))
  {
    RefuseHeader(fileName, "it is no MRC2014 file: it has no MAP at byte " + std::to_string(Map));
  }
  return bytes;
}

bool
IsBigEndian(const std::filesystem::path & fileName, const std::vector<unsigned char> & bytes)
{
  constexpr unsigned int little = 0x44;
  constexpr unsigned int big = 0x11;
  const unsigned int     stamp = bytes[MachineStamp];
  if (stamp != little && stamp != big)
  {
    RefuseHeader(fileName,
                 "its machine stamp begins with " + std::to_string(stamp) + "; it must begin with " +
                   std::to_string(little) + " (little endian) or " + std::to_string(big) + " (big endian)");
  }
  return stamp == big;
}

Whole
ReadWhole(const BinaryHeader & fields, std::size_t offset)
{
  return { fields.Get<std::int32_t>(offset),
           fields.Get<std::int32_t>(offset + 4),
           fields.Get<std::int32_t>(offset + 8) };
}

Real
ReadReal(const BinaryHeader & fields, std::size_t offset)
{
  return { fields.Get<float>(offset), fields.Get<float>(offset + 4), fields.Get<float>(offset + 8) };
}

std::string
Format(const Whole & numbers)
{
  return Join(numbers, " ", [](std::int32_t number) { return std::to_string(number); });
}

/** The properties of a volume that the format leaves open. */
void
CheckVariant(const std::filesystem::path & fileName, const BinaryHeader & fields)
{
  const Whole order = ReadWhole(fields, AxisOrder);
  if (order != Whole{ 1, 2, 3 })
  {
    RefuseHeader(fileName, "MAPC, MAPR, MAPS are " + Format(order) + "; only the order of axes 1 2 3 is read");
  }
  const Real angles = ReadReal(fields, Angles);
  if (angles != Real{ 0, 0, 0 } && angles != Real{ 90, 90, 90 })
  {
    RefuseHeader(fileName,
                 "the angles of its cell are " + FormatNumbers({ angles.begin(), angles.end() }, " ") +
                   "; only right angles, of 90 degrees, are read");
  }
  constexpr std::int32_t firstOfStacks = 401;
  const auto             group = fields.Get<std::int32_t>(SpaceGroup);
  if (group >= firstOfStacks)
  {
    RefuseHeader(fileName, "ISPG is " + std::to_string(group) + ", a stack of volumes; only single volumes are read");
  }
}

std::vector<std::uint64_t>
ReadSize(const std::filesystem::path & fileName, const BinaryHeader & fields)
{
  std::vector<std::uint64_t> size = ParseSizes(fileName, "NX NY NZ", Format(ReadWhole(fields, Size)), 3);
  if (size.back() == 1)
  {
    size.pop_back();
  }
  return size;
}

PixelType
ReadPixelType(const std::filesystem::path & fileName, const BinaryHeader & fields)
{
  constexpr std::array<std::pair<std::int32_t, PixelType>, 4> known{
    { { 0, PixelType::Int8 }, { 1, PixelType::Int16 }, { 2, PixelType::Float32 }, { 6, PixelType::UInt16 } }
  };
  const auto mode = fields.Get<std::int32_t>(Mode);
  const auto found = std::find_if(known.begin(), known.end(), [mode](const auto & type) { return type.first == mode; });
  if (found == known.end())
  {
    RefuseHeader(fileName,
                 "MODE is " + std::to_string(mode) +
                   "; only 0, 1, 2 and 6 are read: int8, int16, float32 and uint16, no float16 and no complex numbers");
  }
  // IMOD marks its files, and also marks signed bytes.
  constexpr std::int32_t imod = 1146047817;
  const bool             isUnsigned =
    fields.Get<std::int32_t>(ImodStamp) == imod && (fields.Get<std::uint32_t>(ImodFlags) & 1u) == 0;
  return found->second == PixelType::Int8 && isUnsigned ? PixelType::UInt8 : found->second;
}

/** Millimeters: the cell divided by its intervals; 1 where the header has no cell. */
Real
ReadSpacing(const std::filesystem::path & fileName, const BinaryHeader & fields)
{
  const Real  cell = ReadReal(fields, Cell);
  const Whole intervals = ReadWhole(fields, Intervals);
  if (cell == Real{ 0, 0, 0 })
  {
    return { 1, 1, 1 };
  }
  if (*std::min_element(intervals.begin(), intervals.end()) < 1)
  {
    RefuseHeader(fileName, "MX MY MZ are " + Format(intervals) + "; each must be a whole number from 1 on");
  }
  Real spacing{};
  std::transform(cell.begin(), cell.end(), intervals.begin(), spacing.begin(), [](double length, std::int32_t count) {
    return length / count / AngstromsPerMillimeter;
  });
  return spacing;
}

/** Millimeters: ORIGIN or, of files without it, the place of the first voxel in the cell. */
Real
ReadOrigin(const BinaryHeader & fields, const Real & spacing)
{
  Real origin = ReadReal(fields, Origin);
  if (origin != Real{ 0, 0, 0 })
  {
    std::transform(
      origin.begin(), origin.end(), origin.begin(), [](double length) { return length / AngstromsPerMillimeter; });
    return origin;
  }
  const Whole start = ReadWhole(fields, Start);
  std::transform(start.begin(), start.end(), spacing.begin(), origin.begin(), std::multiplies<double>());
  return origin;
}

void
ReadGeometry(VolumeHeader & header, const BinaryHeader & fields)
{
  const Real spacing = ReadSpacing(header.fileName, fields);
  const Real origin = ReadOrigin(fields, spacing);
  const auto dimension = static_cast<std::ptrdiff_t>(header.geometry.size.size());
  header.geometry.spacing.assign(spacing.begin(), spacing.begin() + dimension);
  header.geometry.origin.assign(origin.begin(), origin.begin() + dimension);
  header.geometry.SetIdentityDirection();
  header.geometry.inMillimeters = ReadReal(fields, Cell) != Real{ 0, 0, 0 };
}

std::uint64_t
ReadDataOffset(const std::filesystem::path & fileName, const BinaryHeader & fields)
{
  const auto extended = fields.Get<std::int32_t>(ExtendedHeaderSize);
  if (extended < 0)
  {
    RefuseHeader(fileName, "NSYMBT is " + std::to_string(extended) + "; it must be a whole number from 0 on");
  }
  return HeaderSize + static_cast<std::uint64_t>(extended);
}

VolumeHeader
ReadMrcHeader(const std::filesystem::path & fileName)
{
  const std::vector<unsigned char> bytes = ReadBytes(fileName);
  VolumeHeader                     header;
  header.fileName = fileName;
  header.bigEndian = IsBigEndian(fileName, bytes);
  const BinaryHeader fields(bytes, header.bigEndian);
  CheckVariant(fileName, fields);
  header.geometry.size = ReadSize(fileName, fields);
  header.pixelType = ReadPixelType(fileName, fields);
  ReadGeometry(header, fields);
  header.dataFile = fileName;
  header.dataFileSize = GetDataFileSize(fileName, fileName);
  header.dataOffset = ReadDataOffset(fileName, fields);
  return header;
}

} // namespace

VolumeFormat
MakeMrcFormat()
{
  return { "MRC", { { ".mrc" }, { ".map" }, { ".rec" } }, MakePlainInput(ReadMrcHeader) };
}

} // end namespace medialvoxel
