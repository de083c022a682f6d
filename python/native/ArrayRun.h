// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelArrayRun_h
#define medialvoxelArrayRun_h

#include "Binding.h"
#include "Options.h"
#include "VolumeHeader.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** What all calls have. */
struct ArrayCall
{
  const MedialVoxelArray &   array;
  VolumeHeader               header; ///< of the array, for checks and messages
  const MedialVoxelOutputs & outputs;
  MedialVoxelControl &       control;
};

struct ArrayMesh
{
  std::vector<double>       points;
  std::vector<float>        thickness;
  std::vector<std::int64_t> faces;
  std::int64_t              cornersPerFace{ 4 };
};

/** Each returns numbers of the run.
 * \throw JobError, itk::ExceptionObject and exceptions of the engine */
nlohmann::json
ExtractArray(const ArrayCall & call, const ExtractOptions & options);
nlohmann::json
NumberArrayWalls(const ArrayCall & call, const ExtractOptions & options);
nlohmann::json
MeshArray(const ArrayCall & call, const ExtractOptions & options, ArrayMesh & mesh);
nlohmann::json
MeasureDistances(const ArrayCall & call, const DistanceOptions & options);
nlohmann::json
MeasureLocalThickness(const ArrayCall & call, const PartOptions & options);

/** Parses the arguments as the program does, checks them and calls the named function; surface stands for its local
 * thickness. */
nlohmann::json
RunArguments(const ArrayCall & call, std::vector<std::string> arguments, ArrayMesh & mesh);

} // end namespace medialvoxel

#endif
