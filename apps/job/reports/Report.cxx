// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Report.h"

#include "MeshJson.h"
#include "PlaceJson.h"
#include "WallJson.h"
#include "Version.h"
#include "VolumeFormats.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

Json
MakeInput(const VolumeHeader & header)
{
  const VolumeHeader & stored = header.GetStored();
  return { { "file", header.fileName.string() },
           { "format", header.format->name },
           { "type", std::string(GetTraits(stored.pixelType).name) },
           { "size", stored.geometry.size },
           { "spacing", stored.geometry.spacing },
           { "unit", stored.geometry.inMillimeters ? Json("mm") : Json(nullptr) },
           { "bytes", stored.GetDataSize() } };
}

Json
MakeOutputs(const JobResult & result)
{
  Json outputs = Json::object();
  for (const OutputRequest & output : result.outputs)
  {
    outputs[output.role] = output.fileName.string();
  }
  return outputs;
}

Json
MakeCounts(const itk::MedialVoxelCounts & counts)
{
  Json json;
  for (const NamedCount & count : NamedCounts)
  {
    json[count.name] = counts.*count.member;
  }
  json["medial_cells"] = counts.boundCells + counts.geodesicMedialCells;
  return json;
}

/** Shares of the candidate cells that were decided without, and with, geodesic search; null without candidates. */
Json
MakePercent(const itk::MedialVoxelCounts & counts)
{
  const auto searched = static_cast<double>(counts.geodesicMedialCells + counts.geodesicNonMedialCells);
  const auto all = static_cast<double>(counts.candidateCells);
  const auto percentOf = [all](double cells) { return all > 0.0 ? Json(100.0 * cells / all) : Json(nullptr); };
  return { { "pseudo", percentOf(all - searched) }, { "correct", percentOf(searched) } };
}

/** Null without a limit, also for an infinite one. */
Json
MakeLimit(const std::optional<itk::MedialVoxelExactNumber> & limit)
{
  if (!limit)
  {
    return nullptr;
  }
  if (!limit->IsDouble()) // a whole number that no double holds
  {
    return limit->GetWhole() ? Json(*limit->GetWhole()) : Json(*limit->GetNegative());
  }
  const double value = limit->GetNearestDouble();
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/** Each warning as an object with a code for scripts, a line for readers, and the numbers of that line. */
Json
MakeWarnings(const std::vector<Warning> & warnings)
{
  Json list = Json::array();
  for (const Warning & warning : warnings)
  {
    Json values = Json::object();
    for (const auto & [name, value] : warning.values)
    {
      values[name] = value;
    }
    list.push_back({ { "code", warning.code }, { "message", warning.message }, { "values", values } });
  }
  return list;
}

void
AddObject(Json & parameters, const JobOptions & options, const JobResult & result)
{
  parameters["lower"] = MakeLimit(result.otsu ? result.otsu : options.lowerThreshold);
  parameters["lower_otsu"] = options.lowerIsOtsu;
  parameters["upper"] = MakeLimit(options.upperThreshold);
  parameters["label"] = options.label ? Json::parse(FormatLabel(*options.label)) : Json(nullptr);
  parameters["resampled_spacing"] = result.input.stored ? Json(result.input.geometry.spacing) : Json(nullptr);
}

Json
MakeRoughness(const std::optional<itk::MedialVoxelRoughness> & roughness)
{
  return roughness ? Json{ { "rough_voxels", roughness->roughVoxels },
                           { "border_voxels", roughness->borderVoxels },
                           { "ratio", roughness->GetRatio() } }
                   : Json(nullptr);
}

/** Share of the time of the threads, while there were tiles, that they worked on tiles. */
Json
GetThreadEfficiency(const JobResult & result)
{
  const double possible = result.plan.threads * result.seconds.tiles;
  return possible > 0.0 ? Json(result.sums.threadSeconds / possible) : Json(nullptr);
}

void
AddRun(Json & report, const JobResult & result)
{
  report["warnings"] = MakeWarnings(result.warnings);
  report["seconds"] = { { "distance", result.seconds.distance },
                        { "classification", result.seconds.classification },
                        { "tiles", result.seconds.tiles },
                        { "input_output", result.seconds.inputOutput },
                        { "total", result.seconds.total } };
  if (result.surface && result.surface->remeshing)
  {
    report["seconds"]["remeshing"] = result.seconds.remeshing;
  }
  if (!result.topology.is_null())
  {
    report["seconds"]["topology"] = result.seconds.topology;
  }
  if (result.walls)
  {
    report["seconds"]["walls"] = result.seconds.walls;
  }
  report["peak_memory_bytes"] = result.peakMemory;
  report["planned_peak_bytes"] = result.plan.memory.planned;
  report["memory_limit_bytes"] = result.plan.memory.limit;
  report["bytes_read"] = result.bytesRead;
  report["recomputed_voxels"] = result.sums.recomputedVoxels;
  report["threads"] = result.plan.threads;
  report["divisions"] = result.plan.divisions;
  report["thread_efficiency"] = GetThreadEfficiency(result);
}

/** The head of each report. */
Json
BeginReport(const Json & parameters, const JobResult & result)
{
  Json report;
  report["version"] = GetVersion();
  report["itk_version"] = GetItkVersion();
  report["input"] = MakeInput(result.input);
  report["outputs"] = MakeOutputs(result);
  report["parameters"] = parameters;
  report["size"] = result.input.geometry.size;
  return report;
}

Json
MakeLocalThickness(const ExtractOptions & options, const JobResult & result)
{
  const itk::MedialVoxelLocalThicknessSums & sums = result.sums.localThickness;
  const auto maximum = static_cast<float>(GetLocalThickness(options, GetGrid(result.input)).maximumThickness);
  return { { "method", GetName(options.localThicknessMethod) },
           { "largest_ball", maximum },
           { "voxels", sums.voxels },
           { "mean", sums.voxels > 0 ? Json(sums.GetMean(maximum)) : Json(nullptr) },
           { "standard_deviation", sums.voxels > 0 ? Json(sums.GetStandardDeviation(maximum)) : Json(nullptr) },
           { "largest", sums.voxels > 0 ? Json(sums.largest) : Json(nullptr) },
           { "voxels_at_maximum", result.sums.voxelsAtMaximum },
           { "voxels_without_wall", result.sums.voxelsWithoutWall } };
}

Json
MakeMeasure(const JobResult & result)
{
  const WallMeasure & measure = result.wallMeasure.value();
  Json                scan(nullptr);
  if (measure.scan)
  {
    scan = { { "background", measure.scan->background },
             { "material", measure.scan->material },
             { "blur", measure.scan->blur },
             { "noise", measure.scan->noise },
             { "correlation", measure.scan->correlation } };
  }
  return { { "on", measure.scan ? "fits" : (measure.usesGrayValues ? "crossings" : "object") },
           { "scan", scan },
           { "reason", measure.reason },
           { "uncertainty", result.uncertainty } };
}

/** The maximum thickness that was raised, if it was. */
void
AddRaisedMaximum(Json & parameters, const ExtractOptions & options, const JobResult & result)
{
  const itk::MedialVoxelGrid grid = GetGrid(result.input);
  ExtractOptions             before = options;
  before.neededMaximum.reset();
  const double maximum = GetLimitsOfWalls(before, grid).maximum;
  const bool   isRaised = !options.thickness && GetLimitsOfWalls(options, grid).maximum > maximum;
  parameters["raised_from"] = isRaised ? Json(maximum) : Json(nullptr);
}

/** The share of the object that has no sheet near, and that of the sheet in places. */
void
AddShares(Json & report, const itk::MedialVoxelGrid & grid)
{
  const Json   thickness = report["thickness"];
  const auto   get = [&thickness](const char * name) { return thickness[name].get<double>(); };
  const double area = get("area") * get("one_cell_of");
  double       volume = report["counts"]["object_voxels"].get<double>();
  for (const double spacing : grid.GetSpacing())
  {
    volume *= spacing;
  }
  report["share_without_sheet"] = nullptr;
  if (!thickness["mean"].is_null())
  {
    // Cells without a thickness have walls, too. Walls overlap where they bend, so that they may be more than the
    // object.
    const double cells = (get("cells") + get("unpaired_cells") + get("unresolved_cells")) / get("cells");
    report["share_without_sheet"] = std::max(1.0 - area * cells * get("mean") / volume, 0.0);
  }
  for (const char * const kind : { "thin", "thick" })
  {
    const Json::json_pointer path("/places/" + std::string(kind));
    if (report.contains(path) && !report[path].is_null())
    {
      report[path]["share_of_sheet"] = area > 0.0 ? report[path]["area_beyond_limit"].get<double>() / area : 0.0;
    }
  }
}

} // namespace

Json
MakeReport(const ExtractOptions & options, const JobResult & result)
{
  Json parameters;
  if (options.thickness)
  {
    parameters["thickness"] = *options.thickness;
  }
  else
  {
    const auto limits = GetLimitsOfWalls(options, GetGrid(result.input));
    parameters["thickness"] = AutomaticThickness;
    parameters["min_thickness"] = limits.minimum;
    parameters["max_thickness"] = limits.maximum;
  }
  AddRaisedMaximum(parameters, options, result);
  AddObject(parameters, options, result);
  if (options.labels)
  {
    parameters["labels"] = options.labels->all ? Json("all") : Json(options.labels->values);
  }
  parameters["max_pore_size"] = GetParameters(options, GetGrid(result.input)).maximumPoreSize;
  parameters["smooth"] = GetName(GetRequestedSmoothing(options));
  parameters["same_topology"] = options.sameTopology;
  parameters["sub_voxel"] = options.subVoxel ? Json(*options.subVoxel) : Json(nullptr);
  parameters["materials"] =
    options.materials ? Json{ options.materials->background, options.materials->material } : Json(nullptr);
  parameters["vector_boundary"] = GetName(options.vectorBoundary);
  if (!options.meshFile.empty())
  {
    parameters["min_branch_length"] = options.minimumBranchLength;
    parameters["min_component_size"] = options.minimumComponentSize;
    parameters["extend_rims"] = options.extendsRims;
    parameters["mesh_walls"] = options.meshWalls;
  }

  Json report = BeginReport(parameters, result);
  report["counts"] = MakeCounts(result.sums.counts);
  report["percent"] = MakePercent(result.sums.counts);
  report["smoothed"] = IsSmoothed(options, result);
  report["roughness"] = MakeRoughness(result.roughness);
  report["measure"] = MakeMeasure(result);
  report["thickness"] = result.thickness;
  if (!result.places.empty())
  {
    report["places"] = MakePlacesJson(result.places);
  }
  AddShares(report, GetGrid(result.input));
  if (!options.localThicknessFile.empty())
  {
    report["local_thickness"] = MakeLocalThickness(options, result);
  }
  if (!result.topology.is_null())
  {
    report["topology"] = result.topology;
  }
  if (result.walls)
  {
    report["walls"] = MakeWallsJson(*result.walls);
  }
  if (!result.objects.is_null())
  {
    report.update(result.objects);
  }
  if (result.surface)
  {
    report["mesh"] = MakeMeshJson(*result.surface);
  }
  AddRun(report, result);
  return report;
}

Json
MakeReport(const PartOptions & options, const JobResult & result)
{
  const ExtractOptions walls = GetThicknessOptions(options);
  const auto           grid = GetGrid(result.input);
  Json                 parameters = Json::object();
  AddObject(parameters, options, result);
  parameters["max_pore_size"] = GetParameters(walls, grid).maximumPoreSize;
  parameters["max_thickness"] = GetLimitsOfWalls(walls, grid).maximum;
  AddRaisedMaximum(parameters, walls, result);
  parameters["sub_voxel"] = options.subVoxel ? Json(*options.subVoxel) : Json(nullptr);
  parameters["open"] = options.isOpen;

  Json         report = BeginReport(parameters, result);
  const auto & counts = result.sums.counts;
  report["counts"] = { { "object_voxels", counts.objectVoxels },
                       { "not_a_number_voxels", counts.notANumberVoxels },
                       { "filled_voxels", counts.filledVoxels },
                       { "removed_voxels", counts.removedVoxels } };
  report["local_thickness"] = MakeLocalThickness(walls, result);
  report["measure"] = MakeMeasure(result);
  report["surface"] = result.part;
  AddRun(report, result);
  return report;
}

Json
MakeReport(const DistanceOptions & options, const JobResult & result)
{
  Json parameters = Json::object();
  AddObject(parameters, options, result);
  parameters["boundary"] = GetName(options.boundary);
  parameters["region"] = GetName(options.region);
  parameters["max_distance"] = OptionalToJson(options.maximumDistance);

  Json report = BeginReport(parameters, result);
  report["counts"] = { { "not_a_number_voxels", result.sums.counts.notANumberVoxels } };
  AddRun(report, result);
  return report;
}

std::string
FormatReport(const Json & report)
{
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // end namespace medialvoxel
