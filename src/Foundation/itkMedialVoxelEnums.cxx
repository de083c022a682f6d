// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEnums.h"

namespace itk
{

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::PseudoGeodesicBound value)
{
  switch (value)
  {
    case MedialVoxelEnums::PseudoGeodesicBound::FreeSpace:
      return out << "itk::MedialVoxelEnums::PseudoGeodesicBound::FreeSpace";
    case MedialVoxelEnums::PseudoGeodesicBound::Paper:
      return out << "itk::MedialVoxelEnums::PseudoGeodesicBound::Paper";
    case MedialVoxelEnums::PseudoGeodesicBound::Off:
      return out << "itk::MedialVoxelEnums::PseudoGeodesicBound::Off";
  }
  return out << "INVALID VALUE FOR itk::MedialVoxelEnums::PseudoGeodesicBound";
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::Boundary value)
{
  switch (value)
  {
    case MedialVoxelEnums::Boundary::Object:
      return out << "itk::MedialVoxelEnums::Boundary::Object";
    case MedialVoxelEnums::Boundary::Background:
      return out << "itk::MedialVoxelEnums::Boundary::Background";
  }
  return out << "INVALID VALUE FOR itk::MedialVoxelEnums::Boundary";
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::Region value)
{
  switch (value)
  {
    case MedialVoxelEnums::Region::Inside:
      return out << "itk::MedialVoxelEnums::Region::Inside";
    case MedialVoxelEnums::Region::Outside:
      return out << "itk::MedialVoxelEnums::Region::Outside";
    case MedialVoxelEnums::Region::Both:
      return out << "itk::MedialVoxelEnums::Region::Both";
  }
  return out << "INVALID VALUE FOR itk::MedialVoxelEnums::Region";
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::ThicknessMode value)
{
  switch (value)
  {
    case MedialVoxelEnums::ThicknessMode::Fixed:
      return out << "itk::MedialVoxelEnums::ThicknessMode::Fixed";
    case MedialVoxelEnums::ThicknessMode::Automatic:
      return out << "itk::MedialVoxelEnums::ThicknessMode::Automatic";
  }
  return out << "INVALID VALUE FOR itk::MedialVoxelEnums::ThicknessMode";
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelEnums::Smoothing value)
{
  switch (value)
  {
    case MedialVoxelEnums::Smoothing::Off:
      return out << "itk::MedialVoxelEnums::Smoothing::Off";
    case MedialVoxelEnums::Smoothing::On:
      return out << "itk::MedialVoxelEnums::Smoothing::On";
    case MedialVoxelEnums::Smoothing::Automatic:
      return out << "itk::MedialVoxelEnums::Smoothing::Automatic";
  }
  return out << "INVALID VALUE FOR itk::MedialVoxelEnums::Smoothing";
}

} // end namespace itk
