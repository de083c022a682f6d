// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FormatRows.h"
#include "HeaderParsing.h"
#include "LengthUnits.h"
#include "Text.h"
#include "ZarrFields.h"
#include "ZarrValues.h"
#include "ZarrVolume.h"

#include <algorithm>
#include <optional>

namespace medialvoxel
{
namespace
{

using Json = ZarrFields::Json;
using Path = std::filesystem::path;

/** The array that a group stands for, and its place in space. */
struct ZarrImage
{
  Path         arrayFile;
  Path         metadataFile;   ///< with the place in space
  unsigned int dimension{ 0 }; ///< 0: the metadata do not say
  unsigned int numberOfLevels{ 1 };
  Json         transforms = Json::array();
  Json         direction;

  std::vector<std::string> units; ///< of the axes of space, z first; empty ones are not told
};

Path
ReadDatasetPath(const Path & fileName, const Json & dataset)
{
  const Path path = dataset.at("path").get<std::string>();
  const bool leavesFolder = path.has_root_path() || std::find(path.begin(), path.end(), "..") != path.end();
  if (path.empty() || leavesFolder)
  {
    RefuseHeader(fileName,
                 "the path of its dataset is " + ZarrFields::Show(dataset.at("path")) + "; it must stay in the folder");
  }
  return path;
}

/** Axes of space come last, as z, y, x. */
unsigned int
ReadDimension(const Path & fileName, const Json & multiscale, std::vector<std::string> & units)
{
  std::string space;
  bool        spaceIsLast = true;
  const Json  axes = multiscale.value("axes", Json::array());
  for (const Json & axis : axes)
  {
    // Version 0.3 has names alone; later ones may leave the type out.
    const std::string name = axis.is_string() ? axis.get<std::string>() : axis.at("name").get<std::string>();
    const bool        isSpace = axis.is_string() ? name != "t" && name != "c" : axis.value("type", "space") == "space";
    spaceIsLast = spaceIsLast && (isSpace || space.empty());
    space += isSpace ? name : "";
    if (isSpace)
    {
      units.push_back(axis.is_string() ? "" : axis.value("unit", ""));
    }
  }
  const bool isKnown = axes.empty() || (spaceIsLast && (space == "zyx" || space == "yx"));
  if (!isKnown)
  {
    RefuseHeader(fileName,
                 "its axes are " + ZarrFields::Show(axes) + "; those of space must be the last ones, z, y, x or y, x");
  }
  return static_cast<unsigned int>(space.size());
}

/** The file with the metadata of an array. */
Path
FindArrayFile(const Path & folder)
{
  const Path version3 = folder / ZarrFile;
  return std::filesystem::exists(version3) ? version3 : folder / ZarrArrayFile;
}

/** The metadata of OME in a group. */
Json
GetOmeAttributes(const Path & fileName, const Json & metadata)
{
  const bool isVersion3 = fileName.filename() == ZarrFile;
  return isVersion3 ? metadata.value("attributes", Json::object()).value("ome", Json::object()) : metadata;
}

/** The images that a group names; nothing when it is an array. */
Json
ReadMultiscales(const Path & fileName, const Json & metadata)
{
  if (fileName.filename() == ZarrFile && metadata.value("node_type", "") == "array")
  {
    return {};
  }
  const Json multiscales = GetOmeAttributes(fileName, metadata).value("multiscales", Json::array());
  if (multiscales.empty())
  {
    RefuseHeader(fileName, "it names no multiscales; give the folder of an image or of an array");
  }
  return multiscales;
}

/** The file with the metadata of a group. */
Path
FindGroupFile(const Path & folder)
{
  const Path version3 = folder / ZarrFile;
  return std::filesystem::exists(version3) ? version3 : folder / ".zattrs";
}

/** The only image in a container of bioformats2raw; its folder is a number. */
std::optional<Path>
FindOnlyImage(const Path & folder, const Path & fileName, const Json & metadata)
{
  if (!GetOmeAttributes(fileName, metadata).contains("bioformats2raw.layout"))
  {
    return std::nullopt;
  }
  std::vector<std::string> images;
  std::error_code          error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    if (ParseInteger(name) && IsZarrFolder(entry->path()))
    {
      images.push_back(name);
    }
  }
  std::sort(images.begin(), images.end());
  if (images.size() != 1)
  {
    RefuseHeader(fileName,
                 "it is a container with " + std::to_string(images.size()) + " images (" +
                   Join(images, ", ", [](const std::string & name) { return name; }) + "); give the folder of one");
  }
  return folder / images.front();
}

ZarrImage
ReadGroup(const Path & folder, const Path & fileName, const Json & metadata, unsigned int level)
{
  ZarrImage  image;
  const Json multiscales = ReadMultiscales(fileName, metadata);
  if (multiscales.is_null())
  {
    image.arrayFile = fileName;
    return image;
  }
  const Json & multiscale = multiscales.at(0);
  const Json & datasets = multiscale.at("datasets");
  image.metadataFile = fileName;
  image.numberOfLevels = static_cast<unsigned int>(datasets.size());
  const Json & dataset = datasets.at(std::min<std::size_t>(level, datasets.size() - 1)); // a further one is refused
  image.arrayFile = FindArrayFile(folder / ReadDatasetPath(fileName, dataset));
  image.dimension = ReadDimension(fileName, multiscale, image.units);
  for (const Json & place : { dataset, multiscale })
  {
    for (const Json & transform : place.value("coordinateTransformations", Json::array()))
    {
      image.transforms.push_back(transform);
    }
  }
  const bool isVersion3 = fileName.filename() == ZarrFile;
  const Json attributes = isVersion3 ? metadata.value("attributes", Json::object()) : metadata;
  image.direction = attributes.value("medialvoxel", Json::object()).value("direction", Json());
  return image;
}

/** The image that an array is a level of; the image knows its place in space. */
std::optional<ZarrImage>
FindImageOf(const Path & array)
{
  const Path folder = std::filesystem::absolute(array).lexically_normal();
  const Path name = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
  const Path parent = folder.has_filename() ? folder.parent_path() : folder.parent_path().parent_path();
  const Path fileName = FindGroupFile(parent);
  if (!std::filesystem::exists(fileName))
  {
    return std::nullopt;
  }
  return ZarrFields::WithJson(fileName, [&](const Json & metadata) -> std::optional<ZarrImage> {
    const Json multiscales = GetOmeAttributes(fileName, metadata).value("multiscales", Json::array());
    const Json datasets = multiscales.empty() ? Json::array() : multiscales.at(0).value("datasets", Json::array());
    for (unsigned int level = 0; level < datasets.size(); ++level)
    {
      if (Path(datasets.at(level).value("path", "")).lexically_normal() == name)
      {
        ZarrImage image = ReadGroup(parent, fileName, metadata, level);
        image.numberOfLevels = 1;
        return image;
      }
    }
    return std::nullopt;
  });
}

ZarrImage
ReadImage(const Path & folder, unsigned int level)
{
  ZarrImage image;
  image.arrayFile = folder / ZarrArrayFile;
  if (!std::filesystem::exists(image.arrayFile))
  {
    const Path          fileName = FindGroupFile(folder);
    std::optional<Path> only;
    image = ZarrFields::WithJson(fileName, [&](const Json & metadata) {
      only = FindOnlyImage(folder, fileName, metadata);
      return only ? ZarrImage{} : ReadGroup(folder, fileName, metadata, level);
    });
    if (only)
    {
      return ReadImage(*only, level);
    }
  }
  if (image.metadataFile.empty())
  {
    image = FindImageOf(folder).value_or(image);
  }
  if (level >= image.numberOfLevels)
  {
    Fail(ExitStatus::Usage,
         folder.string(),
         ": it has no level ",
         level,
         "; ",
         image.numberOfLevels == 1 ? "its only level is 0"
                                   : "its levels are 0 to " + std::to_string(image.numberOfLevels - 1));
  }
  return image;
}

/** The last numbers of a transform, x first. */
std::vector<double>
ReadNumbersOfSpace(const Path & fileName, const Json & values, size_t dimension)
{
  const auto numbers = values.get<std::vector<double>>();
  if (numbers.size() < dimension)
  {
    RefuseHeader(fileName,
                 ZarrFields::Show(values) + " has " + std::to_string(numbers.size()) +
                   " numbers, one per axis is needed");
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
      RefuseHeader(fileName,
                   "a transform of it is " + ZarrFields::Show(transform) + "; only scale and translation are read");
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
MakeGeometry(const ZarrImage & image, const ZarrGrid & grid)
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
  const Path & fileName = image.metadataFile;
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

VolumeChunks
DescribeChunks(const ZarrArray & array)
{
  const ZarrGrid & grid = array.grid;
  VolumeChunks     chunks;
  chunks.size = grid.chunk;
  chunks.packing = array.packing;
  chunks.inShards = array.shards.has_value();
  chunks.bytesPerThread = GetZarrThreadMemory(array);
  chunks.bytesOfIndices = ZarrChunks::GetIndexSize(array);
  // Rows that are stored one by one are read when they are needed.
  chunks.bytesPerLayer =
    array.IsPlain() ? 0 : grid.GetNumberOfChunks(0) * grid.GetNumberOfChunks(1) * grid.GetChunkSize();
  return chunks;
}

VolumeHeader
ReadZarrHeader(const Path & folder, unsigned int level)
{
  if (!std::filesystem::exists(folder))
  {
    Fail(ExitStatus::Failure, "cannot read ", folder.string(), ": No such file or directory");
  }
  if (!IsZarrFolder(folder))
  {
    RefuseHeader(folder, "it is not a Zarr folder: .zgroup, .zarray and zarr.json are missing");
  }
  const ZarrImage image = ReadImage(folder, level);
  VolumeHeader    header;
  header.fileName = folder;
  header.dataFile = image.arrayFile;
  header.dataFileSize = GetDataFileSize(folder, header.dataFile);
  header.level = level;
  header.numberOfLevels = image.numberOfLevels;
  const ZarrArray array = ReadZarrArray(header.dataFile, image.dimension);
  header.geometry = MakeGeometry(image, array.grid);
  const auto isScale = [](const Json & transform) { return transform.value("type", "") == "scale"; };
  if (std::none_of(image.transforms.begin(), image.transforms.end(), isScale))
  {
    WarnOfUnknownSpacing(header, "the metadata have no scale");
  }
  else
  {
    ApplyUnits(header, { image.units.rbegin(), image.units.rend() });
  }
  header.pixelType = array.grid.layout.pixelType;
  header.chunks = DescribeChunks(array);
  header.liesInRows = false;
  return header;
}

} // namespace

ZarrArray
ReadZarrArray(const Path & arrayFile, unsigned int dimension)
{
  return ZarrFields::WithJson(arrayFile, [&](const Json & json) {
    const ZarrFields fields(arrayFile, json);
    return arrayFile.filename() == ZarrFile ? ReadZarrArray3(fields, dimension) : ReadZarrArray2(fields, dimension);
  });
}

VolumeFormat
MakeZarrFormat()
{
  VolumeInput input;
  input.readHeader = [](const Path & folder) { return ReadZarrHeader(folder, 0); };
  input.sizeCheck = DataSizeCheck::ByReader;
  input.makeChunkReader = MakeZarrValues;
  input.readLevel = ReadZarrHeader;
  input.isFolder = IsZarrFolder;
  VolumeWriter writer;
  writer.makeFolder = [](const Path & folder, const JobOptions & options) -> std::unique_ptr<SharedVolume> {
    return std::make_unique<ZarrVolume>(
      folder, options.overwrite, options.sparse, GetZarrCompression(options.compression));
  };
  writer.packsChunks = true;
  writer.getMemory = [](const VolumeGeometry & geometry, const VoxelLayout & layout, const JobOptions & options) {
    return ZarrVolume::GetMemory(geometry, layout, GetZarrCompression(options.compression));
  };
  writer.getSlicesOfLayer = [](const VolumeGeometry & geometry, const VoxelLayout & layout) {
    return ZarrGrid::ForVolume(geometry, layout).chunk[2];
  };
  writer.getRowsOfLayer = [](const VolumeGeometry & geometry, const VoxelLayout & layout) {
    return geometry.GetDimension() == 3 ? ZarrGrid::ForVolume(geometry, layout).chunk[1] : 0;
  };
  writer.getFurtherSize = ZarrVolume::GetSizeOfSmallerLevels;
  return { "Zarr", { { ".zarr" } }, input, writer };
}

} // end namespace medialvoxel
