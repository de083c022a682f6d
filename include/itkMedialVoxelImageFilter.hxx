// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilter_hxx
#define itkMedialVoxelImageFilter_hxx

#include "itkMedialVoxelGridLimits.h"

#include <cmath>
#include <utility>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetMaximumPoreSize(const SizeValueType numberOfVoxels)
{
  if (!m_HasMaximumPoreSize || m_MaximumPoreSize != numberOfVoxels)
  {
    m_HasMaximumPoreSize = true;
    m_MaximumPoreSize = numberOfVoxels;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetMaximumPoreSize() const
{
  return m_HasMaximumPoreSize
           ? m_MaximumPoreSize
           : static_cast<SizeValueType>(MedialVoxelParameters::GetDefaultMaximumPoreSize(m_ThicknessMode));
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::UnsetMaximumPoreSize()
{
  if (m_HasMaximumPoreSize)
  {
    m_HasMaximumPoreSize = false;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetSmoothing(const SmoothingEnum smoothing)
{
  itkMedialVoxelCheckEnumMacro(Smoothing, smoothing);
  if (!m_HasSmoothing || m_Smoothing != smoothing)
  {
    m_HasSmoothing = true;
    m_Smoothing = smoothing;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetSmoothing() const -> SmoothingEnum
{
  if (m_HasSmoothing)
  {
    return m_Smoothing;
  }
  const bool isAutomatic = m_ThicknessMode == ThicknessModeEnum::Automatic && !m_SeparateObjects;
  return isAutomatic ? SmoothingEnum::Automatic : SmoothingEnum::Off;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::UnsetSmoothing()
{
  if (m_HasSmoothing)
  {
    m_HasSmoothing = false;
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::PrepareSmoothing()
{
  const ModifiedTimeType modifiedTime = this->GetPixelMTime();
  if (m_RoughnessMTime == modifiedTime)
  {
    return;
  }
  m_RoughnessMTime = 0;
  m_SmoothsObject = false;
  m_Roughness = {};
  if (this->GetSmoothing() == SmoothingEnum::Automatic)
  {
    m_Roughness = this->MeasureRoughness();
  }
  m_SmoothsObject = this->GetSmoothing() == SmoothingEnum::On || m_Roughness.NeedsSmoothing();
  m_RoughnessMTime = modifiedTime;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetScanLevels(const double background, const double material)
{
  m_ScanLevels = MedialVoxelScanLevels{ background, material };
  this->Modified();
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::UnsetScanLevels()
{
  m_ScanLevels.reset();
  this->Modified();
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::PrepareScan()
{
  const ModifiedTimeType modifiedTime = this->GetPixelMTime();
  if (!m_SubvoxelThickness || m_ScanMTime == modifiedTime)
  {
    return;
  }
  m_ScanMTime = 0;
  const auto            result = this->SurveyScan(m_ScanLevels);
  const MedialVoxelScan scan = result.scan.value_or(MedialVoxelScan{});
  m_ReasonWithoutScan = result.reason;
  m_IsMask = result.isMask;
  m_BackgroundLevel = scan.background;
  m_MaterialLevel = scan.material;
  m_Blur = scan.blur;
  m_Noise = scan.noise;
  m_NoiseCorrelation = scan.correlation;
  // Made again, for walls that are measured like this.
  this->DropWindow();
  m_ScanMTime = modifiedTime;
}

template <typename TInputImage, typename TOutputImage>
std::optional<MedialVoxelExtraction::GrayRange>
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetGrayRange() const
{
  if (!m_SubvoxelThickness || m_IsMask)
  {
    return std::nullopt;
  }
  MedialVoxelExtraction::GrayRange range{ this->GetLowerThreshold(), this->GetUpperThreshold() };
  if (m_Blur > 0.0)
  {
    range.scan = MedialVoxelScan{ m_BackgroundLevel, m_MaterialLevel, m_Blur, m_Noise, m_NoiseCorrelation };
  }
  return range;
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
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetUncertaintyOutput() -> ThicknessImageType *
{
  return dynamic_cast<ThicknessImageType *>(this->ProcessObject::GetOutput(UncertaintyName));
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetUncertaintyOutput() const -> const ThicknessImageType *
{
  return dynamic_cast<const ThicknessImageType *>(this->ProcessObject::GetOutput(UncertaintyName));
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
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetVectorDistanceOutput() -> VectorImageType *
{
  return dynamic_cast<VectorImageType *>(this->ProcessObject::GetOutput(VectorDistanceName));
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetVectorDistanceOutput() const -> const VectorImageType *
{
  return dynamic_cast<const VectorImageType *>(this->ProcessObject::GetOutput(VectorDistanceName));
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetThicknessOutput() -> ThicknessImageType *
{
  return dynamic_cast<ThicknessImageType *>(this->ProcessObject::GetOutput(ThicknessName));
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetThicknessOutput() const -> const ThicknessImageType *
{
  return dynamic_cast<const ThicknessImageType *>(this->ProcessObject::GetOutput(ThicknessName));
}

template <typename TInputImage, typename TOutputImage>
ProcessObject::DataObjectPointer
MedialVoxelImageFilter<TInputImage, TOutputImage>::MakeOutput(const ProcessObject::DataObjectIdentifierType & name)
{
  if (name == VectorDistanceName)
  {
    return VectorImageType::New().GetPointer();
  }
  if (name == ThicknessName || name == UncertaintyName)
  {
    return ThicknessImageType::New().GetPointer();
  }
  if (name == ObjectsName)
  {
    return ObjectImageType::New().GetPointer();
  }
  return Superclass::MakeOutput(name);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!(m_Thickness > 0.0) || !std::isfinite(m_Thickness))
  {
    itkExceptionMacro("Thickness is " << m_Thickness << "; it must be positive and finite.");
  }
  constexpr double largest = MedialVoxelGridLimits::LargestLength;
  if (!(m_MinimumThickness >= 0.0 && m_MinimumThickness <= largest))
  {
    itkExceptionMacro("MinimumThickness is " << m_MinimumThickness << "; it must be from 0 to " << largest << '.');
  }
  if (!(m_MaximumThickness >= 0.0 && m_MaximumThickness <= largest))
  {
    itkExceptionMacro("MaximumThickness is " << m_MaximumThickness << "; it must be from 0 to " << largest << '.');
  }
  if (this->GetMaximumPoreSize() > MedialVoxelParameters::LargestMaximumPoreSize)
  {
    itkExceptionMacro("MaximumPoreSize is " << this->GetMaximumPoreSize() << "; it must not exceed "
                                            << MedialVoxelParameters::LargestMaximumPoreSize << '.');
  }
  if (m_SeparateObjects)
  {
    this->VerifyObjectLabels();
  }
  if (m_SubvoxelThickness && !this->GetUseThresholds())
  {
    itkExceptionMacro("SubvoxelThickness is on; LowerThreshold or UpperThreshold must be set for it.");
  }
  if (m_GenerateUncertainty && !m_SubvoxelThickness)
  {
    itkExceptionMacro("GenerateUncertainty is on; SubvoxelThickness must be on for it.");
  }
  const std::string problem =
    m_ScanLevels ? m_ScanLevels->FindProblem(this->GetLowerThreshold(), this->GetUpperThreshold()) : "";
  if (!problem.empty())
  {
    itkExceptionMacro("ScanLevels: " << problem << '.');
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
  if (m_SeparateObjects)
  {
    this->GetObjectOutput()->SetOrigin(output->GetOrigin());
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::SetTileObservers(std::vector<MedialVoxelTileObserver *> observers)
{
  m_TileObservers = std::move(observers);
  this->Modified();
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelParameters
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetParameters(const MedialVoxelGrid & grid) const
{
  const auto limits = MedialVoxelParameters::LimitsOfWalls(grid, m_MinimumThickness, m_MaximumThickness);
  if (m_ThicknessMode == ThicknessModeEnum::Automatic && limits.minimum > limits.maximum)
  {
    itkExceptionMacro("MinimumThickness is " << limits.minimum << "; it must not be larger than MaximumThickness, "
                                             << limits.maximum << '.');
  }
  MedialVoxelParameters::Settings settings;
  settings.mode = m_ThicknessMode;
  settings.thickness = m_Thickness;
  settings.minimumThickness = m_MinimumThickness;
  settings.maximumThickness = m_MaximumThickness;
  settings.maximumPoreSize = this->GetMaximumPoreSize();
  settings.bound = m_PseudoGeodesicBound;
  return MedialVoxelParameters::ForSettings(grid, settings);
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelEngineTask
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetTask(const MedialVoxelGrid & grid) const
{
  MedialVoxelExtraction extraction;
  extraction.parameters = this->GetParameters(grid);
  extraction.measuresThickness = m_GenerateThickness || m_GenerateUncertainty;
  if (m_SeparateObjects && m_GenerateThickness)
  {
    // Of a tile, until its cells have their objects.
    extraction.observerBytesPerVoxel += sizeof(float);
  }
  if (m_GenerateVectorDistance)
  {
    extraction.vectorBoundary = m_VectorDistanceBoundary;
  }
  extraction.grayRange = this->GetGrayRange();
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
  if (m_SeparateObjects)
  {
    m_Objects->TakeTile(tile);
    return;
  }
  TOutputImage & labels = *this->GetOutput();
  tile.WriteLabels(this->FirstPixelOf(labels, tile.box), this->StridesOf(labels));
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
  if (m_GenerateVectorDistance)
  {
    this->WriteVectors(*this->GetVectorDistanceOutput(), tile);
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "ThicknessMode: " << m_ThicknessMode << std::endl;
  os << indent << "Thickness: " << m_Thickness << std::endl;
  os << indent << "MinimumThickness: " << m_MinimumThickness << std::endl;
  os << indent << "MaximumThickness: " << m_MaximumThickness << std::endl;
  os << indent << "MaximumPoreSize: " << this->GetMaximumPoreSize() << std::endl;
  os << indent << "Smoothing: " << this->GetSmoothing() << std::endl;
  os << indent << "ObjectIsSmoothed: " << (m_SmoothsObject ? "Yes" : "No") << std::endl;
  os << indent << "Roughness: " << this->GetRoughness() << std::endl;
  os << indent << "PseudoGeodesicBound: " << m_PseudoGeodesicBound << std::endl;
  os << indent << "GenerateVectorDistance: " << (m_GenerateVectorDistance ? "On" : "Off") << std::endl;
  os << indent << "VectorDistanceBoundary: " << m_VectorDistanceBoundary << std::endl;
  os << indent << "GenerateThickness: " << (m_GenerateThickness ? "On" : "Off") << std::endl;
  os << indent << "SubvoxelThickness: " << (m_SubvoxelThickness ? "On" : "Off") << std::endl;
  os << indent << "GenerateUncertainty: " << (m_GenerateUncertainty ? "On" : "Off") << std::endl;
  os << indent << "BackgroundLevel: " << m_BackgroundLevel << std::endl;
  os << indent << "MaterialLevel: " << m_MaterialLevel << std::endl;
  os << indent << "Blur: " << m_Blur << std::endl;
  os << indent << "Noise: " << m_Noise << std::endl;
  os << indent << "ReasonWithoutScan: " << m_ReasonWithoutScan << std::endl;
  os << indent << "SeparateObjects: " << (m_SeparateObjects ? "On" : "Off") << std::endl;
  os << indent << "ObjectLabels:";
  for (const std::int64_t label : m_ObjectLabels)
  {
    os << ' ' << label;
  }
  os << std::endl;
  os << indent << "NumberOfPasses: " << this->GetNumberOfPasses() << std::endl;
  os << indent << "NumberOfSharedCells: " << this->GetNumberOfSharedCells() << std::endl;
  os << indent << "NumberOfObjectVoxels: " << this->GetNumberOfObjectVoxels() << std::endl;
  os << indent << "NumberOfBoundaryVoxels: " << this->GetNumberOfBoundaryVoxels() << std::endl;
  os << indent << "NumberOfFilledVoxels: " << this->GetNumberOfFilledVoxels() << std::endl;
  os << indent << "NumberOfRemovedVoxels: " << this->GetNumberOfRemovedVoxels() << std::endl;
  os << indent << "NumberOfCandidateCells: " << this->GetNumberOfCandidateCells() << std::endl;
  os << indent << "NumberOfTrivialCells: " << this->GetNumberOfTrivialCells() << std::endl;
  os << indent << "NumberOfBoundCells: " << this->GetNumberOfBoundCells() << std::endl;
  os << indent << "NumberOfGeodesicMedialCells: " << this->GetNumberOfGeodesicMedialCells() << std::endl;
  os << indent << "NumberOfGeodesicNonMedialCells: " << this->GetNumberOfGeodesicNonMedialCells() << std::endl;
}

} // end namespace itk

#endif
