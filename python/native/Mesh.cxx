// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayEngine.h"
#include "ProcessMemory.h"
#include "RimRays.h"
#include "SheetMesh.h"
#include "MeshReader.h"
#include "SheetRemeshing.h"

#include <algorithm>
#include <filesystem>

namespace medialvoxel
{
namespace
{

/** Takes a surface apart, with coordinates in the order of the axes of the array; a triangle among quadrilaterals has
 * its last corner twice. */
void
CopyMesh(const MeshSpool & surface, ArrayMesh & mesh)
{
  mesh.cornersPerFace = surface.GetNumberOfTriangles() > 0 && surface.GetNumberOfQuads() == 0 ? 3 : 4;
  MeshReader reader(surface, {});
  reader.ForEachVertex([&](std::uint64_t, const MeshSpool::Vertex & vertex) {
    mesh.points.insert(mesh.points.end(), { vertex.position[2], vertex.position[1], vertex.position[0] });
    mesh.thickness.push_back(vertex.thickness);
  });
  reader.ForEachFace([&](std::uint64_t, const MeshFace & face) {
    for (std::int64_t corner = 0; corner < mesh.cornersPerFace; ++corner)
    {
      const auto last = std::int64_t{ face.numberOfVertices } - 1;
      mesh.faces.push_back(static_cast<std::int64_t>(face.vertices[static_cast<std::size_t>(std::min(corner, last))]));
    }
  });
}

} // namespace

nlohmann::json
MeshArray(const ArrayCall & call, const ExtractOptions & given, ArrayMesh & mesh)
{
  ExtractOptions options = given;
  options.scratchFolder = std::filesystem::temp_directory_path().string();
  const VolumeGeometry & geometry = call.header.geometry;
  CheckElementSize(options, geometry);
  ArrayEngine                 engine(call, options);
  itk::MedialVoxelObjectInput object = engine.MakeObject(GetSmoothing(options));
  engine.Prepare(object, options);
  const ArrayMeasure measure =
    engine.FindMeasure(object, MayMeasureOnGrayValues(options, call.header), "", options.materials);
  const std::uint64_t             memoryLimit = options.memoryLimit.value_or(GetFreeMemory() / 2);
  SheetMesh                       surface(options, geometry, engine.GetGrid(), memoryLimit);
  itk::MedialVoxelSheetExtraction extraction;
  extraction.parameters = GetParameters(options, engine.GetGrid());
  extraction.grayRange = measure.range;
  extraction.AddObserver(surface.GetObserver());
  engine.Run(object, extraction, [](const itk::MedialVoxelTileResult &) {});
  RimRays rays(object, geometry, measure.range);
  surface.FindEdgesWith([&rays](const auto & bundle) { return rays.Measure(bundle); });
  engine.ReadBeforeRun([&](const auto & observer) {
    CopyMesh(surface.Finish(memoryLimit, engine.GetNumberOfThreads(), observer), mesh);
  });
  return nlohmann::json::object();
}

} // end namespace medialvoxel
