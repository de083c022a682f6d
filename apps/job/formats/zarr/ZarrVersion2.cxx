// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrFields.h"

#include <algorithm>
#include <numeric>

namespace medialvoxel
{
namespace
{

/** Sets type and byte order from a name of NumPy's, for example "<u2". */
void
SetType(const ZarrFields & fields, ZarrArray & array)
{
  const auto & dtype = fields.At("dtype");
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
  fields.Refuse("dtype is " + ZarrFields::Show(dtype) + "; only whole numbers and reals of 1 to 8 bytes are read");
}

void
SetOrder(const ZarrFields & fields, ZarrArray & array)
{
  const auto & order = fields.At("order");
  if (order != "C" && order != "F")
  {
    fields.Refuse("order is " + ZarrFields::Show(order) + "; it must be C or F");
  }
  if (order == "F")
  {
    std::vector<std::uint64_t> reversed(array.grid.leadingAxes + array.grid.dimension);
    std::iota(reversed.rbegin(), reversed.rend(), 0);
    array.axisOrder = fields.ReadAxisOrder(reversed, array.grid);
  }
}

} // namespace

ZarrArray
ReadZarrArray2(const ZarrFields & fields, unsigned int dimension)
{
  const auto & json = fields.GetJson();
  if (fields.At("zarr_format") != 2)
  {
    fields.Refuse("zarr_format is " + ZarrFields::Show(fields.At("zarr_format")) + "; in a .zarray it must be 2");
  }
  const auto filters = json.value("filters", ZarrFields::Json());
  if (!filters.is_null() && !filters.empty())
  {
    fields.Refuse("its chunks went through filters, " + ZarrFields::Show(filters) + "; none are read");
  }
  ZarrArray array;
  fields.SetLengths(fields.At("shape"), fields.At("chunks"), dimension, array.grid);
  array.grid.separator = fields.ReadSeparator(json.value("dimension_separator", ZarrFields::Json(".")));
  SetType(fields, array);
  SetOrder(fields, array);
  const auto & compressor = fields.At("compressor");
  if (!compressor.is_null())
  {
    fields.AddCodec(compressor.at("id"), compressor, 2, array);
  }
  fields.SetFillValue(fields.At("fill_value"), array);
  fields.CheckChunkSize(array);
  return array;
}

} // end namespace medialvoxel
