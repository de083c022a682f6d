// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "WallJson.h"

#include "FillIn.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

Json
ToJson(const itk::MedialVoxelWallRow & wall, const std::size_t number)
{
  const auto measured = [&wall](const double value) { return wall.measured > 0 ? Json(value) : Json(nullptr); };
  return { { "wall", number },
           { "cells", wall.cells },
           { "area", wall.area },
           { "thickness",
             { { "cells", wall.measured },
               { "mean", measured(wall.meanThickness) },
               { "minimum", measured(wall.leastThickness) },
               { "maximum", measured(wall.mostThickness) },
               { "standard_deviation", measured(wall.spreadOfThickness) } } },
           { "centroid", wall.centroid },
           { "normal", wall.normal },
           { "flatness", wall.flatness },
           { "rim_length", wall.rimLength },
           { "neighbors", wall.neighbors } };
}

Json
ToJson(const itk::MedialVoxelSeamRow & seam, const std::size_t number)
{
  return { { "seam", number }, { "walls", seam.walls }, { "length", seam.length }, { "angles", seam.angles } };
}

template <typename TRow>
Json
ListRows(const std::vector<TRow> & rows, const std::size_t most)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(rows.size(), most); ++i)
  {
    list.push_back(ToJson(rows[i], i + 1));
  }
  return list;
}

template <typename TNumber>
std::string
JoinNumbers(const std::vector<TNumber> & numbers)
{
  return Join(numbers, " ", [](const TNumber number) { return Json(number).dump(); });
}

} // namespace

Json
MakeWallsJson(const itk::MedialVoxelSheetWalls & walls, const std::size_t mostRows)
{
  return { { "number_of_walls", walls.walls.size() },
           { "number_of_seams", walls.seams.size() },
           { "walls", ListRows(walls.walls, mostRows) },
           { "seams", ListRows(walls.seams, mostRows) } };
}

std::string
MakeWallsCsv(const itk::MedialVoxelSheetWalls & walls)
{
  std::string text = "wall,cells,area,thickness_mean,thickness_minimum,thickness_maximum,thickness_standard_deviation,"
                     "centroid_x,centroid_y,centroid_z,normal_x,normal_y,normal_z,flatness,rim_length,neighbors\n";
  for (std::size_t i = 0; i < walls.walls.size(); ++i)
  {
    text += FillIn("{wall},{cells},{area},[thickness.cells>0?{thickness.mean},{thickness.minimum},{thickness.maximum},"
                   "{thickness.standard_deviation}][!thickness.cells>0?,,,],{centroid.0},{centroid.1},{centroid.2},"
                   "{normal.0},{normal.1},{normal.2},{flatness},{rim_length},",
                   ToJson(walls.walls[i], i + 1)) +
            JoinNumbers(walls.walls[i].neighbors) + '\n';
  }
  return text;
}

std::string
MakeSeamsCsv(const itk::MedialVoxelSheetWalls & walls)
{
  std::string text = "seam,length,walls,angles\n";
  for (std::size_t i = 0; i < walls.seams.size(); ++i)
  {
    text += FillIn("{seam},{length},", ToJson(walls.seams[i], i + 1)) + JoinNumbers(walls.seams[i].walls) + ',' +
            JoinNumbers(walls.seams[i].angles) + '\n';
  }
  return text;
}

} // end namespace medialvoxel
