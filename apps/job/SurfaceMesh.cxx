// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceMesh.h"

#include "Errors.h"
#include "FileNames.h"
#include "VolumeText.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

/** Cells of the surface in the slices that are smoothed at a time: those of thin walls, some of them along the slices.
 */
constexpr std::uint64_t VoxelsPerCellInWork = 3;
constexpr std::uint64_t BytesPerCellInWork = 144;

/** A cell that waits for its piece to be done, in a vector that grows. */
constexpr std::uint64_t BytesPerPendingCell = 2 * sizeof(itk::MedialVoxelSurfaceCell);

/** What reading the scratch files for a writer takes. */
constexpr std::uint64_t BytesOfWriting = 8 * MiB;

/** Of the table of pieces: a vertex for each 64 voxels, in a vector that grows. */
constexpr std::uint64_t VoxelsPerByteOfPieces = 8;

/** Vertices or faces that are copied at a time. */
constexpr std::uint64_t CopiedAtATime = std::uint64_t{ 1 } << 14;

/** Cells that may wait; pieces that find more are done in smaller ones. */
std::uint64_t
GetPendingCells(const VolumeGeometry & geometry)
{
  constexpr std::uint64_t least = std::uint64_t{ 1 } << 16;
  return std::max(least, geometry.GetVoxelsPerSlice() / 8);
}

itk::MedialVoxelGrid::SpacingType
GetSpacing(const VolumeGeometry & geometry)
{
  return { { geometry.spacing[0], geometry.spacing[1], geometry.spacing[2] } };
}

itk::MedialVoxelSurfaceBuilder::Placement
GetPlacement(const VolumeGeometry & geometry)
{
  itk::MedialVoxelSurfaceBuilder::Placement placement;
  for (unsigned int component = 0; component < 3; ++component)
  {
    placement.origin[component] = geometry.origin[component];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      placement.steps[axis][component] = geometry.direction[axis][component] * geometry.spacing[axis];
    }
  }
  return placement;
}

/** Folder of the scratch files. */
std::filesystem::path
GetScratchFolder(const ExtractOptions & options)
{
  if (!options.scratchFolder.empty())
  {
    return options.scratchFolder;
  }
  const std::filesystem::path folder = FollowLinks(options.meshFile).parent_path();
  return folder.empty() ? "." : folder;
}

} // namespace

SurfaceMesh::SurfaceMesh(const ExtractOptions &       options,
                         const VolumeGeometry &       geometry,
                         const itk::MedialVoxelGrid & grid)
  : m_Format(GetSurfaceFormat(options.meshFile))
  , m_AsTriangles(options.meshTriangles)
  , m_SmallestPiece(options.smallestPiece)
  , m_SectionWidth(
      options.sectionWidth.value_or(0.25 * *std::min_element(geometry.spacing.begin(), geometry.spacing.end())))
  , m_ScratchFolder(GetScratchFolder(options))
  , m_Spool(m_ScratchFolder)
  , m_Observer(grid, GetParameters(options, grid), GetSpacing(geometry), GetPlacement(geometry), *this)
{
  m_Observer.SetMaximumNumberOfCells(GetPendingCells(geometry));
}

SurfaceSummary
SurfaceMesh::Write(OutputFile & file, const std::function<void(double)> & progress)
{
  m_Observer.Finish();
  SurfaceWriteOptions options;
  options.thicknessClassWidth = m_SectionWidth;
  options.progress = progress;
  if (m_SmallestPiece <= 1)
  {
    return this->WriteFrom(m_Spool, options, file);
  }
  SurfaceSpool kept(m_ScratchFolder);
  this->CopyPieces(kept);
  return this->WriteFrom(kept, options, file);
}

SurfaceSummary
SurfaceMesh::WriteFrom(const SurfaceSpool & spool, const SurfaceWriteOptions & options, OutputFile & file) const
{
  WriteSurface(m_Format, spool, options, file);
  SurfaceSummary summary;
  summary.vertices = spool.GetNumberOfVertices();
  summary.faces = spool.GetNumberOfFaces();
  summary.area = m_Area;
  return summary;
}

void
SurfaceMesh::CopyPieces(SurfaceSpool & kept)
{
  m_Pieces.Keep(m_SmallestPiece);
  m_Area = 0.0;
  std::vector<SurfaceSpool::Vertex> vertices;
  for (std::uint64_t first = 0; first < m_Spool.GetNumberOfVertices(); first += CopiedAtATime)
  {
    m_Spool.ReadVertices(first, std::min(CopiedAtATime, m_Spool.GetNumberOfVertices() - first), vertices);
    m_Vertices.clear();
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      if (m_Pieces.IsKept(first + i))
      {
        const auto & [x, y, z] = vertices[i].position;
        m_Vertices.push_back({ { { x, y, z } }, vertices[i].thickness });
      }
    }
    kept.AddVertices(m_Vertices);
  }
  for (std::uint64_t first = 0; first < m_Spool.GetNumberOfFaces(); first += CopiedAtATime)
  {
    m_Spool.ReadFaces(first, std::min(CopiedAtATime, m_Spool.GetNumberOfFaces() - first), m_Faces);
    const auto isDropped = [this](const SurfaceFace & face) { return !m_Pieces.IsKept(face.vertices[0]); };
    m_Faces.erase(std::remove_if(m_Faces.begin(), m_Faces.end(), isDropped), m_Faces.end());
    for (SurfaceFace & face : m_Faces)
    {
      m_Area += face.area;
      for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
      {
        face.vertices[corner] = m_Pieces.NumberOf(face.vertices[corner]);
      }
    }
    kept.AddFaces(m_Faces);
  }
}

void
SurfaceMesh::AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices)
{
  m_Vertices.resize(vertices.size());
  std::transform(vertices.begin(), vertices.end(), m_Vertices.begin(), [](const auto & vertex) {
    return SurfaceVertex{ vertex.point, vertex.thickness };
  });
  m_Spool.AddVertices(m_Vertices);
  if (m_SmallestPiece > 1)
  {
    m_Pieces.AddVertices(vertices.size());
  }
}

void
SurfaceMesh::AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads)
{
  m_Faces.clear();
  for (const itk::MedialVoxelSurfaceQuad & quad : quads)
  {
    m_Area += quad.GetArea();
    if (m_SmallestPiece > 1)
    {
      m_Pieces.AddQuad(quad.vertices);
    }
    if (m_AsTriangles)
    {
      this->AddTriangles(quad);
    }
    else
    {
      m_Faces.push_back({ quad.vertices, 4, quad.rimSides, quad.junctionSides, quad.GetArea() });
    }
  }
  m_Spool.AddFaces(m_Faces);
}

/** The halves along the shorter diagonal, which has no mark. */
void
SurfaceMesh::AddTriangles(const itk::MedialVoxelSurfaceQuad & quad)
{
  for (unsigned int half = 0; half < 2; ++half)
  {
    const auto  corners = quad.GetTriangle(half);
    SurfaceFace face;
    const auto  marksOf = [&](const unsigned int sides) {
      return static_cast<std::uint8_t>((sides >> corners[0] & 1u) | (sides >> corners[1] & 1u) << 1);
    };
    face.vertices = { { quad.vertices[corners[0]], quad.vertices[corners[1]], quad.vertices[corners[2]], 0 } };
    face.numberOfVertices = 3;
    face.rimEdges = marksOf(quad.rimSides);
    face.junctionEdges = marksOf(quad.junctionSides);
    face.area = quad.areas[half];
    m_Faces.push_back(face);
  }
}

std::uint64_t
SurfaceMesh::GetBytes(const ExtractOptions & options, const VolumeGeometry & geometry)
{
  const std::uint64_t pieces = options.smallestPiece > 1 ? geometry.GetNumberOfVoxels() / VoxelsPerByteOfPieces : 0;
  return geometry.GetVoxelsPerSlice() / VoxelsPerCellInWork * BytesPerCellInWork +
         GetPendingCells(geometry) * BytesPerPendingCell + BytesOfWriting + pieces;
}

void
CheckSurfaceInput(const VolumeHeader & header)
{
  if (header.geometry.GetDimension() != 3)
  {
    Fail(ExitStatus::Usage, header.fileName, ": the volume has 2 dimensions; a medial surface needs 3");
  }
}

} // end namespace medialvoxel
