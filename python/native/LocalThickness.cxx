// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FilterRun.h"

#include "itkLocalThicknessImageFilter.h"

namespace medialvoxel
{
namespace
{

template <typename TPixel>
nlohmann::json
Measure(const ArrayCall & call, const PartOptions & options)
{
  auto filter = itk::LocalThicknessImageFilter<ArrayImage<TPixel>>::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  filter->SetMethod(options.localThicknessMethod);
  const bool mayMeasure =
    options.localThicknessMethod == LocalThicknessMethod::Wall && HasOneThreshold(options, call.header);
  SetGrayMeasure(*filter, call, options, options.subVoxel.value_or(mayMeasure));
  if (options.largestBall)
  {
    filter->SetMaximumThickness(*options.largestBall);
  }
  UseMemory(*filter->GetOutput(), call.outputs.thickness, call.array);
  RunFilter(*filter, call.control);
  KeepPixels(*filter->GetOutput(), call.outputs.thickness);
  return { { "counts",
             { { "object_voxels", filter->GetCounts().objectVoxels },
               { "voxels_at_maximum", filter->GetNumberOfVoxelsAtMaximum() },
               { "voxels_without_wall", filter->GetNumberOfVoxelsWithoutWall() },
               { "not_a_number_voxels", filter->GetCounts().notANumberVoxels } } } };
}

} // namespace

nlohmann::json
MeasureLocalThickness(const ArrayCall & call, const PartOptions & options)
{
  return DispatchPixelType(call.header.pixelType, [&](auto zero) { return Measure<decltype(zero)>(call, options); });
}

} // end namespace medialvoxel
