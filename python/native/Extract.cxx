// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FilterRun.h"
#include "NamedCounts.h"

#include "itkMedialVoxelObjectsImageFilter.h"

namespace medialvoxel
{
namespace
{

/** States an uncertainty only where it can. */
template <typename TImage>
class ProgramFilter final : public itk::MedialVoxelImageFilter<TImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ProgramFilter);

  using Self = ProgramFilter;
  using Superclass = itk::MedialVoxelImageFilter<TImage>;
  using Pointer = itk::SmartPointer<Self>;

  itkNewMacro(Self);

  /** As the report of the program has it.
   * \param whyOnObject where gray values are not looked at */
  nlohmann::json
  DescribeMeasure(const std::string & whyOnObject) const
  {
    const auto     found = this->GetScan();
    nlohmann::json scan;
    if (found.scan)
    {
      scan = { { "background", found.scan->background },
               { "material", found.scan->material },
               { "blur", found.scan->blur },
               { "noise", found.scan->noise } };
    }
    const bool          isGray = this->GetSubvoxelThickness() && !found.isMask;
    const char * const  on = found.scan ? "fits" : (isGray ? "crossings" : "object");
    const std::string & reason = this->GetSubvoxelThickness() ? found.reason : whyOnObject;
    return { { "on", on }, { "scan", scan }, { "reason", reason } };
  }

protected:
  itk::MedialVoxelEngineTask
  GetTask(const itk::MedialVoxelGrid & grid) const override
  {
    // Tasks are asked for before the scan is known, too: then there is no reason yet.
    const auto found = this->GetScan();
    if (this->GetGenerateUncertainty() && !found.scan && !found.reason.empty())
    {
      Fail(ExitStatus::Refused, "array: the uncertainty of the thickness cannot be stated, as ", found.reason);
    }
    return Superclass::GetTask(grid);
  }

private:
  ProgramFilter() = default;
  ~ProgramFilter() override = default;
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

/** What one object and many have. */
template <typename TFilter>
nlohmann::json
Run(TFilter & filter, const ArrayCall & call)
{
  const MedialVoxelOutputs & outputs = call.outputs;
  filter.SetGenerateThickness(outputs.thickness != nullptr);
  UseMemory(*filter.GetOutput(), outputs.labels, call.array);
  if (outputs.thickness != nullptr)
  {
    UseMemory(*filter.GetThicknessOutput(), outputs.thickness, call.array);
  }
  RunFilter(filter, call.control);
  KeepPixels(*filter.GetOutput(), outputs.labels);
  if (outputs.thickness != nullptr)
  {
    KeepPixels(*filter.GetThicknessOutput(), outputs.thickness);
  }
  return { { "counts", DescribeCounts(filter.GetCounts()) },
           { "smoothed", filter.GetObjectIsSmoothed() },
           { "roughness", filter.GetRoughness() } };
}

template <typename TPixel>
nlohmann::json
ExtractOne(const ArrayCall & call, const ExtractOptions & options)
{
  const MedialVoxelOutputs & outputs = call.outputs;
  auto                       filter = ProgramFilter<ArrayImage<TPixel>>::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  SetWalls(*filter, options);
  const bool measures = outputs.thickness != nullptr || outputs.uncertainty != nullptr;
  SetGrayMeasure(*filter, call, options, measures && MayMeasureOnGrayValues(options, call.header));
  SetLevels(*filter, options);
  filter->SetGenerateUncertainty(outputs.uncertainty != nullptr);
  filter->SetGenerateVectorDistance(outputs.vectors != nullptr);
  filter->SetVectorDistanceBoundary(options.vectorBoundary);
  auto * const vectors = reinterpret_cast<itk::Vector<float, 3> *>(outputs.vectors);
  if (outputs.uncertainty != nullptr)
  {
    UseMemory(*filter->GetUncertaintyOutput(), outputs.uncertainty, call.array);
  }
  if (vectors != nullptr)
  {
    UseMemory(*filter->GetVectorDistanceOutput(), vectors, call.array);
  }
  nlohmann::json numbers = Run(*filter, call);
  if (outputs.uncertainty != nullptr)
  {
    KeepPixels(*filter->GetUncertaintyOutput(), outputs.uncertainty);
  }
  if (vectors != nullptr)
  {
    KeepPixels(*filter->GetVectorDistanceOutput(), vectors);
    ReverseVectors(outputs.vectors, call.array);
  }
  numbers["measure"] =
    filter->DescribeMeasure(measures ? DescribeMeasureOnObject(options, call.header) : "no thickness is asked for");
  return numbers;
}

template <typename TPixel>
nlohmann::json
ExtractObjects(const ArrayCall & call, const ExtractOptions & options)
{
  auto filter = itk::MedialVoxelObjectsImageFilter<ArrayImage<TPixel>>::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  SetWalls(*filter, options);
  if (!options.labels->names.empty())
  {
    Fail(ExitStatus::Usage,
         "array: the label '",
         options.labels->names.front(),
         "' is a name, which an array has none of");
  }
  if (!options.labels->all)
  {
    filter->SetObjectLabels(options.labels->values);
  }
  filter->SetGenerateVectorDistance(call.outputs.vectors != nullptr);
  UseMemory(*filter->GetObjectOutput(), static_cast<TPixel *>(call.outputs.objects), call.array);
  nlohmann::json numbers = Run(*filter, call);
  KeepPixels(*filter->GetObjectOutput(), static_cast<TPixel *>(call.outputs.objects));
  const std::string reason = DescribeMeasureOnObject(options, call.header);
  numbers["measure"] = { { "on", "object" }, { "scan", nullptr }, { "reason", reason } };
  numbers["objects"] = DescribeObjects(*filter);
  numbers["shared_cells"] = filter->GetNumberOfSharedCells();
  return numbers;
}

} // namespace

nlohmann::json
ExtractArray(const ArrayCall & call, const ExtractOptions & options)
{
  CheckFits(call, options);
  return DispatchPixelType(call.header.pixelType, [&](auto zero) {
    return options.labels ? ExtractObjects<decltype(zero)>(call, options) : ExtractOne<decltype(zero)>(call, options);
  });
}

} // end namespace medialvoxel
