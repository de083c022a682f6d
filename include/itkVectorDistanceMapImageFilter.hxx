// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkVectorDistanceMapImageFilter_hxx
#define itkVectorDistanceMapImageFilter_hxx

#include <cmath>

namespace itk
{

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
MedialVoxelEngineTask
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::GetTask(const MedialVoxelGrid &) const
{
  return MedialVoxelDistanceMap{ m_Boundary, m_Region, m_MaximumDistance };
}

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::TakeTile(const MedialVoxelTileResult & tile)
{
  this->WriteVectors(*this->GetOutput(), tile.box, *tile.displacements);
  if (m_GenerateDistance)
  {
    this->WriteDistances(tile);
  }
}

template <typename TInputImage, typename TVectorImage>
void
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::WriteDistances(const MedialVoxelTileResult & tile)
{
  const MedialVoxelBits &            object = *tile.object;
  const MedialVoxelFeatures &        features = *tile.displacements;
  const MedialVoxelGrid::SpacingType spacing = this->GetGrid().GetSpacing();
  this->ForEachRow(*this->GetDistanceOutput(), tile.box, [&](float * const target, const MedialVoxelBox & row) {
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
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Boundary: " << m_Boundary << std::endl;
  os << indent << "Region: " << m_Region << std::endl;
  os << indent << "MaximumDistance: " << m_MaximumDistance << std::endl;
  os << indent << "GenerateDistance: " << (m_GenerateDistance ? "On" : "Off") << std::endl;
  os << indent << "InsideIsPositive: " << (m_InsideIsPositive ? "On" : "Off") << std::endl;
  os << indent << "SquaredDistance: " << (m_SquaredDistance ? "On" : "Off") << std::endl;
  os << indent << "NumberOfObjectVoxels: " << this->GetNumberOfObjectVoxels() << std::endl;
}

} // end namespace itk

#endif
