// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetMesh.h"

#include "JobClock.h"
#include "MeshPlacement.h"
#include "MeshReader.h"
#include "OrderedWork.h"
#include "SheetObserver.h"
#include "SheetQuality.h"
#include "SheetRemeshing.h"
#include "MeshSorting.h"
#include "SheetThickness.h"

#include "itkMedialVoxelNearestWall.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

/** Memory for reading the scratch files for a writer. */
constexpr std::uint64_t WritingMemory = 8 * MiB;

/** Planned density of vertices, whose tables and scratch files hold all of them; there are as many faces. */
constexpr std::uint64_t VoxelsPerVertex = 64;

/** Faces whose walls a thread looks for at a time. */
constexpr std::uint64_t FacesOfTask = std::uint64_t{ 1 } << 12;

/** Vertices of a surface that is planned for. */
std::uint64_t
GetPlannedVertices(const VolumeGeometry & geometry)
{
  return geometry.GetNumberOfVoxels() / VoxelsPerVertex;
}

/** Marks of vertices, which the formats of solvers need. */
std::uint64_t
GetEdgeMemory(const ExtractOptions & options, const VolumeGeometry & geometry)
{
  const bool isForSolvers = HoldsElements(GetMeshFormat(options.meshFile));
  return isForSolvers ? GetPlannedVertices(geometry) / SheetEdges::VerticesPerByte : 0;
}

SheetCleaning
GetCleaning(const ExtractOptions & options)
{
  SheetCleaning cleaning;
  cleaning.minimumBranchLength = options.minimumBranchLength;
  cleaning.minimumComponentSize = options.minimumComponentSize;
  cleaning.scratchFolder = GetScratchFolder(options, options.meshFile);
  return cleaning;
}

} // namespace

SheetMesh::SheetMesh(const ExtractOptions &       options,
                     const VolumeGeometry &       geometry,
                     const itk::MedialVoxelGrid & grid,
                     const std::uint64_t          surplus,
                     RunTasks                     run)
  : m_Options(options)
  , m_Geometry(geometry)
  , m_Grid(grid)
  , m_Surplus(surplus)
  , m_Cleaning(GetCleaning(options))
  , m_RunTasks(std::move(run))
  , m_Spool(std::make_unique<MeshSpool>(m_Cleaning.scratchFolder, GetPrecision(geometry), MeshSpoolInput::Added))
{
  m_Cleaning.memoryLimit = GetCleaningMemory(m_Cleaning, GetPlannedVertices(geometry));
  if (options.labels)
  {
    itk::MedialVoxelSurfaceConsumer & consumer = *this;
    m_Passes = std::make_unique<SheetPasses>([this](auto & ofPass) { return this->MakeObserver(ofPass); }, consumer);
  }
  else
  {
    m_Observer = this->MakeObserver(*this);
  }
}

std::unique_ptr<itk::MedialVoxelSurfaceObserver>
SheetMesh::MakeObserver(itk::MedialVoxelSurfaceConsumer & consumer) const
{
  auto observer = MakeSheetObserver(m_Options, m_Geometry, m_Grid, m_Surplus, m_RunTasks, consumer);
  if (m_Options.labels)
  {
    observer->FindPartsWith([this](const itk::MedialVoxelIndex & cell) { return m_FindObject(cell); });
  }
  return observer;
}

SheetSummary
SheetMesh::Write(OutputFile &                        file,
                 std::uint64_t                       memoryLimit,
                 unsigned int                        threads,
                 const std::function<void(double)> & progress)
{
  this->Finish(memoryLimit, threads, progress);
  MeshWriteOptions options;
  options.thicknessClassWidth =
    m_Options.sectionWidth.value_or(0.25 * *std::min_element(m_Geometry.spacing.begin(), m_Geometry.spacing.end()));
  options.thicknessPlace = m_Options.thicknessPlace;
  options.objectLabels = m_ObjectLabels;
  options.hasWalls = m_Options.meshWalls;
  options.unit = m_Geometry.DescribeUnit();
  options.progress = progress;
  WriteMesh(GetMeshFormat(m_Options.meshFile), *m_Spool, options, file);
  SheetSummary summary;
  summary.vertices = m_Spool->GetNumberOfVertices();
  summary.faces = m_Spool->GetNumberOfFaces();
  summary.area = m_Area;
  summary.elementSize = m_Options.elementSize;
  summary.pieces = m_Pieces;
  summary.remeshing = m_Remeshing;
  if (m_Remeshing)
  {
    summary.quality = MeasureQuality(*m_Spool);
  }
  summary.remeshingSeconds = m_RemeshingSeconds;
  summary.wallSeconds = m_WallSeconds;
  return summary;
}

const MeshSpool &
SheetMesh::Finish(std::uint64_t memoryLimit, unsigned int threads, const std::function<void(double)> & progress)
{
  const auto check = [&progress](double) { progress(0.0); };
  if (m_Passes)
  {
    m_Passes->Finish();
    const auto objectOf = [](const MeshSpool::Vertex & vertex) { return vertex.object; };
    m_Spool = SortMesh(std::move(m_Spool), objectOf, m_ObjectLabels.size(), m_Cleaning.scratchFolder, check).surface;
  }
  else
  {
    this->CompleteSheet();
  }
  // They are in memory until all faces are there.
  memoryLimit -= std::min<std::uint64_t>(
    memoryLimit, m_Walls.points.size() * (sizeof(m_Walls.points.front()) + sizeof(m_Walls.wallOf.front())));
  if (m_Cleaning.IsOn())
  {
    m_Cleaning.memoryLimit += memoryLimit;
    m_Cleaning.progress = check;
    m_Spool = CleanSheet(std::move(m_Spool), m_Cleaning, m_Pieces);
  }
  if (IsRemeshed(m_Options))
  {
    const auto start = JobClock::now();
    this->Remesh(memoryLimit, threads, progress);
    m_RemeshingSeconds = SecondsSince(start);
  }
  if (m_Passes || m_Cleaning.IsOn() || m_Remeshing)
  {
    m_Area = 0.0;
    MeshReader(*m_Spool, {}).ForEachFace([this](std::uint64_t, const MeshFace & face) { m_Area += face.area; });
  }
  if (m_Options.meshWalls)
  {
    const auto start = JobClock::now();
    this->NumberFaces(threads, progress);
    m_WallSeconds = SecondsSince(start);
  }
  return *m_Spool;
}

void
SheetMesh::CompleteSheet()
{
  if (!m_IsComplete)
  {
    m_Observer->Finish();
    m_IsComplete = true;
  }
}

void
SheetMesh::NumberFaces(const unsigned int threads, const std::function<void(double)> & progress)
{
  const itk::MedialVoxelNearestWall nearest(std::move(m_Walls.points), std::move(m_Walls.wallOf));
  const std::uint64_t               faces = m_Spool->GetNumberOfFaces();
  const auto                        find = [&](const std::uint64_t task, const std::function<void()> & check) {
    const std::uint64_t   first = task * FacesOfTask;
    std::vector<MeshFace> ofTask;
    m_Spool->ReadFaces(first, std::min(FacesOfTask, faces - first), ofTask, MeshFaceFields::Corners);
    MeshReader                 reader(*m_Spool, {});
    std::vector<std::uint32_t> walls;
    for (const MeshFace & face : ofTask)
    {
      itk::MedialVoxelVector3 middle{};
      for (unsigned int corner = 0; corner < face.numberOfVertices; ++corner)
      {
        middle = itk::MedialVoxelAddScaled(
          middle, reader.GetVertex(face.vertices[corner]).position, 1.0 / face.numberOfVertices);
      }
      walls.push_back(nearest.Find(middle));
    }
    check();
    return walls;
  };
  OrderedWork<std::vector<std::uint32_t>>::Run((faces + FacesOfTask - 1) / FacesOfTask,
                                               threads,
                                               find,
                                               [&](const std::uint64_t task, const std::vector<std::uint32_t> & walls) {
                                                 m_Spool->PutWalls(task * FacesOfTask, walls);
                                               },
                                               [&progress] { progress(0.0); });
}

void
SheetMesh::Remesh(std::uint64_t memoryLimit, unsigned int threads, const std::function<void(double)> & progress)
{
  SheetRemeshing remeshing;
  remeshing.size = GetElementSize(m_Options, m_Geometry);
  remeshing.size.extendsRims = m_Options.extendsRims;
  remeshing.size.measureRimRays = m_MeasureRimRays;
  remeshing.scratchFolder = m_Cleaning.scratchFolder;
  remeshing.memoryLimit = memoryLimit + GetRemeshingMemory(1);
  remeshing.threads = threads;
  remeshing.progress = progress;
  m_Spool = RemeshSheet(std::move(m_Spool), remeshing, m_Remeshing.emplace());
}

void
SheetMesh::AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices)
{
  m_Vertices.resize(vertices.size());
  std::transform(vertices.begin(), vertices.end(), m_Vertices.begin(), [](const auto & vertex) {
    return MeshVertex{ vertex.point, vertex.thickness, vertex.part };
  });
  m_Spool->AddVertices(m_Vertices);
  for (itk::MedialVoxelSurfaceConsumer * const other : m_Others)
  {
    other->AddVertices(vertices);
  }
}

void
SheetMesh::AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads)
{
  m_Faces.clear();
  for (const itk::MedialVoxelSurfaceQuad & quad : quads)
  {
    m_Area += quad.GetArea();
    if (m_Options.meshTriangles && m_Options.elementSize.kind == ElementSize::Kind::Voxel)
    {
      this->AddTriangles(quad);
    }
    else
    {
      m_Faces.push_back({ quad.vertices, 4, quad.rimSides, quad.junctionSides, quad.GetArea() });
    }
  }
  m_Spool->AddFaces(m_Faces);
  for (itk::MedialVoxelSurfaceConsumer * const other : m_Others)
  {
    other->AddQuads(quads);
  }
}

/** The halves along the shorter diagonal, which has no mark. */
void
SheetMesh::AddTriangles(const itk::MedialVoxelSurfaceQuad & quad)
{
  for (unsigned int half = 0; half < 2; ++half)
  {
    const auto corners = quad.GetTriangle(half);
    MeshFace   face;
    const auto marksOf = [&](const unsigned int sides) {
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

ProductFootprint
SheetMesh::GetFootprint(const ExtractOptions &       options,
                        const VolumeGeometry &       geometry,
                        const itk::MedialVoxelGrid & grid)
{
  const SheetCleaning cleaning = GetCleaning(options);
  const bool          isRemeshed = IsRemeshed(options);
  const std::uint64_t vertices = GetPlannedVertices(geometry);
  ProductFootprint    footprint = GetSheetFootprint(options, geometry, grid);
  footprint.beside += WritingMemory + GetEdgeMemory(options, geometry) + (isRemeshed ? GetRemeshingMemory(1) : 0) +
                      GetCleaningMemory(cleaning, vertices);
  const std::uint64_t spools = isRemeshed ? 3 : cleaning.IsOn() || options.labels ? 2 : 1;
  const std::uint64_t sorting = options.labels || isRemeshed ? SortedVertexSize : 0;
  footprint.scratch = { cleaning.scratchFolder,
                        vertices * (spools * (MeshSpool::VertexSize + MeshSpool::FaceSize) + sorting +
                                    (options.meshWalls ? MeshSpool::WallSize : 0)) };
  return footprint;
}

} // end namespace medialvoxel
