// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ManifestValues.h"

#include <stdexcept>
#include <string>

namespace medialvoxel
{

Json
RoughnessToJson(const std::optional<itk::MedialVoxelRoughness> & roughness)
{
  return roughness ? Json{ roughness->roughVoxels, roughness->borderVoxels } : Json(nullptr);
}

std::optional<itk::MedialVoxelRoughness>
RoughnessFromJson(const Json & json)
{
  if (json.is_null())
  {
    return std::nullopt;
  }
  itk::MedialVoxelRoughness roughness;
  ReadWhole(json.at(0), roughness.roughVoxels);
  ReadWhole(json.at(1), roughness.borderVoxels);
  return roughness;
}

Json
SmoothingLevelToJson(const std::optional<itk::MedialVoxelSmoothingLevel> & level)
{
  return level ? Json{ { "value", level->value ? Json(*level->value) : Json(nullptr) },
                       { "object_is_above", level->objectIsAbove } }
               : Json(nullptr);
}

std::optional<itk::MedialVoxelSmoothingLevel>
SmoothingLevelFromJson(const Json & json)
{
  if (json.is_null())
  {
    return std::nullopt;
  }
  const Json & value = json.at("value");
  return itk::MedialVoxelSmoothingLevel{ value.is_null() ? std::nullopt : std::optional(value.get<double>()),
                                         json.at("object_is_above").get<bool>() };
}

Json
MeasureToJson(const std::optional<WallMeasure> & measure)
{
  if (!measure)
  {
    return nullptr;
  }
  Json scan(nullptr);
  if (measure->scan)
  {
    scan = { measure->scan->background,
             measure->scan->material,
             measure->scan->blur,
             measure->scan->noise,
             measure->scan->correlation };
  }
  return { { "gray_values", measure->usesGrayValues }, { "scan", scan }, { "reason", measure->reason } };
}

std::optional<WallMeasure>
MeasureFromJson(const Json & json)
{
  if (json.is_null())
  {
    return std::nullopt;
  }
  WallMeasure  measure{ json.at("gray_values").get<bool>(), std::nullopt, json.at("reason").get<std::string>() };
  const Json & scan = json.at("scan");
  if (!scan.is_null())
  {
    measure.scan = itk::MedialVoxelScan{ scan.at(0).get<double>(),
                                         scan.at(1).get<double>(),
                                         scan.at(2).get<double>(),
                                         scan.at(3).get<double>(),
                                         scan.at(4).get<double>() };
    if (!(measure.scan->blur > 0.0) || !(measure.scan->background != measure.scan->material))
    {
      throw std::invalid_argument("it has a scan without blur or contrast");
    }
  }
  return measure;
}

} // end namespace medialvoxel
