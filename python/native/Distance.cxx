// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FilterRun.h"

#include "itkVectorDistanceMapImageFilter.h"

namespace medialvoxel
{
namespace
{

template <typename TPixel>
nlohmann::json
Measure(const ArrayCall & call, const DistanceOptions & options)
{
  const MedialVoxelOutputs & outputs = call.outputs;
  auto * const               vectors = reinterpret_cast<itk::Vector<float, 3> *>(outputs.vectors);
  auto                       filter = itk::VectorDistanceMapImageFilter<ArrayImage<TPixel>>::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  filter->SetBoundary(options.boundary);
  filter->SetRegion(options.region);
  filter->SetMaximumDistance(options.maximumDistance.value_or(filter->GetMaximumDistance()));
  filter->SetGenerateDistance(true);
  UseMemory(*filter->GetOutput(), vectors, call.array);
  UseMemory(*filter->GetDistanceOutput(), outputs.distance, call.array);
  RunFilter(*filter, call.control);
  KeepPixels(*filter->GetOutput(), vectors);
  KeepPixels(*filter->GetDistanceOutput(), outputs.distance);
  ReverseVectors(outputs.vectors, call.array);
  return { { "counts",
             { { "object_voxels", filter->GetCounts().objectVoxels },
               { "not_a_number_voxels", filter->GetCounts().notANumberVoxels } } } };
}

} // namespace

nlohmann::json
MeasureDistances(const ArrayCall & call, const DistanceOptions & options)
{
  return DispatchPixelType(call.header.pixelType, [&](auto zero) { return Measure<decltype(zero)>(call, options); });
}

} // end namespace medialvoxel
