// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshFile.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <istream>
#include <map>

namespace medialvoxel
{
namespace
{

constexpr std::size_t HeaderSize = 80;
constexpr std::size_t NormalSize = 12;
constexpr std::size_t TriangleSize = 50;

template <typename TNumber>
TNumber
GetNumber(const char * bytes)
{
  TNumber number;
  std::memcpy(&number, bytes, sizeof(number));
  return number;
}

template <std::size_t VSize>
void
Read(std::istream & input, std::array<char, VSize> & bytes, const std::string & fileName)
{
  if (!input.read(bytes.data(), VSize))
  {
    Fail(ExitStatus::CorruptInput, fileName, ": ends before its last triangle");
  }
}

} // namespace

void
ReadStlMesh(std::istream & input, MeshFileBuilder & builder)
{
  std::array<char, HeaderSize + sizeof(std::uint32_t)> header;
  Read(input, header, builder.GetFileName());
  const auto triangles = GetNumber<std::uint32_t>(header.data() + HeaderSize);

  std::map<std::array<float, 3>, std::uint64_t> numbers;
  std::array<char, TriangleSize>                bytes;
  for (std::uint64_t triangle = 1; triangle <= triangles; ++triangle)
  {
    Read(input, bytes, builder.GetFileName());
    std::vector<std::uint64_t> nodes;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const auto place =
        GetNumber<std::array<float, 3>>(bytes.data() + NormalSize + corner * sizeof(numbers.begin()->first));
      const itk::MedialVoxelVector3 point{ { place[0], place[1], place[2] } };
      const bool isKey = std::none_of(place.begin(), place.end(), [](const float value) { return std::isnan(value); });
      const auto found = isKey ? numbers.find(place) : numbers.end();
      if (found == numbers.end())
      {
        builder.AddNode(numbers.size() + 1, point);
        nodes.push_back(numbers.size() + 1);
        numbers.emplace(place, numbers.size() + 1);
      }
      else
      {
        nodes.push_back(found->second);
      }
    }
    builder.AddElement(triangle, nodes);
  }
  if (input.peek() != std::istream::traits_type::eof())
  {
    Fail(ExitStatus::CorruptInput, builder.GetFileName(), ": is not a binary STL file of ", triangles, " triangles");
  }
}

} // end namespace medialvoxel
