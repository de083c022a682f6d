// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Setters of enumerations take enumerators alone: other languages give them any number.

#include "itkMedialSurfaceMeshFilter.h"
#include "itkMedialVoxelImageFilter.h"
#include "itkVectorDistanceMapImageFilter.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
using Image = itk::Image<short, 3>;

/** Sets \a value, which is none, after \a valid, which stays. */
template <typename TFilter, typename TEnum>
void
ExpectRefused(void (TFilter::*set)(TEnum),
              TEnum (TFilter::*get)() const,
              const TEnum         valid,
              const unsigned int  value,
              const std::string & message)
{
  auto filter = TFilter::New();
  (filter->*set)(valid);
  const itk::ModifiedTimeType before = filter->GetMTime();
  try
  {
    (filter->*set)(static_cast<TEnum>(value));
    FAIL() << "no exception for " << value;
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find(message), std::string::npos) << error.GetDescription();
  }
  EXPECT_EQ((filter.GetPointer()->*get)(), valid);
  EXPECT_EQ(filter->GetMTime(), before);
}

const std::string OfModes = "; it must be 0 (Fixed) or 1 (Automatic).";
const std::string OfSmoothings = "; it must be 0 (Off), 1 (On) or 2 (Automatic).";
const std::string OfBounds = "; it must be 0 (FreeSpace), 1 (Paper) or 2 (Off).";
const std::string OfBoundaries = "; it must be 0 (Object) or 1 (Background).";
const std::string OfRegions = "; it must be 0 (Inside), 1 (Outside) or 2 (Both).";
} // namespace

TEST(MedialVoxelEnums, SettersOfLabelsRefuseOtherNumbers)
{
  using Filter = itk::MedialVoxelImageFilter<Image>;
  using Enums = itk::MedialVoxelEnums;
  for (const unsigned int value : { 3u, 99u, 255u })
  {
    const std::string text = " is " + std::to_string(value);
    ExpectRefused<Filter, Enums::ThicknessMode>(&Filter::SetThicknessMode,
                                                &Filter::GetThicknessMode,
                                                Enums::ThicknessMode::Automatic,
                                                value,
                                                "ThicknessMode" + text + OfModes);
    ExpectRefused<Filter, Enums::Smoothing>(
      &Filter::SetSmoothing, &Filter::GetSmoothing, Enums::Smoothing::On, value, "Smoothing" + text + OfSmoothings);
    ExpectRefused<Filter, Enums::PseudoGeodesicBound>(&Filter::SetPseudoGeodesicBound,
                                                      &Filter::GetPseudoGeodesicBound,
                                                      Enums::PseudoGeodesicBound::Off,
                                                      value,
                                                      "PseudoGeodesicBound" + text + OfBounds);
    ExpectRefused<Filter, Enums::Boundary>(&Filter::SetVectorDistanceBoundary,
                                           &Filter::GetVectorDistanceBoundary,
                                           Enums::Boundary::Background,
                                           value,
                                           "VectorDistanceBoundary" + text + OfBoundaries);
  }
}

TEST(MedialVoxelEnums, SettersOfVectorsRefuseOtherNumbers)
{
  using Filter = itk::VectorDistanceMapImageFilter<Image>;
  using Enums = itk::MedialVoxelEnums;
  ExpectRefused<Filter, Enums::Boundary>(
    &Filter::SetBoundary, &Filter::GetBoundary, Enums::Boundary::Background, 2, "Boundary is 2" + OfBoundaries);
  ExpectRefused<Filter, Enums::Region>(
    &Filter::SetRegion, &Filter::GetRegion, Enums::Region::Inside, 3, "Region is 3" + OfRegions);
}

TEST(MedialVoxelEnums, SettersOfMeshesRefuseOtherNumbers)
{
  using Filter = itk::MedialSurfaceMeshFilter<Image>;
  using Enums = itk::MedialVoxelEnums;
  ExpectRefused<Filter, Enums::ThicknessMode>(&Filter::SetThicknessMode,
                                              &Filter::GetThicknessMode,
                                              Enums::ThicknessMode::Automatic,
                                              2,
                                              "ThicknessMode is 2" + OfModes);
  ExpectRefused<Filter, Enums::Smoothing>(
    &Filter::SetSmoothing, &Filter::GetSmoothing, Enums::Smoothing::On, 3, "Smoothing is 3" + OfSmoothings);
}

TEST(MedialVoxelEnums, EnumeratorsHaveNoProblem)
{
  for (const auto mode : { itk::MedialVoxelThicknessMode::Fixed, itk::MedialVoxelThicknessMode::Automatic })
  {
    EXPECT_EQ(itk::MedialVoxelFindEnumProblem(mode), "");
    EXPECT_EQ(itk::MedialVoxelFindEnumProblem(static_cast<itk::MedialVoxelBoundary>(mode)), "");
  }
  EXPECT_EQ(itk::MedialVoxelFindEnumProblem(itk::MedialVoxelRegion::Both), "");
}
