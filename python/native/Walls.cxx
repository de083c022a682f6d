// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayEngine.h"
#include "NamedCounts.h"
#include "ProcessMemory.h"
#include "SheetInMemory.h"
#include "SheetObserver.h"
#include "TaskRunner.h"
#include "WallJson.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{

nlohmann::json
NumberArrayWalls(const ArrayCall & call, const ExtractOptions & given)
{
  ExtractOptions              options = given;
  const VolumeGeometry &      geometry = call.header.geometry;
  ArrayEngine                 engine(call, options);
  itk::MedialVoxelObjectInput object = engine.MakeObject(GetSmoothing(options));
  engine.Prepare(object, options);
  itk::MedialVoxelSheetExtraction extraction;
  extraction.parameters = GetParameters(options, engine.GetGrid());
  extraction.grayRange =
    engine.FindMeasure(object, MayMeasureOnGrayValues(options, call.header), "", options.materials).range;
  const std::uint64_t memoryLimit = options.memoryLimit.value_or(GetFreeMemory() / 2);
  SheetInMemory       sheet(memoryLimit);
  const auto          observer = MakeSheetObserver(options, geometry, engine.GetGrid(), memoryLimit, {}, sheet);
  extraction.AddObserver(*observer);
  const auto     sums = engine.Run(object, extraction, [](const itk::MedialVoxelTileResult &) {});
  nlohmann::json numbers = engine.ReadBeforeRun([&](const auto & check) {
    observer->Finish();
    const auto runTasks = MakeTaskRunner(engine.GetNumberOfThreads(), [&check] { check(0.0); });
    const auto walls = itk::MedialVoxelFindWalls(sheet.sheet, runTasks);
    auto *     numbersOfCells = call.outputs.walls;
    sheet.ForEachSlice(geometry, walls.wallOf, [&numbersOfCells](const std::vector<std::uint32_t> & slice) {
      numbersOfCells = std::copy(slice.begin(), slice.end(), numbersOfCells);
    });
    return nlohmann::json(MakeWallsJson(walls, std::numeric_limits<std::size_t>::max()));
  });
  for (const NamedCount & count : NamedCounts)
  {
    numbers["counts"][count.name] = sums.counts.*count.member;
  }
  return numbers;
}

} // end namespace medialvoxel
