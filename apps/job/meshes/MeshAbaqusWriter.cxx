// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshElementSets.h"
#include "SheetSections.h"
#include "MeshWriters.h"

namespace medialvoxel
{
namespace
{

constexpr unsigned int NumbersPerLine = 16;
constexpr unsigned int MostSides = 4;

const std::string ElementSet = "*ELSET, ELSET=";

/** \class SetLines
 * \brief A set, which appears in the file with the first of its members. */
class SetLines
{
public:
  /** \param head as "*ELSET, ELSET=RIM" */
  SetLines(std::string head, BufferedOutput & output)
    : m_Head(std::move(head) + "\n")
    , m_Output(output)
  {}

  void
  Add(std::uint64_t number)
  {
    if (m_Number == 0)
    {
      m_Output.Text(m_Head);
    }
    else
    {
      m_Output.Text(m_Number % NumbersPerLine == 0 ? ",\n" : ", ");
    }
    m_Output.Integer(number);
    ++m_Number;
  }

  void
  Finish()
  {
    if (m_Number > 0)
    {
      m_Output.Text("\n");
    }
  }

private:
  std::string      m_Head;
  BufferedOutput & m_Output;
  std::uint64_t    m_Number{ 0 };
};

std::string
GetSetName(size_t section)
{
  return "THICKNESS_" + std::to_string(section + 1);
}

void
WriteNodes(MeshReader & reader, BufferedOutput & output)
{
  output.Text("*NODE, NSET=ALL_NODES\n");
  reader.ForEachVertex([&](std::uint64_t number, const auto & vertex) {
    output.Integer(number + 1);
    ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.Text(", ").Float(coordinate); });
    output.Text("\n");
  });
}

/** Triangles or quads, with the numbers that all elements have in the order of the faces. */
void
WriteElements(MeshReader & reader, unsigned int numberOfVertices, const char * head, BufferedOutput & output)
{
  output.Text(head);
  ForEachElement(reader, [&](std::uint64_t number, const MeshFace & face, const MeshCorners & corners) {
    if (corners.size() == numberOfVertices)
    {
      output.Integer(number);
      for (const unsigned int corner : corners)
      {
        output.Text(", ").Integer(face.vertices[corner] + 1);
      }
      output.Text("\n");
    }
  });
}

/** Elements with some of the sides that are marked in their faces. */
void
WriteSideSet(MeshReader &        reader,
             const std::string & name,
             std::uint8_t MeshFace::* sides,
             unsigned int             wanted,
             BufferedOutput &         output)
{
  SetLines lines(ElementSet + name, output);
  ForEachElement(reader, [&](std::uint64_t number, const MeshFace & face, const MeshCorners & corners) {
    if ((GetElementSides(face, corners, face.*sides) & wanted) != 0)
    {
      lines.Add(number);
    }
  });
  lines.Finish();
}

/** The nodes at rims or at junctions, the elements there, and the elements by the number of the side that lies there.
 */
void
WriteEdgeSets(MeshReader &              reader,
              const std::string &       name,
              const std::vector<bool> & nodes,
              std::uint8_t MeshFace::* sides,
              BufferedOutput &         output)
{
  SetLines lines("*NSET, NSET=" + name, output);
  ForEachMarked(nodes, [&](std::uint64_t vertex) { lines.Add(vertex + 1); });
  lines.Finish();
  WriteSideSet(reader, name, sides, ~0U, output);
  for (unsigned int side = 0; side < MostSides; ++side)
  {
    WriteSideSet(reader, name + "_E" + std::to_string(side + 1), sides, 1U << side, output);
  }
}

/** A set for each object of a label map, whose elements follow each other. */
void
WriteObjectSets(MeshReader & reader, const std::vector<std::int64_t> & labels, BufferedOutput & output)
{
  std::uint32_t object = 0;
  std::uint64_t first = 1;
  std::uint64_t last = 0;
  const auto    write = [&] {
    if (object > 0)
    {
      output.Text(ElementSet + GetObjectName(labels[object - 1]) + ", GENERATE\n");
      output.Integer(first).Text(", ").Integer(last).Text(", 1\n");
    }
  };
  ForEachElement(reader, [&](std::uint64_t number, const MeshFace & face, const MeshCorners &) {
    if (reader.GetObject(face) != object)
    {
      write();
      object = reader.GetObject(face);
      first = number;
    }
    last = number;
  });
  write();
}

void
WriteNodalThickness(MeshReader &             reader,
                    const SheetEdges &       edges,
                    const SheetSections &    sections,
                    const MeshWriteOptions & options,
                    BufferedOutput &         output)
{
  output.Text("*NODAL THICKNESS\n");
  ForEachNodeThickness(reader, edges, options.keptNumbers, [&](std::uint64_t vertex, std::optional<double> thickness) {
    const std::uint32_t object = reader.GetVertex(vertex).object;
    output.Integer(vertex + 1).Text(", ");
    output.Float(thickness ? static_cast<float>(*thickness) : sections.GetMeanThickness(object)).Text("\n");
  });
}

void
WriteProperties(const std::vector<SheetSection> & sections, const char * further, BufferedOutput & output)
{
  output.Text("**\n** A placeholder (aluminum in N, mm, t): put in your material.\n"
              "*MATERIAL, NAME=REPLACE_THIS_MATERIAL\n*ELASTIC\n70000., 0.33\n*DENSITY\n2.7e-9\n");
  for (size_t section = 0; section < sections.size(); ++section)
  {
    output.Text("*SHELL SECTION, ELSET=" + GetSetName(section) + ", MATERIAL=REPLACE_THIS_MATERIAL" + further + "\n");
    output.Float(sections[section].thickness).Text("\n");
  }
}

} // namespace

void
WriteMeshAbaqus(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  const bool isAtNodes = options.thicknessPlace == ThicknessPlace::Nodes;
  reader.SetNumberOfPasses(1, 17);
  const SheetEdges    edges(reader);
  const SheetSections sections(reader, edges, options);
  CheckElementsFit(MeshFormat::Abaqus, reader, sections);
  const MeshElementSets sectionSets(sections.CountElements(), options.keptNumbers);
  const MeshElementSets wallSets(CountElementsOfWalls(reader, options), options.keptNumbers);
  const std::uint64_t   elementPasses = (sections.GetNumberOfTriangles() > 0) + (sections.GetNumberOfQuads() > 0);
  const std::uint64_t   setPasses = sectionSets.GetNumberOfPasses() + wallSets.GetNumberOfPasses();
  const std::uint64_t   nodePasses =
    isAtNodes ? CountNodePasses(reader.GetMesh().GetNumberOfVertices(), options.keptNumbers) : 0;
  reader.SetNumberOfPasses(1, 13 + (options.hasWalls ? 1 : 0) + elementPasses + setPasses + nodePasses);

  output.Text("*HEADING\n" + GetTitle(options) + "\n");
  WriteNodes(reader, output);
  if (sections.GetNumberOfTriangles() > 0)
  {
    WriteElements(reader, 3, "*ELEMENT, TYPE=S3, ELSET=TRIANGLES\n", output);
  }
  if (sections.GetNumberOfQuads() > 0)
  {
    WriteElements(reader, 4, "*ELEMENT, TYPE=S4, ELSET=QUADS\n", output);
  }
  const auto setOf = [&output](const std::string & name) { return SetLines(ElementSet + name, output); };
  sectionSets.Write(
    reader,
    [&](const MeshFace & face) { return sections.GetSection(reader, face); },
    [&](const size_t section) { return setOf(GetSetName(section)); });
  output.Text("** RIM and JUNCTION are sets of nodes and of elements; of those in RIM_E1, side E1 is at a rim.\n");
  WriteEdgeSets(reader, "RIM", edges.GetRims(), &MeshFace::rimEdges, output);
  WriteEdgeSets(reader, "JUNCTION", edges.GetJunctions(), &MeshFace::junctionEdges, output);
  WriteObjectSets(reader, options.objectLabels, output);
  wallSets.Write(reader, GetWallGroup, [&](const size_t group) { return setOf(GetWallName(group + 1)); });
  if (isAtNodes)
  {
    WriteNodalThickness(reader, edges, sections, options, output);
  }
  WriteProperties(sections.GetSections(), isAtNodes ? ", NODAL THICKNESS" : "", output);
}

} // end namespace medialvoxel
