// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PartSurface.h"

#include "MeshPlacement.h"
#include "ThreadedTasks.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

/** Memory for reading the scratch files, by measures and writers, and for their results. */
constexpr std::uint64_t WritingMemory = 24 * MiB;

/** Planned density of vertices; there are twice as many triangles. */
constexpr std::uint64_t VoxelsPerVertex = 32;

constexpr const char * RayName = "ray_thickness";

double
GetMaximumRay(const PartOptions & options, const VolumeHeader & header)
{
  return GetLocalThickness(GetThicknessOptions(options), GetGrid(header)).maximumThickness;
}

std::int64_t
GetHalo(const PartOptions & options, const VolumeHeader & header)
{
  return options.measuresRays
           ? itk::MedialVoxelWallRay::GetHalo(header.geometry.spacing[2], GetMaximumRay(options, header))
           : 0;
}

/** Slices whose margins are kept: two that have the surface between them, and the halo on both sides. */
std::int64_t
GetSlicesOfMargins(const PartOptions & options, const VolumeHeader & header)
{
  return 2 * GetHalo(options, header) + 2;
}

bool
IsMirrored(const itk::MedialVoxelSurfacePlacement & placement)
{
  const auto & [x, y, z] = placement.steps;
  return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) + x[2] * (y[0] * z[1] - y[1] * z[0]) <
         0.0;
}

} // namespace

/** \class PartSurface::Map
 * \brief Takes a volume that is written, and hands its slices on instead of keeping them. */
class PartSurface::Map : public VoxelReceiver
{
public:
  explicit Map(PartSurface & surface)
    : m_Surface(surface)
  {}

  void
  Write(std::uint64_t firstVoxel, std::uint64_t numberOfVoxels, const void * data) override
  {
    const auto perSlice = m_Surface.m_Header.geometry.GetVoxelsPerSlice();
    for (std::uint64_t done = 0; done < numberOfVoxels; done += perSlice)
    {
      m_Surface.AddSlice(static_cast<std::int64_t>((firstVoxel + done) / perSlice),
                         static_cast<const float *>(data) + done);
    }
  }

private:
  PartSurface & m_Surface;
};

PartSurface::PartSurface(const PartOptions & options, const VolumeHeader & header, itk::MedialVoxelObjectSource & input)
  : m_Options(options)
  , m_Header(header)
  , m_Input(input)
  , m_Size(GetSize(header.geometry))
  , m_Placement(GetPlacement(header.geometry))
  , m_IsMirrored(IsMirrored(m_Placement))
  , m_MaximumRay(GetMaximumRay(options, header))
  , m_Halo(GetHalo(options, header))
  , m_Margins(m_Size, GetSlicesOfMargins(options, header))
  , m_Ray(m_Margins, GetGrid(header).GetSpacing(), m_MaximumRay)
  , m_Isosurface(m_Margins,
                 !options.isOpen,
                 *this,
                 [](const std::size_t count, const auto & task) { RunInThreads(count, task); })
  , m_Map(std::make_unique<Map>(*this))
  , m_Before(header.geometry.GetVoxelsPerSlice())
  , m_Spool(GetScratchFolder(options, options.output), GetPrecision(header.geometry))
{
  if (options.measuresRays)
  {
    m_RayThickness.emplace(GetScratchFolder(options, options.output), RayName);
  }
}

PartSurface::~PartSurface() = default;

VoxelOutput &
PartSurface::GetMap()
{
  return *m_Map;
}

void
PartSurface::AddSlice(std::int64_t z, const float * thickness)
{
  itk::MedialVoxelCheckAbort();
  m_Z = z;
  m_Now = thickness;
  this->ReadSlices(z + m_Halo);
  m_Isosurface.AddSlice(m_Objects.front());
  m_Objects.pop_front();
  std::copy(thickness, thickness + m_Before.size(), m_Before.begin());
}

void
PartSurface::ReadSlices(std::int64_t last)
{
  for (const std::int64_t end = std::min(last + 1, m_Size[2]); m_SlicesRead < end; ++m_SlicesRead)
  {
    this->ReadSlice(m_SlicesRead);
  }
}

void
PartSurface::ReadSlice(std::int64_t z)
{
  const itk::MedialVoxelBox box{ { 0, 0, z }, { m_Size[0], m_Size[1], z + 1 } };
  m_Objects.emplace_back(box);
  itk::MedialVoxelTargets targets;
  targets.object = &m_Objects.back();
  if (m_Facts.usesGrayValues)
  {
    m_Gray.Frame(box, box);
    targets.gray = &m_Gray;
  }
  m_Input.Fill(box, targets);
  this->SetMargins(z, m_Objects.back());
}

void
PartSurface::SetMargins(std::int64_t z, const itk::MedialVoxelBits & object)
{
  const auto range = GetGrayRange(m_Options, m_Header);
  const bool isLower = std::isfinite(range.lower);
  for (std::int64_t y = 0; y < m_Size[1]; ++y)
  {
    float * const margins = m_Margins.GetRow(y, z);
    if (m_Facts.usesGrayValues)
    {
      const float * const values = m_Gray.GetRow(y, z);
      std::transform(values, values + m_Size[0], margins, [&](float value) {
        return static_cast<float>(isLower ? value - range.lower : range.upper - value);
      });
    }
    else
    {
      const auto * const row = object.GetRow(y, z);
      for (std::int64_t x = 0; x < m_Size[0]; ++x)
      {
        margins[x] = (row[x >> 6] >> (x & 63) & 1u) != 0 ? 0.5f : -0.5f;
      }
    }
  }
}

void
PartSurface::AddVertices(const std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceVertex> & vertices)
{
  if (vertices.empty())
  {
    return;
  }
  constexpr double        unknown = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t           unknownVertices = 0;
  std::vector<MeshVertex> records(vertices.size());
  std::transform(vertices.begin(), vertices.end(), records.begin(), [&](const auto & vertex) {
    MeshVertex result{ m_Placement.origin };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (unsigned int component = 0; component < 3; ++component)
      {
        result.position[component] += vertex.point[axis] * m_Placement.steps[axis][component];
      }
    }
    const auto & object = vertex.object;
    const auto   offset = static_cast<std::size_t>(object[1] * m_Size[0] + object[0]);
    const float  thickness = object[2] == m_Z && m_Now != nullptr ? m_Now[offset] : m_Before[offset];
    result.thickness = thickness > 0.0f ? thickness : unknown;
    unknownVertices += thickness > 0.0f ? 0 : 1;
    return result;
  });
  m_Spool.PutVertices(first, records);
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Facts.unknownVertices += unknownVertices;
  }
  if (m_RayThickness)
  {
    this->AddRays(first, vertices);
  }
}

void
PartSurface::CountRay(const itk::MedialVoxelRayEnd end)
{
  using End = itk::MedialVoxelRayEnd;
  m_Facts.unansweredRays.leaveVolume += end == End::Image ? 1 : 0;
  m_Facts.unansweredRays.tooLong += end == End::Maximum ? 1 : 0;
  m_Facts.unansweredRays.unknown += end == End::Unknown ? 1 : 0;
}

void
PartSurface::AddRays(const std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceVertex> & vertices)
{
  constexpr float                        unknown = std::numeric_limits<float>::quiet_NaN();
  std::vector<itk::MedialVoxelRayResult> rays(vertices.size());
  std::transform(vertices.begin(), vertices.end(), rays.begin(), [this](const auto & vertex) {
    return m_Ray.Measure(vertex.point);
  });
  std::vector<float> lengths(vertices.size());
  std::transform(rays.begin(), rays.end(), lengths.begin(), [](const itk::MedialVoxelRayResult & ray) {
    return ray.end == itk::MedialVoxelRayEnd::Surface ? static_cast<float>(ray.length) : unknown;
  });
  m_RayThickness->Put(first, lengths);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  std::for_each(rays.begin(), rays.end(), [this](const itk::MedialVoxelRayResult & ray) { this->CountRay(ray.end); });
}

void
PartSurface::AddTriangles(const std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceTriangle> & triangles)
{
  if (triangles.empty())
  {
    return;
  }
  std::vector<MeshFace> faces(triangles.size());
  std::transform(triangles.begin(), triangles.end(), faces.begin(), [this](const auto & triangle) {
    MeshFace face;
    const auto & [a, b, c] = triangle.vertices;
    face.vertices = { a, m_IsMirrored ? c : b, m_IsMirrored ? b : c, 0 };
    face.numberOfVertices = 3;
    face.isCap = triangle.isCap;
    return face;
  });
  m_Spool.PutFaces(first, faces);
}

Json
PartSurface::Write(OutputFile & file, const std::function<void(double)> & progress)
{
  m_Now = nullptr;
  m_Isosurface.Finish();
  m_Facts.isOpen = m_Options.isOpen;
  const VertexValues * const rays = m_RayThickness ? &*m_RayThickness : nullptr;
  const Json                 part = MeasurePart(m_Spool, rays, m_Header.geometry, m_Facts, progress);
  const Json &               colors = part["color_range"];
  MeshWriteOptions           options;
  options.isOfPart = true;
  options.unit = m_Header.geometry.DescribeUnit();
  options.progress = progress;
  if (!colors.is_null())
  {
    options.colorRange = ThicknessRange{ colors.front(), colors.back() };
  }
  if (rays != nullptr)
  {
    options.vertexArrays.push_back(rays);
  }
  WriteMesh(GetMeshFormat(m_Options.output), m_Spool, options, file);
  return part;
}

ProductFootprint
PartSurface::GetFootprint(const PartOptions & options, const VolumeHeader & header)
{
  const itk::MedialVoxelIndex size = GetSize(header.geometry);
  const std::uint64_t         perSlice = header.geometry.GetVoxelsPerSlice();
  const std::uint64_t         bits = itk::MedialVoxelBits::GetBytes({ { 0, 0, 0 }, { size[0], size[1], 1 } });
  const bool                  mayUseGray = MayMeasureOnGrayValues(GetThicknessOptions(options), header);
  const std::uint64_t         gray = mayUseGray ? perSlice * sizeof(float) : 0;
  ProductFootprint            footprint;
  footprint.beside = itk::MedialVoxelMargins::GetBytes(size, GetSlicesOfMargins(options, header)) +
                     itk::MedialVoxelIsosurface::GetBytes(size) + perSlice * sizeof(float) + gray +
                     static_cast<std::uint64_t>(GetHalo(options, header) + 1) * bits + WritingMemory;
  const std::uint64_t perVertex =
    MeshSpool::VertexSize + 2 * MeshSpool::FaceSize + (options.measuresRays ? VertexValues::VertexSize : 0);
  footprint.scratch = { GetScratchFolder(options, options.output),
                        header.geometry.GetNumberOfVoxels() / VoxelsPerVertex * perVertex };
  return footprint;
}

} // end namespace medialvoxel
