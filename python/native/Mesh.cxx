// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayVolume.h"
#include "FilterRun.h"
#include "ProcessMemory.h"
#include "RimRays.h"
#include "SurfacePlacement.h"
#include "SurfaceReader.h"
#include "SurfaceRemeshing.h"

#include "itkMedialSurfaceMeshFilter.h"
#include "itkMultiThreaderBase.h"

#include <filesystem>

namespace medialvoxel
{
namespace
{

/** Points are as exact as the volume is large; cells have their areas. */
using MeshType = itk::Mesh<float, 3, itk::DefaultStaticMeshTraits<float, 3, 3, double, float, double>>;

/** Takes the mesh apart, with coordinates in the order of the axes of the array. */
void
CopyMesh(const MeshType & source, ArrayMesh & mesh)
{
  mesh.points.reserve(3 * source.GetNumberOfPoints());
  mesh.thickness.reserve(source.GetNumberOfPoints());
  for (itk::IdentifierType i = 0; i < source.GetNumberOfPoints(); ++i)
  {
    const auto & point = source.GetPoints()->ElementAt(i);
    mesh.points.insert(mesh.points.end(), { point[2], point[1], point[0] });
    mesh.thickness.push_back(source.GetPointData()->ElementAt(i));
  }
  mesh.faces.reserve(static_cast<std::size_t>(mesh.cornersPerFace) * source.GetNumberOfCells());
  for (itk::IdentifierType i = 0; i < source.GetNumberOfCells(); ++i)
  {
    const MeshType::CellType & cell = *source.GetCells()->ElementAt(i);
    mesh.faces.insert(mesh.faces.end(), cell.PointIdsBegin(), cell.PointIdsEnd());
  }
}

/** The mesh as the program keeps it, with the areas of its source. */
std::unique_ptr<SurfaceSpool>
MakeSpool(const ArrayMesh &             mesh,
          const MeshType &              source,
          const VolumeGeometry &        geometry,
          const std::filesystem::path & folder)
{
  std::vector<SurfaceVertex> vertices;
  for (std::size_t i = 0; i < mesh.thickness.size(); ++i)
  {
    const double * const point = mesh.points.data() + 3 * i;
    vertices.push_back({ { { point[2], point[1], point[0] } }, mesh.thickness[i] });
  }
  std::vector<SurfaceFace> faces;
  const auto               corners = static_cast<std::size_t>(mesh.cornersPerFace);
  for (std::size_t first = 0; first < mesh.faces.size(); first += corners)
  {
    SurfaceFace face{ {}, static_cast<std::uint8_t>(corners) };
    std::copy_n(mesh.faces.begin() + static_cast<std::ptrdiff_t>(first), corners, face.vertices.begin());
    face.area = source.GetCellData()->ElementAt(first / corners);
    faces.push_back(face);
  }
  auto spool = std::make_unique<SurfaceSpool>(folder, GetPrecision(geometry));
  spool->AddVertices(vertices);
  spool->AddFaces(faces);
  return spool;
}

/** Takes a surface apart; a triangle among quadrilaterals has its last corner twice. */
void
CopySurface(const SurfaceSpool & surface, ArrayMesh & mesh)
{
  mesh = ArrayMesh();
  mesh.cornersPerFace = surface.GetNumberOfTriangles() > 0 && surface.GetNumberOfQuads() == 0 ? 3 : 4;
  SurfaceReader reader(surface, {});
  reader.ForEachVertex([&](std::uint64_t, const SurfaceSpool::Vertex & vertex) {
    mesh.points.insert(mesh.points.end(), { vertex.position[2], vertex.position[1], vertex.position[0] });
    mesh.thickness.push_back(vertex.thickness);
  });
  reader.ForEachFace([&](std::uint64_t, const SurfaceFace & face) {
    for (std::int64_t corner = 0; corner < mesh.cornersPerFace; ++corner)
    {
      const auto last = std::int64_t{ face.numberOfVertices } - 1;
      mesh.faces.push_back(static_cast<std::int64_t>(face.vertices[static_cast<std::size_t>(std::min(corner, last))]));
    }
  });
}

/** Elements of a size instead of the faces of the voxels.
 * \param source   that the mesh was made of
 * \param findEdge of the part, from its rims */
void
Remesh(const ArrayCall &              call,
       const ExtractOptions &         options,
       const MeshType &               source,
       itk::MedialVoxelMeasureRimRays findEdge,
       ArrayMesh &                    mesh)
{
  const VolumeGeometry &          geometry = call.header.geometry;
  ControlProgress                 progress(call.control);
  const itk::MedialVoxelPollScope scope(progress);
  SurfaceRemeshing                remeshing;
  remeshing.size = GetElementSize(options, geometry);
  remeshing.size.extendsRims = options.extendsRims;
  remeshing.size.measureRimRays = std::move(findEdge);
  remeshing.scratchFolder = std::filesystem::temp_directory_path();
  remeshing.memoryLimit = options.memoryLimit.value_or(GetFreeMemory() / 2);
  remeshing.threads = options.threads.value_or(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads());
  remeshing.progress = [](double) { itk::MedialVoxelPoll(); };
  itk::MedialVoxelRemeshingSummary summary;
  auto                             surface = MakeSpool(mesh, source, geometry, remeshing.scratchFolder);
  CopySurface(*RemeshSurface(std::move(surface), remeshing, summary), mesh);
}

template <typename TPixel>
nlohmann::json
MakeMesh(const ArrayCall & call, const ExtractOptions & options, ArrayMesh & mesh)
{
  CheckElementSize(options, call.header.geometry);
  auto filter = itk::MedialSurfaceMeshFilter<ArrayImage<TPixel>, MeshType>::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  SetWalls(*filter, options);
  SetGrayMeasure(*filter, call, options, MayMeasureOnGrayValues(options, call.header));
  SetLevels(*filter, options);
  // Elements are joined from quadrilaterals, whether they become triangles or not.
  const bool isOfVoxels = options.elementSize.kind == ElementSize::Kind::Voxel;
  const bool hasTriangles = options.meshTriangles && isOfVoxels;
  filter->SetGenerateTriangles(hasTriangles);
  filter->SetMinimumBranchLength(options.minimumBranchLength);
  filter->SetSmallestComponent(static_cast<itk::SizeValueType>(options.smallestComponent));
  RunFilter(*filter, call.control);
  mesh.cornersPerFace = hasTriangles ? 3 : 4;
  CopyMesh(*filter->GetOutput(), mesh);
  if (!isOfVoxels)
  {
    ArrayVolume                                          volume(call, options, filter->GetObjectIsSmoothed());
    const auto                                           found = filter->GetScan();
    std::optional<itk::MedialVoxelExtraction::GrayRange> range;
    if (filter->GetSubvoxelThickness() && !found.isMask)
    {
      range = { filter->GetLowerThreshold(), filter->GetUpperThreshold(), found.scan };
    }
    RimRays rays(volume, call.header.geometry, range);
    Remesh(call, options, *filter->GetOutput(), [&rays](const auto & bundle) { return rays.Measure(bundle); }, mesh);
  }
  return nlohmann::json::object();
}

} // namespace

nlohmann::json
MeshArray(const ArrayCall & call, const ExtractOptions & options, ArrayMesh & mesh)
{
  return DispatchPixelType(call.header.pixelType,
                           [&](auto zero) { return MakeMesh<decltype(zero)>(call, options, mesh); });
}

} // end namespace medialvoxel
