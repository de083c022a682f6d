// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNrrdHeader.h"
#include "itkMedialVoxelText.h"

#include <algorithm>
#include <array>
#include <utility>

namespace itk
{

using namespace MedialVoxelText;

namespace
{

constexpr std::array<std::pair<const char *, const char *>, 10> WrittenTypes{ {
  { "uint8", "unsigned char" },
  { "int8", "signed char" },
  { "uint16", "unsigned short" },
  { "int16", "short" },
  { "uint32", "unsigned int" },
  { "int32", "int" },
  { "uint64", "unsigned long long int" },
  { "int64", "long long int" },
  { "float32", "float" },
  { "float64", "double" },
} };

/** Line ends would end the header line, backslashes begin an escape. */
std::string
Escape(const std::string & text)
{
  std::string escaped;
  for (const char character : text)
  {
    escaped += character == '\n' ? "\\n" : character == '\\' ? "\\\\" : std::string(1, character);
  }
  return escaped;
}

std::string
VectorText(const std::vector<double> & vector)
{
  return "(" + FormatNumbers(vector, ",") + ")";
}

std::string
SpaceDirectionsText(const MedialVoxelNrrdHeader & header)
{
  std::vector<std::vector<double>> vectors = header.direction;
  for (size_t axis = 0; axis < vectors.size(); ++axis)
  {
    for (double & component : vectors[axis])
    {
      component *= header.spacing[axis];
    }
  }
  return (header.componentKind.empty() ? "" : "none ") + Join(vectors, " ", VectorText);
}

} // namespace

std::string
MakeMedialVoxelNrrdText(const MedialVoxelNrrdHeader & header)
{
  const bool        hasComponents = !header.componentKind.empty();
  const size_t      dimension = header.size.size();
  const auto        type = std::find_if(WrittenTypes.begin(), WrittenTypes.end(), [&header](const auto & entry) {
    return header.componentType == entry.first;
  });
  const std::string sizes = Join(header.size, " ", [](std::uint64_t size) { return std::to_string(size); });

  std::string text = "NRRD0004\n";
  text += "type: " + std::string(type->second) + "\n";
  text += "dimension: " + std::to_string(dimension + (hasComponents ? 1 : 0)) + "\n";
  text += dimension == 3 ? std::string("space: left-posterior-superior\n")
                         : "space dimension: " + std::to_string(dimension) + "\n";
  text += "sizes: " + (hasComponents ? std::to_string(header.numberOfComponents) + " " : "") + sizes + "\n";
  text += "space directions: " + SpaceDirectionsText(header) + "\n";
  text += "kinds: " + (hasComponents ? header.componentKind + " " : "") +
          (dimension == 3 ? "domain domain domain" : "domain domain") + "\n";
  text += std::string("endian: ") + (header.bigEndian ? "big" : "little") + "\n";
  text += "encoding: " + header.encoding + "\n";
  text += "space origin: " + VectorText(header.origin) + "\n";
  for (const auto & [key, value] : header.keyValues)
  {
    text += Escape(key) + ":=" + Escape(value) + "\n";
  }
  if (!header.IsAttached())
  {
    text += "data file: " + header.dataFiles.front().string() + "\n";
  }
  return text + "\n";
}

} // end namespace itk
