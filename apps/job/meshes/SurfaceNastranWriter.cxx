// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceParts.h"
#include "SurfaceSections.h"
#include "SurfaceWriters.h"

#include <array>
#include <charconv>

namespace medialvoxel
{
namespace
{

constexpr size_t SmallField = 8;
constexpr size_t LargeField = 16;

/** A field of a fixed width, filled with blanks at its right. */
std::string
GetField(std::string text, size_t width)
{
  text.resize(width, ' ');
  return text;
}

/** With a point, which tells a number from an integer. */
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

/** A number of at most 15 characters. */
std::string
GetReal(float value)
{
  return WithPoint(FormatFloat(value));
}

/** A number of as many digits as a large field holds: 9 at least. */
std::string
GetReal(double value)
{
  std::string text = WithPoint(FormatFloat(value));
  for (int digits = 16; text.size() > LargeField; --digits)
  {
    std::array<char, 32> characters;
    const auto           result = std::to_chars(
      characters.data(), characters.data() + characters.size(), value, std::chars_format::general, digits);
    text = WithPoint({ characters.data(), result.ptr });
  }
  return text;
}

void
WriteProperties(const std::vector<SurfaceSection> & sections,
                const std::vector<std::int64_t> &   labels,
                BufferedOutput &                    output)
{
  output.Text("$ A placeholder (aluminum in N, mm, t): put in your material.\n"
              "MAT1,1,70000.,,.33,2.7-9\n");
  for (size_t section = 0; section < sections.size(); ++section)
  {
    const std::uint32_t object = sections[section].object;
    if (object > 0 && (section == 0 || sections[section - 1].object != object))
    {
      output.Text("$ " + GetObjectName(labels[object - 1]) + "\n");
    }
    const std::string material = GetField("1", LargeField);
    output.Text("PSHELL* ")
      .Text(GetField(std::to_string(section + 1), LargeField))
      .Text(material)
      .Text(GetField(GetReal(sections[section].thickness), LargeField))
      .Text(material)
      .Text("\n*       ")
      .Text(GetField("", LargeField))
      .Text("1\n");
  }
}

void
WriteNodes(SurfaceReader & reader, BufferedOutput & output)
{
  const std::string inBasicSystem = GetField("", LargeField);
  reader.ForEachVertex([&](std::uint64_t number, const auto & vertex) {
    std::vector<std::string> position;
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { position.push_back(GetReal(coordinate)); });
    output.Text("GRID*   ")
      .Text(GetField(std::to_string(number + 1), LargeField))
      .Text(inBasicSystem)
      .Text(GetField(position[0], LargeField))
      .Text(GetField(position[1], LargeField))
      .Text("\n*       ")
      .Text(position[2])
      .Text("\n");
  });
}

void
WriteElements(SurfaceReader & reader, const SurfaceSections & sections, BufferedOutput & output)
{
  ForEachElement(reader, [&](std::uint64_t number, const SurfaceFace & face, const SurfaceCorners & corners) {
    output.Text(corners.size() == 3 ? "CTRIA3  " : "CQUAD4  ")
      .Text(GetField(std::to_string(number), SmallField))
      .Text(GetField(std::to_string(sections.GetSection(reader, face) + 1), SmallField));
    for (const unsigned int corner : corners)
    {
      output.Text(GetField(std::to_string(face.vertices[corner] + 1), SmallField));
    }
    output.Text("\n");
  });
}

} // namespace

void
WriteSurfaceNastran(SurfaceReader & reader, const SurfaceWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 2);
  const SurfaceSections sections(reader, options.thicknessClassWidth);
  CheckElementsFit(SurfaceFormat::Nastran, reader, sections);
  output.Text("$ Medial surface by MedialVoxel, lengths in the units of the image\nSOL 101\nCEND\nBEGIN BULK\n");
  WriteProperties(sections.GetSections(), options.objectLabels, output);
  WriteNodes(reader, output);
  WriteElements(reader, sections, output);
  output.Text("ENDDATA\n");
}

} // end namespace medialvoxel
