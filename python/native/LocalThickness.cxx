// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayEngine.h"
#include "Errors.h"

namespace medialvoxel
{

nlohmann::json
MeasureLocalThickness(const ArrayCall & call, const PartOptions & options)
{
  const bool isOfWalls = options.localThicknessMethod == LocalThicknessMethod::Wall;
  if (options.subVoxel.value_or(false) && !isOfWalls)
  {
    Fail(ExitStatus::Usage, "array: sub-voxel measures have no effect with the method sphere");
  }
  ExtractOptions thicknessOptions = GetThicknessOptions(options);
  thicknessOptions.maximumPoreSize = 0; // the thickness is that of the array as it is
  ArrayEngine                 engine(call, options);
  itk::MedialVoxelObjectInput object = engine.MakeObject(Smoothing::Off);
  if (isOfWalls)
  {
    engine.Prepare(object, thicknessOptions);
  }
  itk::MedialVoxelLocalThickness task = GetLocalThickness(thicknessOptions, engine.GetGrid());
  const bool mayUseValues = options.subVoxel.value_or(isOfWalls && HasOneThreshold(options, call.header));
  if (task.walls)
  {
    task.walls->grayRange = engine.FindMeasure(object, mayUseValues, "", std::nullopt).range;
  }
  float * const thickness = call.outputs.thickness;
  const auto    sums = engine.Run(object, task, [&](const itk::MedialVoxelTileResult & tile) {
    tile.WriteLocalThickness(engine.PlaceOf(thickness, tile.box), engine.GetStrides());
  });
  return { { "counts",
             { { "object_voxels", sums.counts.objectVoxels },
               { "voxels_at_maximum", sums.voxelsAtMaximum },
               { "voxels_without_wall", sums.voxelsWithoutWall },
               { "not_a_number_voxels", sums.counts.notANumberVoxels } } } };
}

} // end namespace medialvoxel
