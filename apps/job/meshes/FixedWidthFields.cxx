// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FixedWidthFields.h"

#include <array>
#include <charconv>

namespace medialvoxel
{
namespace
{

std::string
WithPoint(std::string text)
{
  const size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos)
  {
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".");
  }
  return text;
}

/** The shortest text that reads back as the same number, or as many digits as fit. */
template <typename TReal>
std::string
FormatReal(TReal value, size_t width)
{
  std::string text = WithPoint(FormatFloat(value));
  for (int digits = 16; text.size() > width && digits > 0; --digits)
  {
    std::array<char, 32> characters;
    const auto           result = std::to_chars(
      characters.data(), characters.data() + characters.size(), value, std::chars_format::general, digits);
    text = WithPoint({ characters.data(), result.ptr });
  }
  return GetField(std::move(text), width);
}

} // namespace

std::string
GetField(std::string text, size_t width)
{
  text.resize(width, ' ');
  return text;
}

std::string
GetField(std::uint64_t number, size_t width)
{
  return GetField(std::to_string(number), width);
}

std::string
GetRealField(float value, size_t width)
{
  return FormatReal(value, width);
}

std::string
GetRealField(double value, size_t width)
{
  return FormatReal(value, width);
}

std::vector<std::string>
GetPositionFields(const MeshReader & reader, const MeshSpool::Vertex & vertex, size_t width)
{
  std::vector<std::string> fields;
  ForEachCoordinate(reader, vertex, [&](auto coordinate) { fields.push_back(GetRealField(coordinate, width)); });
  return fields;
}

} // end namespace medialvoxel
