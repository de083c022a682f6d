// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrFields.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace medialvoxel
{
namespace
{

constexpr unsigned int MostAxes = 5;

/** Places of space among the lengths of the file, whose last one is x. */
ZarrIndex
GetSpatialLengths(const std::vector<std::uint64_t> & lengths, unsigned int dimension)
{
  const size_t rank = lengths.size();
  return dimension == 2 ? ZarrIndex{ { lengths[rank - 1], 1, lengths[rank - 2] } }
                        : ZarrIndex{ { lengths[rank - 1], lengths[rank - 2], lengths[rank - 3] } };
}

bool
AreOne(const std::vector<std::uint64_t> & lengths, unsigned int leadingAxes)
{
  return std::all_of(lengths.begin(), lengths.begin() + leadingAxes, [](std::uint64_t length) { return length == 1; });
}

/** Numbers, true and false, names of reals that are no numbers, and bits of reals in hexadecimal digits.
 * \return nothing for anything else */
std::optional<double>
ParseFillValue(const nlohmann::json & fill, PixelType type)
{
  if (fill.is_null())
  {
    return 0.0;
  }
  if (fill.is_boolean())
  {
    return fill.get<bool>() ? 1.0 : 0.0;
  }
  if (fill.is_number())
  {
    return fill.get<double>();
  }
  const std::string text = fill.is_string() ? fill.get<std::string>() : "";
  if (text == "NaN")
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (text == "Infinity" || text == "-Infinity")
  {
    return text.front() == '-' ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  }
  const std::size_t digits = 2 * GetTraits(type).bytes;
  if (text.size() != digits + 2 || text.rfind("0x", 0) != 0 ||
      text.find_first_not_of("0123456789abcdefABCDEF", 2) != std::string::npos)
  {
    return std::nullopt;
  }
  const std::uint64_t bits = std::stoull(text, nullptr, 16);
  return DispatchPixelType(type, [bits](auto zero) -> std::optional<double> {
    if constexpr (std::is_floating_point<decltype(zero)>::value)
    {
      using BitsType = std::conditional_t<sizeof(zero) == 4, std::uint32_t, std::uint64_t>;
      const auto sameSize = static_cast<BitsType>(bits);
      std::memcpy(&zero, &sameSize, sizeof(zero));
      return static_cast<double>(zero);
    }
    return std::nullopt;
  });
}

} // namespace

std::string
ZarrFields::Show(const Json & value)
{
  constexpr size_t longest = 60;
  const auto       text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

std::vector<std::uint64_t>
ZarrFields::ReadLengths(const Json & values, const char * name) const
{
  constexpr std::uint64_t    maximumVoxels = std::uint64_t{ 1 } << 59;
  std::vector<std::uint64_t> lengths;
  std::uint64_t              product = 1;
  bool                       isGood = values.is_array() && values.size() >= 2 && values.size() <= MostAxes;
  for (auto value = values.begin(); isGood && value != values.end(); ++value)
  {
    isGood = value->is_number_unsigned() && *value > 0 && *value <= maximumVoxels / product;
    product *= isGood ? value->get<std::uint64_t>() : 1;
    lengths.push_back(isGood ? value->get<std::uint64_t>() : 0);
  }
  if (!isGood)
  {
    this->Refuse(std::string(name) + " is " + Show(values) +
                 "; it must have 2 to 5 whole numbers from 1 on, with a product of 2^59 at most");
  }
  return lengths;
}

void
ZarrFields::SetLengths(const Json & shape, const Json & chunks, unsigned int dimension, ZarrGrid & grid) const
{
  const auto sizes = this->ReadLengths(shape, "shape");
  const auto rank = static_cast<unsigned int>(sizes.size());
  grid.dimension = dimension == 0 ? std::min(rank, 3U) : dimension;
  if (rank < grid.dimension)
  {
    this->Refuse("shape is " + Show(shape) + "; the metadata of its image have " + std::to_string(grid.dimension) +
                 " axes of space");
  }
  grid.leadingAxes = rank - grid.dimension;
  if (!AreOne(sizes, grid.leadingAxes))
  {
    this->Refuse("shape is " + Show(shape) + "; only one value per voxel is read: before z, y, x all must be 1");
  }
  grid.size = GetSpatialLengths(sizes, grid.dimension);
  grid.chunk = this->ReadChunkLengths(chunks, grid);
}

ZarrIndex
ZarrFields::ReadChunkLengths(const Json & lengths, const ZarrGrid & grid) const
{
  const auto sizes = this->ReadLengths(lengths, "the shape of its chunks");
  if (sizes.size() != grid.leadingAxes + grid.dimension)
  {
    this->Refuse("its chunks are " + Show(lengths) + "; they must have " +
                 std::to_string(grid.leadingAxes + grid.dimension) + " axes, as the array has");
  }
  if (!AreOne(sizes, grid.leadingAxes))
  {
    this->Refuse("its chunks are " + Show(lengths) +
                 "; only one value per voxel is read: before z, y, x all must be 1");
  }
  return GetSpatialLengths(sizes, grid.dimension);
}

std::array<unsigned int, 3>
ZarrFields::ReadAxisOrder(const std::vector<std::uint64_t> & order, const ZarrGrid & grid) const
{
  const std::uint64_t        rank = grid.leadingAxes + grid.dimension;
  std::vector<std::uint64_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  bool isGood = sorted.size() == rank;
  for (std::uint64_t axis = 0; isGood && axis < rank; ++axis)
  {
    isGood = sorted[axis] == axis;
  }
  if (!isGood)
  {
    this->Refuse("its axes are transposed to the order " + Show(order) + "; each of them must be there once");
  }
  std::array<unsigned int, 3> axes{ { 0, 1, 2 } };
  auto                        next = axes.begin();
  for (auto axis = order.rbegin(); axis != order.rend(); ++axis)
  {
    if (*axis >= grid.leadingAxes)
    {
      const auto fromX = static_cast<unsigned int>(rank - 1 - *axis);
      *next++ = grid.dimension == 2 && fromX == 1 ? 2 : fromX;
    }
  }
  if (grid.dimension == 2)
  {
    axes[2] = 1; // of length 1
  }
  return axes == std::array<unsigned int, 3>{ { 0, 2, 1 } } && grid.dimension == 2
           ? std::array<unsigned int, 3>{ { 0, 1, 2 } }
           : axes;
}

void
ZarrFields::SetFillValue(const Json & fill, ZarrArray & array) const
{
  const PixelType             type = array.grid.layout.pixelType;
  const std::optional<double> value = ParseFillValue(fill, type);
  if (!value)
  {
    this->Refuse("fill_value is " + Show(fill) + "; it must be a number");
  }
  const bool fits = DispatchPixelType(type, [value](auto zero) {
    using Limits = std::numeric_limits<decltype(zero)>;
    // The largest whole number may round up to one that is too large.
    return !Limits::is_integer || (*value >= static_cast<double>(Limits::lowest()) &&
                                   *value < std::ldexp(1.0, Limits::digits) && *value == std::floor(*value));
  });
  if (!fits)
  {
    this->Refuse("fill_value is " + Show(fill) + "; no voxel of type " + std::string(GetTraits(type).name) + " has it");
  }
  array.fillValue = *value;
}

char
ZarrFields::ReadSeparator(const Json & separator) const
{
  if (separator != "." && separator != "/")
  {
    this->Refuse("the separator of its chunk names is " + Show(separator) + "; it must be '.' or '/'");
  }
  return separator.get<std::string>().front();
}

void
ZarrFields::AddCodec(const Json & name, const Json & options, int version, ZarrArray & array) const
{
  const ZarrCodec * const codec = FindZarrCodec(name.get<std::string>(), version);
  if (codec == nullptr)
  {
    this->Refuse("its chunks are packed by " + Show(name) +
                 "; only chunks that are not packed, or by one of these, are read: " + ListZarrCodecs(version));
  }
  if (codec->unpack == nullptr)
  {
    this->Refuse("its chunks are packed by " + Show(name) + ", which this program was built without; it needs " +
                 codec->neededLibrary);
  }
  if (array.codecs.size() == MostZarrCodecs)
  {
    this->Refuse("its chunks are packed more than " + std::to_string(MostZarrCodecs) + " times");
  }
  array.codecs.push_back(codec);
  const Json        inside = options.is_object() ? options.value("cname", Json()) : Json();
  const std::string kind = inside.is_string() ? " (" + inside.get<std::string>().substr(0, 20) + ")" : "";
  array.packing += (array.packing.empty() ? "" : " and ") + name.get<std::string>() + kind;
}

void
ZarrFields::CheckChunkSize(const ZarrArray & array) const
{
  // Whole chunks take memory, also without a file: they must not be much larger than the array.
  constexpr std::uint64_t alwaysAllowed = std::uint64_t{ 1 } << 26;
  constexpr std::uint64_t allowedRatio = 8;
  const ZarrGrid &        grid = array.grid;
  std::uint64_t           usedSize = GetTraits(grid.layout.pixelType).bytes;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    usedSize *= std::min(grid.chunk[axis], grid.size[axis]);
  }
  const std::string bytes = std::to_string(grid.GetChunkSize());
  if (grid.GetChunkSize() > alwaysAllowed && grid.GetChunkSize() / allowedRatio > usedSize)
  {
    this->Refuse("its chunks have " + bytes + " bytes, of which the array uses " + std::to_string(usedSize) +
                 "; chunks above 64 MiB must be at most 8 times as large as what is used");
  }
  if (!array.IsPlain() && grid.GetChunkSize() > LargestPackedChunk)
  {
    this->Refuse("its chunks have " + bytes + " bytes; those that are packed or transposed must have " +
                 std::to_string(LargestPackedChunk) + " at most");
  }
  constexpr std::uint64_t mostChunksPerShard = std::uint64_t{ 1 } << 18;
  if (array.shards && array.shards->GetNumberOfChunks() > mostChunksPerShard)
  {
    this->Refuse("its shards have " + std::to_string(array.shards->GetNumberOfChunks()) + " chunks; they must have " +
                 std::to_string(mostChunksPerShard) + " at most");
  }
}

} // end namespace medialvoxel
