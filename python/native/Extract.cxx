// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FilterRun.h"
#include "NamedCounts.h"

#include "itkMedialVoxelImageFilter.h"

namespace medialvoxel
{
namespace
{

/** Shows the sums. */
template <typename TImage>
class CountingFilter final : public itk::MedialVoxelImageFilter<TImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(CountingFilter);

  using Self = CountingFilter;
  using Superclass = itk::MedialVoxelImageFilter<TImage>;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  using Superclass::GetSums;

private:
  CountingFilter() = default;
  ~CountingFilter() override = default;
};

nlohmann::json
DescribeCounts(const itk::MedialVoxelCounts & counts)
{
  nlohmann::json json;
  for (const NamedCount & count : NamedCounts)
  {
    json[count.name] = counts.*count.member;
  }
  json["medial_cells"] = counts.boundCells + counts.geodesicMedialCells;
  return json;
}

/** Of each object of a label map. */
template <typename TFilter>
nlohmann::json
DescribeObjects(const TFilter & filter)
{
  nlohmann::json objects = nlohmann::json::array();
  for (const std::int64_t label : filter.GetFoundLabels())
  {
    objects.push_back({ { "label", label },
                        { "voxels", filter.GetNumberOfVoxelsWithLabel(label) },
                        { "candidate_cells", filter.GetNumberOfCandidateCellsWithLabel(label) },
                        { "medial_cells", filter.GetNumberOfMedialCellsWithLabel(label) } });
  }
  return objects;
}

template <typename TFilter>
void
SetObjects(TFilter & filter, const LabelSelection & labels)
{
  if (!labels.names.empty())
  {
    Fail(ExitStatus::Usage, "array: the label '", labels.names.front(), "' is a name, which an array has none of");
  }
  filter.SetSeparateObjects(true);
  if (!labels.all)
  {
    filter.SetObjectLabels(labels.values);
  }
}

template <typename TPixel>
nlohmann::json
Extract(const ArrayCall & call, const ExtractOptions & options)
{
  using FilterType = CountingFilter<ArrayImage<TPixel>>;
  const MedialVoxelOutputs & outputs = call.outputs;
  auto                       filter = FilterType::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  SetWalls(*filter, options);
  if (options.labels)
  {
    SetObjects(*filter, *options.labels);
  }
  filter->SetGenerateThickness(outputs.thickness != nullptr);
  filter->SetGenerateVectorDistance(outputs.vectors != nullptr);
  filter->SetVectorDistanceBoundary(options.vectorBoundary);
  auto * const vectors = reinterpret_cast<itk::Vector<float, 3> *>(outputs.vectors);
  UseMemory(*filter->GetOutput(), outputs.labels, call.array);
  if (outputs.thickness != nullptr)
  {
    UseMemory(*filter->GetThicknessOutput(), outputs.thickness, call.array);
  }
  if (vectors != nullptr)
  {
    UseMemory(*filter->GetVectorDistanceOutput(), vectors, call.array);
  }
  if (options.labels)
  {
    UseMemory(*filter->GetObjectOutput(), static_cast<TPixel *>(outputs.objects), call.array);
  }
  RunFilter(*filter, call.control);
  KeepPixels(*filter->GetOutput(), outputs.labels);
  if (outputs.thickness != nullptr)
  {
    KeepPixels(*filter->GetThicknessOutput(), outputs.thickness);
  }
  if (vectors != nullptr)
  {
    KeepPixels(*filter->GetVectorDistanceOutput(), vectors);
    ReverseVectors(outputs.vectors, call.array);
  }
  if (options.labels)
  {
    KeepPixels(*filter->GetObjectOutput(), static_cast<TPixel *>(outputs.objects));
  }
  nlohmann::json numbers{ { "counts", DescribeCounts(filter->GetSums().counts) },
                          { "smoothed", filter->GetObjectIsSmoothed() },
                          { "roughness", filter->GetRoughness() } };
  if (options.labels)
  {
    numbers["objects"] = DescribeObjects(*filter);
    numbers["shared_cells"] = filter->GetNumberOfSharedCells();
  }
  return numbers;
}

} // namespace

nlohmann::json
ExtractArray(const ArrayCall & call, const ExtractOptions & options)
{
  return DispatchPixelType(call.header.pixelType, [&](auto zero) { return Extract<decltype(zero)>(call, options); });
}

} // end namespace medialvoxel
