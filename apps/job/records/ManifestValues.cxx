// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ManifestValues.h"

#include "PixelType.h"

#include <stdexcept>
#include <string>

namespace medialvoxel
{

Json
RawToJson(const std::optional<RawDescription> & raw)
{
  if (!raw)
  {
    return nullptr;
  }
  return { { "size", raw->size },
           { "type", std::string(GetTraits(raw->pixelType).name) },
           { "spacing", raw->spacing },
           { "header_bytes", raw->headerBytes },
           { "big_endian", raw->bigEndian } };
}

std::optional<RawDescription>
RawFromJson(const Json & json)
{
  if (json.is_null())
  {
    return std::nullopt;
  }
  RawDescription raw;
  for (const Json & length : json.at("size"))
  {
    ReadWhole(length, raw.size.emplace_back());
  }
  const auto type = PixelTypeFromName(json.at("type").get<std::string>());
  if (!type)
  {
    throw std::invalid_argument("it has the unknown type of voxels " + json.at("type").dump());
  }
  raw.pixelType = *type;
  json.at("spacing").get_to(raw.spacing);
  ReadWhole(json.at("header_bytes"), raw.headerBytes);
  json.at("big_endian").get_to(raw.bigEndian);
  return raw;
}

std::optional<LabelValue>
LabelFromJson(const Json & json)
{
  if (json.is_null())
  {
    return std::nullopt;
  }
  const std::optional<LabelValue> label = ParseLabel(json.get<std::string>());
  if (!label)
  {
    throw std::invalid_argument("it has the unknown label " + json.dump());
  }
  return label;
}

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
LevelsToJson(const std::optional<itk::MedialVoxelScanLevels> & levels)
{
  return levels ? Json{ levels->background, levels->material } : Json(nullptr);
}

std::optional<itk::MedialVoxelScanLevels>
LevelsFromJson(const Json & json)
{
  if (json.is_null())
  {
    return std::nullopt;
  }
  return itk::MedialVoxelScanLevels{ json.at(0).get<double>(), json.at(1).get<double>() };
}

Json
PlacesToJson(const std::optional<PlaceLimits> & limits)
{
  return limits ? Json{ limits->limit, NumberToJson(limits->growLimit) } : Json(nullptr);
}

std::optional<PlaceLimits>
PlacesFromJson(const Json & json)
{
  if (json.is_null())
  {
    return std::nullopt;
  }
  return PlaceLimits{ json.at(0).get<double>(), NumberFromJson(json.at(1)) };
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
