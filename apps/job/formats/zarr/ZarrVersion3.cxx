// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrFields.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

using Json = ZarrFields::Json;

/** An extension of version 3, as codecs and grids are: a name alone, or a name and its configuration. */
struct Extension
{
  std::string name;
  Json        configuration = Json::object();
};

Extension
ReadExtension(const Json & json)
{
  if (json.is_string())
  {
    return { json.get<std::string>() };
  }
  return { json.at("name").get<std::string>(), json.value("configuration", Json::object()) };
}

void
SetType(const ZarrFields & fields, ZarrArray & array)
{
  const Json & type = fields.At("data_type");
  if (type == "bool")
  {
    return; // a mask of bytes 0 and 1
  }
  const auto found = std::find_if(
    PixelTypes.begin(), PixelTypes.end(), [&type](const PixelTypeTraits & traits) { return type == traits.name; });
  if (found == PixelTypes.end())
  {
    fields.Refuse("data_type is " + ZarrFields::Show(type) + "; only whole numbers and reals of 1 to 8 bytes are read");
  }
  array.grid.layout.pixelType = found->type;
}

Json
ReadChunkShape(const ZarrFields & fields)
{
  const Extension grid = ReadExtension(fields.At("chunk_grid"));
  if (grid.name != "regular")
  {
    fields.Refuse("its chunk_grid is " + ZarrFields::Show(fields.At("chunk_grid")) + "; only regular ones are read");
  }
  return grid.configuration.at("chunk_shape");
}

void
SetChunkNames(const ZarrFields & fields, ZarrGrid & grid)
{
  const Extension encoding = ReadExtension(fields.At("chunk_key_encoding"));
  const bool      isDefault = encoding.name == "default";
  if (!isDefault && encoding.name != "v2")
  {
    fields.Refuse("its chunk_key_encoding is " + ZarrFields::Show(fields.At("chunk_key_encoding")) +
                  "; only default and v2 are read");
  }
  grid.separator = fields.ReadSeparator(encoding.configuration.value("separator", Json(isDefault ? "/" : ".")));
  grid.prefix = isDefault ? "c" : "";
}

/** True for the order of the bytes of numbers that begins with the highest. */
bool
IsBigEndian(const ZarrFields & fields, const Extension & bytes)
{
  const Json order = bytes.configuration.value("endian", Json("little"));
  if (order != "little" && order != "big")
  {
    fields.Refuse("the endian of its bytes is " + ZarrFields::Show(order) + "; it must be little or big");
  }
  return order == "big";
}

ZarrShards
ReadShards(const ZarrFields & fields, const Json & sharding)
{
  ZarrShards   shards;
  const Json   location = sharding.value("index_location", Json("end"));
  const Json & codecs = sharding.at("index_codecs");
  if (location != "start" && location != "end")
  {
    fields.Refuse("the index_location of its shards is " + ZarrFields::Show(location) + "; it must be start or end");
  }
  shards.indexAtStart = location == "start";
  const bool isKnown = (codecs.size() == 1 || codecs.size() == 2) && ReadExtension(codecs.at(0)).name == "bytes" &&
                       (codecs.size() == 1 || ReadExtension(codecs.at(1)).name == "crc32c");
  if (!isKnown)
  {
    fields.Refuse("the index_codecs of its shards are " + ZarrFields::Show(codecs) +
                  "; only bytes, alone or before crc32c, are read");
  }
  shards.indexIsBigEndian = IsBigEndian(fields, ReadExtension(codecs.at(0)));
  shards.indexHasChecksum = codecs.size() == 2;
  return shards;
}

/** Sets the codecs of a chunk: transpose, bytes, and packing. */
void
SetCodecs(const ZarrFields & fields, const Json & codecs, ZarrArray & array)
{
  bool hasByteOrder = false;
  for (const Json & json : codecs)
  {
    const Extension codec = ReadExtension(json);
    if (codec.name == "transpose" && !hasByteOrder && !array.IsTransposed())
    {
      const Json & order = codec.configuration.at("order");
      array.axisOrder = fields.ReadAxisOrder(order.get<std::vector<std::uint64_t>>(), array.grid);
    }
    else if (codec.name == "bytes" && !hasByteOrder)
    {
      array.bigEndian = IsBigEndian(fields, codec);
      hasByteOrder = true;
    }
    else if (hasByteOrder)
    {
      fields.AddCodec(codec.name, codec.configuration, 3, array);
    }
    else
    {
      fields.Refuse("its codec " + ZarrFields::Show(codec.name) +
                    " is not read there; only bytes, or transpose and bytes, may come first");
    }
  }
  if (!hasByteOrder)
  {
    fields.Refuse("its codecs are " + ZarrFields::Show(codecs) + "; bytes must be one of them");
  }
}

/** The chunks of the array become the shards, and the inner chunks its chunks. */
void
DivideShards(const ZarrFields & fields, const Json & sharding, ZarrArray & array)
{
  const Json &    shape = sharding.at("chunk_shape");
  const ZarrIndex shard = array.grid.chunk;
  array.shards = ReadShards(fields, sharding);
  array.grid.chunk = fields.ReadChunkLengths(shape, array.grid);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (shard[axis] % array.grid.chunk[axis] != 0)
    {
      fields.Refuse("the chunks in its shards are " + ZarrFields::Show(shape) + "; they must divide the shards evenly");
    }
    array.shards->chunks[axis] = shard[axis] / array.grid.chunk[axis];
  }
}

} // namespace

ZarrArray
ReadZarrArray3(const ZarrFields & fields, unsigned int dimension)
{
  const Json & json = fields.GetJson();
  if (fields.At("zarr_format") != 3 || fields.At("node_type") != "array")
  {
    fields.Refuse("zarr_format and node_type are " + ZarrFields::Show(fields.At("zarr_format")) + " and " +
                  ZarrFields::Show(fields.At("node_type")) + "; those of an array must be 3 and \"array\"");
  }
  const Json transformers = json.value("storage_transformers", Json::array());
  if (!transformers.empty())
  {
    fields.Refuse("its storage_transformers are " + ZarrFields::Show(transformers) + "; none are read");
  }
  ZarrArray array;
  fields.SetLengths(fields.At("shape"), ReadChunkShape(fields), dimension, array.grid);
  SetChunkNames(fields, array.grid);
  SetType(fields, array);
  const Json & codecs = fields.At("codecs");
  const bool   hasShards = codecs.size() == 1 && ReadExtension(codecs.at(0)).name == "sharding_indexed";
  if (hasShards)
  {
    const Json sharding = ReadExtension(codecs.at(0)).configuration;
    DivideShards(fields, sharding, array);
    SetCodecs(fields, sharding.at("codecs"), array);
  }
  else
  {
    SetCodecs(fields, codecs, array);
  }
  fields.SetFillValue(fields.At("fill_value"), array);
  fields.CheckChunkSize(array);
  return array;
}

} // end namespace medialvoxel
