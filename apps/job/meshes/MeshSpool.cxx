// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshSpool.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSurfaceBuilder.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** A vertex whose coordinates are rounded, in the scratch file. */
struct RoundedVertex
{
  std::array<float, 3> position;
  float                thickness;
};

/** The lower halves of the numbers of the vertices of a face. */
using Corners = std::array<std::uint32_t, 4>;

constexpr unsigned int BitsOfHalf = 32;

/** Data of a face beside its vertices, in the scratch file. */
struct FaceMarks
{
  float        area;
  std::uint8_t numberOfVertices;
  std::uint8_t rimEdges;
  std::uint8_t junctionEdges;
  bool         isCap;
};

static_assert(MeshSpool::VertexSize == sizeof(MeshSpool::Vertex));
static_assert(MeshSpool::FaceSize == 2 * sizeof(Corners) + sizeof(FaceMarks));

MeshSpool::Vertex
Pack(const MeshVertex & vertex, MeshPrecision precision)
{
  MeshSpool::Vertex record{ vertex.position, static_cast<float>(vertex.thickness), vertex.object };
  if (precision == MeshPrecision::Single)
  {
    for (double & coordinate : record.position)
    {
      coordinate = itk::MedialVoxelSurfaceBuilder::RoundedToFloat(coordinate);
    }
  }
  return record;
}

template <typename TRecord>
void
WriteRecords(ScratchFile & file, std::uint64_t first, const std::vector<TRecord> & records)
{
  file.WriteAt(first * sizeof(TRecord), records.data(), records.size() * sizeof(TRecord));
}

template <typename TRecord>
std::vector<TRecord>
ReadRecords(const ScratchFile & file, std::uint64_t first, std::uint64_t count)
{
  std::vector<TRecord> records(count);
  file.ReadAt(first * sizeof(TRecord), records.data(), count * sizeof(TRecord));
  return records;
}

} // namespace

void
MeshSpool::RareNumbers::Write(std::uint64_t first, const std::vector<std::uint32_t> & numbers)
{
  if (std::all_of(numbers.begin(), numbers.end(), [](std::uint32_t number) { return number == 0; }))
  {
    return;
  }
  if (!m_File)
  {
    m_File.emplace(m_Folder);
  }
  WriteRecords(*m_File, first, numbers);
  m_End = std::max(m_End, first + numbers.size());
}

std::vector<std::uint32_t>
MeshSpool::RareNumbers::Read(std::uint64_t first, std::uint64_t count) const
{
  std::vector<std::uint32_t> numbers;
  if (first < m_End)
  {
    numbers = ReadRecords<std::uint32_t>(*m_File, first, std::min(count, m_End - first));
  }
  numbers.resize(count);
  return numbers;
}

MeshSpool::MeshSpool(const std::filesystem::path & folder, MeshPrecision precision, MeshSpoolInput input)
  : m_VertexFile(folder)
  , m_CornerFile(folder)
  , m_MarkFile(folder)
  , m_Objects(folder)
  , m_UpperCorners(folder)
  , m_Walls(folder)
  , m_Precision(precision)
  , m_HoldsFloats(precision == MeshPrecision::Single && input == MeshSpoolInput::Added)
{}

void
MeshSpool::AddVertices(const std::vector<MeshVertex> & vertices)
{
  this->PutVertices(m_NumberOfVertices, vertices);
}

void
MeshSpool::PutVertices(std::uint64_t first, const std::vector<MeshVertex> & vertices)
{
  if (m_HoldsFloats)
  {
    std::vector<RoundedVertex> records(vertices.size());
    std::vector<std::uint32_t> objects(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      const auto & [position, thickness, object] = vertices[i];
      records[i].position = {
        { static_cast<float>(position[0]), static_cast<float>(position[1]), static_cast<float>(position[2]) }
      };
      records[i].thickness = static_cast<float>(thickness);
      objects[i] = object;
    }
    WriteRecords(m_VertexFile, first, records);
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Objects.Write(first, objects);
    m_NumberOfVertices += vertices.size();
    return;
  }
  std::vector<Vertex> records(vertices.size());
  std::transform(vertices.begin(), vertices.end(), records.begin(), [this](const auto & vertex) {
    return Pack(vertex, m_Precision);
  });
  this->PutVertices(first, records);
}

void
MeshSpool::PutVertices(std::uint64_t first, const std::vector<Vertex> & vertices)
{
  WriteRecords(m_VertexFile, first, vertices);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_NumberOfVertices += vertices.size();
}

void
MeshSpool::AddFaces(const std::vector<MeshFace> & faces)
{
  this->PutFaces(this->GetNumberOfFaces(), faces);
}

void
MeshSpool::PutFaces(std::uint64_t first, const std::vector<MeshFace> & faces)
{
  std::vector<Corners>       corners(faces.size());
  std::vector<std::uint32_t> upper(4 * faces.size());
  std::vector<FaceMarks>     marks(faces.size());
  std::vector<std::uint32_t> walls(faces.size());
  std::uint64_t              triangles = 0;
  std::uint64_t              needed = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    const MeshFace & face = faces[i];
    for (std::size_t k = 0; k < 4; ++k)
    {
      corners[i][k] = static_cast<std::uint32_t>(face.vertices[k]);
      upper[4 * i + k] = static_cast<std::uint32_t>(face.vertices[k] >> BitsOfHalf);
    }
    const auto end = face.vertices.begin() + face.numberOfVertices;
    needed = std::max(needed, *std::max_element(face.vertices.begin(), end) + 1);
    marks[i] = { static_cast<float>(face.area), face.numberOfVertices, face.rimEdges, face.junctionEdges, face.isCap };
    walls[i] = face.wall;
    triangles += face.numberOfVertices == 3 ? 1 : 0;
  }
  WriteRecords(m_CornerFile, first, corners);
  WriteRecords(m_MarkFile, first, marks);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_UpperCorners.Write(4 * first, upper);
  m_Walls.Write(first, walls);
  m_NumberOfTriangles += triangles;
  m_NumberOfQuads += faces.size() - triangles;
  m_NumberOfNeededVertices = std::max(m_NumberOfNeededVertices, needed);
}

void
MeshSpool::PutWalls(std::uint64_t first, const std::vector<std::uint32_t> & walls)
{
  m_Walls.Write(first, walls);
}

void
MeshSpool::ReadVertices(std::uint64_t first, std::uint64_t count, std::vector<Vertex> & vertices) const
{
  itk::MedialVoxelCheckAbort();
  if (!m_HoldsFloats)
  {
    vertices.resize(count);
    m_VertexFile.ReadAt(first * VertexSize, vertices.data(), count * VertexSize);
    return;
  }
  const auto records = ReadRecords<RoundedVertex>(m_VertexFile, first, count);
  const auto objects = m_Objects.Read(first, count);
  vertices.resize(count);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    const auto & [position, thickness] = records[i];
    vertices[i] = { { { position[0], position[1], position[2] } }, thickness, objects[i] };
  }
}

void
MeshSpool::ReadFaces(std::uint64_t           first,
                     std::uint64_t           count,
                     std::vector<MeshFace> & faces,
                     MeshFaceFields          parts) const
{
  itk::MedialVoxelCheckAbort();
  faces.resize(count);
  if (parts != MeshFaceFields::Marks)
  {
    this->ReadCorners(first, faces);
  }
  if (parts != MeshFaceFields::Corners || m_NumberOfTriangles > 0)
  {
    const auto marks = ReadRecords<FaceMarks>(m_MarkFile, first, count);
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      MeshFace & face = faces[i];
      face.area = marks[i].area;
      face.numberOfVertices = marks[i].numberOfVertices;
      face.rimEdges = marks[i].rimEdges;
      face.junctionEdges = marks[i].junctionEdges;
      face.isCap = marks[i].isCap;
    }
  }
  else
  {
    for (MeshFace & face : faces)
    {
      face.numberOfVertices = 4;
    }
  }
  if (parts != MeshFaceFields::Corners)
  {
    const auto walls = m_Walls.Read(first, count);
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      faces[i].wall = walls[i];
    }
  }
}

void
MeshSpool::ReadCorners(std::uint64_t first, std::vector<MeshFace> & faces) const
{
  const auto corners = ReadRecords<Corners>(m_CornerFile, first, faces.size());
  const auto upper = m_UpperCorners.Read(4 * first, 4 * faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    for (std::size_t k = 0; k < 4; ++k)
    {
      faces[i].vertices[k] = std::uint64_t{ upper[4 * i + k] } << BitsOfHalf | corners[i][k];
    }
  }
}

} // end namespace medialvoxel
