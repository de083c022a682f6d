// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceParts.h"
#include "SurfaceSections.h"
#include "SurfaceWriters.h"

namespace medialvoxel
{
namespace
{

constexpr unsigned int NumbersPerLine = 16;

/** \class SetLines
 * \brief A set of elements, which appears in the file with the first of them. */
class SetLines
{
public:
  SetLines(const std::string & name, BufferedOutput & output)
    : m_Name(name)
    , m_Output(output)
  {}

  void
  Add(std::uint64_t element)
  {
    if (m_Number == 0)
    {
      m_Output.Text("*ELSET, ELSET=" + m_Name + "\n");
    }
    else
    {
      m_Output.Text(m_Number % NumbersPerLine == 0 ? ",\n" : ", ");
    }
    m_Output.Integer(element);
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
  std::string      m_Name;
  BufferedOutput & m_Output;
  std::uint64_t    m_Number{ 0 };
};

std::string
GetSetName(size_t section)
{
  return "THICKNESS_" + std::to_string(section + 1);
}

void
WriteNodes(SurfaceReader & reader, BufferedOutput & output)
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
WriteElements(SurfaceReader & reader, unsigned int numberOfVertices, const char * head, BufferedOutput & output)
{
  output.Text(head);
  ForEachElement(reader, [&](std::uint64_t number, const SurfaceFace & face, const SurfaceCorners & corners) {
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

/** Ends of the runs of sections whose elements are kept at once; a section that is too large is a run of its own. */
std::vector<size_t>
GetRunEnds(const std::vector<SurfaceSection> & sections, std::uint64_t keptElements)
{
  std::vector<size_t> ends;
  std::uint64_t       kept = 0;
  for (size_t section = 0; section < sections.size(); ++section)
  {
    kept += sections[section].numberOfElements;
    if (section > 0 && kept > keptElements)
    {
      ends.push_back(section);
      kept = sections[section].numberOfElements;
    }
  }
  ends.push_back(sections.size());
  return ends;
}

/** The sets of a run of sections; the elements of a single one need not be kept. */
void
WriteSectionSets(SurfaceReader &         reader,
                 const SurfaceSections & sections,
                 size_t                  begin,
                 size_t                  end,
                 BufferedOutput &        output)
{
  if (end - begin == 1)
  {
    SetLines lines(GetSetName(begin), output);
    ForEachElement(reader, [&](std::uint64_t number, const SurfaceFace & face, const SurfaceCorners &) {
      if (sections.GetSection(reader, face) == begin)
      {
        lines.Add(number);
      }
    });
    lines.Finish();
    return;
  }
  std::vector<std::vector<std::uint64_t>> elements(end - begin);
  ForEachElement(reader, [&](std::uint64_t number, const SurfaceFace & face, const SurfaceCorners &) {
    const size_t section = sections.GetSection(reader, face);
    if (section >= begin && section < end)
    {
      elements[section - begin].push_back(number);
    }
  });
  for (size_t section = begin; section < end; ++section)
  {
    SetLines lines(GetSetName(section), output);
    for (const std::uint64_t element : elements[section - begin])
    {
      lines.Add(element);
    }
    lines.Finish();
  }
}

/** The elements at rims, or at junctions. */
void
WriteEdgeSet(SurfaceReader & reader, const char * name, std::uint8_t SurfaceFace::* edges, BufferedOutput & output)
{
  SetLines lines(name, output);
  ForEachElement(reader, [&](std::uint64_t number, const SurfaceFace & face, const SurfaceCorners &) {
    if (face.*edges != 0)
    {
      lines.Add(number);
    }
  });
  lines.Finish();
}

/** A set for each object of a label map, whose elements follow each other. */
void
WriteObjectSets(SurfaceReader & reader, const std::vector<std::int64_t> & labels, BufferedOutput & output)
{
  std::uint32_t object = 0;
  std::uint64_t first = 1;
  std::uint64_t last = 0;
  const auto    write = [&] {
    if (object > 0)
    {
      output.Text("*ELSET, ELSET=" + GetObjectName(labels[object - 1]) + ", GENERATE\n");
      output.Integer(first).Text(", ").Integer(last).Text(", 1\n");
    }
  };
  ForEachElement(reader, [&](std::uint64_t number, const SurfaceFace & face, const SurfaceCorners &) {
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
WriteProperties(const std::vector<SurfaceSection> & sections, BufferedOutput & output)
{
  output.Text("**\n** A placeholder (aluminum in N, mm, t): put in your material.\n"
              "*MATERIAL, NAME=REPLACE_THIS_MATERIAL\n*ELASTIC\n70000., 0.33\n*DENSITY\n2.7e-9\n");
  for (size_t section = 0; section < sections.size(); ++section)
  {
    output.Text("*SHELL SECTION, ELSET=" + GetSetName(section) + ", MATERIAL=REPLACE_THIS_MATERIAL\n");
    output.Float(sections[section].thickness).Text("\n");
  }
}

} // namespace

void
WriteSurfaceAbaqus(SurfaceReader & reader, const SurfaceWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(1, 7);
  const SurfaceSections sections(reader, options.thicknessClassWidth);
  CheckElementsFit(SurfaceFormat::Abaqus, reader, sections);
  const std::vector<size_t> ends = GetRunEnds(sections.GetSections(), options.keptElements);
  const std::uint64_t       elementPasses = (sections.GetNumberOfTriangles() > 0) + (sections.GetNumberOfQuads() > 0);
  reader.SetNumberOfPasses(1, 4 + elementPasses + ends.size());

  output.Text("*HEADING\nMedial surface by MedialVoxel, lengths in the units of the image\n");
  WriteNodes(reader, output);
  if (sections.GetNumberOfTriangles() > 0)
  {
    WriteElements(reader, 3, "*ELEMENT, TYPE=S3, ELSET=TRIANGLES\n", output);
  }
  if (sections.GetNumberOfQuads() > 0)
  {
    WriteElements(reader, 4, "*ELEMENT, TYPE=S4, ELSET=QUADS\n", output);
  }
  size_t begin = 0;
  for (const size_t end : ends)
  {
    WriteSectionSets(reader, sections, begin, end, output);
    begin = end;
  }
  WriteEdgeSet(reader, "RIM", &SurfaceFace::rimEdges, output);
  WriteEdgeSet(reader, "JUNCTION", &SurfaceFace::junctionEdges, output);
  WriteObjectSets(reader, options.objectLabels, output);
  WriteProperties(sections.GetSections(), output);
}

} // end namespace medialvoxel
