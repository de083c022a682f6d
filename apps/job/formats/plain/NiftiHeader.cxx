// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BinaryHeader.h"
#include "FormatRows.h"
#include "HeaderParsing.h"
#include "InflateReader.h"
#include "NiftiFields.h"
#include "NiftiText.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace medialvoxel
{
namespace
{

using namespace NiftiFields;

bool
IsCompressed(const std::filesystem::path & fileName)
{
  return ToLower(fileName.extension().string()) == ".gz";
}

/** True for a header whose voxels are in a file of their own. */
bool
IsOfPair(const std::filesystem::path & fileName)
{
  return ToLower(fileName.extension().string()) == ".hdr";
}

std::vector<unsigned char>
ReadBytes(const std::filesystem::path & fileName, std::int32_t count)
{
  std::vector<unsigned char> bytes(static_cast<std::size_t>(count));
  if (IsCompressed(fileName))
  {
    InflateReader(fileName, 0).Read(bytes.data(), bytes.size());
    return bytes;
  }
  std::ifstream file = OpenRegularFile(fileName);
  file.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.good())
  {
    RefuseHeader(fileName, "it is shorter than a header of NIfTI, " + std::to_string(count) + " bytes");
  }
  return bytes;
}

/** \class NiftiNumbers
 * \brief The fields of a header of either version and byte order. */
class NiftiNumbers
{
public:
  explicit NiftiNumbers(const std::filesystem::path & fileName)
  {
    const std::vector<unsigned char> start = ReadBytes(fileName, sizeof(std::int32_t));
    for (m_Version = 0; m_Version < Versions.size(); ++m_Version)
    {
      for (const bool bigEndian : { false, true })
      {
        if (BinaryHeader(start, bigEndian).Get<std::int32_t>(0) == this->GetVersion().headerSize)
        {
          m_BigEndian = bigEndian;
          const std::vector<unsigned char> bytes = ReadBytes(fileName, this->GetVersion().headerSize);
          this->CheckMagic(fileName, bytes);
          m_Bytes = BinaryHeader(bytes, bigEndian);
          return;
        }
      }
    }
    RefuseHeader(fileName, "it does not begin as a file of NIfTI does");
  }

  const Version &
  GetVersion() const
  {
    return Versions[m_Version];
  }

  bool
  IsBigEndian() const
  {
    return m_BigEndian;
  }

  template <typename TResult>
  TResult
  Get(const Field & field, std::size_t index = 0) const
  {
    const Place & place = field[m_Version];
    return DispatchNumber(place.type, [&](auto zero) {
      return static_cast<TResult>(m_Bytes.Get<decltype(zero)>(place.offset + index * sizeof(zero)));
    });
  }

private:
  void
  CheckMagic(const std::filesystem::path & fileName, const std::vector<unsigned char> & bytes) const
  {
    const bool             isOfPair = IsOfPair(fileName);
    const std::string_view expected = isOfPair ? this->GetVersion().magicOfPair : this->GetVersion().magicOfFile;
    if (!std::equal(
          expected.begin(), expected.end(), bytes.begin() + static_cast<std::ptrdiff_t>(this->GetVersion().magic)))
    {
      const std::string what = isOfPair ? "it is not the header of a NIfTI-" : "it is not a NIfTI-";
      RefuseHeader(fileName,
                   what + std::to_string(m_Version + 1) +
                     (isOfPair ? " pair, of files .hdr and .img" : " file with header and voxels in one file"));
    }
  }

  std::size_t  m_Version{ 0 };
  bool         m_BigEndian{ false };
  BinaryHeader m_Bytes;
};

std::vector<std::uint64_t>
ReadSize(const std::filesystem::path & fileName, const NiftiNumbers & fields)
{
  const auto dimOf = [&fields](std::int64_t axis) {
    return fields.Get<std::int64_t>(Dim, static_cast<std::size_t>(axis));
  };
  std::int64_t dimension = dimOf(0);
  while (dimension > 3 && dimension <= 7 && dimOf(dimension) >= 0 && dimOf(dimension) <= 1) // 0 is not said
  {
    --dimension;
  }
  if (dimension < 2 || dimension > 3)
  {
    RefuseHeader(fileName, "it has " + std::to_string(dimension) + " dimensions; only volumes with 2 or 3 are read");
  }
  std::vector<std::int64_t> sizes;
  for (std::int64_t axis = 1; axis <= dimension; ++axis)
  {
    sizes.push_back(dimOf(axis));
  }
  const std::string text = Join(sizes, " ", [](std::int64_t size) { return std::to_string(size); });
  return ParseSizes(fileName, "dim", text, sizes.size());
}

PixelType
ReadPixelType(const std::filesystem::path & fileName, const NiftiNumbers & fields)
{
  const auto code = fields.Get<std::int16_t>(DataType);
  const auto found =
    std::find_if(DataTypes.begin(), DataTypes.end(), [code](const auto & entry) { return entry.first == code; });
  if (found == DataTypes.end())
  {
    RefuseHeader(fileName,
                 "datatype is " + std::to_string(code) +
                   "; only scalar whole numbers and reals of 1 to 8 bytes are read");
  }
  const auto bits = fields.Get<std::int16_t>(BitsPerVoxel);
  if (bits < 0 || static_cast<unsigned int>(bits) != 8 * GetTraits(found->second).bytes)
  {
    RefuseHeader(fileName, "bitpix is " + std::to_string(bits) + ", which does not fit its datatype");
  }
  return found->second;
}

/** Bytes before the voxels, which the first version keeps as a real number. */
std::uint64_t
ReadDataOffset(const std::filesystem::path & fileName, const NiftiNumbers & fields)
{
  constexpr double greatest = 1e15;
  const double     least = IsOfPair(fileName) ? 0.0 : fields.GetVersion().minimumDataOffset;
  const auto       offset = fields.Get<double>(VoxelOffset);
  if (!(offset >= least && offset <= greatest) || std::floor(offset) != offset)
  {
    RefuseHeader(fileName,
                 "vox_offset is " + FormatNumber(offset) + "; it must be a whole number from " + FormatNumber(least) +
                   " on");
  }
  return static_cast<std::uint64_t>(offset);
}

/** Nothing when numbers are values. Writers put not a number for "none", and the format 0. */
std::optional<ValueScale>
ReadScale(const NiftiNumbers & fields)
{
  const auto   slope = fields.Get<double>(ScaleSlope);
  const auto   intercept = fields.Get<double>(ScaleIntercept);
  const double usedIntercept = std::isfinite(intercept) ? intercept : 0.0;
  if (!std::isfinite(slope) || slope == 0.0 || (slope == 1.0 && usedIntercept == 0.0))
  {
    return std::nullopt;
  }
  return ValueScale{ slope, usedIntercept };
}

/** Millimeters of the unit of lengths; nothing for an unknown one. */
std::optional<double>
ReadUnit(const NiftiNumbers & fields)
{
  constexpr std::array<double, 3> units{ { 1e3, 1.0, 1e-3 } };
  const std::uint32_t             code = fields.Get<std::uint32_t>(Units) & 7u;
  return code >= 1 && code <= units.size() ? std::optional<double>(units[code - 1]) : std::nullopt;
}

/** Rows of three columns for the axes and one for the origin. */
using Placement = std::array<std::array<double, 4>, 3>;

Placement
PlaceByRows(const NiftiNumbers & fields)
{
  Placement placement{};
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 4; ++column)
    {
      placement[row][column] = fields.Get<double>(SRows, 4 * row + column);
    }
  }
  return placement;
}

Placement
PlaceByQuaternion(const NiftiNumbers & fields)
{
  const auto   number = [&fields](const Field & field, std::size_t index) { return fields.Get<double>(field, index); };
  double       b = number(Quaternion, 0);
  double       c = number(Quaternion, 1);
  double       d = number(Quaternion, 2);
  const double rest = 1.0 - (b * b + c * c + d * d);
  double       a = std::sqrt(std::max(0.0, rest));
  if (rest < 1e-7)
  {
    // A turn by 180 degrees, up to rounding.
    const double length = std::sqrt(b * b + c * c + d * d);
    a = 0.0;
    b /= length;
    c /= length;
    d /= length;
  }
  const double sign = number(PixDim, 0) < 0 ? -1.0 : 1.0;
  return {
    { { a * a + b * b - c * c - d * d, 2 * (b * c - a * d), sign * 2 * (b * d + a * c), number(QOffset, 0) },
      { 2 * (b * c + a * d), a * a + c * c - b * b - d * d, sign * 2 * (c * d - a * b), number(QOffset, 1) },
      { 2 * (b * d - a * c), 2 * (c * d + a * b), sign * (a * a + d * d - c * c - b * b), number(QOffset, 2) } }
  };
}

/** Length of a column. */
double
GetLength(const Placement & placement, std::size_t axis)
{
  return std::sqrt(placement[0][axis] * placement[0][axis] + placement[1][axis] * placement[1][axis] +
                   placement[2][axis] * placement[2][axis]);
}

bool
HasRightAngles(const Placement & placement)
{
  constexpr double tolerance = 1e-4;
  const auto       dot = [&placement](std::size_t i, std::size_t j) {
    return placement[0][i] * placement[0][j] + placement[1][i] * placement[1][j] + placement[2][i] * placement[2][j];
  };
  const auto cosine = [&dot](std::size_t i, std::size_t j) { return dot(i, j) / std::sqrt(dot(i, i) * dot(j, j)); };
  return std::abs(cosine(0, 1)) < tolerance && std::abs(cosine(0, 2)) < tolerance && std::abs(cosine(1, 2)) < tolerance;
}

/** Columns in voxels become columns in lengths. */
Placement
Scale(Placement placement, const std::array<double, 3> & lengths)
{
  for (auto & row : placement)
  {
    std::transform(lengths.begin(), lengths.end(), row.begin(), row.begin(), std::multiplies<>());
  }
  return placement;
}

/** Whether voxels of the image lie at the same places, within a tenth of the smallest voxel. */
bool
AreNearlyEqual(const Placement & a, const Placement & b, const std::vector<std::uint64_t> & size)
{
  constexpr double share = 0.1;
  double           smallest = std::numeric_limits<double>::infinity();
  double           farthest = 0.0;
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    smallest = std::min(smallest, GetLength(a, axis));
  }
  for (std::size_t row = 0; row < 3; ++row)
  {
    double apart = std::abs(a[row][3] - b[row][3]);
    for (std::size_t axis = 0; axis < size.size(); ++axis)
    {
      apart += std::abs(a[row][axis] - b[row][axis]) * static_cast<double>(size[axis]);
    }
    farthest = std::max(farthest, apart);
  }
  return farthest <= share * smallest;
}

/** The sform when it has a code, as nibabel takes it, else the qform; nothing when it has neither. A sform with axes
 * that are not at right angles gives way to a qform. */
std::optional<Placement>
ReadPlacement(VolumeHeader & header, const NiftiNumbers & fields)
{
  const bool                  hasRows = fields.Get<int>(SFormCode) > 0;
  const bool                  hasQuaternion = fields.Get<int>(QFormCode) > 0;
  const std::array<double, 3> lengths{
    { fields.Get<double>(PixDim, 1), fields.Get<double>(PixDim, 2), fields.Get<double>(PixDim, 3) }
  };
  const Placement rows = PlaceByRows(fields);
  const Placement quaternion = Scale(PlaceByQuaternion(fields), lengths);
  const bool      takesRows = hasRows && (!hasQuaternion || HasRightAngles(rows));
  if (hasRows && hasQuaternion && !AreNearlyEqual(rows, quaternion, header.geometry.size))
  {
    header.warnings.push_back({ HeaderWarnings::ContradictingForms,
                                std::string("its sform and its qform place the voxels differently; the ") +
                                  (takesRows ? "sform" : "qform, whose axes are at right angles,") + " is taken",
                                {} });
  }
  if (takesRows && !hasQuaternion)
  {
    for (std::size_t axis = 0; axis < header.geometry.size.size(); ++axis)
    {
      const double own = GetLength(rows, axis);
      if (!(std::abs(own - lengths[axis]) <= 1e-3 * own))
      {
        header.warnings.push_back({ HeaderWarnings::ContradictingForms,
                                    "its sform has the spacing " + FormatShort(own) + " along axis " +
                                      std::to_string(axis) + " and its pixdim " + FormatShort(lengths[axis]) +
                                      "; that of the sform is taken",
                                    {} });
        break;
      }
    }
  }
  if (takesRows)
  {
    return rows;
  }
  return hasQuaternion ? std::optional<Placement>(quaternion) : std::nullopt;
}

void
ReadGeometry(VolumeHeader & header, const NiftiNumbers & fields)
{
  VolumeGeometry &  geometry = header.geometry;
  const std::size_t dimension = geometry.size.size();
  const double      unit = ReadUnit(fields).value_or(1.0);
  geometry.inMillimeters = ReadUnit(fields).has_value();
  for (std::size_t axis = 0; axis < dimension; ++axis)
  {
    geometry.spacing.push_back(unit * fields.Get<double>(PixDim, axis + 1));
  }
  geometry.origin.assign(dimension, 0.0);
  geometry.SetIdentityDirection();
  const std::optional<Placement> placement = ReadPlacement(header, fields);
  if (!placement)
  {
    return;
  }
  for (std::size_t axis = 0; axis < dimension; ++axis)
  {
    const double length = GetLength(*placement, axis);
    // pixdim is exact where the numbers of the form, rounded to 32 bits, are the same.
    if (!(std::abs(unit * length - geometry.spacing[axis]) <= 1e-5 * geometry.spacing[axis]))
    {
      geometry.spacing[axis] = unit * length;
    }
    for (std::size_t row = 0; row < dimension; ++row)
    {
      // The x and y axes of the format point right and anterior; the sum makes 0 of -0, which other formats do not
      // have.
      const double sign = row < 2 ? -1.0 : 1.0;
      geometry.origin[row] = sign * unit * (*placement)[row][3] + 0.0;
      geometry.direction[axis][row] = sign * (*placement)[row][axis] + 0.0;
    }
  }
  for (std::vector<double> & direction : geometry.direction)
  {
    const double length = std::sqrt(std::inner_product(direction.begin(), direction.end(), direction.begin(), 0.0));
    std::transform(direction.begin(), direction.end(), direction.begin(), [length](double x) { return x / length; });
  }
  if (!std::all_of(geometry.origin.begin(), geometry.origin.end(), [](double value) { return std::isfinite(value); }))
  {
    RefuseHeader(header.fileName, "its origin is not finite");
  }
}

VolumeHeader
ReadNiftiHeader(const std::filesystem::path & fileName)
{
  const NiftiNumbers fields(fileName);
  VolumeHeader       header;
  header.fileName = fileName;
  header.bigEndian = fields.IsBigEndian();
  header.geometry.size = ReadSize(fileName, fields);
  header.pixelType = ReadPixelType(fileName, fields);
  ReadGeometry(header, fields);
  header.scale = ReadScale(fields);
  header.dataFile = fileName;
  if (IsOfPair(fileName))
  {
    header.dataFile.replace_extension(".img");
  }
  header.dataFileSize = GetDataFileSize(fileName, header.dataFile);
  header.compressed = IsCompressed(fileName);
  // With compression the header is packed too.
  (header.compressed ? header.skipAfterInflation : header.dataOffset) = ReadDataOffset(fileName, fields);
  return header;
}

} // namespace

VolumeFormat
MakeNiftiFormat()
{
  VolumeWriter writer;
  writer.makeHeader = [](const VolumeGeometry & geometry,
                         const VoxelLayout &    layout,
                         const std::string &,
                         const std::optional<std::uint64_t> &) { return MakeNiftiHeader(geometry, layout); };
  writer.packsHeader = true;
  writer.hasComponents = false;
  writer.largestSize = LargestNiftiSize;
  return { "NIfTI",
           { { ".nii", false, false, false, "name it .nii.gz" }, { ".nii.gz", false, true, true } },
           MakePlainInput(ReadNiftiHeader),
           writer };
}

/** Headers whose voxels are in a file of their own are only read. */
VolumeFormat
MakeNiftiPairFormat()
{
  return { "NIfTI", { { ".hdr" } }, MakePlainInput(ReadNiftiHeader) };
}

} // end namespace medialvoxel
