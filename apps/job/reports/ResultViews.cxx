// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ResultViews.h"

#include "MeshJson.h"
#include "FillIn.h"

#include <cstddef>

namespace medialvoxel
{

const char * const MeasureText =
  "[measure.on=object?on the object][measure.on=crossings?where gray values cross the threshold]"
  "[measure.on=fits?by fits to gray values: background {short measure.scan.background}, material "
  "{short measure.scan.material}, blur {short measure.scan.blur} voxels, noise {contrast measure.scan.noise "
  "measure.scan.material measure.scan.background} of the contrast][measure.reason?: {measure.reason}]";

namespace
{

/** Where the thinnest wall is. */
constexpr const char * ThinnestText =
  "at [thickness.thinnest.center:[!#=1?, ]{short .}], cell [thickness.thinnest.index:[!#=1?, ]{.}]; "
  "[thickness.thinnest.uncertainty?± {short thickness.thinnest.uncertainty} (95 %)]"
  "[!thickness.thinnest.uncertainty?uncertainty not known][thickness.thinnest.at_edge?, at the edge of the volume]";

constexpr unsigned int Tables = ExtractTable | SurfaceTable | DistanceTable;
constexpr unsigned int PartTables = ExtractTable | SurfaceTable;

/** Rows of a list in a table. */
constexpr std::size_t MostMembers = 20;

std::string
OverThreads(const std::string & seconds)
{
  return "{fixed seconds." + seconds + "} s[!threads=1?, summed over {threads} threads]";
}

/** The text of a thickness of the surface of a part. */
std::string
OfSurface(const std::string & path)
{
  const std::string percentile = "{short " + path + ".percentiles.";
  return "[" + path + ".mean?5 %: " + percentile + "5}, median " + percentile + "50}, 95 %: " + percentile +
         "95}, in {unit}, by area][!" + path + ".mean?not known anywhere]";
}

/** The text of a count of cells among all candidates. */
std::string
OfCells(const std::string & count)
{
  return "{count counts." + count + " counts.candidate_cells}";
}

/** The text of the largest place of a kind. */
std::string
OfPlaces(const std::string & kind, const std::string & side, const std::string & extreme)
{
  const std::string path = "places." + kind;
  return "{" + path + ".number}, area {short " + path + ".area_beyond_limit} " + side + " {short " + path +
         ".limit}, {percent " + path + ".share_of_sheet} of the sheet[" + path + ".worst?; the " + extreme +
         " {short " + path + ".worst}, the largest {short " + path + ".places.0.area_beyond_limit}][" + path +
         ".smaller>0?; without {" + path + ".smaller} of less than {short " + path + ".min_place_area}]";
}

} // namespace

const std::vector<ViewRow> &
ListViewRows()
{
  static const std::vector<ViewRow> rows{
    { PageInput, "", "file", "{name input.file}" },
    { PageInput, "", "format", "{input.format}" },
    { DistanceTable, "", "volume", "{times size}" },
    { PageInput, "", "resolution", "{times size}" },
    { PageInput,
      "",
      "spacing",
      "[parameters.resampled_spacing?{times parameters.resampled_spacing}]"
      "[!parameters.resampled_spacing?{times input.spacing}][input.unit? {input.unit}]" },
    { PageInput, "", "type", "{input.type}" },

    { PageParameters, "", "thickness (tau)", "{parameters.thickness}" },
    { PageParameters, "parameters.max_thickness", "thinner walls count as", "{short parameters.min_thickness}" },
    { PageParameters,
      "parameters.max_thickness",
      "maximum thickness",
      "{short parameters.max_thickness}[parameters.raised_from?, raised from {short parameters.raised_from}]" },
    { PageParameters, "", "lengths in", "{unit}" },
    { PageParameters,
      "",
      "lower threshold",
      "[parameters.lower?{parameters.lower}][!parameters.lower?none][parameters.lower_otsu? (otsu)]" },
    { PageParameters, "", "upper threshold", "[parameters.upper?{parameters.upper}][!parameters.upper?none]" },
    { PageParameters, "", "label", "[parameters.label?{parameters.label}][!parameters.label?none]" },

    { PartTables, "", "object", "{counts.object_voxels} voxels, {filled counts.object_voxels size} of {times size}" },
    { ExtractTable,
      "passes",
      "  objects",
      "{size objects} in {passes} pass[!passes=1?es], {shared_cells} cells medial for several" },
    { ExtractTable,
      "",
      "  label {label}",
      "[name?{name}: ]{voxels} voxels, {medial_cells} medial cells[thickness.mean?, mean thickness {short "
      "thickness.mean}]",
      "/objects" },
    { SlicerLines, "", "objectVoxels", "{counts.object_voxels}" },
    { PageParameters,
      "smoothed|roughness",
      "smoothed",
      "[smoothed?yes][!smoothed?no][roughness?, roughness {percent roughness.ratio}]" },
    { PageParameters, "!smoothed&!roughness", "smoothed", "no" },
    { PageParameters, "", "largest pores left out", "{parameters.max_pore_size} voxels" },
    { LongTable, "", "tau", "{parameters.thickness}[!parameters.thickness=auto? {unit}]" },
    { LongTable, "", "candidate cells", "{counts.candidate_cells}" },
    { LongTable, "", "  trivial", OfCells("trivial") },
    { LongTable, "", "  medial by bound", OfCells("bound") },
    { LongTable, "", "  medial by geodesic", OfCells("geodesic_medial") },
    { LongTable, "", "  non-medial by geodesic", OfCells("geodesic_non_medial") },
    { LongTable, "", "medial cells", "{counts.medial_cells}" },
    { ExtractTable,
      "topology",
      "topology",
      "{topology.added_cells} cells added; parts {topology.object.parts}, tunnels {topology.object.tunnels}, cavities "
      "{topology.object.cavities}" },
    { ExtractTable, "walls", "seams", "{walls.number_of_seams}, where {walls.number_of_walls} walls meet or end" },
    { LongTable, "", "pseudo", "[percent.pseudo?{fixed percent.pseudo} %][!percent.pseudo?-]" },
    { LongTable, "", "correct", "[percent.correct?{fixed percent.correct} %][!percent.correct?-]" },
    { SlicerLines, "", "candidateCells", "{counts.candidate_cells}" },
    { SlicerLines, "", "trivialCells", "{counts.trivial}" },
    { SlicerLines, "", "boundCells", "{counts.bound}" },
    { SlicerLines, "", "geodesicMedialCells", "{counts.geodesic_medial}" },
    { SlicerLines, "", "geodesicNonMedialCells", "{counts.geodesic_non_medial}" },
    { SlicerLines, "", "medialCells", "{counts.medial_cells}" },
    { SlicerLines, "", "pseudoPercent", "[percent.pseudo?{percent.pseudo}][!percent.pseudo?nan]" },
    { SlicerLines, "", "correctPercent", "[percent.correct?{percent.correct}][!percent.correct?nan]" },

    { ExtractTable, "!thickness.mean", "walls", "none with a thickness" },
    { ExtractTable,
      "thickness.mean",
      "walls",
      "[thickness.minimum?thinnest {short thickness.minimum}, ]5 %: {short thickness.percentiles.5}, median {short "
      "thickness.percentiles.50}, 95 %: {short thickness.percentiles.95}[thickness.maximum?, thickest {short "
      "thickness.maximum}], in {unit}, by area" },
    { ExtractTable, "thickness.thinnest", "  thinnest", ThinnestText },
    { ExtractTable,
      "thickness.mean",
      "  measured",
      std::string(MeasureText) + "[measure.uncertainty?; uncertainty {short measure.uncertainty.percentiles.50} (half "
                                 "of the 95 % interval, median)]"
                                 "[thickness.standard_error?; a sample, one of {thickness.one_cell_of}]" },
    { LongTable,
      "thickness.mean",
      "  mean",
      "{short thickness.mean}[thickness.standard_error?, standard error {short thickness.standard_error}], standard "
      "deviation {short thickness.standard_deviation}, area {short thickness.area}" },
    { LongTable,
      "thickness.mean",
      "  at rims, junctions",
      "{count thickness.unpaired_cells thickness.unpaired_cells thickness.unresolved_cells thickness.cells}" },
    { LongTable,
      "thickness.mean&thickness.unresolved_cells>0",
      "  not resolved",
      "{count thickness.unresolved_cells thickness.unpaired_cells thickness.unresolved_cells thickness.cells}" },
    { LongTable,
      "thickness.mean&measure.uncertainty",
      "  uncertainty (95 %)",
      "median {short measure.uncertainty.percentiles.50}, 95 % of cells up to {short "
      "measure.uncertainty.percentiles.95}" },
    { ExtractTable, "places.thin", "thin places", OfPlaces("thin", "below", "thinnest") },
    { ExtractTable, "places.thick", "thick places", OfPlaces("thick", "above", "thickest") },
    { ExtractTable,
      "thickness.mean",
      "no wall",
      "{percent share_without_sheet} of the object: edges and lumps, where no sheet is near" },
    { PageThickness, "thickness.minimum", "smallest", "{short thickness.minimum}" },
    { PageThickness, "", "{@} % of the area up to", "{short .}", "/thickness/percentiles" },
    { PageThickness, "thickness.maximum", "largest", "{short thickness.maximum}" },
    { PageThickness, "", "mean", "{short thickness.mean}" },
    { PageThickness,
      "places.thin",
      "of the area, in places below {short places.thin.limit}",
      "{percent places.thin.area_beyond_limit thickness.area thickness.one_cell_of}" },
    { PageThickness,
      "places.thick",
      "of the area, in places above {short places.thick.limit}",
      "{percent places.thick.area_beyond_limit thickness.area thickness.one_cell_of}" },
    { ExtractTable | PageLocalThickness,
      "local_thickness.mean",
      "local thickness",
      "mean {short local_thickness.mean}, standard deviation {short local_thickness.standard_deviation}, largest "
      "{short "
      "local_thickness.largest}, in {unit}, of {local_thickness.voxels} object voxels" },

    { ExtractTable,
      "mesh",
      "mesh",
      "{mesh.vertices} vertices, {mesh.faces} faces[mesh.quality?, {percent mesh.quality.triangles mesh.faces} "
      "triangles; sides "
      "{short mesh.quality.shortest_side} to {short mesh.quality.longest_side} long, mean {short "
      "mesh.quality.mean_side}]" },
    { ExtractTable,
      "mesh.quality",
      "  shapes",
      "of 99 % of the elements: scaled Jacobian {short mesh.quality.limits.1.value}, at least "
      "{short mesh.quality.limits.1.least}; aspect ratio {short mesh.quality.limits.2.value}, at most "
      "{short mesh.quality.limits.2.most}" },
    { LongTable,
      "mesh.pieces_left_out",
      "  small pieces left out",
      "{mesh.pieces_left_out.number} of fewer than {parameters.min_component_size} faces of a voxel, area {short "
      "mesh.pieces_left_out.area}" },
    { LongTable,
      "mesh.remeshing",
      "  rims",
      "[mesh.remeshing.rims?carried on to the edges of the part by {short mesh.remeshing.rims.mean_extension} in the "
      "mean, {short mesh.remeshing.rims.largest_extension} at most][!mesh.remeshing.rims?half a thickness before the "
      "edges of the part]" },
    { LongTable, "mesh.remeshing", "  area", "{short mesh.area} of {short mesh.remeshing.area_before}" },
    { LongTable,
      "mesh.remeshing",
      "  farthest from the sheet",
      "{short mesh.remeshing.distance_to_fine.largest mesh.remeshing.distance_from_fine.largest}" },
    { ExtractTable,
      "mesh.remeshing",
      "  distance to the sheet",
      "mean {short mesh.remeshing.mean_distance_elsewhere} on {percent mesh.remeshing.area_share_elsewhere} of the "
      "area, "
      "{short mesh.remeshing.mean_distance_at_lines} at rims, junctions and bends; 99 % within {short "
      "mesh.remeshing.distance_to_fine.percentile_99 mesh.remeshing.distance_from_fine.percentile_99}" },
    { ExtractTable,
      "mesh.remeshing",
      "  walls left out",
      "{mesh.remeshing.walls_left_out} of {mesh.remeshing.walls}, {percent mesh.remeshing.left_out.area_share} of the "
      "area[mesh.remeshing.left_out.walls?, the largest {mesh.remeshing.left_out.walls.0.reason}]"
      "[mesh.pieces_left_out.number>0?; {mesh.pieces_left_out.number} pieces of fewer than "
      "{parameters.min_component_size} faces of a voxel]" },
    { LongTable, "mesh.remeshing", "  orientation conflicts", "{mesh.remeshing.orientation_conflicts}" },
    { LongTable, "mesh.quality", "  quadrilaterals", "{mesh.quality.quadrilaterals}" },
    { LongTable, "mesh.quality", "  sides of one element", "{mesh.quality.rim_sides}" },
    { LongTable, "mesh.quality", "  sides of more than two", "{mesh.quality.junction_sides}" },
    { LongTable, "mesh.quality", "  walls", "{mesh.quality.walls}" },
    { LongTable, "mesh.quality", "  walls with one side only", "{mesh.quality.one_sided_walls}" },
    { LongTable, "mesh.quality", "  least scaled Jacobian", "{short mesh.quality.least_scaled_jacobian}" },
    { LongTable, "mesh.quality", "  largest aspect ratio", "{short mesh.quality.largest_aspect_ratio}" },
    { LongTable,
      "mesh.quality",
      "  warpage",
      "{short mesh.quality.largest_warpage} degrees at most, of 99 % up to {short "
      "mesh.quality.warpage_percentile_99}" },
    { LongTable,
      "mesh.quality",
      "  angles",
      "{short mesh.quality.least_angle} to {short mesh.quality.largest_angle} degrees" },
    { LongTable, "", "  {name}", MeshLimitText, "/mesh/quality/limits" },

    { SurfaceTable,
      "",
      "surface",
      "{surface.vertices} vertices, {surface.triangles} triangles, placed by [surface.placed_by=values?gray values]"
      "[surface.placed_by=object?the object]" },
    { SurfaceTable,
      "",
      "area",
      "{short surface.area}[surface.cap_area>0?, of which {short surface.cap_area} close it at the volume's faces]" },
    { SurfaceTable, "surface.volume", "volume", "{short surface.volume}" },
    { SurfaceTable, "", "walls", OfSurface("surface.thickness") },
    { SurfaceTable, "", "  of", "[local_thickness.method=wall?walls][local_thickness.method=sphere?largest balls]" },
    { SurfaceTable, "", "  measured", MeasureText },
    { SurfaceTable, "", "  not known", "{count surface.thickness.unknown_vertices surface.vertices} of the vertices" },
    { SurfaceTable, "surface.ray_thickness", "by rays", OfSurface("surface.ray_thickness") },
    { SurfaceTable,
      "surface.ray_thickness",
      "  no answer",
      "{count surface.ray_thickness.unknown_vertices surface.vertices} of the vertices: "
      "{surface.ray_thickness.unanswered.leave_volume} leave the volume, {surface.ray_thickness.unanswered.too_long} "
      "are "
      "too long" },
    { SurfaceTable,
      "surface.color_range",
      "colors",
      "from {short surface.color_range.0} to {short surface.color_range.1}" },

    { PartTables,
      "",
      "decided",
      "[smoothed?smoothed][!smoothed?not smoothed][roughness? (roughness {percent roughness.ratio})]"
      "[parameters.max_thickness?, walls up to {short parameters.max_thickness}]"
      "[parameters.raised_from?, raised from {short parameters.raised_from} as walls are thicker]"
      "[counts.filled_voxels>0?, pores of {counts.filled_voxels} voxels filled]"
      "[counts.removed_voxels>0?, dust of {counts.removed_voxels} voxels left out]"
      "[mesh.remeshing.rims?, rims carried on to the edges of the part]" },
    { Tables, "parameters.lower_otsu", "  threshold", "{parameters.lower}, of Otsu" },
    { Tables,
      "parameters.resampled_spacing",
      "  resampled",
      "from {times input.size} at {times input.spacing} to {times parameters.resampled_spacing}" },
    { Tables,
      "counts.not_a_number_voxels>0",
      "  not a number",
      "{counts.not_a_number_voxels} voxels, taken as background" },
    { LongTable, "", "distance", OverThreads("distance") },
    { LongTable, "seconds.classification>0", "classification", OverThreads("classification") },
    { LongTable, "mesh.remeshing", "remeshing", "{fixed seconds.remeshing} s" },
    { LongTable, "", "reading and writing", "{fixed seconds.input_output} s" },
    { LongTable, "", "total", "{fixed seconds.total} s" },
    { LongTable, "", "peak memory", "{bytes peak_memory_bytes}, planned {bytes planned_peak_bytes}" },
    { Tables, "outputs", "files", "[outputs:[!#=1?, ]{.}]" },
    { Tables,
      "",
      "run",
      "{fixed seconds.total} s with {threads} thread[!threads=1?s], {bytes peak_memory_bytes} of memory" },
    { SlicerLines, "", "distanceSeconds", "{seconds.distance}" },
    { SlicerLines, "", "classificationSeconds", "{seconds.classification}" },
    { SlicerLines, "", "totalSeconds", "{seconds.total}" },
    { PageRun, "", "distance", "{seconds seconds.distance}" },
    { PageRun, "", "classification", "{seconds seconds.classification}" },
    { PageRun, "", "remeshing", "{seconds seconds.remeshing}" },
    { PageRun, "", "reading and writing", "{seconds seconds.input_output}" },
    { PageRun, "", "total", "{seconds seconds.total}" },
    { PageRun, "", "peak memory", "{bytes peak_memory_bytes}" },
    { PageRun, "", "bytes read", "{bytes_read}" },
    { PageRun, "", "threads", "{threads}" },
    { PageRun, "", "divisions", "{divisions}" },
  };
  return rows;
}

TextTable
MakeTable(const unsigned int views, const Json & report)
{
  TextTable table;
  for (const ViewRow & row : ListViewRows())
  {
    if ((row.views & views) == 0 || (!row.condition.empty() && !Holds(row.condition, report)))
    {
      continue;
    }
    const Json::json_pointer list(row.list);
    if (row.list.empty())
    {
      table.emplace_back(FillIn(row.name, report), FillIn(row.value, report));
    }
    else if (report.contains(list))
    {
      const Json & members = report[list];
      std::size_t  number = 0;
      for (auto member = members.begin(); member != members.end() && number < MostMembers; ++member, ++number)
      {
        const Json key = members.is_object() ? Json(member.key()) : Json(nullptr);
        table.emplace_back(FillIn(row.name, report, *member, key), FillIn(row.value, report, *member, key));
      }
      if (number < members.size())
      {
        table.emplace_back("  others", std::to_string(members.size() - number) + ", --report has all");
      }
    }
  }
  return table;
}

std::string
MakeReturnParameters(const Json & report)
{
  std::string lines;
  for (const auto & [name, value] : MakeTable(SlicerLines, report))
  {
    lines += name + " = " + value + "\n";
  }
  return lines;
}

} // end namespace medialvoxel
