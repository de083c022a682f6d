// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelManifestValues_h
#define medialvoxelManifestValues_h

#include "Options.h"
#include "SealedJson.h"

#include <optional>

namespace medialvoxel
{

/** Values of options in a manifest; what is not set is null. Reading throws Json::exception or std::invalid_argument
 * for what was not written so. */
Json
RawToJson(const std::optional<RawDescription> & raw);
std::optional<RawDescription>
RawFromJson(const Json & json);
std::optional<LabelValue>
LabelFromJson(const Json & json);

Json
RoughnessToJson(const std::optional<itk::MedialVoxelRoughness> & roughness);
std::optional<itk::MedialVoxelRoughness>
RoughnessFromJson(const Json & json);

Json
LevelsToJson(const std::optional<itk::MedialVoxelScanLevels> & levels);
std::optional<itk::MedialVoxelScanLevels>
LevelsFromJson(const Json & json);

Json
PlacesToJson(const std::optional<PlaceLimits> & limits);
std::optional<PlaceLimits>
PlacesFromJson(const Json & json);

Json
MeasureToJson(const std::optional<WallMeasure> & measure);
std::optional<WallMeasure>
MeasureFromJson(const Json & json);

} // end namespace medialvoxel

#endif
