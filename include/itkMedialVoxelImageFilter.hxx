// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilter_hxx
#define itkMedialVoxelImageFilter_hxx

#include "itkMedialVoxelGridLimits.h"

namespace itk
{

template <typename TInputImage, typename TOutputImage>
std::unique_ptr<MedialVoxelInput>
MedialVoxelImageFilter<TInputImage, TOutputImage>::MakeInput(MedialVoxelValueSource & source)
{
  const MedialVoxelGrid grid = this->GetGrid();
  auto                  input =
    std::make_unique<MedialVoxelObjectInput>(source, grid.GetVoxelBox(), this->GetObjectRule(), this->GetSmoothing());
  if (const auto maximum = this->GetDefaultMaximumThickness(grid))
  {
    input->LookForThickWalls(grid, *maximum);
  }
  return input;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetGenerateVectorDistance(const bool generate)
{
  this->SwitchOutput(m_GenerateVectorDistance, generate, VectorDistanceName);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetGenerateThickness(const bool generate)
{
  this->SwitchOutput(m_GenerateThickness, generate, ThicknessName);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetGenerateUncertainty(const bool generate)
{
  this->SwitchOutput(m_GenerateUncertainty, generate, UncertaintyName);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetGenerateImportance(const bool generate)
{
  this->SwitchOutput(m_GenerateImportance, generate, ImportanceName);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetGenerateImportanceThreshold(const bool generate)
{
  this->SwitchOutput(m_GenerateImportanceThreshold, generate, ImportanceThresholdName);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SwitchOutput(bool & isOn, const bool generate, const char * name)
{
  if (generate == isOn)
  {
    return;
  }
  isOn = generate;
  if (generate)
  {
    this->ProcessObject::SetOutput(name, this->MakeOutput(name));
  }
  else
  {
    this->ProcessObject::RemoveOutput(name);
  }
  this->Modified();
}

template <typename TInputImage, typename TOutputImage>
ProcessObject::DataObjectPointer
MedialVoxelImageFilter<TInputImage, TOutputImage>::MakeOutput(const ProcessObject::DataObjectIdentifierType & name)
{
  if (name == VectorDistanceName)
  {
    return VectorImageType::New().GetPointer();
  }
  if (name == ThicknessName || name == UncertaintyName || name == ImportanceName || name == ImportanceThresholdName)
  {
    return ThicknessImageType::New().GetPointer();
  }
  return Superclass::MakeOutput(name);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  if (m_GenerateUncertainty && !this->GetSubvoxelThickness())
  {
    itkExceptionMacro("GenerateUncertainty is on; SubvoxelThickness must be on for it.");
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  Superclass::GenerateOutputInformation();
  const TInputImage * const input = this->GetInput();
  TOutputImage * const      output = this->GetOutput();
  if (input == nullptr || output == nullptr)
  {
    return;
  }
  const MedialVoxelGrid grid = this->GetGrid();
  this->GetParameters(grid);
  if (const std::string inaccuracy = MedialVoxelGridLimits::FindInaccuracy(grid); !inaccuracy.empty())
  {
    itkWarningMacro(<< "The spacing of the input is unequal: " << inaccuracy << ". Resample it to equal spacing.");
  }
  typename TInputImage::SpacingType::VectorType shift;
  for (unsigned int axis = 0; axis < ImageDimension; ++axis)
  {
    shift[axis] = grid.IsActive(axis) ? 0.5 * input->GetSpacing()[axis] : 0.0;
  }
  output->SetOrigin(input->GetOrigin() + input->GetDirection() * shift);
  if (m_GenerateThickness)
  {
    this->GetThicknessOutput()->SetOrigin(output->GetOrigin());
  }
  if (m_GenerateUncertainty)
  {
    this->GetUncertaintyOutput()->SetOrigin(output->GetOrigin());
  }
  if (m_GenerateImportance)
  {
    this->GetImportanceOutput()->SetOrigin(output->GetOrigin());
  }
  if (m_GenerateImportanceThreshold)
  {
    this->GetImportanceThresholdOutput()->SetOrigin(output->GetOrigin());
  }
}

/** Cells depend on others far away, and the label comes after those around it. */
template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::EnlargeOutputRequestedRegion(DataObject * output)
{
  Superclass::EnlargeOutputRequestedRegion(output);
  if (m_SameTopology)
  {
    output->SetRequestedRegionToLargestPossibleRegion();
  }
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelEngineTask
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetTask(const MedialVoxelGrid & grid) const
{
  MedialVoxelSheetExtraction extraction;
  extraction.parameters = this->GetParameters(grid, this->GetNeededMaximum());
  extraction.findsLevels = m_SameTopology;
  extraction.measuresThickness = m_GenerateThickness || m_GenerateUncertainty;
  extraction.findsImportance = m_GenerateImportance || m_GenerateImportanceThreshold;
  extraction.findsImportanceThreshold = m_GenerateImportanceThreshold;
  if (m_GenerateVectorDistance)
  {
    extraction.vectorBoundary = m_VectorDistanceBoundary;
  }
  if (this->GetSubvoxelThickness())
  {
    extraction.grayRange = this->GetGrayRange();
  }
  for (auto * const observer : m_TileObservers)
  {
    extraction.AddObserver(*observer);
  }
  return extraction;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::TakeTile(const MedialVoxelTileResult & tile)
{
  TOutputImage & labels = *this->GetOutput();
  tile.WriteLabels(this->FirstPixelOf(labels, tile.box), this->StridesOf(labels));
  if (m_Topology)
  {
    m_Topology->TakeTile(tile);
  }
  if (m_GenerateThickness)
  {
    ThicknessImageType & thickness = *this->GetThicknessOutput();
    tile.WriteThickness(this->FirstPixelOf(thickness, tile.box), this->StridesOf(thickness));
  }
  if (m_GenerateUncertainty)
  {
    ThicknessImageType & uncertainty = *this->GetUncertaintyOutput();
    tile.WriteUncertainty(this->FirstPixelOf(uncertainty, tile.box), this->StridesOf(uncertainty));
  }
  if (m_GenerateImportance)
  {
    ThicknessImageType & importance = *this->GetImportanceOutput();
    tile.WriteImportance(this->FirstPixelOf(importance, tile.box), this->StridesOf(importance));
  }
  if (m_GenerateImportanceThreshold)
  {
    ThicknessImageType & threshold = *this->GetImportanceThresholdOutput();
    tile.WriteImportanceThreshold(this->FirstPixelOf(threshold, tile.box), this->StridesOf(threshold));
  }
  if (m_GenerateVectorDistance)
  {
    this->WriteVectors(*this->GetVectorDistanceOutput(), tile);
  }
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelSums
MedialVoxelImageFilter<TInputImage, TOutputImage>::RunRegion(const MedialVoxelBox & region)
{
  if (this->GetSubvoxelThickness())
  {
    this->PrepareScan(this->GetScanLevels());
  }
  m_Topology.reset(); // of an update that was aborted
  if (!m_SameTopology)
  {
    return Superclass::RunRegion(region);
  }
  const MedialVoxelGrid grid = this->GetGrid();
  m_Topology = std::make_unique<MedialVoxelSameTopology>(
    grid, this->GetParameters(grid).maximumPoreSize, [this](const auto & added) { this->LabelAddedCells(added); });
  const MedialVoxelSums sums = Superclass::RunRegion(grid.GetVoxelBox());
  m_NumberOfAddedCells = static_cast<SizeValueType>(m_Topology->GetSums().addedCells);
  m_Topology.reset();
  return sums;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::LabelAddedCells(const MedialVoxelBits & added)
{
  TOutputImage & labels = *this->GetOutput();
  MedialVoxelSameTopology::Label(added, this->FirstPixelOf(labels, added.GetBox()), this->StridesOf(labels));
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "ObjectIsSmoothed: " << (this->GetObjectIsSmoothed() ? "Yes" : "No") << std::endl;
  os << indent << "Roughness: " << this->GetRoughness() << std::endl;
  os << indent << "RaisedMaximumThickness: " << this->GetRaisedMaximumThickness() << std::endl;
  os << indent << "SameTopology: " << (m_SameTopology ? "On" : "Off") << std::endl;
  os << indent << "NumberOfAddedCells: " << m_NumberOfAddedCells << std::endl;
  os << indent << "GenerateVectorDistance: " << (m_GenerateVectorDistance ? "On" : "Off") << std::endl;
  os << indent << "VectorDistanceBoundary: " << m_VectorDistanceBoundary << std::endl;
  os << indent << "GenerateThickness: " << (m_GenerateThickness ? "On" : "Off") << std::endl;
  os << indent << "GenerateUncertainty: " << (m_GenerateUncertainty ? "On" : "Off") << std::endl;
  os << indent << "GenerateImportance: " << (m_GenerateImportance ? "On" : "Off") << std::endl;
  os << indent << "GenerateImportanceThreshold: " << (m_GenerateImportanceThreshold ? "On" : "Off") << std::endl;
  const MedialVoxelScan scan = this->GetScanResult().scan.value_or(MedialVoxelScan{});
  os << indent << "Scan: background " << scan.background << ", material " << scan.material << ", blur " << scan.blur
     << ", noise " << scan.noise << "; " << this->GetScanResult().reason << std::endl;
}

} // end namespace itk

#endif
