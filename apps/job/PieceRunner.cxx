// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceRunner.h"

namespace medialvoxel
{

std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header)
{
  return DispatchPixelType(header.pixelType, [&](auto zero) { return OpenInput<decltype(zero)>(header); });
}

std::unique_ptr<PieceRunner>
MakeExtractRunner(InputVolume &          input,
                  const VolumeHeader &   header,
                  const ExtractOptions & options,
                  const PieceObserver &  observer)
{
  return DispatchPixelType(header.pixelType, [&](auto zero) {
    return MakeExtractRunnerFor<decltype(zero)>(input, header, options, observer);
  });
}

std::unique_ptr<PieceRunner>
MakeDistanceRunner(InputVolume &            input,
                   const VolumeHeader &     header,
                   const JobOptions &       options,
                   const DistanceSettings & settings,
                   const PieceObserver &    observer)
{
  return DispatchPixelType(header.pixelType, [&](auto zero) {
    return MakeDistanceRunnerFor<decltype(zero)>(input, header, options, settings, observer);
  });
}

} // end namespace medialvoxel
