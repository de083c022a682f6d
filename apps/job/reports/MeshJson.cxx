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

/** Where a list ends of which only the first are of interest. */
constexpr std::size_t MostWalls = 100;

/** Why a wall has no elements; its length is its area over its width. */
const char *
GetReason(const itk::MedialVoxelWallLeftOut & wall)
{
  return wall.area < wall.elementSize * wall.width ? "smaller than an element"
         : wall.width < wall.elementSize / 2.0     ? "narrower than half an element"
                                                   : "no elements of good shape";
}

/** The largest of them, with the area of all. */
Json
MakeWallsLeftOut(const itk::MedialVoxelRemeshingSummary & remeshing)
{
  Json   walls = Json::array();
  double area = 0.0;
  for (const itk::MedialVoxelWallLeftOut & wall : remeshing.wallsLeftOut)
  {
    area += wall.area;
    if (walls.size() < MostWalls)
    {
      walls.push_back({ { "number", walls.size() + 1 },
                        { "position", wall.place },
                        { "area", wall.area },
                        { "width", wall.width },
                        { "element_size", wall.elementSize },
                        { "reason", GetReason(wall) } });
    }
  }
  return { { "area", area },
           { "area_share", remeshing.fineArea > 0.0 ? area / remeshing.fineArea : 0.0 },
           { "walls", walls } };
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
           { "warpage_percentile_99", quality.shapes.highWarpage },
           { "largest_warpage", quality.shapes.largestWarpage },
           { "least_angle", quality.shapes.leastAngle },
           { "largest_angle", quality.shapes.largestAngle },
           { "shortest_side", quality.shapes.shortestSide },
           { "mean_side", quality.shapes.meanSide },
           { "longest_side", quality.shapes.longestSide },
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
  json["pieces_left_out"] =
    surface.pieces ? Json{ { "number", surface.pieces->number }, { "area", surface.pieces->area } } : Json(nullptr);
  if (surface.remeshing)
  {
    const itk::MedialVoxelRemeshingSummary & remeshing = *surface.remeshing;
    json["remeshing"] = { { "area_before", remeshing.fineArea },
                          { "distance_to_fine", MakeDistances(remeshing.toFine) },
                          { "distance_from_fine", MakeDistances(remeshing.fromFine) },
                          { "mean_distance_at_lines", remeshing.toFineAtLines },
                          { "mean_distance_elsewhere", remeshing.toFineElsewhere },
                          { "area_share_elsewhere", remeshing.shareElsewhere },
                          { "walls", remeshing.walls },
                          { "walls_left_out", remeshing.wallsLeftOut.size() },
                          { "left_out", MakeWallsLeftOut(remeshing) },
                          { "holes_closed", remeshing.holesClosed },
                          { "triangles_left_out", remeshing.trianglesLeftOut },
                          { "orientation_conflicts", remeshing.orientationConflicts },
                          { "rims", MakeRims(remeshing.rims) } };
    json["quality"] = MakeQuality(surface.quality.value());
  }
  return json;
}

} // end namespace medialvoxel
