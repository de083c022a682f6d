// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FixedWidthFields.h"
#include "MeshElementSets.h"
#include "SheetSections.h"

#include <array>
#include <charconv>

namespace medialvoxel
{
namespace
{

constexpr size_t SmallField = 8;
constexpr size_t LargeField = 16;

/** Characters of a line of the case control. */
constexpr size_t LineLength = 72;

/** \class SetLines
 * \brief A set of the case control, which appears in the file with the first of its members: a solver refuses empty
 * ones.
 */
class SetLines
{
public:
  /** \param what as "nodes of RIM" */
  SetLines(const std::uint64_t number, const std::string & what, BufferedOutput & output)
    : m_Output(output)
    , m_Head("$ Set " + std::to_string(number) + ": " + what + "\n")
    , m_Line("SET " + std::to_string(number) + " = ")
  {}

  void
  Add(const std::uint64_t member)
  {
    const std::string text = std::to_string(member);
    if (m_IsEmpty)
    {
      m_Output.Text(m_Head);
      m_IsEmpty = false;
    }
    else
    {
      m_Line += ",";
    }
    if (m_Line.size() + text.size() + 1 > LineLength)
    {
      m_Output.Text(m_Line + "\n");
      m_Line.clear();
    }
    m_Line += text;
  }

  void
  Finish()
  {
    if (!m_IsEmpty)
    {
      m_Output.Text(m_Line + "\n");
    }
  }

private:
  BufferedOutput & m_Output;
  std::string      m_Head;
  std::string      m_Line;
  bool             m_IsEmpty{ true };
};

void
WriteNodeSet(const std::uint64_t       number,
             const std::string &       name,
             const std::vector<bool> & marks,
             BufferedOutput &          output)
{
  SetLines lines(number, "nodes of " + name, output);
  ForEachMarked(marks, [&](const std::uint64_t node) { lines.Add(node + 1); });
  lines.Finish();
}

void
WriteProperties(const std::vector<SheetSection> & sections,
                const std::vector<std::int64_t> & labels,
                BufferedOutput &                  output)
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
      .Text(GetField(section + 1, LargeField))
      .Text(material)
      .Text(GetRealField(sections[section].thickness, LargeField))
      .Text(material)
      .Text("\n*       ")
      .Text(GetField("", LargeField))
      .Text("1\n");
  }
}

void
WriteNodes(MeshReader & reader, BufferedOutput & output)
{
  const std::string inBasicSystem = GetField("", LargeField);
  reader.ForEachVertex([&](std::uint64_t number, const auto & vertex) {
    const std::vector<std::string> position = GetPositionFields(reader, vertex, LargeField);
    output.Text("GRID*   ")
      .Text(GetField(number + 1, LargeField))
      .Text(inBasicSystem)
      .Text(position[0])
      .Text(position[1])
      .Text("\n*       ")
      .Text(position[2].substr(0, position[2].find(' ')))
      .Text("\n");
  });
}

/** A number in a small field, of four digits at least; exponents come without an e, as the format allows. */
std::string
GetSmallReal(float value)
{
  const auto  lengthOf = [](const std::string & text) { return std::min(text.size(), text.find(' ')); };
  std::string text = GetRealField(value, value >= 0.1F && value < 1e6F ? SmallField : LargeField);
  for (int digits = 7; lengthOf(text) > SmallField; --digits)
  {
    std::array<char, 32> characters;
    const auto           end = std::to_chars(
      characters.data(), characters.data() + characters.size(), value, std::chars_format::scientific, digits - 1);
    const std::string number(characters.data(), end.ptr);
    const size_t      exponent = number.find('e');
    const size_t      figures = std::min(number.size() - 1, number.find_first_not_of('0', exponent + 2));
    text = number.substr(0, exponent) + number[exponent + 1] + number.substr(figures);
  }
  return GetField(text.substr(0, lengthOf(text)), SmallField);
}

void
WriteElement(const char *                       name,
             const std::vector<std::uint64_t> & numbers,
             const std::vector<float> &         thicknesses,
             BufferedOutput &                   output)
{
  output.Text(name);
  for (const std::uint64_t number : numbers)
  {
    output.Text(GetField(number, SmallField));
  }
  output.Text("\n");
  if (!thicknesses.empty())
  {
    // The name's field, an empty one and TFLAG come before them in the second line.
    output.Text(GetField("", 3 * SmallField));
    for (const float thickness : thicknesses)
    {
      output.Text(GetSmallReal(thickness));
    }
    output.Text("\n");
  }
}

void
WriteElements(MeshReader &             reader,
              const SheetSections &    sections,
              const MeshWriteOptions & options,
              BufferedOutput &         output)
{
  ForEachElement(reader, [&](std::uint64_t number, const MeshFace & face, const MeshCorners & corners) {
    std::vector<std::uint64_t> numbers{ number, sections.GetSection(reader, face) + 1 };
    for (const unsigned int corner : corners)
    {
      numbers.push_back(face.vertices[corner] + 1);
    }
    const bool hasThickness = options.thicknessPlace == ThicknessPlace::Nodes;
    WriteElement(corners.size() == 3 ? "CTRIA3  " : "CQUAD4  ",
                 numbers,
                 hasThickness ? sections.GetCornerThicknesses(reader, face, corners) : std::vector<float>(),
                 output);
  });
}

} // namespace

void
WriteMeshNastran(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 3);
  const SheetEdges    edges(reader);
  const SheetSections sections(reader, edges, options);
  CheckElementsFit(MeshFormat::Nastran, reader, sections);
  const MeshElementSets wallSets(CountElementsOfWalls(reader, options), options.keptNumbers);
  reader.SetNumberOfPasses(1, 3 + (options.hasWalls ? 1 : 0) + wallSets.GetNumberOfPasses());
  output.Text("$ " + GetTitle(options) + "\nSOL 101\nCEND\n");
  WriteNodeSet(1, "RIM", edges.GetRims(), output);
  WriteNodeSet(2, "JUNCTION", edges.GetJunctions(), output);
  wallSets.Write(reader, GetWallGroup, [&](const size_t group) {
    return SetLines(FirstWallSet + group + 1, "elements of " + GetWallName(group + 1), output);
  });
  output.Text("BEGIN BULK\n");
  WriteProperties(sections.GetSections(), options.objectLabels, output);
  WriteNodes(reader, output);
  WriteElements(reader, sections, options, output);
  output.Text("ENDDATA\n");
}

} // end namespace medialvoxel
