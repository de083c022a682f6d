// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrMetadata.h"

#include "itkByteSwapper.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

namespace medialvoxel
{
namespace
{

using Json = nlohmann::ordered_json;

std::string
MakeText(const Json & value)
{
  constexpr int indent = 2;
  return value.dump(indent) + "\n";
}

/** Values of the axes in the order of the file: the leading ones, then the axes of space with x last. */
template <typename TValue>
std::vector<TValue>
InFileOrder(const std::vector<TValue> & alongXYZ, unsigned int leadingAxes, TValue leading)
{
  std::vector<TValue> values(leadingAxes, leading);
  values.insert(values.end(), alongXYZ.rbegin(), alongXYZ.rend());
  return values;
}

std::vector<std::uint64_t>
GetArrayLengths(const ZarrGrid & grid, const ZarrIndex & lengths, std::uint64_t leading)
{
  std::vector<std::uint64_t> alongXYZ{ lengths[0], lengths[1], lengths[2] };
  if (grid.dimension == 2)
  {
    alongXYZ = { lengths[0], lengths[2] };
  }
  return InFileOrder(alongXYZ, grid.leadingAxes, leading);
}

/** As NumPy names the type: byte order, kind, bytes. */
std::string
MakeTypeText(PixelType type)
{
  const PixelTypeTraits & traits = GetTraits(type);
  const bool              bigEndian = itk::ByteSwapper<int>::SystemIsBigEndian();
  const std::string       order = traits.bytes == 1 ? "|" : bigEndian ? ">" : "<";
  return order + traits.name.front() + std::to_string(traits.bytes);
}

Json
MakeAxes(unsigned int dimension, unsigned int leadingAxes)
{
  Json axes = Json::array();
  if (leadingAxes > 0)
  {
    axes.push_back({ { "name", "c" }, { "type", "channel" } });
  }
  for (unsigned int axis = dimension; axis > 0; --axis)
  {
    axes.push_back({ { "name", std::string(1, "xyz"[axis - 1]) }, { "type", "space" } });
  }
  return axes;
}

bool
IsIdentity(const std::vector<std::vector<double>> & direction)
{
  VolumeGeometry identity;
  identity.size.resize(direction.size());
  identity.SetIdentityDirection();
  return direction == identity.direction;
}

/** As numcodecs has it. */
Json
MakeCompressor(ZarrCompression compression)
{
  constexpr int byteShuffle = 1;
  constexpr int chosenByBlosc = 0;
  switch (compression)
  {
    case ZarrCompression::None:
      break;
    case ZarrCompression::Gzip:
      return { { "id", "gzip" }, { "level", ZarrGzipLevel } };
    case ZarrCompression::BloscZstd:
      return { { "id", "blosc" },
               { "cname", "zstd" },
               { "clevel", ZarrBloscLevel },
               { "shuffle", byteShuffle },
               { "blocksize", chosenByBlosc } };
  }
  return nullptr;
}

Json
MakeDataset(const ZarrLevel & level)
{
  const unsigned int leadingAxes = level.grid.leadingAxes;
  const Json         scale{ { "type", "scale" }, { "scale", InFileOrder(level.geometry.spacing, leadingAxes, 1.0) } };
  const Json         translation{ { "type", "translation" },
                                  { "translation", InFileOrder(level.geometry.origin, leadingAxes, 0.0) } };
  return { { "path", level.folder }, { "coordinateTransformations", { scale, translation } } };
}

} // namespace

std::string
MakeZarrGroupText()
{
  return MakeText({ { "zarr_format", 2 } });
}

std::string
MakeZarrArrayText(const ZarrGrid & grid, ZarrCompression compression)
{
  const PixelType type = grid.layout.pixelType;
  const bool      isReal = type == PixelType::Float32 || type == PixelType::Float64;
  return MakeText({ { "chunks", GetArrayLengths(grid, grid.chunk, 1) },
                    { "compressor", MakeCompressor(compression) },
                    { "dimension_separator", std::string(1, grid.separator) },
                    { "dtype", MakeTypeText(type) },
                    { "fill_value", isReal ? Json(0.0) : Json(0) },
                    { "filters", nullptr },
                    { "order", "C" },
                    { "shape", GetArrayLengths(grid, grid.size, grid.layout.components) },
                    { "zarr_format", 2 } });
}

std::string
MakeZarrAttributesText(const std::string & name, const std::vector<ZarrLevel> & levels)
{
  const VolumeGeometry & geometry = levels.front().geometry;
  Json                   datasets = Json::array();
  std::transform(levels.begin(), levels.end(), std::back_inserter(datasets), MakeDataset);
  Json attributes{ { "multiscales",
                     Json::array({ { { "version", "0.4" },
                                     { "name", name },
                                     { "axes", MakeAxes(geometry.GetDimension(), levels.front().grid.leadingAxes) },
                                     { "datasets", datasets } } }) } };
  if (!IsIdentity(geometry.direction))
  {
    // A unit vector for each axis, in the order of the axes, with its components along z, y, x of space.
    Json directions = Json::array();
    for (auto axis = geometry.direction.rbegin(); axis != geometry.direction.rend(); ++axis)
    {
      directions.push_back(InFileOrder(*axis, 0, 0.0));
    }
    attributes["medialvoxel"] = { { "direction", directions } };
  }
  return MakeText(attributes);
}

bool
IsZarrFolder(const std::filesystem::path & folder)
{
  std::error_code error;
  return std::filesystem::is_regular_file(folder / ".zgroup", error) ||
         std::filesystem::is_regular_file(folder / ZarrArrayFile, error) ||
         std::filesystem::is_regular_file(folder / ZarrFile, error);
}

ZarrGrid
ZarrArray::GetShardGrid() const
{
  ZarrGrid shardGrid = grid;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    shardGrid.chunk[axis] *= shards ? shards->chunks[axis] : 1;
  }
  return shardGrid;
}

} // end namespace medialvoxel
