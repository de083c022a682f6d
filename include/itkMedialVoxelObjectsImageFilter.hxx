// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectsImageFilter_hxx
#define itkMedialVoxelObjectsImageFilter_hxx

#include <algorithm>
#include <optional>
#include <variant>
#include <vector>

namespace itk
{

/** The results of the passes over the objects of the input. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::Objects
{
public:
  Objects(Self & filter, MedialVoxelLabelInput & map)
    : m_Filter(filter)
    , m_Map(map)
    , m_Union(map, filter.GetGrid().GetSize(), filter.GetMaximumPoreSize())
  {}

  /** Fills the outputs, which are allocated. */
  MedialVoxelSums
  Run(const MedialVoxelBox & region)
  {
    m_Union.CompleteTopology(m_Filter.GetSameTopology() ? std::make_optional(m_Filter.GetGrid()) : std::nullopt);
    m_Union.Begin(region, this->MakeValues());
    MedialVoxelSums    sums;
    const unsigned int passes = m_Map.GetNumberOfPasses();
    for (unsigned int pass = 0; pass < passes; ++pass)
    {
      m_Map.ShowPass(pass);
      sums += m_Filter.RunEngine(region, pass, passes);
      m_Union.FinishPass();
      if (passes > 1)
      {
        m_Filter.DropWindow();
      }
    }
    m_Union.Finish();
    this->WriteOutputs();
    return sums;
  }

  void
  KeepSums(const bool isNew)
  {
    m_Total = isNew ? MedialVoxelObjectUnion::Sums{} : m_Total;
    m_Total += m_Union.GetSums();
  }

  MedialVoxelObjectUnion &
  GetUnion()
  {
    return m_Union;
  }

  const MedialVoxelObjectMap &
  GetMap() const
  {
    return m_Map;
  }

  const MedialVoxelObjectUnion::Sums &
  GetTotal() const
  {
    return m_Total;
  }

private:
  std::vector<MedialVoxelObjectUnion::Values>
  MakeValues() const
  {
    if (!m_Filter.GetGenerateThickness())
    {
      return {};
    }
    m_Filter.GetThicknessOutput()->FillBuffer(0.0f);
    MedialVoxelObjectUnion::Values thickness;
    thickness.first = reinterpret_cast<std::byte *>(m_Filter.GetThicknessOutput()->GetBufferPointer());
    thickness.bytesPerVoxel = sizeof(float);
    thickness.write = [](const MedialVoxelTileResult & tile, void * const first, const MedialVoxelStrides & strides) {
      tile.WriteThickness(static_cast<float *>(first), strides);
    };
    return { thickness };
  }

  void
  WriteOutputs() const
  {
    const auto & labels = m_Union.GetLabels();
    const auto & objects = m_Union.GetObjects();
    const auto   valueOf = [this](const MedialVoxelObjectNumber object) {
      return object > 0 ? static_cast<InputPixelType>(m_Map.GetTable().GetValue(object)) : InputPixelType{};
    };
    std::copy(labels.begin(), labels.end(), m_Filter.GetOutput()->GetBufferPointer());
    std::transform(objects.begin(), objects.end(), m_Filter.GetObjectOutput()->GetBufferPointer(), valueOf);
  }

  Self &                       m_Filter;
  MedialVoxelLabelInput &      m_Map;
  MedialVoxelObjectUnion       m_Union;
  MedialVoxelObjectUnion::Sums m_Total;
};

template <typename TInputImage, typename TOutputImage>
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::MedialVoxelObjectsImageFilter()
{
  this->SetSmoothing(SmoothingEnum::Off);
  this->ProcessObject::SetOutput(ObjectsName, this->MakeOutput(ObjectsName));
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::~MedialVoxelObjectsImageFilter() = default;

template <typename TInputImage, typename TOutputImage>
ProcessObject::DataObjectPointer
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::MakeOutput(
  const ProcessObject::DataObjectIdentifierType & name)
{
  if (name == ObjectsName)
  {
    return ObjectImageType::New().GetPointer();
  }
  return Superclass::MakeOutput(name);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::SetObjectLabels(const ObjectLabelsType & labels)
{
  ObjectLabelsType sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted != m_ObjectLabels)
  {
    m_ObjectLabels = std::move(sorted);
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetFoundLabels() const -> ObjectLabelsType
{
  return m_Objects ? m_Objects->GetMap().GetTable().GetValues() : ObjectLabelsType{};
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfPasses() const
{
  return m_Objects ? m_Objects->GetMap().GetNumberOfPasses() : 0;
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfSharedCells() const
{
  return m_Objects ? m_Objects->GetTotal().shared : 0;
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfVoxelsWithLabel(const std::int64_t label) const
{
  return static_cast<SizeValueType>(m_Objects->GetMap().GetObjectVoxels()[this->FindObjectNumber(label)]);
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelObjectUnion::Cells
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::FindCells(const std::int64_t label) const
{
  const MedialVoxelObjectNumber object = this->FindObjectNumber(label);
  const auto                    found = m_Objects->GetTotal().cells.find(object);
  return found == m_Objects->GetTotal().cells.end() ? MedialVoxelObjectUnion::Cells{} : found->second;
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfCandidateCellsWithLabel(
  const std::int64_t label) const
{
  return static_cast<SizeValueType>(this->FindCells(label).candidate);
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfMedialCellsWithLabel(
  const std::int64_t label) const
{
  return static_cast<SizeValueType>(this->FindCells(label).medial);
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfAddedCellsWithLabel(const std::int64_t label) const
{
  return static_cast<SizeValueType>(this->FindCells(label).added);
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelObjectNumber
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::FindObjectNumber(const std::int64_t label) const
{
  const MedialVoxelObjectNumber number =
    m_Objects ? m_Objects->GetMap().GetTable().GetNumber(label) : MedialVoxelObjectNumber{};
  if (number == 0)
  {
    itkExceptionMacro("The last update found no object with the label " << label << '.');
  }
  return number;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  if (this->GetUseThresholds() || this->GetUseObjectValue() || this->GetBackgroundValue() != InputPixelType{})
  {
    itkExceptionMacro("Each value but 0 is an object: LowerThreshold, UpperThreshold, ObjectValue and BackgroundValue "
                      "must not be set.");
  }
  if (this->GetSmoothing() != SmoothingEnum::Off)
  {
    itkExceptionMacro("The objects of a label map are not smoothed; Smoothing must be Off.");
  }
  if (this->GetGenerateVectorDistance() || this->GetGenerateImportance() || this->GetGenerateImportanceThreshold())
  {
    itkExceptionMacro("Vectors and importance are for one object; set ObjectValue of MedialVoxelImageFilter instead.");
  }
  for (const std::int64_t label : m_ObjectLabels)
  {
    if (label == 0 || MedialVoxelToLabel(static_cast<InputPixelType>(label)) != label)
    {
      using PrintType = typename NumericTraits<InputPixelType>::PrintType;
      itkExceptionMacro("ObjectLabels has "
                        << label << "; labels are values of the pixel type other than 0, from "
                        << static_cast<PrintType>(std::numeric_limits<InputPixelType>::lowest()) << " to "
                        << static_cast<PrintType>(std::numeric_limits<InputPixelType>::max()) << '.');
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  Superclass::GenerateOutputInformation();
  this->GetObjectOutput()->SetOrigin(this->GetOutput()->GetOrigin());
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelEngineTask
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetTask(const MedialVoxelGrid & grid) const
{
  auto task = Superclass::GetTask(grid);
  if (this->GetGenerateThickness())
  {
    // Of a tile, until its cells have their objects.
    std::get<MedialVoxelSheetExtraction>(task).observerBytesPerVoxel += sizeof(float);
  }
  return task;
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelSums
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::RunRegion(const MedialVoxelBox & region)
{
  this->PrepareObjects();
  return m_Objects->Run(region);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::TakeTile(const MedialVoxelTileResult & tile)
{
  m_Objects->GetUnion().TakeTile(tile);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::KeepSums(const bool isNew)
{
  m_Objects->KeepSums(isNew);
  this->m_NumberOfAddedCells = static_cast<SizeValueType>(m_Objects->GetTotal().topology.addedCells);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "ObjectLabels:";
  for (const std::int64_t label : m_ObjectLabels)
  {
    os << ' ' << label;
  }
  os << std::endl;
  os << indent << "NumberOfPasses: " << this->GetNumberOfPasses() << std::endl;
  os << indent << "NumberOfSharedCells: " << this->GetNumberOfSharedCells() << std::endl;
}

template <typename TInputImage, typename TOutputImage>
std::unique_ptr<MedialVoxelInput>
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::MakeInput(MedialVoxelValueSource & source)
{
  m_Objects.reset();
  return std::make_unique<MedialVoxelLabelInput>(
    source, this->GetGrid().GetVoxelBox(), m_ObjectLabels, this->GetMaximumPoreSize());
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::PrepareObjects()
{
  try
  {
    auto & map = static_cast<MedialVoxelLabelInput &>(this->PrepareInput());
    if (!map.GetMissingLabels().empty())
    {
      itkGenericExceptionMacro("No voxel of the input has the label " << map.GetMissingLabels().front()
                                                                      << " of ObjectLabels.");
    }
    if (!m_Objects)
    {
      m_Objects = std::make_unique<Objects>(*this, map);
    }
  }
  catch (const MedialVoxelLabelError & error)
  {
    itkGenericExceptionMacro("The input is not a label map: " << error.what() << '.');
  }
}

} // end namespace itk

#endif
