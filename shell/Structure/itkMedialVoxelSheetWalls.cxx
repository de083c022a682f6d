// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetWalls.h"

#include "itkMedialVoxelSpread.h"
#include "itkMedialVoxelWallPieces.h"
#include "itkMedialVoxelWallSeams.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;

/** Numbers the walls of all points by area. */
void
NumberWalls(const MedialVoxelSheetGraph & graph, const MedialVoxelWallPieces & pieces, MedialVoxelSheetWalls & result)
{
  constexpr Index     none = MedialVoxelSheetGraph::None;
  std::vector<Index>  numbers(graph.GetNumberOfNodes(), none); // in the order of the first points
  std::vector<double> areas;
  const auto &        areasOfPoints = graph.GetAreasOfPoints();
  result.wallOf.assign(areasOfPoints.size(), none);
  for (Index point = 0; point < areasOfPoints.size(); ++point)
  {
    if (graph.GetNode(point) == none || pieces.GetWall(graph.GetNode(point)) == none)
    {
      continue;
    }
    Index & number = numbers[pieces.GetWall(graph.GetNode(point))];
    if (number == none)
    {
      number = static_cast<Index>(areas.size());
      areas.push_back(0.0);
    }
    areas[number] += areasOfPoints[point];
    result.wallOf[point] = number;
  }
  std::vector<Index> order(areas.size());
  std::iota(order.begin(), order.end(), Index{ 0 });
  std::stable_sort(order.begin(), order.end(), [&](const Index a, const Index b) { return areas[a] > areas[b]; });
  std::vector<Index> ranks(areas.size());
  for (Index rank = 0; rank < order.size(); ++rank)
  {
    ranks[order[rank]] = rank + 1;
  }
  for (Index & wall : result.wallOf)
  {
    wall = wall == none ? 0 : ranks[wall];
  }
  result.walls.resize(areas.size());
}

void
DescribeWalls(const MedialVoxelSheet & sheet, const MedialVoxelSheetGraph & graph, MedialVoxelSheetWalls & result)
{
  std::vector<MedialVoxelSpread> spreads(result.walls.size());
  std::vector<double>            squares(result.walls.size());
  for (Index point = 0; point < sheet.points.size(); ++point)
  {
    if (result.wallOf[point] == 0)
    {
      continue;
    }
    const Index          number = result.wallOf[point] - 1;
    MedialVoxelWallRow & wall = result.walls[number];
    if (wall.cells == 0)
    {
      spreads[number] = MedialVoxelSpread(sheet.points[point]);
    }
    ++wall.cells;
    wall.area += graph.GetAreasOfPoints()[point];
    wall.rimLength += graph.GetRimsOfPoints()[point];
    spreads[number].Add(sheet.points[point], graph.GetAreasOfPoints()[point]);
    if (MedialVoxelIsKnown(sheet.thickness[point]))
    {
      const double thickness = sheet.thickness[point];
      ++wall.measured;
      wall.meanThickness += thickness;
      squares[number] += thickness * thickness;
      wall.leastThickness = std::min(wall.leastThickness, thickness);
      wall.mostThickness = std::max(wall.mostThickness, thickness);
    }
  }
  for (Index number = 0; number < result.walls.size(); ++number)
  {
    MedialVoxelWallRow & wall = result.walls[number];
    const auto           axes = spreads[number].FindAxes();
    wall.centroid = spreads[number].GetMiddle();
    wall.normal = axes.directions[0];
    const auto first =
      std::find_if(wall.normal.begin(), wall.normal.end(), [](const double component) { return component != 0.0; });
    if (first != wall.normal.end() && *first < 0.0)
    {
      wall.normal = MedialVoxelAddScaled({}, wall.normal, -1.0);
    }
    wall.flatness = std::sqrt(axes.variances[0]);
    if (wall.measured > 0)
    {
      const auto measured = static_cast<double>(wall.measured);
      wall.meanThickness /= measured;
      wall.spreadOfThickness =
        std::sqrt(std::max(0.0, squares[number] / measured - wall.meanThickness * wall.meanThickness));
    }
  }
}

} // namespace

MedialVoxelSheetWalls
MedialVoxelFindWalls(const MedialVoxelSheet & sheet, const MedialVoxelRunTasks & runTasks)
{
  MedialVoxelSheetWalls       result;
  const MedialVoxelSheetGraph graph(sheet);
  const MedialVoxelWallPieces pieces(graph, runTasks);
  NumberWalls(graph, pieces, result);
  DescribeWalls(sheet, graph, result);
  std::vector<Index> numberOf(graph.GetNumberOfNodes());
  for (Index point = 0; point < sheet.points.size(); ++point)
  {
    if (result.wallOf[point] != 0)
    {
      numberOf[pieces.GetWall(graph.GetNode(point))] = result.wallOf[point];
    }
  }
  result.seams = MedialVoxelFindSeams(graph, pieces, numberOf);
  for (const MedialVoxelSeamRow & seam : result.seams)
  {
    for (const Index wall : seam.walls)
    {
      auto & neighbors = result.walls[wall - 1].neighbors;
      std::copy_if(seam.walls.begin(), seam.walls.end(), std::back_inserter(neighbors), [&](const Index other) {
        return other != wall;
      });
      std::sort(neighbors.begin(), neighbors.end());
      neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    }
  }
  return result;
}

} // end namespace itk
