// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkLocalThicknessImageFilter_hxx
#define itkLocalThicknessImageFilter_hxx

#include <cmath>

namespace itk
{

template <typename TInputImage>
void
LocalThicknessImageFilter<TInputImage>::SetLargestBall(const double thickness)
{
  if (!(thickness > 0.0) || !std::isfinite(thickness))
  {
    itkExceptionMacro("LargestBall is " << thickness << "; it must be positive and finite.");
  }
  if (thickness != m_LargestBall)
  {
    m_LargestBall = thickness;
    this->Modified();
  }
}

template <typename TInputImage>
void
LocalThicknessImageFilter<TInputImage>::UnsetLargestBall()
{
  if (m_LargestBall != 0.0)
  {
    m_LargestBall = 0.0;
    this->Modified();
  }
}

template <typename TInputImage>
std::unique_ptr<MedialVoxelInput>
LocalThicknessImageFilter<TInputImage>::MakeInput(MedialVoxelValueSource & source)
{
  auto input = Superclass::MakeInput(source);
  if (m_Method == MethodEnum::Wall)
  {
    const MedialVoxelGrid grid = this->GetGrid();
    const double          maximum = MedialVoxelParameters::LimitsOfWalls(grid, 0.0, 0.0).maximum;
    static_cast<MedialVoxelObjectInput &>(*input).LookForThickWalls(grid, maximum);
  }
  return input;
}

template <typename TInputImage>
MedialVoxelEngineTask
LocalThicknessImageFilter<TInputImage>::GetTask(const MedialVoxelGrid & grid) const
{
  const double largest = MedialVoxelLocalThickness::GetLargestMaximum(grid);
  if (m_LargestBall > largest)
  {
    itkExceptionMacro("LargestBall is " << m_LargestBall << "; it must be at most "
                                        << MedialVoxelLocalThickness::MostVoxels << " voxels, which is " << largest
                                        << " here.");
  }
  MedialVoxelLocalThickness task;
  task.maximumThickness = m_LargestBall > 0.0 ? m_LargestBall : MedialVoxelLocalThickness::GetDefaultMaximum(grid);
  if (m_Method == MethodEnum::Wall)
  {
    MedialVoxelParameters::Settings settings;
    settings.mode = MedialVoxelThicknessMode::Automatic;
    settings.maximumThickness = this->GetNeededMaximum().value_or(0.0);
    settings.maximumPoreSize = 0;
    task.walls.emplace();
    task.walls->parameters = MedialVoxelParameters::ForSettings(grid, settings);
    if (m_SubvoxelThickness)
    {
      task.walls->grayRange = this->GetGrayRange();
    }
  }
  return task;
}

template <typename TInputImage>
void
LocalThicknessImageFilter<TInputImage>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  if (m_SubvoxelThickness && m_Method == MethodEnum::Sphere)
  {
    itkExceptionMacro("SubvoxelThickness is on; it has no effect with the Method Sphere.");
  }
  if (m_SubvoxelThickness && !this->GetUseThresholds())
  {
    itkExceptionMacro("SubvoxelThickness is on; LowerThreshold or UpperThreshold must be set for it.");
  }
}

template <typename TInputImage>
MedialVoxelSums
LocalThicknessImageFilter<TInputImage>::RunRegion(const MedialVoxelBox & region)
{
  if (m_SubvoxelThickness)
  {
    this->PrepareScan({});
  }
  return Superclass::RunRegion(region);
}

template <typename TInputImage>
void
LocalThicknessImageFilter<TInputImage>::TakeTile(const MedialVoxelTileResult & tile)
{
  OutputImageType & output = *this->GetOutput();
  tile.WriteLocalThickness(this->FirstPixelOf(output, tile.box), this->StridesOf(output));
}

template <typename TInputImage>
void
LocalThicknessImageFilter<TInputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << m_Method << std::endl;
  os << indent << "SubvoxelThickness: " << (m_SubvoxelThickness ? "On" : "Off") << std::endl;
  os << indent << "LargestBall: " << m_LargestBall << std::endl;
  os << indent << "NumberOfVoxelsAtMaximum: " << this->GetNumberOfVoxelsAtMaximum() << std::endl;
  os << indent << "NumberOfVoxelsWithoutWall: " << this->GetNumberOfVoxelsWithoutWall() << std::endl;
}

} // end namespace itk

#endif
