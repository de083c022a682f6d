// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "JsonFile.h"
#include "Text.h"
#include "ZarrMetadata.h"

#include "itkByteSwapper.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace medialvoxel
{
namespace
{

using Json = nlohmann::json;
using Path = std::filesystem::path;

constexpr std::uint64_t MaximumMetadataBytes = std::uint64_t{ 1 } << 22;

/** Reads JSON and hands it to a function; a value that has another type than it must have is refused. */
template <typename TFunction>
auto
WithJson(const Path & fileName, TFunction && function)
{
  const Json value = ReadJsonFile(fileName, MaximumMetadataBytes);
  try
  {
    return function(value);
  }
  catch (const Json::exception & error)
  {
    RefuseHeader(fileName, std::string("it is not the metadata of a Zarr folder: ") + error.what());
  }
}

/** A value as text for a message, not too long. */
std::string
Show(const Json & value)
{
  constexpr size_t longest = 60;
  const auto       text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

/** Lengths of an array or its chunks: whole numbers from 1 on, whose product fits. */
std::vector<std::uint64_t>
ReadLengths(const Path & fileName, const Json & json, const char * name)
{
  constexpr std::uint64_t    maximumVoxels = std::uint64_t{ 1 } << 59;
  const Json &               values = json.at(name);
  std::vector<std::uint64_t> lengths;
  std::uint64_t              product = 1;
  bool                       isGood = values.is_array() && values.size() >= 2 && values.size() <= 5;
  for (auto value = values.begin(); isGood && value != values.end(); ++value)
  {
    isGood = value->is_number_unsigned() && *value > 0 && *value <= maximumVoxels / product;
    product *= isGood ? value->get<std::uint64_t>() : 1;
    lengths.push_back(isGood ? value->get<std::uint64_t>() : 0);
  }
  if (!isGood)
  {
    RefuseHeader(fileName,
                 std::string(name) + " is " + Show(values) +
                   "; it must have 2 to 5 whole numbers from 1 on, with a product of 2^59 at most");
  }
  return lengths;
}

/** Sets type and byte order from a name of NumPy's, such as "<u2". */
void
ReadType(const Path & fileName, const Json & json, ZarrArray & array)
{
  const Json & dtype = json.at("dtype");
  if (dtype.is_string() && dtype.get<std::string>() == "|b1")
  {
    return; // a mask of bytes 0 and 1
  }
  const std::string text = dtype.is_string() ? dtype.get<std::string>() : "";
  for (const PixelTypeTraits & traits : PixelTypes)
  {
    const std::string name = traits.name.front() + std::to_string(traits.bytes);
    const bool        hasOrder = text.size() == 3 && (text[0] == '<' || text[0] == '>');
    if (text == "|" + name || (hasOrder && text.substr(1) == name))
    {
      array.grid.layout.pixelType = traits.type;
      array.bigEndian = text[0] == '>';
      return;
    }
  }
  RefuseHeader(fileName, "dtype is " + Show(dtype) + "; only whole numbers and reals of 1 to 8 bytes are read");
}

ZarrCompression
ReadCompression(const Path & fileName, const Json & json)
{
  const Json & compressor = json.at("compressor");
  if (compressor.is_null())
  {
    return ZarrCompression::None;
  }
  const Json & id = compressor.at("id");
  if (id != "zlib" && id != "gzip")
  {
    RefuseHeader(fileName,
                 "its chunks are packed by " + Show(id) +
                   "; only chunks that are not packed, or by zlib or gzip, are read");
  }
  return ZarrCompression::Gzip;
}

double
ReadFillValue(const Path & fileName, const Json & json, PixelType type)
{
  const Json & fill = json.at("fill_value");
  double       value = 0.0;
  if (fill.is_number() || fill.is_boolean())
  {
    value = fill.is_boolean() ? static_cast<double>(fill.get<bool>()) : fill.get<double>();
  }
  else if (fill.is_string() && (fill == "NaN" || fill == "Infinity" || fill == "-Infinity"))
  {
    value = fill == "NaN" ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
    value = fill == "-Infinity" ? -value : value;
  }
  else if (!fill.is_null())
  {
    RefuseHeader(fileName, "fill_value is " + Show(fill) + "; it must be a number");
  }
  const bool fits = DispatchPixelType(type, [value](auto zero) {
    using Limits = std::numeric_limits<decltype(zero)>;
    // The largest whole number may round up to one that is too large.
    return !Limits::is_integer || (value >= static_cast<double>(Limits::lowest()) &&
                                   value < std::ldexp(1.0, Limits::digits) && value == std::floor(value));
  });
  if (!fits)
  {
    RefuseHeader(fileName,
                 "fill_value is " + Show(fill) + "; no voxel of type " + std::string(GetTraits(type).name) + " has it");
  }
  return value;
}

char
ReadSeparator(const Path & fileName, const Json & json)
{
  const Json separator = json.value("dimension_separator", Json("."));
  if (separator != "." && separator != "/")
  {
    RefuseHeader(fileName, "dimension_separator is " + Show(separator) + "; it must be '.' or '/'");
  }
  return separator.get<std::string>().front();
}

/** Memory is taken for whole chunks, also for those without a file: they must not be much larger than the array. */
void
RefuseLargeChunks(const Path & fileName, const ZarrGrid & grid)
{
  constexpr std::uint64_t alwaysAllowed = std::uint64_t{ 1 } << 26;
  constexpr std::uint64_t allowedRatio = 8;
  std::uint64_t           usedBytes = GetTraits(grid.layout.pixelType).bytes;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    usedBytes *= std::min(grid.chunk[axis], grid.size[axis]);
  }
  if (grid.GetChunkBytes() > alwaysAllowed && grid.GetChunkBytes() / allowedRatio > usedBytes)
  {
    RefuseHeader(fileName,
                 "its chunks have " + std::to_string(grid.GetChunkBytes()) + " bytes, of which the array uses " +
                   std::to_string(usedBytes) +
                   "; chunks above 64 MiB must be at most 8 times as large as what is used");
  }
}

/** Places of space among the lengths of the file, whose last one is x. */
ZarrIndex
GetSpatialLengths(const std::vector<std::uint64_t> & lengths, unsigned int dimension)
{
  const size_t rank = lengths.size();
  return dimension == 2 ? ZarrIndex{ { lengths[rank - 1], 1, lengths[rank - 2] } }
                        : ZarrIndex{ { lengths[rank - 1], lengths[rank - 2], lengths[rank - 3] } };
}

void
RefuseOtherWaysOfStorage(const Path & fileName, const Json & json)
{
  if (json.at("zarr_format") != 2)
  {
    RefuseHeader(fileName, "zarr_format is " + Show(json.at("zarr_format")) + "; only version 2 is read");
  }
  if (json.at("order") != "C")
  {
    RefuseHeader(fileName, "order is " + Show(json.at("order")) + "; only C is read");
  }
  const Json filters = json.value("filters", Json());
  if (!filters.is_null() && !filters.empty())
  {
    RefuseHeader(fileName, "its chunks went through filters, " + Show(filters) + "; none are read");
  }
}

/** The array that a group stands for, and its place in space. */
struct ZarrImage
{
  Path         arrayFolder;
  unsigned int dimension{ 0 }; ///< 0: the metadata do not say
  Json         transforms = Json::array();
  Json         direction;
};

Path
ReadDatasetPath(const Path & fileName, const Json & dataset)
{
  const Path path = dataset.at("path").get<std::string>();
  const bool leavesFolder = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
  if (path.empty() || leavesFolder)
  {
    RefuseHeader(fileName, "the path of its dataset is " + Show(dataset.at("path")) + "; it must stay in the folder");
  }
  return path;
}

/** Axes of space come last, as z, y, x. */
unsigned int
ReadDimension(const Path & fileName, const Json & multiscale)
{
  std::string space;
  bool        spaceIsLast = true;
  const Json  axes = multiscale.value("axes", Json::array());
  for (const Json & axis : axes)
  {
    const bool isSpace = axis.value("type", "") == "space";
    spaceIsLast = spaceIsLast && (isSpace || space.empty());
    space += isSpace ? axis.at("name").get<std::string>() : "";
  }
  const bool isKnown = axes.empty() || (spaceIsLast && (space == "zyx" || space == "yx"));
  if (!isKnown)
  {
    RefuseHeader(fileName, "its axes are " + Show(axes) + "; those of space must be the last ones, z, y, x or y, x");
  }
  return static_cast<unsigned int>(space.size());
}

ZarrImage
ReadImage(const Path & folder)
{
  ZarrImage image;
  if (std::filesystem::exists(folder / ".zarray"))
  {
    image.arrayFolder = folder;
    return image;
  }
  const Path fileName = folder / ".zattrs";
  return WithJson(fileName, [&](const Json & attributes) {
    if (!attributes.contains("multiscales") || attributes.at("multiscales").empty())
    {
      RefuseHeader(fileName, "it names no multiscales; give the folder of an array");
    }
    const Json & multiscale = attributes.at("multiscales").at(0);
    const Json & dataset = multiscale.at("datasets").at(0);
    image.arrayFolder = folder / ReadDatasetPath(fileName, dataset);
    image.dimension = ReadDimension(fileName, multiscale);
    for (const Json & level : { dataset, multiscale })
    {
      for (const Json & transform : level.value("coordinateTransformations", Json::array()))
      {
        image.transforms.push_back(transform);
      }
    }
    image.direction = attributes.value("medialvoxel", Json::object()).value("direction", Json());
    return image;
  });
}

/** The last numbers of a transform, x first. */
std::vector<double>
ReadNumbersOfSpace(const Path & fileName, const Json & values, size_t dimension)
{
  const auto numbers = values.get<std::vector<double>>();
  if (numbers.size() < dimension)
  {
    RefuseHeader(fileName,
                 Show(values) + " has " + std::to_string(numbers.size()) + " numbers, one per axis is needed");
  }
  return { numbers.rbegin(), numbers.rbegin() + static_cast<std::ptrdiff_t>(dimension) };
}

void
ApplyTransforms(const Path & fileName, const ZarrImage & image, VolumeGeometry & geometry)
{
  const size_t dimension = geometry.size.size();
  for (const Json & transform : image.transforms)
  {
    const auto type = transform.at("type").get<std::string>();
    if (type != "scale" && type != "translation" && type != "identity")
    {
      RefuseHeader(fileName, "a transform of it is " + Show(transform) + "; only scale and translation are read");
    }
    if (type == "identity")
    {
      continue;
    }
    const std::vector<double> numbers = ReadNumbersOfSpace(fileName, transform.at(type), dimension);
    for (size_t axis = 0; axis < dimension; ++axis)
    {
      if (type == "scale")
      {
        geometry.spacing[axis] *= numbers[axis];
        geometry.origin[axis] *= numbers[axis];
      }
      else
      {
        geometry.origin[axis] += numbers[axis];
      }
    }
  }
}

VolumeGeometry
MakeGeometry(const Path & folder, const ZarrImage & image, const ZarrGrid & grid)
{
  VolumeGeometry geometry;
  geometry.size = { grid.size[0], grid.size[1], grid.size[2] };
  if (grid.dimension == 2)
  {
    geometry.size = { grid.size[0], grid.size[2] };
  }
  geometry.spacing.assign(grid.dimension, 1.0);
  geometry.origin.assign(grid.dimension, 0.0);
  geometry.SetIdentityDirection();
  const Path fileName = folder / ".zattrs";
  try
  {
    ApplyTransforms(fileName, image, geometry);
    for (size_t axis = 0; !image.direction.is_null() && axis < grid.dimension; ++axis)
    {
      geometry.direction[axis] =
        ReadNumbersOfSpace(fileName, image.direction.at(grid.dimension - 1 - axis), grid.dimension);
    }
  }
  catch (const Json::exception & error)
  {
    RefuseHeader(fileName, std::string("it has no place in space: ") + error.what());
  }
  return geometry;
}

/** A layer of chunks, and one chunk to unpack. */
std::uint64_t
GetUnpackBytes(const ZarrGrid & grid)
{
  const std::uint64_t sliceBytes = grid.size[0] * grid.size[1] * GetTraits(grid.layout.pixelType).bytes;
  return sliceBytes * std::min(grid.chunk[2], grid.size[2]) + grid.GetChunkBytes();
}

} // namespace

ZarrArray
ReadZarrArray(const Path & arrayFile, unsigned int dimension)
{
  return WithJson(arrayFile, [&](const Json & json) {
    RefuseOtherWaysOfStorage(arrayFile, json);
    ZarrArray  array;
    const auto shape = ReadLengths(arrayFile, json, "shape");
    const auto chunks = ReadLengths(arrayFile, json, "chunks");
    const auto rank = static_cast<unsigned int>(shape.size());
    array.grid.dimension = dimension == 0 ? std::min(rank, 3U) : dimension;
    if (chunks.size() != rank || rank < array.grid.dimension)
    {
      RefuseHeader(arrayFile,
                   "shape " + Show(json.at("shape")) + " and chunks " + Show(json.at("chunks")) + " do not fit");
    }
    array.grid.leadingAxes = rank - array.grid.dimension;
    const auto isOne = [](std::uint64_t length) { return length == 1; };
    if (!std::all_of(shape.begin(), shape.begin() + array.grid.leadingAxes, isOne) ||
        !std::all_of(chunks.begin(), chunks.begin() + array.grid.leadingAxes, isOne))
    {
      RefuseHeader(arrayFile,
                   "shape is " + Show(json.at("shape")) + ", chunks " + Show(json.at("chunks")) +
                     "; only one value per voxel is read: before z, y, x all must be 1");
    }
    array.grid.size = GetSpatialLengths(shape, array.grid.dimension);
    array.grid.chunk = GetSpatialLengths(chunks, array.grid.dimension);
    array.grid.separator = ReadSeparator(arrayFile, json);
    ReadType(arrayFile, json, array);
    array.compression = ReadCompression(arrayFile, json);
    array.fillValue = ReadFillValue(arrayFile, json, array.grid.layout.pixelType);
    RefuseLargeChunks(arrayFile, array.grid);
    return array;
  });
}

VolumeHeader
ReadZarrHeader(const Path & folder)
{
  if (!std::filesystem::exists(folder))
  {
    Fail(ExitStatus::Failure, "cannot read ", folder.string(), ": No such file or directory");
  }
  if (std::filesystem::exists(folder / "zarr.json"))
  {
    RefuseHeader(folder, "it is a Zarr folder of version 3; only version 2 is read");
  }
  if (!IsZarrFolder(folder))
  {
    RefuseHeader(folder, "it is not a Zarr folder: .zgroup and .zarray are missing");
  }
  const ZarrImage image = ReadImage(folder);
  VolumeHeader    header;
  header.fileName = folder;
  header.dataFile = image.arrayFolder / ".zarray";
  header.dataFileSize = GetDataFileSize(folder, header.dataFile);
  const ZarrArray array = ReadZarrArray(header.dataFile, image.dimension);
  header.geometry = MakeGeometry(folder, image, array.grid);
  header.pixelType = array.grid.layout.pixelType;
  header.bigEndian = array.bigEndian;
  header.compressed = array.compression != ZarrCompression::None;
  header.liesInRows = false;
  header.unpackBytes = header.compressed ? GetUnpackBytes(array.grid) : 0;
  return header;
}

} // end namespace medialvoxel
