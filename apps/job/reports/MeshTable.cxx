// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshTable.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

Json
ElementSizeToJson(const ElementSize & size)
{
  return size.kind == ElementSize::Kind::Length
           ? Json(size.length)
           : Json(size.kind == ElementSize::Kind::Voxel ? VoxelElementSize : AutomaticElementSize);
}

Json
MakeDistances(const itk::MedialVoxelRemeshingSummary::Distances & distances)
{
  return { { "largest", distances.largest }, { "percentile_99", distances.most }, { "mean", distances.mean } };
}

/** Null where they stay where they are. */
Json
MakeRims(const std::optional<itk::MedialVoxelRimExtensionSummary> & rims)
{
  return rims ? Json{ { "length", rims->rimLength },
                      { "points", rims->points },
                      { "mean_extension", rims->length },
                      { "largest_extension", rims->longest },
                      { "area", rims->area },
                      { "points_cut_back", rims->cutBack },
                      { "sides", rims->sides },
                      { "sides_without_surface", rims->withoutSurface } }
              : Json(nullptr);
}

/** Limits as a list, in the order of the table. */
Json
MakeQuality(const MeshQuality & quality)
{
  Json limits = Json::array();
  for (const MeshLimit & limit : ListMeshLimits(quality))
  {
    limits.push_back({ { "name", limit.name },
                       { "value", limit.value },
                       { limit.isLeast ? "least" : "most", limit.limit },
                       { "holds", limit.Holds() } });
  }
  return { { "nodes", quality.nodes },
           { "triangles", quality.triangles },
           { "quadrilaterals", quality.quads },
           { "rim_sides", quality.rimSides },
           { "junction_sides", quality.junctionSides },
           { "walls", quality.walls },
           { "one_sided_walls", quality.oneSidedWalls },
           { "least_scaled_jacobian", quality.shapes.leastJacobian },
           { "largest_aspect_ratio", quality.shapes.largestAspect },
           { "limits", limits } };
}

/** Of a mesh with elements of a size, with the limits. */
void
AddQuality(TextTable & table, const MeshQuality & quality)
{
  const TextTable counts{ { "triangles", std::to_string(quality.triangles) },
                          { "quadrilaterals", std::to_string(quality.quads) },
                          { "sides of one element", std::to_string(quality.rimSides) },
                          { "sides of more than two", std::to_string(quality.junctionSides) },
                          { "walls", std::to_string(quality.walls) },
                          { "walls with one side only", std::to_string(quality.oneSidedWalls) },
                          { "least scaled Jacobian", FormatShort(quality.shapes.leastJacobian) },
                          { "largest aspect ratio", FormatShort(quality.shapes.largestAspect) } };
  for (const auto & [name, value] : counts)
  {
    table.emplace_back("  " + name, value);
  }
  for (const MeshLimit & limit : ListMeshLimits(quality))
  {
    table.emplace_back("  " + limit.name, limit.Format());
  }
}

} // namespace

Json
MakeMeshJson(const SurfaceSummary & surface)
{
  Json json{ { "vertices", surface.vertices },
             { "faces", surface.faces },
             { "area", surface.area },
             { "element_size", ElementSizeToJson(surface.elementSize) } };
  if (surface.remeshing)
  {
    const itk::MedialVoxelRemeshingSummary & remeshing = *surface.remeshing;
    json["remeshing"] = { { "area_before", remeshing.fineArea },
                          { "distance_to_fine", MakeDistances(remeshing.toFine) },
                          { "distance_from_fine", MakeDistances(remeshing.fromFine) },
                          { "walls", remeshing.walls },
                          { "walls_left_out", remeshing.wallsLeftOut },
                          { "holes_closed", remeshing.holesClosed },
                          { "triangles_left_out", remeshing.trianglesLeftOut },
                          { "orientation_conflicts", remeshing.orientationConflicts },
                          { "rims", MakeRims(remeshing.rims) } };
    json["quality"] = MakeQuality(surface.quality.value());
  }
  return json;
}

TextTable
DescribeMesh(const SurfaceSummary & surface)
{
  TextTable table{ { "mesh",
                     std::to_string(surface.vertices) + " vertices, " + std::to_string(surface.faces) + " faces" } };
  if (!surface.remeshing)
  {
    return table;
  }
  const itk::MedialVoxelRemeshingSummary & remeshing = *surface.remeshing;
  table.emplace_back("  area", FormatShort(surface.area) + " of " + FormatShort(remeshing.fineArea));
  table.emplace_back("  farthest from the fine surface",
                     FormatShort(std::max(remeshing.toFine.largest, remeshing.fromFine.largest)) + ", 99 % within " +
                       FormatShort(std::max(remeshing.toFine.most, remeshing.fromFine.most)));
  table.emplace_back("  walls left out",
                     std::to_string(remeshing.wallsLeftOut) + " of " + std::to_string(remeshing.walls));
  table.emplace_back("  orientation conflicts", std::to_string(remeshing.orientationConflicts));
  AddQuality(table, surface.quality.value());
  return table;
}

} // end namespace medialvoxel
