// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceSpool.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSurfaceBuilder.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** A face in the scratch file. */
struct FaceRecord
{
  std::array<std::uint64_t, 4> vertices;
  float                        area;
  std::uint8_t                 numberOfVertices;
  std::uint8_t                 rimEdges;
  std::uint8_t                 junctionEdges;
  bool                         isCap;
};

static_assert(SurfaceSpool::BytesPerVertex == sizeof(SurfaceSpool::Vertex));
static_assert(SurfaceSpool::BytesPerFace == sizeof(FaceRecord));

SurfaceSpool::Vertex
Pack(const SurfaceVertex & vertex, SurfacePrecision precision)
{
  SurfaceSpool::Vertex record{ vertex.position, static_cast<float>(vertex.thickness), vertex.object };
  if (precision == SurfacePrecision::Single)
  {
    for (double & coordinate : record.position)
    {
      coordinate = itk::MedialVoxelSurfaceBuilder::RoundedToFloat(coordinate);
    }
  }
  return record;
}

FaceRecord
Pack(const SurfaceFace & face)
{
  return { face.vertices, static_cast<float>(face.area), face.numberOfVertices, face.rimEdges, face.junctionEdges,
           face.isCap };
}

SurfaceFace
Unpack(const FaceRecord & record)
{
  return { record.vertices, record.numberOfVertices, record.rimEdges, record.junctionEdges, record.area, record.isCap };
}

} // namespace

SurfaceSpool::SurfaceSpool(const std::filesystem::path & folder, SurfacePrecision precision)
  : m_VertexFile(folder)
  , m_FaceFile(folder)
  , m_Precision(precision)
{}

void
SurfaceSpool::AddVertices(const std::vector<SurfaceVertex> & vertices)
{
  std::vector<Vertex> records(vertices.size());
  std::transform(vertices.begin(), vertices.end(), records.begin(), [this](const auto & vertex) {
    return Pack(vertex, m_Precision);
  });
  this->PutVertices(m_NumberOfVertices, records);
}

void
SurfaceSpool::PutVertices(std::uint64_t first, const std::vector<Vertex> & vertices)
{
  m_VertexFile.WriteAt(first * BytesPerVertex, vertices.data(), vertices.size() * BytesPerVertex);
  m_NumberOfVertices += vertices.size();
}

void
SurfaceSpool::AddFaces(const std::vector<SurfaceFace> & faces)
{
  this->PutFaces(this->GetNumberOfFaces(), faces);
}

void
SurfaceSpool::PutFaces(std::uint64_t first, const std::vector<SurfaceFace> & faces)
{
  std::vector<FaceRecord> records(faces.size());
  std::transform(faces.begin(), faces.end(), records.begin(), [](const auto & face) { return Pack(face); });
  m_FaceFile.WriteAt(first * BytesPerFace, records.data(), records.size() * BytesPerFace);
  for (const SurfaceFace & face : faces)
  {
    ++(face.numberOfVertices == 3 ? m_NumberOfTriangles : m_NumberOfQuads);
    const auto end = face.vertices.begin() + face.numberOfVertices;
    m_NumberOfNeededVertices = std::max(m_NumberOfNeededVertices, *std::max_element(face.vertices.begin(), end) + 1);
  }
}

void
SurfaceSpool::ReadVertices(std::uint64_t first, std::uint64_t count, std::vector<Vertex> & vertices) const
{
  itk::MedialVoxelPoll();
  vertices.resize(count);
  m_VertexFile.ReadAt(first * BytesPerVertex, vertices.data(), count * BytesPerVertex);
}

void
SurfaceSpool::ReadFaces(std::uint64_t first, std::uint64_t count, std::vector<SurfaceFace> & faces) const
{
  itk::MedialVoxelPoll();
  std::vector<FaceRecord> records(count);
  m_FaceFile.ReadAt(first * BytesPerFace, records.data(), count * BytesPerFace);
  faces.resize(count);
  std::transform(records.begin(), records.end(), faces.begin(), [](const auto & record) { return Unpack(record); });
}

} // end namespace medialvoxel
