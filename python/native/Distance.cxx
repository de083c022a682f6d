// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayEngine.h"

namespace medialvoxel
{

nlohmann::json
MeasureDistances(const ArrayCall & call, const DistanceOptions & options)
{
  const MedialVoxelOutputs &  outputs = call.outputs;
  ArrayEngine                 engine(call, options);
  itk::MedialVoxelObjectInput object = engine.MakeObject(Smoothing::Off);
  itk::MedialVoxelDistanceMap task;
  task.boundary = options.boundary;
  task.region = options.region;
  task.maximumDistance = options.maximumDistance.value_or(task.maximumDistance);
  task.findsDisplacements = outputs.vectors != nullptr;
  const auto sums = engine.Run(object, task, [&](const itk::MedialVoxelTileResult & tile) {
    if (task.findsDisplacements)
    {
      engine.WriteVectors(tile, outputs.vectors);
    }
    tile.WriteDistances(
      { engine.GetGrid().GetSpacing() }, engine.PlaceOf(outputs.distance, tile.box), engine.GetStrides());
  });
  return { { "counts",
             { { "object_voxels", sums.counts.objectVoxels },
               { "not_a_number_voxels", sums.counts.notANumberVoxels } } } };
}

} // end namespace medialvoxel
