// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HtmlReport.h"

#include "LocalThicknessTable.h"
#include "PageText.h"
#include "PageView.h"
#include "PlaceTable.h"
#include "Text.h"
#include "Version.h"
#include "VolumeFormats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace medialvoxel
{
namespace
{

/** Browsers load nothing that is not in the page. */
constexpr const char * Policy = "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src "
                                "data:; style-src 'unsafe-inline'; "
                                "script-src 'unsafe-inline'\">\n";

std::string
MakeRows(const TextTable & table, const char * kind)
{
  std::string rows;
  for (const auto & [name, value] : table)
  {
    rows += "<tr><th scope=\"row\">" + EscapeHtml(name) + "</th><td class=\"" + kind + "\">" + EscapeHtml(value) +
            "</td></tr>\n";
  }
  return "<table>\n" + rows + "</table>\n";
}

std::string
MakePhaseTable(const itk::MedialVoxelCounts & counts)
{
  const std::uint64_t all = counts.candidateCells;
  const auto          row = [all](const char * mark, const char * name, std::uint64_t cells) {
    return "<tr><th scope=\"row\">" + std::string(mark) + name + "</th><td class=\"number\">" + std::to_string(cells) +
           "</td><td class=\"number\">" + (all > 0 ? FormatPercent(cells, all) : "-") + "</td></tr>\n";
  };
  return "<table>\n<tr><th>Decided by</th><th>cells</th><th>of all</th></tr>\n" +
         row("", "trivial pairs: not medial", counts.trivialCells) +
         row("<span class=\"bound\"></span>", "bound: medial", counts.boundCells) +
         row("<span class=\"geodesic\"></span>", "geodesic search: medial", counts.geodesicMedialCells) +
         row("", "geodesic search: not medial", counts.geodesicNonMedialCells) +
         row("", "all cells with an object corner", all) + "</table>\n";
}

/** A square of a color; nothing without one. */
std::string
MakeSwatch(const std::optional<SegmentColor> & color)
{
  if (!color)
  {
    return "";
  }
  constexpr double largest = 255.0;
  return "<span class=\"object\" style=\"background:rgb(" +
         Join(*color, ",", [](double shade) { return std::to_string(std::lround(shade * largest)); }) + ")\"></span>";
}

/** The objects of a label map, a row each. */
std::string
MakeObjectTable(const LabelMapSummary & summary, const std::string & unit)
{
  constexpr std::size_t mostRows = 1000;
  const std::size_t     rows = std::min(summary.objects.size(), mostRows);
  const auto            number = [](const std::string & text) { return "<td class=\"number\">" + text + "</td>"; };
  std::string           text = "<h2>Objects</h2>\n<table>\n<tr><th>label</th><th>name</th><th>voxels</th><th>medial "
                               "cells</th><th>mean thickness</th><th>median</th></tr>\n";
  for (std::size_t i = 0; i < rows; ++i)
  {
    const ObjectSummary & object = summary.objects[i];
    const bool            isMeasured = object.thickness.cells > 0;
    text += "<tr>" + number(std::to_string(object.label)) + "<td class=\"text\">" + MakeSwatch(object.color) +
            EscapeHtml(object.name) + "</td>" + number(std::to_string(object.voxels)) +
            number(std::to_string(object.medialCells)) + number(isMeasured ? FormatShort(object.thickness.mean) : "-") +
            number(isMeasured ? FormatShort(object.thickness.GetMedian()) : "-") + "</tr>\n";
  }
  text += "</table>\n<p class=\"muted\">Thickness in " + unit + ".";
  if (rows < summary.objects.size())
  {
    text += " These are " + std::to_string(rows) + " of " + std::to_string(summary.objects.size()) +
            " objects; the report has all.";
  }
  return text + "</p>\n";
}

std::string
MakeThickness(const ThicknessSummary & thickness, const std::string & unit, const WallMeasure & measure)
{
  if (thickness.cells == 0)
  {
    return "<p>No medial cells, so no thickness.</p>\n";
  }
  const auto limit = [](const std::optional<double> & length) { return length ? FormatShort(*length) : "not known"; };
  TextTable  table{ { "in " + unit, "" },
                    { "mean", FormatShort(thickness.mean) },
                    { "standard deviation", FormatShort(thickness.standardDeviation) },
                    { "smallest", limit(thickness.minimum) },
                    { "largest", limit(thickness.maximum) },
                    { "area of the sheet", FormatShort(thickness.area) } };
  TextTable  percentiles;
  for (std::size_t i = 0; i < thickness.percentiles.size(); ++i)
  {
    percentiles.emplace_back(std::to_string(ThicknessSummary::Percents[i]) + " % of the area up to",
                             FormatShort(thickness.percentiles[i]));
  }
  std::string text = MakeHistogramSvg(thickness, unit) + "<div class=\"columns\">\n" + MakeRows(table, "number") +
                     MakeRows(percentiles, "number") + "</div>\n<p class=\"muted\">Of " +
                     std::to_string(thickness.cells) + " medial cells, without " + std::to_string(thickness.rimCells) +
                     " at rims and junctions";
  if (thickness.standardError)
  {
    text += ", a sample of one cell in " + std::to_string(thickness.step) + " (standard error of the mean " +
            FormatShort(*thickness.standardError) + ")";
  }
  if (thickness.unresolvedCells > 0)
  {
    text += ", and " + std::to_string(thickness.unresolvedCells) + " that the blur does not resolve";
  }
  text += ", in " + unit + ", measured " + EscapeHtml(Describe(measure)) + "; lengths are multiples of " +
          FormatNumber(thickness.resolution) +
          ". Cells count as much as the area of the sheet in them, in squared units.";
  if (thickness.bins.above > 0.0)
  {
    text += " An area of " + FormatShort(thickness.bins.above) + " is thicker than the last bin.";
  }
  if (thickness.uncertainCells > 0)
  {
    text += " The uncertainty of a thickness, half of the interval that holds the truth in 95 % of the cases, has the "
            "median " +
            FormatShort(thickness.uncertainty.GetMedian()) + " and is up to " +
            FormatShort(thickness.uncertainty.percentiles[5]) + " at 95 % of the cells. It covers " +
            UncertaintyCovers + ". It leaves out " + UncertaintyLeavesOut + ".";
  }
  return text + "</p>\n";
}

std::string
MakeWarnings(const std::vector<Warning> & warnings)
{
  std::string text;
  for (const Warning & warning : warnings)
  {
    text += "<p class=\"warning\">Warning: " + EscapeHtml(warning.message) + ".</p>\n";
  }
  return text;
}

std::string
FormatLimit(const std::optional<itk::MedialVoxelLimit> & limit)
{
  return limit ? limit->Format() : "none";
}

TextTable
DescribeInput(const VolumeHeader & header)
{
  return { { "file", header.fileName.filename().string() },
           { "format", header.format->name },
           { "resolution", FormatSize(header.geometry.size) },
           { "spacing", FormatNumbers(header.geometry.spacing, " x ") + (header.geometry.inMillimeters ? " mm" : "") },
           { "type", std::string(GetTraits(header.GetStored().pixelType).name) } };
}

TextTable
DescribeParameters(const ExtractOptions & options, const JobResult & result)
{
  const itk::MedialVoxelGrid grid = GetGrid(options, result.input);
  TextTable                  table{ { "thickness (tau)", DescribeThickness(options, "") } };
  if (!options.thickness)
  {
    const auto limits = GetLimitsOfWalls(options, grid);
    table.emplace_back("minimum thickness", FormatShort(limits.minimum));
    table.emplace_back("maximum thickness", FormatShort(limits.maximum));
  }
  const TextTable others{
    { "lengths in", DescribeUnit(options, result.input.geometry) },
    { "lower threshold", FormatLimit(options.lowerThreshold) + (options.lowerIsOtsu ? " (otsu)" : "") },
    { "upper threshold", FormatLimit(options.upperThreshold) },
    { "label", options.label ? FormatLabel(*options.label) : "none" },
    { "smoothed", DescribeSmoothing(options, result) },
    { "largest pores left out", std::to_string(GetParameters(options, grid).maximumPoreSize) + " voxels" }
  };
  table.insert(table.end(), others.begin(), others.end());
  return table;
}

TextTable
DescribeRun(const ExtractOptions & options, const JobResult & result)
{
  return { { "ended", GetTime() },
           { "command", options.command.empty() ? "not known" : options.command },
           { "distance", FormatSeconds(result.seconds.distance) },
           { "classification", FormatSeconds(result.seconds.classification) },
           { "remeshing", FormatSeconds(result.seconds.remeshing) },
           { "reading and writing", FormatSeconds(result.seconds.inputOutput) },
           { "total", FormatSeconds(result.seconds.total) },
           { "peak memory", FormatBytes(result.peakMemoryBytes) },
           { "bytes read", std::to_string(result.bytesRead) },
           { "threads", std::to_string(result.plan.threads) },
           { "divisions", std::to_string(result.plan.divisions) } };
}

std::string
MakeCitation()
{
  return "<p>Please cite the paper and this software:</p>\n<pre>"
         "T. Michikawa and H. Suzuki. Efficient Medial Voxel Extraction for Large Volumetric Models. 2012.\n"
         "The MedialVoxel contributors. MedialVoxel, version " +
         GetVersion() + ".</pre>\n";
}

} // namespace

std::string
MakeHtmlReport(const ExtractOptions & options,
               const JobResult &      result,
               const Pictures &       pictures,
               const PageSheet &      sheet)
{
  const itk::MedialVoxelCounts & counts = result.sums.counts;
  const std::string              name = EscapeHtml(result.input.fileName.filename().string());
  const std::string              unit = DescribeUnit(options, result.input.geometry);
  std::string                    page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += Policy;
  page +=
    "<title>Medial voxels of " + name + "</title>\n<style>\n" + GetPageFile("page.css") + "</style>\n</head>\n<body>\n";
  page += "<h1>Medial voxels of " + name + "</h1>\n<p>" +
          std::to_string(counts.boundCells + counts.geodesicMedialCells) + " medial cells in " +
          std::to_string(counts.objectVoxels) + " object voxels of " + FormatSize(result.input.geometry.size) +
          ", thickness " + DescribeThickness(options, " " + unit) + ".</p>\n";
  page += MakeWarnings(result.warnings);
  const bool hasView = HasView(sheet, result.input.geometry);
  page += hasView ? GetPageFile("view.html") : "";
  page +=
    "<h2>Picture</h2>\n<img alt=\"Slices with the medial cells, and the projection along z\" "
    "src=\"data:image/png;base64," +
    EncodeBase64(pictures.labels) +
    "\">\n<p class=\"muted\"><span class=\"object\"></span>object, <span class=\"bound\"></span>medial by the bound, "
    "<span class=\"geodesic\"></span>medial by a path search. The scale bar is in " +
    result.input.geometry.DescribeUnit() + ".</p>\n";
  page += "<h2>Thickness of the walls</h2>\n";
  if (!pictures.thicknesses.empty())
  {
    page +=
      "<img alt=\"The same views, colored by the thickness\" src=\"data:image/png;base64," +
      EncodeBase64(pictures.thicknesses) +
      "\">\n<p class=\"muted\">The colors span the 1st to the 99th percentile, in " + unit +
      "; values outside are clamped. If several cells share a pixel, the thickest is shown. Cells at rims have no "
      "color.</p>\n";
  }
  page += MakeThickness(result.thickness.value_or(ThicknessSummary{}), unit, result.measure.value());
  const TextTable localThickness = DescribeLocalThickness(options, result);
  page += localThickness.empty() ? "" : MakeRows(localThickness, "text");
  page += MakePlacesHtml(result.places, unit);
  page += result.objects ? MakeObjectTable(*result.objects, unit) : "";
  page += "<h2>Phases</h2>\n" + MakePhaseTable(counts);
  page += "<div class=\"columns\">\n<div><h2>Input</h2>\n" + MakeRows(DescribeInput(result.input), "text") +
          "</div>\n<div><h2>Parameters</h2>\n" + MakeRows(DescribeParameters(options, result), "text") +
          "</div>\n<div><h2>Versions</h2>\n" +
          MakeRows({ { "MedialVoxel", GetVersion() }, { "ITK", GetItkVersion() } }, "text") + "</div>\n</div>\n";
  page += "<h2>How to cite</h2>\n" + MakeCitation();
  page += "<section id=\"run\">\n<h2>Run</h2>\n" + MakeRows(DescribeRun(options, result), "text") + "</section>\n";
  if (hasView)
  {
    AddPageScripts(page, sheet, result.input.geometry, unit);
  }
  return page + "</body>\n</html>\n";
}

} // end namespace medialvoxel
