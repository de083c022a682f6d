// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FixedWidthFields.h"
#include "MeshElementSets.h"
#include "SheetSections.h"

namespace medialvoxel
{
namespace
{

constexpr size_t NumberField = 8; ///< of nodes and elements
constexpr size_t CardField = 10;  ///< of all other cards
constexpr size_t RealField = 16;  ///< of coordinates and of the thickness of corners

std::string
GetCard(const std::vector<std::uint64_t> & numbers)
{
  std::string card;
  for (const std::uint64_t number : numbers)
  {
    card += GetField(number, CardField);
  }
  return card + "\n";
}

/** \class ListCards
 * \brief A set, which appears in the file with the first of its members. */
class ListCards
{
public:
  /** \param keyword with a title, as "*SET_NODE_LIST_TITLE" */
  ListCards(std::string keyword, std::uint64_t set, std::string title, BufferedOutput & output)
    : m_Head(std::move(keyword) + "\n" + std::move(title) + "\n" + GetCard({ set }))
    , m_Output(output)
  {}

  void
  Add(std::uint64_t number)
  {
    m_Output.Text(m_Number == 0                    ? m_Head
                  : m_Number % NumbersPerCard == 0 ? "\n"
                                                   : "")
      .Text(GetField(number, CardField));
    ++m_Number;
  }

  void
  Finish()
  {
    m_Output.Text(m_Number > 0 ? "\n" : "");
  }

private:
  static constexpr std::uint64_t NumbersPerCard = 8;

  std::string      m_Head;
  BufferedOutput & m_Output;
  std::uint64_t    m_Number{ 0 };
};

std::string
GetTitle(const SheetSection & section, size_t number, const std::vector<std::int64_t> & labels)
{
  const std::string object = section.object > 0 ? GetObjectName(labels[section.object - 1]) + " " : "";
  return object + "THICKNESS_" + std::to_string(number);
}

/** A part and a section for each. */
void
WriteSpans(const std::vector<SheetSection> & sections,
           const std::vector<std::int64_t> & labels,
           BufferedOutput &                  output)
{
  output.Text("$ A placeholder (aluminum in N, mm, t): put in your material.\n"
              "*MAT_ELASTIC\n$      mid        ro         e        pr\n"
              "1         2.7e-9    70000.    0.33\n");
  for (size_t section = 0; section < sections.size(); ++section)
  {
    const std::string thickness = GetRealField(sections[section].thickness, CardField);
    output.Text("*PART\n" + GetTitle(sections[section], section + 1, labels) + "\n")
      .Text("$      pid     secid       mid\n" + GetCard({ section + 1, section + 1, 1 }))
      .Text("*SECTION_SHELL\n$    secid    elform      shrf       nip\n")
      .Text(GetField(section + 1, CardField) + "16        0.833333  5         \n")
      .Text("$       t1        t2        t3        t4\n" + thickness + thickness + thickness + thickness + "\n");
  }
}

void
WriteNodes(MeshReader & reader, BufferedOutput & output)
{
  output.Text("*NODE\n$  nid               x               y               z\n");
  reader.ForEachVertex([&](std::uint64_t number, const auto & vertex) {
    output.Text(GetField(number + 1, NumberField));
    for (const std::string & coordinate : GetPositionFields(reader, vertex, RealField))
    {
      output.Text(coordinate);
    }
    output.Text("\n");
  });
}

/** Triangles are quads whose last two corners are the same. */
void
WriteElements(MeshReader &             reader,
              const SheetSections &    sections,
              const MeshWriteOptions & options,
              BufferedOutput &         output)
{
  const bool hasThickness = options.thicknessPlace == ThicknessPlace::Nodes;
  output.Text(hasThickness ? "*ELEMENT_SHELL_THICKNESS\n" : "*ELEMENT_SHELL\n")
    .Text("$  eid     pid      n1      n2      n3      n4\n");
  ForEachElement(reader, [&](std::uint64_t number, const MeshFace & face, const MeshCorners & corners) {
    MeshCorners four = corners;
    four.resize(4, corners.back());
    output.Text(GetField(number, NumberField)).Text(GetField(sections.GetSection(reader, face) + 1, NumberField));
    for (const unsigned int corner : four)
    {
      output.Text(GetField(face.vertices[corner] + 1, NumberField));
    }
    output.Text("\n");
    if (hasThickness)
    {
      for (const float thickness : sections.GetCornerThicknesses(reader, face, four))
      {
        output.Text(GetRealField(thickness, RealField));
      }
      output.Text("\n");
    }
  });
}

void
WriteNodeSet(std::uint64_t set, const char * title, const std::vector<bool> & marks, BufferedOutput & output)
{
  ListCards cards("*SET_NODE_LIST_TITLE", set, title, output);
  ForEachMarked(marks, [&](std::uint64_t vertex) { cards.Add(vertex + 1); });
  cards.Finish();
}

/** Elements with a marked side. */
void
WriteElementSet(MeshReader &  reader,
                std::uint64_t set,
                const char *  title,
                std::uint8_t MeshFace::* sides,
                BufferedOutput &         output)
{
  ListCards cards("*SET_SHELL_LIST_TITLE", set, title, output);
  ForEachElement(reader, [&](std::uint64_t number, const MeshFace & face, const MeshCorners & corners) {
    if (GetElementSides(face, corners, face.*sides) != 0)
    {
      cards.Add(number);
    }
  });
  cards.Finish();
}

/** A set of parts for each object of a label map. */
void
WriteObjectSets(const std::vector<SheetSection> & sections,
                const std::vector<std::int64_t> & labels,
                BufferedOutput &                  output)
{
  for (size_t first = 0, end = 0; first < sections.size(); first = end)
  {
    const std::uint32_t object = sections[first].object;
    const bool          isOfMap = object > 0;
    ListCards           cards("*SET_PART_LIST_TITLE", object, isOfMap ? GetObjectName(labels[object - 1]) : "", output);
    for (; end < sections.size() && sections[end].object == object; ++end)
    {
      if (isOfMap)
      {
        cards.Add(end + 1);
      }
    }
    cards.Finish();
  }
}

} // namespace

void
WriteMeshLsDyna(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 5);
  const SheetEdges    edges(reader);
  const SheetSections sections(reader, edges, options);
  CheckElementsFit(MeshFormat::LsDyna, reader, sections);
  const MeshElementSets wallSets(CountElementsOfWalls(reader, options), options.keptNumbers);
  reader.SetNumberOfPasses(1, 5 + (options.hasWalls ? 1 : 0) + wallSets.GetNumberOfPasses());
  output.Text("*KEYWORD\n*TITLE\n" + GetTitle(options) + "\n");
  WriteSpans(sections.GetSections(), options.objectLabels, output);
  WriteNodes(reader, output);
  WriteElements(reader, sections, options, output);
  WriteNodeSet(1, "RIM", edges.GetRims(), output);
  WriteNodeSet(2, "JUNCTION", edges.GetJunctions(), output);
  WriteElementSet(reader, 1, "RIM", &MeshFace::rimEdges, output);
  WriteElementSet(reader, 2, "JUNCTION", &MeshFace::junctionEdges, output);
  WriteObjectSets(sections.GetSections(), options.objectLabels, output);
  wallSets.Write(reader, GetWallGroup, [&](const size_t group) {
    return ListCards("*SET_SHELL_LIST_TITLE", FirstWallSet + group + 1, GetWallName(group + 1), output);
  });
  output.Text("*END\n");
}

} // end namespace medialvoxel
