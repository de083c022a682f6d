// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectRoughness.h"

#include "PartRunner.h"

namespace medialvoxel
{
itk::MedialVoxelRoughness
MeasureRoughness(InputVolume &               input,
                 const itk::MedialVoxelBox & image,
                 std::uint64_t               slicesOfChunk,
                 const ReadObserver &        observer)
{
  const bool                    isParallel = input.GetSourceThreads() == itk::MedialVoxelSourceThreads::Several;
  PartRunner                    runner;
  itk::MedialVoxelRoughnessPass pass;
  pass.fill = [&input](const itk::MedialVoxelBox & box, itk::MedialVoxelBits & object) {
    input.Fill(box, { &object, nullptr, nullptr });
  };
  pass.forEach = [&](const auto & boxes, const auto & work) { runner.Run(boxes, isParallel, work); };
  pass.observe = observer;
  pass.rows = input.GetRowsReadTogether();
  pass.slices = static_cast<std::int64_t>(slicesOfChunk);
  return itk::MedialVoxelMeasureRoughness(pass, image);
}

} // end namespace medialvoxel
