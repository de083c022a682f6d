// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Report.h"

#include "JobParts.h"
#include "SealedJson.h"

#include "itkVersion.h"

namespace medialvoxel
{
namespace
{

Json
MakeInput(const VolumeHeader & header)
{
  return { { "file", header.fileName.string() },
           { "format", header.format },
           { "type", std::string(GetTraits(header.pixelType).name) },
           { "spacing", header.geometry.spacing },
           { "bytes", header.GetVoxelBytes() } };
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

Json
MakePercent(const itk::MedialVoxelCounts & counts)
{
  const std::optional<PhasePercent> percent = GetPhasePercent(counts);
  return { { "pseudo", percent ? Json(percent->pseudo) : Json(nullptr) },
           { "correct", percent ? Json(percent->correct) : Json(nullptr) } };
}

Json
MakePercentiles(const ThicknessStatistics & statistics)
{
  Json percentiles = Json::object();
  for (std::size_t i = 0; i < statistics.percentiles.size(); ++i)
  {
    percentiles[std::to_string(ThicknessStatistics::Percents[i])] = statistics.percentiles[i];
  }
  return percentiles;
}

Json
MakeThickness(const std::optional<ThicknessSummary> & thickness)
{
  if (!thickness)
  {
    return nullptr;
  }
  return { { "cells", thickness->cells },
           { "one_cell_of", thickness->step },
           { "resolution", thickness->resolution },
           { "mean", thickness->mean },
           { "standard_deviation", thickness->standardDeviation },
           { "minimum", thickness->minimum },
           { "maximum", thickness->maximum },
           { "percentiles", MakePercentiles(*thickness) },
           { "area", thickness->area },
           { "area_weighted",
             { { "mean", thickness->byArea.mean },
               { "standard_deviation", thickness->byArea.standardDeviation },
               { "percentiles", MakePercentiles(thickness->byArea) } } },
           { "histogram",
             { { "bin_width", thickness->binWidth }, { "counts", thickness->bins }, { "above", thickness->above } } } };
}

void
AddObject(Json & parameters, const JobOptions & options)
{
  parameters["lower"] = OptionalToJson(options.lowerThreshold);
  parameters["upper"] = OptionalToJson(options.upperThreshold);
  parameters["units"] = options.voxelUnits ? "voxels" : "physical";
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
  report["seconds"] = { { "distance", result.seconds.distance },
                        { "classification", result.seconds.classification },
                        { "tiles", result.seconds.tiles },
                        { "input_output", result.seconds.inputOutput },
                        { "total", result.seconds.total } };
  report["peak_memory_bytes"] = result.peakMemoryBytes;
  report["planned_peak_bytes"] = result.plan.memoryBytes;
  report["memory_limit_bytes"] = result.plan.memoryLimit;
  report["bytes_read"] = result.bytesRead;
  report["recomputed_voxels"] = result.sums.recomputedVoxels;
  report["threads"] = result.plan.threads;
  report["divisions"] = result.plan.divisions;
  report["thread_efficiency"] = GetThreadEfficiency(result);
}

/** Names of files need not be valid UTF-8. */
std::string
Dump(const Json & report)
{
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace

std::optional<PhasePercent>
GetPhasePercent(const itk::MedialVoxelCounts & counts)
{
  if (counts.candidateCells == 0)
  {
    return std::nullopt;
  }
  const auto searched = static_cast<double>(counts.geodesicMedialCells + counts.geodesicNonMedialCells);
  const auto all = static_cast<double>(counts.candidateCells);
  return PhasePercent{ 100.0 * (all - searched) / all, 100.0 * searched / all };
}

std::string
MakeReport(const ExtractOptions & options, const JobResult & result)
{
  Json parameters;
  if (options.thickness)
  {
    parameters["thickness"] = *options.thickness;
  }
  else
  {
    const auto limits = itk::MedialVoxelParameters::LimitsOfWalls(
      GetGrid(options, result.input), options.minimumThickness.value_or(0.0), options.maximumThickness.value_or(0.0));
    parameters["thickness"] = AutomaticThickness;
    parameters["minimum_thickness"] = limits.minimum;
    parameters["maximum_thickness"] = limits.maximum;
  }
  AddObject(parameters, options);
  parameters["maximum_pore_size"] = GetParameters(options, GetGrid(options, result.input)).maximumPoreSize;
  parameters["bound"] = GetName(options.bound);
  parameters["sub_voxel"] = options.subVoxel;
  parameters["vector_boundary"] = GetName(options.vectorBoundary);
  if (!options.meshFile.empty())
  {
    parameters["minimum_branch_length"] = options.minimumBranchLength;
    parameters["smallest_piece"] = options.smallestPiece;
  }

  Json report;
  report["version"] = GetVersion();
  report["itk_version"] = GetItkVersion();
  report["input"] = MakeInput(result.input);
  report["outputs"] = MakeOutputs(result);
  report["parameters"] = parameters;
  report["size"] = result.input.geometry.size;
  report["counts"] = MakeCounts(result.sums.counts);
  report["percent"] = MakePercent(result.sums.counts);
  report["thickness"] = MakeThickness(result.thickness);
  if (result.surface)
  {
    report["mesh"] = { { "vertices", result.surface->vertices },
                       { "faces", result.surface->faces },
                       { "area", result.surface->area } };
  }
  AddRun(report, result);
  return Dump(report);
}

std::string
MakeReport(const DistanceOptions & options, const JobResult & result)
{
  Json parameters = Json::object();
  AddObject(parameters, options);
  parameters["boundary"] = GetName(options.boundary);
  parameters["region"] = GetName(options.region);
  parameters["squared_distance"] = options.squaredDistance;
  parameters["inside_positive"] = options.insideIsPositive;
  parameters["maximum_distance"] = OptionalToJson(options.maximumDistance);

  Json report;
  report["version"] = GetVersion();
  report["itk_version"] = GetItkVersion();
  report["input"] = MakeInput(result.input);
  report["outputs"] = MakeOutputs(result);
  report["parameters"] = parameters;
  report["size"] = result.input.geometry.size;
  report["counts"] = { { "not_a_number_voxels", result.sums.counts.notANumberVoxels } };
  AddRun(report, result);
  return Dump(report);
}

std::string
GetVersion()
{
  return MEDIALVOXEL_VERSION;
}

std::string
GetItkVersion()
{
  return itk::Version::GetITKVersion();
}

} // end namespace medialvoxel
