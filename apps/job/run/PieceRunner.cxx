// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PieceRunner.h"

#include "MaskInput.h"
#include "ResampledInput.h"

namespace medialvoxel
{

namespace
{

PixelType
GetImagePixelType(const InputVolume & input, const VolumeHeader & header)
{
  return input.IsMask() ? PixelType::UInt8 : header.pixelType;
}

/** Between labels there are no values: not without a threshold, and not with one value for both. A label has no
 * thresholds. */
Interpolation
GetInterpolation(const JobOptions & options)
{
  const bool hasThreshold = options.lowerThreshold || options.upperThreshold;
  return hasThreshold && options.lowerThreshold != options.upperThreshold ? Interpolation::Linear
                                                                          : Interpolation::Nearest;
}

} // namespace

CutSettings
GetCutSettings(const JobPlan & plan)
{
  return { plan.slabThickness, plan.GetFilterLimit(plan.GetMaximumSlices()) };
}

std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header, const JobOptions & options, const std::filesystem::path & scratchFolder)
{
  const Interpolation interpolation = GetInterpolation(options);
  if (!header.CanStream())
  {
    return OpenMaskInput(
      header, { options.lowerThreshold, options.upperThreshold, options.label, scratchFolder, interpolation });
  }
  if (header.stored)
  {
    return OpenResampledInput(header, interpolation);
  }
  return DispatchPixelType(header.pixelType, [&](auto zero) { return OpenStreamedInput<decltype(zero)>(header); });
}

std::unique_ptr<PieceRunner>
MakeExtractRunner(InputVolume &          input,
                  const VolumeHeader &   header,
                  const ExtractOptions & options,
                  const CutSettings &    cut,
                  const PieceObserver &  observer)
{
  return DispatchPixelType(GetImagePixelType(input, header), [&](auto zero) {
    return MakeExtractRunnerFor<decltype(zero)>(input, header, options, cut, observer);
  });
}

std::unique_ptr<PieceRunner>
MakeDistanceRunner(InputVolume &            input,
                   const VolumeHeader &     header,
                   const JobOptions &       options,
                   const DistanceSettings & settings,
                   const PieceObserver &    observer)
{
  return DispatchPixelType(GetImagePixelType(input, header), [&](auto zero) {
    return MakeDistanceRunnerFor<decltype(zero)>(input, header, options, settings, observer);
  });
}

} // end namespace medialvoxel
