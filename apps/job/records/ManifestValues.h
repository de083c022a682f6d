// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelManifestValues_h
#define medialvoxelManifestValues_h

#include "Options.h"
#include "SealedJson.h"

#include <optional>

namespace medialvoxel
{

/** The findings in a volume, in a manifest; unset ones are null. Reading other text throws Json::exception or
 * std::invalid_argument. */
Json
RoughnessToJson(const std::optional<itk::MedialVoxelRoughness> & roughness);
std::optional<itk::MedialVoxelRoughness>
RoughnessFromJson(const Json & json);

Json
SmoothingLevelToJson(const std::optional<itk::MedialVoxelSmoothingLevel> & level);
std::optional<itk::MedialVoxelSmoothingLevel>
SmoothingLevelFromJson(const Json & json);

Json
MeasureToJson(const std::optional<WallMeasure> & measure);
std::optional<WallMeasure>
MeasureFromJson(const Json & json);

} // end namespace medialvoxel

#endif
