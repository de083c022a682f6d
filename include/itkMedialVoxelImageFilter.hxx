// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilter_hxx
#define itkMedialVoxelImageFilter_hxx

#include "itkMedialVoxelLimits.h"
#include "itkNumericTraits.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
struct MedialVoxelImageFilter<TInputImage, TOutputImage>::TileWorkspace : public Superclass::Workspace
{
  MedialVoxelFeatureTransform::Workspace transform;
  MedialVoxelFeatures                    features;
  MedialVoxelFeatures                    objectFeatures;
  MedialVoxelClassifier::Workspace       classifier;
  std::vector<std::uint8_t>              labels;
  std::vector<MedialVoxelWall>           walls;
};

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
  if (m_HasMaximumPoreSize)
  {
    return m_MaximumPoreSize;
  }
  return m_ThicknessMode == ThicknessModeEnum::Fixed ? 0 : MedialVoxelParameters::AutomaticMaximumPoreSize;
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
  if (name == ThicknessName)
  {
    return ThicknessImageType::New().GetPointer();
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
  constexpr double largest = MedialVoxelLimits::LargestLength;
  if (!(m_MinimumThickness >= 0.0 && m_MinimumThickness <= largest))
  {
    itkExceptionMacro("MinimumThickness is " << m_MinimumThickness << "; it must be from 0 to " << largest << '.');
  }
  if (!(m_MaximumThickness >= 0.0 && m_MaximumThickness <= largest))
  {
    itkExceptionMacro("MaximumThickness is " << m_MaximumThickness << "; it must be from 0 to " << largest << '.');
  }
  if (this->GetMaximumPoreSize() > MedialVoxelSmallComponents::LargestMaximumSize)
  {
    itkExceptionMacro("MaximumPoreSize is " << this->GetMaximumPoreSize() << "; it must not exceed "
                                            << MedialVoxelSmallComponents::LargestMaximumSize << '.');
  }
  if (m_SubvoxelThickness && !this->GetUseThresholds())
  {
    itkExceptionMacro("SubvoxelThickness is on; LowerThreshold or UpperThreshold must be set for it.");
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
  if (const std::string inaccuracy = MedialVoxelLimits::FindInaccuracy(grid); !inaccuracy.empty())
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
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelClusterEngine::Settings
MedialVoxelImageFilter<TInputImage, TOutputImage>::GetEngineSettings(const MedialVoxelGrid & grid) const
{
  auto settings = MedialVoxelClusterEngine::Settings::ForClassification(
    grid,
    this->GetParameters(grid),
    m_GenerateVectorDistance && m_VectorDistanceBoundary == MedialVoxelBoundary::Object);
  if (this->KeepsRows())
  {
    settings.workerBytesPerVoxel += MedialVoxelTileWallsBytesPerVoxel;
    settings.keepsGray = m_SubvoxelThickness;
  }
  return settings;
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
  auto parameters = m_ThicknessMode == ThicknessModeEnum::Fixed
                      ? MedialVoxelParameters::ForThickness(
                          std::max(m_Thickness, MedialVoxelLimits::LeastThickness(grid)), m_PseudoGeodesicBound)
                      : MedialVoxelParameters::ForWalls(limits.minimum, limits.maximum, m_PseudoGeodesicBound);
  parameters.maximumPoreSize = this->GetMaximumPoreSize();
  return parameters;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::BeforeTiles(const MedialVoxelGrid & grid)
{
  m_Transform = std::make_unique<const MedialVoxelFeatureTransform>(grid);
  m_Classifier = std::make_unique<const MedialVoxelClassifier>(grid, this->GetParameters(grid));
  m_ThicknessKernel = std::make_unique<const MedialVoxelThickness>(grid);
  m_GrayThicknessKernel =
    m_SubvoxelThickness
      ? std::make_unique<const MedialVoxelGrayThickness>(grid, this->GetLowerThreshold(), this->GetUpperThreshold())
      : nullptr;
  if (m_TileObserver != nullptr)
  {
    m_TileObserver->Begin();
  }
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelImageFilter<TInputImage, TOutputImage>::MakeWorkspace() const
  -> std::unique_ptr<typename Superclass::Workspace>
{
  auto workspace = std::make_unique<TileWorkspace>();
  workspace->classifier.keepsRows = this->KeepsRows();
  return workspace;
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelBox
MedialVoxelImageFilter<TInputImage, TOutputImage>::ProcessTile(const MedialVoxelBox &           tile,
                                                               const MedialVoxelClusterWindow & clusterWindow,
                                                               const MedialVoxelProgress &      progress,
                                                               typename Superclass::Workspace & genericWorkspace,
                                                               typename Superclass::TileSums &  sums)
{
  using ClockType = std::chrono::steady_clock;
  using SecondsType = std::chrono::duration<double>;
  auto &     workspace = static_cast<TileWorkspace &>(genericWorkspace);
  const bool withObjectVectors = m_GenerateVectorDistance && m_VectorDistanceBoundary == MedialVoxelBoundary::Object;
  const MedialVoxelWindow window = clusterWindow.GetWindow(MedialVoxelBoundary::Background);

  if (!window.object->Any(m_Classifier->GetCornerBox(tile)))
  {
    this->WriteEmptyTile(tile);
    // Objects of the neighboring tiles have their boundary here.
    sums.counts.boundaryVoxels = window.sites->Count(tile);
    return {};
  }
  const auto     start = ClockType::now();
  MedialVoxelBox missing =
    m_Transform->Compute(window, m_Classifier->GetVoxelBox(tile), workspace.transform, workspace.features, &progress);
  if (missing.IsEmpty() && withObjectVectors)
  {
    const MedialVoxelWindow objectWindow = clusterWindow.GetWindow(MedialVoxelBoundary::Object);
    missing = m_Transform->Compute(objectWindow, tile, workspace.transform, workspace.objectFeatures, &progress);
  }
  const auto middle = ClockType::now();
  sums.distanceSeconds = SecondsType(middle - start).count();
  if (!missing.IsEmpty())
  {
    return missing;
  }

  missing = m_Classifier->Classify(
    window, tile, workspace.features, progress, workspace.classifier, workspace.labels, sums.counts);
  sums.classificationSeconds = SecondsType(ClockType::now() - middle).count();
  if (!missing.IsEmpty() || progress.IsAborted())
  {
    return missing;
  }

  if (this->KeepsRows())
  {
    missing = this->MeasureWalls(clusterWindow, workspace);
    if (!missing.IsEmpty())
    {
      return missing;
    }
  }
  if (m_TileObserver != nullptr)
  {
    missing = m_TileObserver->Observe({ tile,
                                        window,
                                        workspace.features,
                                        *m_Classifier,
                                        workspace.classifier.rows,
                                        workspace.walls,
                                        workspace.classifier.geodesic,
                                        progress,
                                        clusterWindow.GetGray() });
    if (!missing.IsEmpty())
    {
      return missing;
    }
  }
  this->WriteLabels(tile, workspace.labels);
  if (m_GenerateThickness)
  {
    this->WriteThickness(tile, workspace);
  }
  if (m_GenerateVectorDistance)
  {
    this->WriteVectors(
      *this->GetVectorDistanceOutput(), tile, withObjectVectors ? workspace.objectFeatures : workspace.features);
  }
  sums.counts.objectVoxels = window.object->Count(tile);
  sums.counts.boundaryVoxels = window.sites->Count(tile);
  return {};
}

/** A tile without object: what most tiles of a thin part are. */
template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::WriteEmptyTile(const MedialVoxelBox & tile)
{
  this->ClearTile(*this->GetOutput(), tile);
  if (m_GenerateVectorDistance)
  {
    this->ClearTile(*this->GetVectorDistanceOutput(), tile);
  }
  if (m_GenerateThickness)
  {
    this->ClearTile(*this->GetThicknessOutput(), tile);
  }
}

template <typename TInputImage, typename TOutputImage>
template <typename TImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::ClearTile(TImage & image, const MedialVoxelBox & tile) const
{
  using PixelType = typename TImage::PixelType;
  this->ForEachRow(image, tile, [](PixelType * const target, const MedialVoxelBox & row) {
    std::fill_n(target, row.Extent(0), NumericTraits<PixelType>::ZeroValue());
  });
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::WriteLabels(const MedialVoxelBox &            tile,
                                                               const std::vector<std::uint8_t> & labels)
{
  const std::uint8_t * source = labels.data();
  this->ForEachRow(*this->GetOutput(), tile, [&](OutputPixelType * target, const MedialVoxelBox & row) {
    std::transform(source, source + row.Extent(0), target, [](const std::uint8_t label) {
      return static_cast<OutputPixelType>(label);
    });
    source += row.Extent(0);
  });
}

/** All medial cells for the output, otherwise those that the observer selects. */
template <typename TInputImage, typename TOutputImage>
MedialVoxelBox
MedialVoxelImageFilter<TInputImage, TOutputImage>::MeasureWalls(const MedialVoxelClusterWindow & clusterWindow,
                                                                TileWorkspace &                  workspace) const
{
  const MedialVoxelWindow window = clusterWindow.GetWindow(MedialVoxelBoundary::Background);
  auto &                  rows = workspace.classifier.rows;
  for (MedialVoxelCellRow & row : rows)
  {
    const MedialVoxelBits::WordType medial = row.byBound | row.byGeodesic;
    row.measured = m_GenerateThickness || medial == 0 ? medial : medial & m_TileObserver->SelectCells(row);
  }
  MedialVoxelMeasureWalls(*m_ThicknessKernel, *m_Classifier, window, workspace.features, rows, workspace.walls);
  return m_GrayThicknessKernel == nullptr ? MedialVoxelBox{}
                                          : MedialVoxelRefineWalls(*m_GrayThicknessKernel,
                                                                   *m_Classifier,
                                                                   clusterWindow.GetGray(),
                                                                   workspace.features,
                                                                   rows,
                                                                   workspace.walls);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::WriteThickness(const MedialVoxelBox & tile,
                                                                  const TileWorkspace &  workspace)
{
  ThicknessImageType & image = *this->GetThicknessOutput();
  this->ClearTile(image, tile);
  float * const                 first = image.GetBufferPointer() + image.ComputeOffset(this->RegionOf(tile).GetIndex());
  const OffsetValueType * const strides = image.GetOffsetTable();
  MedialVoxelForEachWall(
    workspace.classifier.rows, workspace.walls, [&](const MedialVoxelIndex & cell, const MedialVoxelWall & wall) {
      OffsetValueType offset = 0;
      for (unsigned int axis = 0; axis < ImageDimension; ++axis)
      {
        offset += (cell[axis] - tile.lower[axis]) * strides[axis];
      }
      first[offset] = wall.GetMarkedThickness();
    });
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelImageFilter<TInputImage, TOutputImage>::AddCounts(const MedialVoxelCounts & counts, const bool isNewSum)
{
  const auto add = [isNewSum](SizeValueType & sum, const std::uint64_t count) {
    sum = (isNewSum ? 0 : sum) + static_cast<SizeValueType>(count);
  };
  add(m_NumberOfObjectVoxels, counts.objectVoxels);
  add(m_NumberOfBoundaryVoxels, counts.boundaryVoxels);
  add(m_NumberOfFilledVoxels, counts.filledVoxels);
  add(m_NumberOfRemovedVoxels, counts.removedVoxels);
  add(m_NumberOfCandidateCells, counts.candidateCells);
  add(m_NumberOfTrivialCells, counts.trivialCells);
  add(m_NumberOfBoundCells, counts.boundCells);
  add(m_NumberOfGeodesicMedialCells, counts.geodesicMedialCells);
  add(m_NumberOfGeodesicNonMedialCells, counts.geodesicNonMedialCells);
  if (m_TileObserver != nullptr)
  {
    m_TileObserver->Commit();
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
  os << indent << "PseudoGeodesicBound: " << m_PseudoGeodesicBound << std::endl;
  os << indent << "GenerateVectorDistance: " << (m_GenerateVectorDistance ? "On" : "Off") << std::endl;
  os << indent << "VectorDistanceBoundary: " << m_VectorDistanceBoundary << std::endl;
  os << indent << "GenerateThickness: " << (m_GenerateThickness ? "On" : "Off") << std::endl;
  os << indent << "SubvoxelThickness: " << (m_SubvoxelThickness ? "On" : "Off") << std::endl;
  os << indent << "NumberOfObjectVoxels: " << m_NumberOfObjectVoxels << std::endl;
  os << indent << "NumberOfBoundaryVoxels: " << m_NumberOfBoundaryVoxels << std::endl;
  os << indent << "NumberOfFilledVoxels: " << m_NumberOfFilledVoxels << std::endl;
  os << indent << "NumberOfRemovedVoxels: " << m_NumberOfRemovedVoxels << std::endl;
  os << indent << "NumberOfCandidateCells: " << m_NumberOfCandidateCells << std::endl;
  os << indent << "NumberOfTrivialCells: " << m_NumberOfTrivialCells << std::endl;
  os << indent << "NumberOfBoundCells: " << m_NumberOfBoundCells << std::endl;
  os << indent << "NumberOfGeodesicMedialCells: " << m_NumberOfGeodesicMedialCells << std::endl;
  os << indent << "NumberOfGeodesicNonMedialCells: " << m_NumberOfGeodesicNonMedialCells << std::endl;
}

} // end namespace itk

#endif
