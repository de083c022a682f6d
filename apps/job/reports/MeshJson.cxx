// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshJson.h"

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

} // namespace

Json
MakeMeshJson(const SheetSummary & surface)
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

} // end namespace medialvoxel
