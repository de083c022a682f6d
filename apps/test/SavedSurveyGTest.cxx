// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "Survey.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialVoxelImageFilter.h"

#include <gtest/gtest.h>

using namespace medialvoxel;

namespace
{

constexpr std::int64_t Size = 48;

using ImageType = itk::Image<unsigned char, 3>;

/** A plate and a block, with cells in all pieces. */
ImageType::Pointer
MakeImage()
{
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType::Filled(Size));
  image->Allocate();
  for (itk::IndexValueType z = 0; z < Size; ++z)
  {
    for (itk::IndexValueType y = 0; y < Size; ++y)
    {
      for (itk::IndexValueType x = 0; x < Size; ++x)
      {
        const bool isPlate = x >= 20 && x < 24;
        const bool isBlock = y >= 30 && y < 42 && z >= 5 && z < 40;
        image->SetPixel({ { x, y, z } }, isPlate || isBlock ? 1 : 0);
      }
    }
  }
  return image;
}

Survey
MakeSurvey()
{
  VolumeGeometry geometry;
  geometry.size.assign(3, Size);
  geometry.spacing.assign(3, 1.0);
  return { geometry, { { Size, Size, Size }, { 1.0, 1.0, 1.0 } }, { true } };
}

void
RunSlices(const ImageType::Pointer & image, Survey & survey, std::int64_t begin, std::int64_t end)
{
  const auto filter = itk::MedialVoxelImageFilter<ImageType>::New();
  filter->SetInput(image);
  itk::MedialVoxelFilterAccess::SetTileObservers(*filter, { &survey });
  filter->UpdateOutputInformation();
  auto region = image->GetLargestPossibleRegion();
  region.SetIndex(2, begin);
  region.SetSize(2, static_cast<itk::SizeValueType>(end - begin));
  filter->GetOutput()->SetRequestedRegion(region);
  filter->GetOutput()->PropagateRequestedRegion();
  filter->GetOutput()->UpdateOutputData();
}

} // namespace

TEST(SavedSurvey, PartsOfAllPiecesMakeTheWhole)
{
  const auto image = MakeImage();
  Survey     whole = MakeSurvey();
  RunSlices(image, whole, 0, Size);
  ASSERT_GT(whole.GetSums().GetCells().GetTotal(), 0u);
  ASSERT_GT(whole.GetSums().GetUnpairedCells(), 0u);
  for (const std::int64_t slices : { 1, 7, 16, 48 })
  {
    Survey merged = MakeSurvey();
    Survey piece = MakeSurvey();
    for (std::int64_t begin = 0; begin < Size; begin += slices)
    {
      piece.Clear();
      RunSlices(image, piece, begin, std::min(Size, begin + slices));
      merged.Merge(piece.Save());
    }
    EXPECT_EQ(merged.Save(), whole.Save()) << slices;
    EXPECT_EQ(merged.GetSums().GetCells().GetNumbers(), whole.GetSums().GetCells().GetNumbers());
    EXPECT_EQ(merged.GetSums().GetUnpairedCells(), whole.GetSums().GetUnpairedCells());
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(merged.GetBestSlice(axis), whole.GetBestSlice(axis));
    }
  }
}

TEST(SavedSurvey, OfNothingChangesNothing)
{
  Survey            survey = MakeSurvey();
  const std::string nothing = survey.Save();
  RunSlices(MakeImage(), survey, 0, Size);
  const std::string before = survey.Save();
  EXPECT_NE(before, nothing);
  survey.Merge(nothing);
  EXPECT_EQ(survey.Save(), before);
  survey.Clear();
  EXPECT_EQ(survey.Save(), nothing);
}

TEST(SavedSurvey, RefusesOtherBytes)
{
  Survey            survey = MakeSurvey();
  const std::string nothing = survey.Save();
  RunSlices(MakeImage(), survey, 0, Size);
  const std::string good = survey.Save();
  for (const std::size_t length : { std::size_t{ 0 }, std::size_t{ 7 }, std::size_t{ 8 }, good.size() - 1 })
  {
    EXPECT_THROW(survey.Merge(good.substr(0, length)), JobError) << length;
  }
  EXPECT_EQ(survey.Save(), good);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i)
  {
    // Some bits of packed bytes do not matter: then all comes out right.
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 4);
    Survey other = MakeSurvey();
    try
    {
      other.Merge(bad);
      EXPECT_EQ(other.Save(), good) << i;
    }
    catch (const JobError &)
    {
      EXPECT_EQ(other.Save(), nothing) << i;
      ++refused;
    }
  }
  EXPECT_GT(refused, good.size() * 9 / 10);
}
