// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkVectorDistanceMapImageFilter_hxx
#define itkVectorDistanceMapImageFilter_hxx

#include <chrono>
#include <cmath>

namespace itk
{

template <typename TInputImage, typename TVectorImage>
struct VectorDistanceMapImageFilter<TInputImage, TVectorImage>::TileWorkspace : public Superclass::Workspace
{
  MedialVoxelFeatureTransform::Workspace transform;
  MedialVoxelFeatures                    features;
};

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::SetGenerateDistance(const bool generate)
{
  if (generate == m_GenerateDistance)
  {
    return;
  }
  m_GenerateDistance = generate;
  if (generate)
  {
    this->ProcessObject::SetOutput(DistanceName, this->MakeOutput(DistanceName));
  }
  else
  {
    this->ProcessObject::RemoveOutput(DistanceName);
  }
  this->Modified();
}

template <typename TInputImage, typename TVectorImage>
auto
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::GetDistanceOutput() -> DistanceImageType *
{
  return dynamic_cast<DistanceImageType *>(this->ProcessObject::GetOutput(DistanceName));
}

template <typename TInputImage, typename TVectorImage>
auto
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::GetDistanceOutput() const -> const DistanceImageType *
{
  return dynamic_cast<const DistanceImageType *>(this->ProcessObject::GetOutput(DistanceName));
}

template <typename TInputImage, typename TVectorImage>
ProcessObject::DataObjectPointer
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::MakeOutput(
  const ProcessObject::DataObjectIdentifierType & name)
{
  if (name == DistanceName)
  {
    return DistanceImageType::New().GetPointer();
  }
  return Superclass::MakeOutput(name);
}

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!(m_MaximumDistance > 0.0))
  {
    itkExceptionMacro("MaximumDistance is " << m_MaximumDistance << "; it must be positive.");
  }
}

template <typename TInputImage, typename TVectorImage>
MedialVoxelClusterEngine::Settings
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::GetEngineSettings(const MedialVoxelGrid &) const
{
  return MedialVoxelClusterEngine::Settings::ForDistances(m_Boundary);
}

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::BeforeTiles(const MedialVoxelGrid & grid)
{
  m_Transform = std::make_unique<const MedialVoxelFeatureTransform>(grid, m_Region, m_MaximumDistance);
}

template <typename TInputImage, typename TVectorImage>
auto
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::MakeWorkspace() const
  -> std::unique_ptr<typename Superclass::Workspace>
{
  return std::make_unique<TileWorkspace>();
}

template <typename TInputImage, typename TVectorImage>
MedialVoxelBox
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::ProcessTile(const MedialVoxelBox &           tile,
                                                                     const MedialVoxelClusterWindow & clusterWindow,
                                                                     const MedialVoxelProgress &      progress,
                                                                     typename Superclass::Workspace & genericWorkspace,
                                                                     typename Superclass::TileSums &  sums)
{
  auto &               workspace = static_cast<TileWorkspace &>(genericWorkspace);
  const auto           start = std::chrono::steady_clock::now();
  const MedialVoxelBox missing =
    m_Transform->Compute(clusterWindow.GetWindow(m_Boundary), tile, workspace.transform, workspace.features, &progress);
  sums.distanceSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (missing.IsEmpty() && !progress.IsAborted())
  {
    sums.counts.objectVoxels = clusterWindow.GetObject().Count(tile);
    this->WriteVectors(*this->GetOutput(), tile, workspace.features);
    if (m_GenerateDistance)
    {
      this->WriteDistances(tile, clusterWindow.GetObject(), workspace.features);
    }
  }
  return missing;
}

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::WriteDistances(const MedialVoxelBox &      tile,
                                                                        const MedialVoxelBits &     object,
                                                                        const MedialVoxelFeatures & features)
{
  const MedialVoxelGrid::SpacingType spacing = this->GetGrid().GetSpacing();
  this->ForEachRow(*this->GetDistanceOutput(), tile, [&](float * const target, const MedialVoxelBox & row) {
    const std::size_t                       offset = features.OffsetOf(row.lower[0], row.lower[1], row.lower[2]);
    const MedialVoxelBits::WordType * const words = object.GetRow(row.lower[1], row.lower[2]) - object.GetFirstWord();
    for (std::int64_t i = 0; i < row.Extent(0); ++i)
    {
      const std::size_t at = offset + static_cast<std::size_t>(i);
      if (!features.HasSite(at))
      {
        target[i] = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      const double       x = features.dx[at] * spacing[0];
      const double       y = features.dy[at] * spacing[1];
      const double       z = features.dz[at] * spacing[2];
      const double       squared = (x * x + y * y) + z * z;
      const double       distance = m_SquaredDistance ? squared : std::sqrt(squared);
      const std::int64_t position = row.lower[0] + i;
      const bool         isInside = ((words[position >> 6] >> (position & 63)) & 1u) != 0;
      target[i] = static_cast<float>(isInside == m_InsideIsPositive ? distance : 0.0 - distance);
    }
  });
}

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::AddCounts(const MedialVoxelCounts & counts,
                                                                   const bool                isNewSum)
{
  m_NumberOfObjectVoxels = (isNewSum ? 0 : m_NumberOfObjectVoxels) + static_cast<SizeValueType>(counts.objectVoxels);
}

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Boundary: " << m_Boundary << std::endl;
  os << indent << "Region: " << m_Region << std::endl;
  os << indent << "MaximumDistance: " << m_MaximumDistance << std::endl;
  os << indent << "GenerateDistance: " << (m_GenerateDistance ? "On" : "Off") << std::endl;
  os << indent << "InsideIsPositive: " << (m_InsideIsPositive ? "On" : "Off") << std::endl;
  os << indent << "SquaredDistance: " << (m_SquaredDistance ? "On" : "Off") << std::endl;
  os << indent << "NumberOfObjectVoxels: " << m_NumberOfObjectVoxels << std::endl;
}

} // end namespace itk

#endif
