// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PageView.h"

#include "ColorMap.h"
#include "EscapeHtml.h"
#include "PageText.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr const char * Library = "three.js";
constexpr const char * Controls = "OrbitControls.js";
constexpr const char * License = "license";

/** Bytes of a point: distance from the one before, three places in its block, and its thickness. */
constexpr std::uint64_t LongestPoint = 5 + 3 + 5;

/** Bytes of the importance of a point, and of its wall. */
constexpr std::uint64_t LongestNumber = 5;

/** Bytes of a part: a run at each side of a face and one between. */
constexpr std::uint64_t LongestPart = 10 * PartBlocks::DefaultBudget;

enum PointCode : std::uint64_t
{
  Unpaired = 0,
  NotMeasured = 1,
  FirstLength = 2
};

void
AddNumber(std::string & bytes, std::uint64_t number)
{
  for (; number >= 128; number >>= 7)
  {
    bytes.push_back(static_cast<char>(number | 128));
  }
  bytes.push_back(static_cast<char>(number));
}

std::uint64_t
GetCode(const SheetPoints::Sums & sums)
{
  if (sums.measured > 0)
  {
    return FirstLength + (sums.thickness + sums.measured / 2) / sums.measured;
  }
  return sums.unpaired > 0 ? Unpaired : NotMeasured;
}

/** Where in its block the mean of the cells is along an axis, in 256ths of the edge. */
char
GetPlaceInBlock(const SheetPoints::Point & point, unsigned int axis, unsigned int level)
{
  constexpr std::uint64_t parts = 256;
  const std::uint64_t     cells = point.sums.cells;
  const std::uint64_t     before = point.sums.index[axis] - cells * (point.block[axis] << level);
  // The middle of a cell is half a voxel from its index.
  const double place = (static_cast<double>(before) + 0.5 * static_cast<double>(cells)) /
                       (static_cast<double>(cells) * static_cast<double>(std::uint64_t{ 1 } << level));
  return static_cast<char>(std::min(static_cast<std::uint64_t>(place * parts), parts - 1));
}

/** Smallest and largest importance of the points, both 0 where it was not found. */
std::pair<std::uint64_t, std::uint64_t>
FindImportances(const SheetPoints & points)
{
  std::pair<std::uint64_t, std::uint64_t> ends{ std::numeric_limits<std::uint64_t>::max(), 0 };
  points.ForEachPoint([&](const SheetPoints::Point & point) {
    ends.first = std::min(ends.first, point.importance);
    ends.second = std::max(ends.second, point.importance);
  });
  return ends;
}

std::string
EncodePoints(const PageSheet & shown)
{
  const SheetPoints & points = shown.sheet->GetPoints();
  const bool          hasImportance = FindImportances(points).second > 0;
  const auto          blocks = points.GetNumberOfBlocks();
  std::string         bytes;
  std::uint64_t       previous = 0;
  auto                wall = shown.walls.begin();
  points.ForEachPoint([&](const SheetPoints::Point & point) {
    const std::uint64_t number = (point.block[2] * blocks[1] + point.block[1]) * blocks[0] + point.block[0];
    AddNumber(bytes, number - previous);
    previous = number;
    for (unsigned int axis = 0; axis < 3 && points.GetLevel() > 0; ++axis)
    {
      bytes.push_back(GetPlaceInBlock(point, axis, points.GetLevel()));
    }
    AddNumber(bytes, GetCode(point.sums));
    hasImportance ? AddNumber(bytes, point.importance) : void();
    wall != shown.walls.end() ? AddNumber(bytes, *wall++) : void();
  });
  return bytes;
}

/** Runs of equal shares. */
std::string
EncodePart(const PartBlocks::Grid & grid)
{
  constexpr unsigned int bitsOfShare = 4;
  std::string            bytes;
  for (auto at = grid.shares.begin(); at != grid.shares.end();)
  {
    const std::uint8_t share = *at;
    const auto end = std::find_if(at, grid.shares.end(), [share](std::uint8_t other) { return other != share; });
    AddNumber(bytes, static_cast<std::uint64_t>(end - at - 1) << bitsOfShare | share);
    at = end;
  }
  return bytes;
}

/** The colors of shares from 0 to 1, six digits each. */
std::string
MakeColors()
{
  constexpr unsigned int     colors = 64;
  constexpr std::string_view digits = "0123456789abcdef";
  std::string                text;
  for (unsigned int i = 0; i < colors; ++i)
  {
    for (const std::uint8_t component : GetMapColor(i / (colors - 1.0)))
    {
      text += digits[component >> 4];
      text += digits[component & 15];
    }
  }
  return text;
}

std::string
Describe(const PageSheet &        shown,
         const PartBlocks::Grid & part,
         const VolumeGeometry &   geometry,
         const std::string &      unit)
{
  const SheetPoints &   points = shown.sheet->GetPoints();
  std::array<double, 3> shift{};
  std::transform(
    geometry.size.begin(), geometry.size.end(), shift.begin(), [](auto size) { return size > 1 ? 0.5 : 0.0; });
  const auto             importance = FindImportances(points);
  nlohmann::ordered_json json{ { "points", points.GetNumberOfPoints() },
                               { "blocks", points.GetNumberOfBlocks() },
                               { "edge", std::uint64_t{ 1 } << points.GetLevel() },
                               { "part",
                                 { { "blocks", part.blocks }, { "edge", 0.5 * static_cast<double>(part.halfEdges) } } },
                               { "size", geometry.size },
                               { "spacing", geometry.spacing },
                               { "origin", geometry.origin },
                               { "direction", geometry.direction },
                               { "shift", shift },
                               { "lengths", unit },
                               { "lengthUnit", shown.sheet->GetLengthUnit() },
                               { "low", shown.colors.low },
                               { "high", shown.colors.high },
                               { "importance", importance },
                               { "colors", MakeColors() } };
  if (!shown.walls.empty())
  {
    json["walls"] = *std::max_element(shown.walls.begin(), shown.walls.end());
  }
  return json.dump();
}

void
AddScript(std::string & page, const char * file)
{
  page += "<script>\n";
  AddPageFile(page, file);
  page += "</script>\n";
}

void
AddData(std::string & page, const char * name, const std::string & text)
{
  page += "<script type=\"text/plain\" id=\"" + std::string(name) + "\">";
  page += text;
  page += "</script>\n";
}

/** Bytes of a text in base 64. */
constexpr std::uint64_t
GetEncodedSize(std::uint64_t bytes)
{
  return (bytes + 2) / 3 * 4;
}

} // namespace

bool
HasPageViewer()
{
  return HasPageFile(Library);
}

bool
HasView(const PageSheet & shown, const VolumeGeometry & geometry)
{
  return HasPageViewer() && shown.sheet != nullptr && geometry.GetDimension() == 3 &&
         shown.sheet->GetPoints().GetNumberOfPoints() > 0;
}

void
AddPageScripts(std::string & page, const PageSheet & shown, const VolumeGeometry & geometry, const std::string & unit)
{
  const PartBlocks::Grid part = shown.sheet->GetPart().MakeGrid(shown.sheet->GetPoints());
  AddData(page, "view-data", Describe(shown, part, geometry, unit));
  AddData(page, "view-points", EncodeBase64(EncodePoints(shown)));
  AddData(page, "view-part", EncodeBase64(EncodePart(part)));
  for (const char * const file : { Library, Controls, "sheet.js", "part.js", "scene.js", "view.js" })
  {
    AddScript(page, file);
  }
  page += "<details>\n<summary>License of three.js, which the view is drawn with</summary>\n<pre>" +
          EscapeHtml(GetPageFile(License)) + "</pre>\n</details>\n";
}

std::uint64_t
GetPageViewMemory(const VolumeGeometry & geometry, const unsigned int numbers)
{
  // Text of points and part, and the page twice while it grows.
  constexpr std::uint64_t copies = 3;
  const std::uint64_t     points = std::min<std::uint64_t>(SheetPoints::DefaultBudget, geometry.GetNumberOfVoxels());
  return copies *
           (GetEncodedSize((LongestPoint + numbers * LongestNumber) * points + LongestPart) + GetPageFileSize()) +
         PartBlocks(geometry.size).GetBytesOfGrid();
}

} // end namespace medialvoxel
