// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkVectorDistanceMapImageFilter_hxx
#define itkVectorDistanceMapImageFilter_hxx

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
VectorDistanceMapImageFilter<TInputImage, TVectorImage>::VerifyPreconditions() const
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
  this->WriteVectors(*this->GetOutput(), tile);
  if (m_GenerateDistance)
  {
    DistanceImageType & distance = *this->GetDistanceOutput();
    tile.WriteDistances({ this->GetGrid().GetSpacing(), m_SquaredDistance, m_InsideIsPositive },
                        this->FirstPixelOf(distance, tile.box),
                        this->StridesOf(distance));
  }
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
}

} // end namespace itk

#endif
