// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PhaseTable.h"

#include "LocalThicknessTable.h"
#include "MeshTable.h"
#include "PlaceTable.h"

#include "Report.h"
#include "Text.h"

#include <algorithm>
#include <cstddef>

namespace medialvoxel
{
namespace
{

constexpr std::size_t MostRowsOfObjects = 20;

std::string
FormatCount(std::uint64_t count, std::uint64_t all)
{
  return std::to_string(count) + (all > 0 ? " (" + FormatPercent(count, all) + ")" : "");
}

void
AddResolution(TextTable & table, const VolumeHeader & input)
{
  const VolumeGeometry & stored = input.GetStored().geometry;
  table.emplace_back("resolution", FormatSize(input.geometry.size));
  if (input.stored)
  {
    table.emplace_back("  resampled",
                       "from " + FormatSize(stored.size) + " at " + FormatNumbers(stored.spacing, " x ") + " to " +
                         FormatNumbers(input.geometry.spacing, " x "));
  }
}

void
AddObject(TextTable & table, const JobOptions & options, const JobResult & result)
{
  if (result.otsu)
  {
    table.emplace_back("lower threshold", result.otsu->Format() + ", of Otsu");
  }
  if (options.label)
  {
    table.emplace_back("label", FormatLabel(*options.label));
  }
}

void
AddSmoothing(TextTable & table, const ExtractOptions & options, const JobResult & result)
{
  if (IsSmoothed(options, result) || result.roughness)
  {
    table.emplace_back("smoothed", DescribeSmoothing(options, result));
  }
}

void
AddNotANumber(TextTable & table, const itk::MedialVoxelCounts & counts)
{
  if (counts.notANumberVoxels > 0)
  {
    table.emplace_back("not a number", std::to_string(counts.notANumberVoxels) + " voxels, taken as background");
  }
}

void
AddSmallComponents(TextTable & table, const itk::MedialVoxelCounts & counts)
{
  if (counts.filledVoxels > 0)
  {
    table.emplace_back("pores", std::to_string(counts.filledVoxels) + " voxels, taken as object");
  }
  if (counts.removedVoxels > 0)
  {
    table.emplace_back("dust", std::to_string(counts.removedVoxels) + " voxels, taken as background");
  }
}

/** Of an object of a label map. */
std::string
DescribeObject(const ObjectSummary & object)
{
  return (object.name.empty() ? "" : object.name + ": ") + std::to_string(object.voxels) + " voxels, " +
         std::to_string(object.medialCells) + " medial cells" +
         (object.thickness.cells > 0 ? ", mean thickness " + FormatShort(object.thickness.mean) : "");
}

void
AddLabelMap(TextTable & table, const JobResult & result)
{
  if (result.objects)
  {
    const LabelMapSummary & summary = *result.objects;
    table.emplace_back("objects",
                       std::to_string(summary.objects.size()) + " in " + std::to_string(summary.passes) +
                         (summary.passes == 1 ? " pass, " : " passes, ") + std::to_string(summary.sharedCells) +
                         " cells medial for several");
    const std::size_t rows = std::min(summary.objects.size(), MostRowsOfObjects);
    for (std::size_t i = 0; i < rows; ++i)
    {
      const ObjectSummary & object = summary.objects[i];
      table.emplace_back("  label " + std::to_string(object.label), DescribeObject(object));
    }
    if (rows < summary.objects.size())
    {
      table.emplace_back("  others", std::to_string(summary.objects.size() - rows) + ", --report has all");
    }
  }
}

void
AddThickness(TextTable & table, const ExtractOptions & options, const JobResult & result)
{
  if (result.thickness && result.thickness->cells > 0)
  {
    const ThicknessSummary & thickness = *result.thickness;
    table.emplace_back("wall thickness",
                       "mean " + FormatShort(thickness.mean) + ", median " + FormatShort(thickness.GetMedian()) +
                         ", 5 to 95 %: " + FormatShort(thickness.percentiles[1]) + " to " +
                         FormatShort(thickness.percentiles[5]) + ", in " +
                         DescribeUnit(options, result.input.geometry));
    if (thickness.standardError)
    {
      table.emplace_back("  sample",
                         "one medial cell in " + std::to_string(thickness.step) + ", standard error of the mean " +
                           FormatShort(*thickness.standardError));
    }
    const std::uint64_t all = thickness.rimCells + thickness.unresolvedCells + thickness.cells;
    table.emplace_back("  at rims, junctions", FormatCount(thickness.rimCells, all));
    if (thickness.unresolvedCells > 0)
    {
      table.emplace_back("  not resolved", FormatCount(thickness.unresolvedCells, all));
    }
    table.emplace_back("  measured", Describe(result.measure.value()));
    if (thickness.uncertainCells > 0)
    {
      table.emplace_back("  uncertainty (95 %)",
                         "median " + FormatShort(thickness.uncertainty.GetMedian()) + ", 95 % of cells up to " +
                           FormatShort(thickness.uncertainty.percentiles[5]));
    }
  }
}

void
AddRun(TextTable & table, const JobResult & result)
{
  if (result.surface && result.surface->remeshing)
  {
    table.emplace_back("remeshing", FormatFixed(result.seconds.remeshing, 2) + " s");
  }
  table.emplace_back("reading and writing", FormatFixed(result.seconds.inputOutput, 2) + " s");
  table.emplace_back("total", FormatFixed(result.seconds.total, 2) + " s");
  table.emplace_back("peak memory",
                     FormatBytes(result.peakMemoryBytes) + ", planned " + FormatBytes(result.plan.memory.planned));
  for (const OutputRequest & output : result.outputs)
  {
    table.emplace_back(output.role, output.fileName.string());
  }
}

} // namespace

void
PrintTable(std::ostream & out, const TextTable & table)
{
  size_t width = 0;
  for (const auto & row : table)
  {
    width = std::max(width, row.first.size());
  }
  for (const auto & [name, value] : table)
  {
    out << name << std::string(width - name.size() + 2, ' ') << value << '\n';
  }
}

void
PrintPhaseTable(std::ostream & out, const ExtractOptions & options, const JobResult & result)
{
  const itk::MedialVoxelCounts &    counts = result.sums.counts;
  const std::optional<PhasePercent> percent = GetPhasePercent(counts);
  TextTable                         table;
  AddResolution(table, result.input);
  table.emplace_back("tau", DescribeThickness(options, " " + DescribeUnit(options, result.input.geometry)));
  AddObject(table, options, result);
  AddLabelMap(table, result);
  table.emplace_back("object voxels", std::to_string(counts.objectVoxels));
  AddNotANumber(table, result.sums.counts);
  AddSmoothing(table, options, result);
  AddSmallComponents(table, counts);
  table.emplace_back("candidate cells", std::to_string(counts.candidateCells));
  table.emplace_back("  trivial", FormatCount(counts.trivialCells, counts.candidateCells));
  table.emplace_back("  medial by bound", FormatCount(counts.boundCells, counts.candidateCells));
  table.emplace_back("  medial by geodesic", FormatCount(counts.geodesicMedialCells, counts.candidateCells));
  table.emplace_back("  non-medial by geodesic", FormatCount(counts.geodesicNonMedialCells, counts.candidateCells));
  table.emplace_back("medial cells", std::to_string(counts.boundCells + counts.geodesicMedialCells));
  table.emplace_back("pseudo", percent ? FormatFixed(percent->pseudo, 2) + " %" : "-");
  table.emplace_back("correct", percent ? FormatFixed(percent->correct, 2) + " %" : "-");
  AddThickness(table, options, result);
  for (const TextTable & rows : { DescribeLocalThickness(options, result),
                                  DescribePlaces(result.places),
                                  result.surface ? DescribeMesh(*result.surface) : TextTable() })
  {
    table.insert(table.end(), rows.begin(), rows.end());
  }
  const std::string threads =
    result.plan.threads == 1 ? " s" : " s, summed over " + std::to_string(result.plan.threads) + " threads";
  table.emplace_back("distance", FormatFixed(result.seconds.distance, 2) + threads);
  table.emplace_back("classification", FormatFixed(result.seconds.classification, 2) + threads);
  AddRun(table, result);
  PrintTable(out, table);
}

void
PrintFinalization(std::ostream & out, const FinalizeResult & result)
{
  if (result.job)
  {
    PrintPhaseTable(out, result.options, *result.job);
  }
  else
  {
    PrintTable(out, { { "job", "was finished before" } });
  }
}

void
PrintSurfaceTable(std::ostream & out, const PartOptions & options, const JobResult & result)
{
  const PartSummary & part = *result.part;
  const auto          describe = [&](const ThicknessOfSurface & thickness) {
    return thickness.area > 0.0
                      ? "mean " + FormatShort(thickness.mean) + ", median " + FormatShort(thickness.GetMedian()) +
                 ", 5 to 95 % of the area: " + FormatShort(thickness.percentiles[1]) + " to " +
                 FormatShort(thickness.percentiles[5]) + ", in " + DescribeUnit(options, result.input.geometry)
                      : std::string("not known anywhere");
  };
  TextTable table;
  AddResolution(table, result.input);
  AddObject(table, options, result);
  AddNotANumber(table, result.sums.counts);
  AddSmallComponents(table, result.sums.counts);
  table.emplace_back("surface",
                     std::to_string(part.vertices) + " vertices, " + std::to_string(part.triangles) +
                       " triangles, placed by " + (part.usesGrayValues ? "gray values" : "the object"));
  table.emplace_back(
    "area",
    FormatShort(part.area) +
      (part.capArea > 0.0 ? ", of which " + FormatShort(part.capArea) + " close it at the volume's faces" : ""));
  if (part.volume)
  {
    table.emplace_back("volume", FormatShort(*part.volume));
  }
  table.emplace_back("wall thickness", describe(part.thickness));
  table.emplace_back("  of", options.localThicknessMethod == LocalThicknessMethod::Wall ? "walls" : "largest balls");
  table.emplace_back("  measured", Describe(result.measure.value()));
  table.emplace_back("  not known", FormatCount(part.thickness.unknownVertices, part.vertices) + " of the vertices");
  if (part.rays)
  {
    table.emplace_back("by rays", describe(*part.rays));
    table.emplace_back("  no answer",
                       FormatCount(part.rays->unknownVertices, part.vertices) +
                         " of the vertices: " + std::to_string(part.unansweredRays.leaveVolume) +
                         " leave the volume, " + std::to_string(part.unansweredRays.tooLong) + " are too long");
  }
  if (part.colorRange)
  {
    table.emplace_back("colors",
                       "from " + FormatShort(part.colorRange->front()) + " to " + FormatShort(part.colorRange->back()));
  }
  const std::string threads =
    result.plan.threads == 1 ? " s" : " s, summed over " + std::to_string(result.plan.threads) + " threads";
  table.emplace_back("thickness", FormatFixed(result.seconds.distance, 2) + threads);
  AddRun(table, result);
  PrintTable(out, table);
}

void
PrintDistanceTable(std::ostream & out, const DistanceOptions & options, const JobResult & result)
{
  TextTable table;
  AddResolution(table, result.input);
  AddObject(table, options, result);
  AddNotANumber(table, result.sums.counts);
  const std::string threads =
    result.plan.threads == 1 ? " s" : " s, summed over " + std::to_string(result.plan.threads) + " threads";
  table.emplace_back("distance", FormatFixed(result.seconds.distance, 2) + threads);
  AddRun(table, result);
  PrintTable(out, table);
}

} // end namespace medialvoxel
