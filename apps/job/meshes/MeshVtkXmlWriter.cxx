// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshWriters.h"

namespace medialvoxel
{
namespace
{

constexpr std::uint8_t VtkTriangle = 5;
constexpr std::uint8_t VtkQuad = 9;

/** \class AppendedArrays
 * \brief The arrays that an XML file of VTK names in its head and has as bytes at its end. */
class AppendedArrays
{
public:
  using Write = std::function<void(BufferedOutput & output)>;

  /** Takes an array. Its bytes follow those of the arrays before it. */
  void
  Add(const char * name, const char * type, unsigned int components, std::uint64_t numberOfBytes, Write write)
  {
    std::string element = std::string("        <DataArray type=\"") + type + "\" Name=\"" + name + "\"";
    if (components > 1)
    {
      element += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    }
    m_Elements += element + " format=\"appended\" offset=\"" + std::to_string(m_Offset) + "\"/>\n";
    m_Offset += sizeof(std::uint64_t) + numberOfBytes;
    m_Arrays.push_back({ numberOfBytes, std::move(write) });
  }

  /** The tag before or after those of arrays. */
  void
  Tag(const std::string & tag)
  {
    m_Elements += "      <" + tag + ">\n";
  }

  const std::string &
  GetElements() const
  {
    return m_Elements;
  }

  void
  WriteAll(BufferedOutput & output) const
  {
    output.Text("  <AppendedData encoding=\"raw\">\n_");
    for (const auto & [numberOfBytes, write] : m_Arrays)
    {
      output.LittleEndian(numberOfBytes);
      write(output);
    }
    output.Text("\n  </AppendedData>\n");
  }

private:
  std::string                                  m_Elements;
  std::vector<std::pair<std::uint64_t, Write>> m_Arrays;
  std::uint64_t                                m_Offset{ 0 };
};

void
AddPoints(MeshReader & reader, AppendedArrays & arrays)
{
  const bool          isDouble = reader.GetMesh().GetPrecision() == MeshPrecision::Double;
  const std::uint64_t bytes = reader.GetMesh().GetNumberOfVertices() * 3 * (isDouble ? sizeof(double) : sizeof(float));
  const auto          write = [&reader](BufferedOutput & output) {
    reader.ForEachVertex([&](std::uint64_t, const auto & vertex) {
      ForEachCoordinate(reader, vertex, [&](auto coordinate) { output.LittleEndian(coordinate); });
    });
  };
  arrays.Tag("Points");
  arrays.Add("Points", isDouble ? "Float64" : "Float32", 3, bytes, write);
  arrays.Tag("/Points");
}

/** An array with a number for each vertex. */
template <typename TGet>
void
AddVertexArray(MeshReader & reader, AppendedArrays & arrays, const char * name, TGet get)
{
  const std::uint64_t bytes = reader.GetMesh().GetNumberOfVertices() * sizeof(float);
  arrays.Add(name, "Float32", 1, bytes, [&reader, get](BufferedOutput & output) {
    reader.ForEachVertex([&](std::uint64_t number, const auto & vertex) { output.LittleEndian(get(number, vertex)); });
  });
}

void
AddPointData(MeshReader & reader, const MeshWriteOptions & options, AppendedArrays & arrays)
{
  using Vertex = MeshSpool::Vertex;
  arrays.Tag("PointData Scalars=\"Thickness\"");
  AddVertexArray(reader, arrays, "Thickness", [](std::uint64_t, const Vertex & vertex) { return vertex.thickness; });
  for (const VertexValues * const array : options.vertexArrays)
  {
    AddVertexArray(reader, arrays, array->GetName().c_str(), [array](std::uint64_t number, const Vertex &) {
      return array->Get(number);
    });
  }
  arrays.Tag("/PointData");
}

/** An array with a number for each face, from these parts of it. */
template <typename TGet>
void
AddFaceArray(MeshReader &     reader,
             AppendedArrays & arrays,
             const char *     name,
             const char *     type,
             TGet             get,
             MeshFaceFields   parts = MeshFaceFields::Marks)
{
  const std::uint64_t bytes = reader.GetMesh().GetNumberOfFaces() * sizeof(get(MeshFace{}));
  arrays.Add(name, type, 1, bytes, [&reader, get, parts](BufferedOutput & output) mutable {
    reader.ForEachFace([&](std::uint64_t, const MeshFace & face) { output.LittleEndian(get(face)); }, parts);
  });
}

unsigned int
CountFaceArrays(const MeshWriteOptions & options)
{
  return options.isOfPart ? 1 : 3 + (options.objectLabels.empty() ? 0 : 1) + (options.hasWalls ? 1 : 0);
}

void
AddCellData(MeshReader & reader, const MeshWriteOptions & options, AppendedArrays & arrays)
{
  arrays.Tag("CellData");
  if (options.isOfPart)
  {
    AddFaceArray(reader, arrays, "Cap", "UInt8", [](const MeshFace & face) { return std::uint8_t{ face.isCap }; });
  }
  else
  {
    AddFaceArray(reader, arrays, "RimEdges", "UInt8", [](const MeshFace & face) { return face.rimEdges; });
    AddFaceArray(reader, arrays, "JunctionEdges", "UInt8", [](const MeshFace & face) { return face.junctionEdges; });
    AddFaceArray(
      reader, arrays, "Area", "Float32", [](const MeshFace & face) { return static_cast<float>(face.area); });
  }
  if (!options.isOfPart && !options.objectLabels.empty())
  {
    const auto labelOf = [&reader, &options](const MeshFace & face) { return GetLabel(reader, options, face); };
    AddFaceArray(reader, arrays, "Object", "Int64", labelOf, MeshFaceFields::Corners);
  }
  if (options.hasWalls)
  {
    AddFaceArray(reader, arrays, "Wall", "UInt32", [](const MeshFace & face) { return face.wall; });
  }
  arrays.Tag("/CellData");
}

/** Corners of all faces, one after the other, and where each face ends. */
void
AddCorners(MeshReader & reader, AppendedArrays & arrays)
{
  const MeshSpool &   surface = reader.GetMesh();
  const std::uint64_t corners = 3 * surface.GetNumberOfTriangles() + 4 * surface.GetNumberOfQuads();
  const auto          writeCorners = [&reader](BufferedOutput & output) {
    const auto write = [&](std::uint64_t, const MeshFace & face) {
      for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
      {
        output.LittleEndian(face.vertices[corner]);
      }
    };
    reader.ForEachFace(write, MeshFaceFields::Corners);
  };
  arrays.Add("connectivity", "Int64", 1, corners * sizeof(std::int64_t), writeCorners);
  AddFaceArray(reader, arrays, "offsets", "Int64", [end = std::uint64_t{ 0 }](const MeshFace & face) mutable {
    return end += face.numberOfVertices;
  });
}

/** All that both kinds of files have. \param faces the element of their corners, which stays open */
void
AddContent(MeshReader & reader, const MeshWriteOptions & options, const char * faces, AppendedArrays & arrays)
{
  AddPointData(reader, options, arrays);
  AddCellData(reader, options, arrays);
  AddPoints(reader, arrays);
  arrays.Tag(faces);
  AddCorners(reader, arrays);
}

/** The whole file. \param counts attributes of the piece beside the number of its points */
void
WriteFile(const char *           dataSet,
          MeshReader &           reader,
          const std::string &    counts,
          const AppendedArrays & arrays,
          const std::string &    title,
          BufferedOutput &       output)
{
  const std::string name = dataSet;
  output.Text("<?xml version=\"1.0\"?>\n<!-- " + title + " -->\n<VTKFile type=\"" + name +
              "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <" + name +
              ">\n    <Piece NumberOfPoints=\"");
  output.Integer(reader.GetMesh().GetNumberOfVertices());
  output.Text("\" " + counts + ">\n" + arrays.GetElements() + "    </Piece>\n  </" + name + ">\n");
  arrays.WriteAll(output);
  output.Text("</VTKFile>\n");
}

} // namespace

void
WriteMeshVtp(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(2 + options.vertexArrays.size(), 2 + CountFaceArrays(options));
  AppendedArrays arrays;
  AddContent(reader, options, "Polys", arrays);
  arrays.Tag("/Polys");
  const std::string counts = R"(NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys=")" +
                             std::to_string(reader.GetMesh().GetNumberOfFaces()) + "\"";
  WriteFile("PolyData", reader, counts, arrays, GetTitle(options), output);
}

void
WriteMeshVtu(MeshReader & reader, const MeshWriteOptions & options, BufferedOutput & output)
{
  reader.SetNumberOfPasses(2 + options.vertexArrays.size(), 3 + CountFaceArrays(options));
  AppendedArrays arrays;
  AddContent(reader, options, "Cells", arrays);
  AddFaceArray(reader, arrays, "types", "UInt8", [](const MeshFace & face) {
    return face.numberOfVertices == 3 ? VtkTriangle : VtkQuad;
  });
  arrays.Tag("/Cells");
  const std::string counts = "NumberOfCells=\"" + std::to_string(reader.GetMesh().GetNumberOfFaces()) + "\"";
  WriteFile("UnstructuredGrid", reader, counts, arrays, GetTitle(options), output);
}

} // end namespace medialvoxel
