// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FilterRun.h"
#include "NamedCounts.h"

#include "itkMedialVoxelImageFilter.h"

namespace medialvoxel
{
namespace
{

/** Shows the sums, and states an uncertainty only where it can. */
template <typename TImage>
class ProgramFilter final : public itk::MedialVoxelImageFilter<TImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ProgramFilter);

  using Self = ProgramFilter;
  using Superclass = itk::MedialVoxelImageFilter<TImage>;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  using Superclass::GetSums;

  /** As the report of the program has it. */
  nlohmann::json
  DescribeMeasure() const
  {
    const bool     hasScan = this->HasScan();
    nlohmann::json scan;
    if (hasScan)
    {
      scan = { { "background", this->GetBackgroundLevel() },
               { "material", this->GetMaterialLevel() },
               { "blur", this->GetBlur() },
               { "noise", this->GetNoise() } };
    }
    const char * const on = hasScan ? "fits" : (this->GetGrayRange() ? "crossings" : "object");
    return { { "on", on }, { "scan", scan }, { "reason", this->GetReasonWithoutScan() } };
  }

protected:
  itk::MedialVoxelEngineTask
  GetTask(const itk::MedialVoxelGrid & grid) const override
  {
    // Tasks are asked for before the scan is known, too: then there is no reason yet.
    if (this->GetGenerateUncertainty() && !this->HasScan() && !this->GetReasonWithoutScan().empty())
    {
      Fail(ExitStatus::Refused,
           "array: the uncertainty of the thickness cannot be stated, as ",
           this->GetReasonWithoutScan());
    }
    return Superclass::GetTask(grid);
  }

private:
  ProgramFilter() = default;
  ~ProgramFilter() override = default;

  bool
  HasScan() const
  {
    return this->GetBlur() > 0.0;
  }
};

/** \throw JobError when fits are asked for and there is no threshold for them */
void
CheckFits(const ArrayCall & call, const ExtractOptions & options)
{
  const bool isUncertain = call.outputs.uncertainty != nullptr;
  if ((isUncertain || options.levels) && !HasOneThreshold(options, call.header))
  {
    Fail(ExitStatus::Usage,
         isUncertain ? "the uncertainty of the thickness needs" : "levels of gray values need",
         " one threshold, lower or upper, that values of the array reach");
  }
}

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
  using FilterType = ProgramFilter<ArrayImage<TPixel>>;
  const MedialVoxelOutputs & outputs = call.outputs;
  auto                       filter = FilterType::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  SetWalls(*filter, options);
  CheckFits(call, options);
  const bool measures = outputs.thickness != nullptr || outputs.uncertainty != nullptr;
  SetGrayMeasure(*filter, call, options, measures && MayMeasureOnGrayValues(options, call.header));
  SetLevels(*filter, options);
  if (options.labels)
  {
    SetObjects(*filter, *options.labels);
  }
  filter->SetGenerateThickness(outputs.thickness != nullptr);
  filter->SetGenerateUncertainty(outputs.uncertainty != nullptr);
  filter->SetGenerateVectorDistance(outputs.vectors != nullptr);
  filter->SetVectorDistanceBoundary(options.vectorBoundary);
  auto * const vectors = reinterpret_cast<itk::Vector<float, 3> *>(outputs.vectors);
  UseMemory(*filter->GetOutput(), outputs.labels, call.array);
  if (outputs.thickness != nullptr)
  {
    UseMemory(*filter->GetThicknessOutput(), outputs.thickness, call.array);
  }
  if (outputs.uncertainty != nullptr)
  {
    UseMemory(*filter->GetUncertaintyOutput(), outputs.uncertainty, call.array);
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
  if (outputs.uncertainty != nullptr)
  {
    KeepPixels(*filter->GetUncertaintyOutput(), outputs.uncertainty);
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
                          { "measure", filter->DescribeMeasure() },
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
