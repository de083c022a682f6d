// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Survey.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkMedialVoxelImageFilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace medialvoxel;

namespace
{

using ImageType = itk::Image<unsigned char, 3>;
using Rule = std::function<bool(itk::IndexValueType, itk::IndexValueType, itk::IndexValueType)>;

ImageType::Pointer
MakeImage(const std::vector<std::uint64_t> & size, const Rule & isObject)
{
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { size[0], size[1], size[2] } });
  image->Allocate();
  itk::ImageRegionIteratorWithIndex<ImageType> voxel(image, image->GetLargestPossibleRegion());
  for (; !voxel.IsAtEnd(); ++voxel)
  {
    const auto & index = voxel.GetIndex();
    voxel.Set(isObject(index[0], index[1], index[2]) ? 1 : 0);
  }
  return image;
}

VolumeGeometry
MakeGeometry(const std::vector<std::uint64_t> & size)
{
  VolumeGeometry geometry;
  geometry.size = size;
  geometry.spacing.assign(size.size(), 1.0);
  return geometry;
}

/** How a run is cut, which must change nothing. */
struct Cut
{
  unsigned int pieces{ 1 };
  unsigned int tileSize{ 0 };
  unsigned int threads{ 1 };
};

constexpr std::uint64_t MeasureAll = std::uint64_t{ 1 } << 40;

/** A survey of a whole run, and its labels. */
class SurveyedRun
{
public:
  SurveyedRun(const std::vector<std::uint64_t> & size,
              const Rule &                       isObject,
              const Cut &                        cut = {},
              std::uint64_t                      fullyMeasuredVoxels = MeasureAll)
    : m_Survey(MakeGeometry(size),
               { { static_cast<std::int64_t>(size[0]),
                   static_cast<std::int64_t>(size[1]),
                   static_cast<std::int64_t>(size[2]) },
                 { 1.0, 1.0, 1.0 } },
               { true, fullyMeasuredVoxels })
    , m_Image(MakeImage(size, isObject))
  {
    m_Filter->SetInput(m_Image);
    itk::MedialVoxelFilterAccess::SetTileSize(*m_Filter, cut.tileSize);
    m_Filter->SetNumberOfWorkUnits(cut.threads);
    itk::MedialVoxelFilterAccess::SetTileObservers(*m_Filter, { &m_Survey });
    m_Filter->UpdateOutputInformation();
    for (unsigned int piece = 0; piece < cut.pieces; ++piece)
    {
      auto region = m_Image->GetLargestPossibleRegion();
      region.SetIndex(2, static_cast<itk::IndexValueType>(size[2] * piece / cut.pieces));
      region.SetSize(2, size[2] * (piece + 1) / cut.pieces - size[2] * piece / cut.pieces);
      m_Filter->GetOutput()->SetRequestedRegion(region);
      m_Filter->GetOutput()->PropagateRequestedRegion();
      m_Filter->GetOutput()->UpdateOutputData();
    }
  }

  const Survey &
  GetSurvey() const
  {
    return m_Survey;
  }

  /** Labels of the last piece. */
  const ImageType &
  GetLabels() const
  {
    return *m_Filter->GetOutput();
  }

  std::uint64_t
  GetNumberOfMedialCells() const
  {
    const auto counts = m_Filter->GetCounts();
    return counts.boundCells + counts.geodesicMedialCells;
  }

  std::vector<std::uint64_t>
  GetBestSlices() const
  {
    return { m_Survey.GetBestSlice(0), m_Survey.GetBestSlice(1), m_Survey.GetBestSlice(2) };
  }

private:
  Survey                                          m_Survey;
  ImageType::Pointer                              m_Image;
  itk::MedialVoxelImageFilter<ImageType>::Pointer m_Filter = itk::MedialVoxelImageFilter<ImageType>::New();
};

/** Walls along all axes, one of them tilted. */
bool
IsWall(itk::IndexValueType x, itk::IndexValueType y, itk::IndexValueType z)
{
  return (z >= 8 && z < 11) || (x >= 70 && x < 74 && y < 30) || (std::abs(x + 2 * z - 60) <= 3 && y > 20);
}

const std::vector<std::uint64_t> Size{ 150, 41, 37 };

} // namespace

TEST(Survey, AnyCutGivesTheSame)
{
  const SurveyedRun whole(Size, IsWall);
  EXPECT_EQ(whole.GetSurvey().GetSums().GetCells().GetTotal() + whole.GetSurvey().GetSums().GetUnpairedCells(),
            whole.GetNumberOfMedialCells());
  EXPECT_GT(whole.GetSurvey().GetSums().GetUnpairedCells(), 0u);
  EXPECT_LT(whole.GetSurvey().GetSums().GetUnpairedCells(), whole.GetNumberOfMedialCells() / 4);
  EXPECT_GT(whole.GetNumberOfMedialCells(), 1000u);
  for (const Cut & cut : { Cut{ 5, 0, 1 }, Cut{ 1, 13, 1 }, Cut{ 3, 0, 4 }, Cut{ 2, 9, 3 } })
  {
    const SurveyedRun other(Size, IsWall, cut);
    EXPECT_EQ(other.GetSurvey().GetSums().GetCells().GetNumbers(), whole.GetSurvey().GetSums().GetCells().GetNumbers());
    EXPECT_EQ(other.GetSurvey().GetSums().GetAreas().GetNumbers(), whole.GetSurvey().GetSums().GetAreas().GetNumbers());
    EXPECT_EQ(other.GetSurvey().GetSums().GetUnpairedCells(), whole.GetSurvey().GetSums().GetUnpairedCells());
    EXPECT_EQ(other.GetBestSlices(), whole.GetBestSlices());
    const auto & expected = whole.GetSurvey().GetProjection();
    const auto & projection = other.GetSurvey().GetProjection();
    ASSERT_EQ(projection.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_EQ(projection[i].label, expected[i].label);
      EXPECT_EQ(projection[i].medialCells, expected[i].medialCells);
      EXPECT_EQ(projection[i].thickest, expected[i].thickest);
    }
  }
}

TEST(Survey, AgreesWithTheThicknessOutput)
{
  Survey     survey(MakeGeometry(Size), { { 150, 41, 37 }, { 1.0, 1.0, 1.0 } }, { true, MeasureAll });
  const auto filter = itk::MedialVoxelImageFilter<ImageType>::New();
  filter->SetInput(MakeImage(Size, IsWall));
  itk::MedialVoxelFilterAccess::SetTileObservers(*filter, { &survey });
  filter->GenerateThicknessOn();
  filter->Update();
  LengthHistogram            expected(1.0 / 64);
  std::uint64_t              unpaired = 0;
  std::vector<std::uint32_t> thickest(150 * 41, 0);
  using ThicknessImageType = itk::MedialVoxelImageFilter<ImageType>::ThicknessImageType;
  itk::ImageRegionConstIteratorWithIndex<ThicknessImageType> value(filter->GetThicknessOutput(),
                                                                   filter->GetThicknessOutput()->GetBufferedRegion());
  for (; !value.IsAtEnd(); ++value)
  {
    if (value.Get() < 0.0f)
    {
      ++unpaired;
    }
    else if (filter->GetOutput()->GetPixel(value.GetIndex()) >= 2)
    {
      const std::size_t bin = expected.GetBin(static_cast<double>(value.Get()));
      expected.Add(bin);
      std::uint32_t & most = thickest[static_cast<std::size_t>(value.GetIndex()[1] * 150 + value.GetIndex()[0])];
      most = std::max(most, static_cast<std::uint32_t>(bin));
    }
  }
  EXPECT_GT(expected.GetTotal(), 1000u);
  EXPECT_EQ(survey.GetSums().GetCells().GetNumbers(), expected.GetNumbers());
  EXPECT_EQ(survey.GetSums().GetUnpairedCells(), unpaired);
  for (std::size_t i = 0; i < thickest.size(); ++i)
  {
    EXPECT_EQ(survey.GetProjection()[i].thickest, thickest[i]) << i;
  }
}

TEST(Survey, AreasOfPlatesAreExact)
{
  const SurveyedRun run({ 60, 50, 40 }, [](auto x, auto, auto z) { return (z >= 8 && z < 11) || x >= 70; });
  const auto &      areas = run.GetSurvey().GetSums().GetAreas();
  EXPECT_EQ(static_cast<double>(areas.GetTotal()) * run.GetSurvey().GetAreaUnit(), 59.0 * 49.0);
  EXPECT_EQ(areas.GetMean(), 3.0);
}

TEST(Survey, ProjectionIsTheLargestLabelAndCountsMedialCells)
{
  const SurveyedRun run(Size, IsWall);
  const auto &      survey = run.GetSurvey();
  ASSERT_EQ(survey.GetProjectionSize(), (std::array<unsigned int, 2>{ { 150, 41 } }));
  for (itk::IndexValueType y = 0; y < 41; ++y)
  {
    for (itk::IndexValueType x = 0; x < 150; ++x)
    {
      unsigned char largest = 0;
      std::uint32_t medial = 0;
      for (itk::IndexValueType z = 0; z < 37; ++z)
      {
        const unsigned char label = run.GetLabels().GetPixel({ { x, y, z } });
        largest = std::max(largest, label);
        medial += label >= 2 ? 1 : 0;
      }
      const auto & pixel = survey.GetProjection()[static_cast<std::size_t>(y * 150 + x)];
      EXPECT_EQ(pixel.label, largest) << x << ' ' << y;
      EXPECT_EQ(pixel.medialCells, medial) << x << ' ' << y;
    }
  }
}

TEST(Survey, BlocksWithoutLabelsAreKnown)
{
  const SurveyedRun run(Size, [](auto x, auto y, auto z) { return x > 100 && y >= 20 && y < 23 && z < 9; });
  for (itk::IndexValueType z = 0; z < 37; ++z)
  {
    for (itk::IndexValueType y = 0; y < 41; ++y)
    {
      for (itk::IndexValueType x = 0; x < 150; ++x)
      {
        if (run.GetLabels().GetPixel({ { x, y, z } }) != 0)
        {
          EXPECT_TRUE(run.GetSurvey().MayHaveLabels(x, y, z));
        }
      }
    }
  }
  EXPECT_FALSE(run.GetSurvey().MayHaveLabels(0, 21, 4));
  EXPECT_FALSE(run.GetSurvey().MayHaveLabels(120, 2, 4));
  EXPECT_FALSE(run.GetSurvey().MayHaveLabels(120, 21, 30));
}

TEST(Survey, SlicesCrossTheSheets)
{
  // A large plate across z, and a small one across x: slices of y and z cut the small one, slices of x the large one.
  const auto best = SurveyedRun({ 60, 60, 60 }, [](auto x, auto y, auto z) {
                      return (z >= 12 && z < 15) || (x >= 30 && x < 33 && y >= 20 && y < 30 && z >= 30 && z < 50);
                    }).GetBestSlices();
  EXPECT_GE(best[1], 19u);
  EXPECT_LE(best[1], 30u);
  EXPECT_GE(best[2], 29u);
  EXPECT_LE(best[2], 50u);
}

TEST(Survey, WithoutMedialCellsTheMiddleIsShown)
{
  const SurveyedRun run({ 21, 10, 7 }, [](auto, auto, auto) { return false; });
  EXPECT_EQ(run.GetBestSlices(), (std::vector<std::uint64_t>{ 10, 5, 3 }));
  EXPECT_EQ(run.GetSurvey().GetSums().GetCells().GetTotal(), 0u);
}

TEST(Survey, AnAbortedExecutionAddsNothing)
{
  Survey     survey(MakeGeometry(Size), { { 150, 41, 37 }, { 1.0, 1.0, 1.0 } }, { true, MeasureAll });
  const auto image = MakeImage(Size, IsWall);
  const auto filter = itk::MedialVoxelImageFilter<ImageType>::New();
  filter->SetInput(image);
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, 10);
  filter->SetNumberOfWorkUnits(1);
  itk::MedialVoxelFilterAccess::SetTileObservers(*filter, { &survey });
  const auto tag = filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    if (filter->GetProgress() > 0.5F)
    {
      filter->AbortGenerateDataOn();
    }
  });
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  EXPECT_EQ(survey.GetSums().GetCells().GetTotal(), 0u);
  filter->RemoveObserver(tag);
  filter->Update();
  EXPECT_EQ(survey.GetSums().GetCells().GetNumbers(),
            SurveyedRun(Size, IsWall).GetSurvey().GetSums().GetCells().GetNumbers());
}

TEST(Survey, OfLargeVolumesEverySoManyCellCounts)
{
  SurveySettings settings;
  const auto     stepOf = [&](std::uint64_t edge) {
    const auto index = static_cast<std::int64_t>(edge);
    return Survey(MakeGeometry({ edge, edge, edge }), { { index, index, index }, { 1.0, 1.0, 1.0 } }, settings)
      .GetSample()
      .GetStep();
  };
  EXPECT_EQ(stepOf(100), 1u);
  EXPECT_EQ(stepOf(203), 1u);
  EXPECT_EQ(stepOf(204), 2u);
  EXPECT_EQ(stepOf(4000), 64u);
}

TEST(Survey, CellsThatAMapMeasuresDoNotCount)
{
  const SurveyedRun part(Size, IsWall, {}, 30000);
  Survey            survey(MakeGeometry(Size), { { 150, 41, 37 }, { 1.0, 1.0, 1.0 } }, { true, 30000 });
  const auto        filter = itk::MedialVoxelImageFilter<ImageType>::New();
  filter->SetInput(MakeImage(Size, IsWall));
  filter->GenerateThicknessOn();
  itk::MedialVoxelFilterAccess::SetTileObservers(*filter, { &survey });
  filter->Update();
  EXPECT_EQ(survey.GetSums().GetCells().GetNumbers(), part.GetSurvey().GetSums().GetCells().GetNumbers());
  EXPECT_EQ(survey.GetSums().GetAreas().GetNumbers(), part.GetSurvey().GetSums().GetAreas().GetNumbers());
  EXPECT_EQ(survey.GetSums().GetUnpairedCells(), part.GetSurvey().GetSums().GetUnpairedCells());
  EXPECT_EQ(survey.GetBestSlice(0), part.GetSurvey().GetBestSlice(0));
}

TEST(Survey, TheStandardErrorIsThatOfSamples)
{
  // Samples of one in 8 of the same cells.
  ThicknessSums              all(1.0);
  std::vector<ThicknessSums> samples(8, all);
  std::mt19937               random(5);
  for (unsigned int cell = 0; cell < 8000; ++cell)
  {
    const auto          thickness = static_cast<float>(10 + random() % 7);
    const std::uint64_t area = ThicknessSums::AreaUnitsPerFace * (1 + cell % 3) / 2;
    all.AddCell(thickness, area);
    samples[random() % 8].AddCell(thickness, area);
  }
  double squares = 0.0;
  double error = 0.0;
  for (const ThicknessSums & sample : samples)
  {
    const double difference = sample.GetAreas().GetMean() - all.GetAreas().GetMean();
    squares += difference * difference / 8.0;
    error += sample.GetStandardErrorOfMean(8) / 8.0;
  }
  // Of eight samples the deviation itself is known to a fourth.
  EXPECT_NEAR(std::sqrt(squares) / error, 1.0, 0.5);
  // The variance of seven equally frequent numbers is 4; areas of 1, 2 and 3 weigh as 6 / 7 of so many cells.
  EXPECT_NEAR(error, std::sqrt(4.0 * (7.0 / 8.0) * (7.0 / 6.0) / 1000.0), 0.003);
  EXPECT_EQ(ThicknessSums(1.0).GetStandardErrorOfMean(8), 0.0);
}

TEST(Survey, TheSampleOfALargeVolumeIsTheSameForAnyCut)
{
  const SurveyedRun all(Size, IsWall);
  const SurveyedRun part(Size, IsWall, {}, 30000);
  EXPECT_EQ(part.GetSurvey().GetSample().GetStep(), 8u);
  const double share = static_cast<double>(part.GetSurvey().GetSums().GetCells().GetTotal()) /
                       static_cast<double>(all.GetSurvey().GetSums().GetCells().GetTotal());
  EXPECT_NEAR(share, 1.0 / 8, 0.01);
  EXPECT_NEAR(part.GetSurvey().GetSums().GetCells().GetMean(), all.GetSurvey().GetSums().GetCells().GetMean(), 0.1);
  for (const Cut & cut : { Cut{ 5, 0, 1 }, Cut{ 3, 13, 4 } })
  {
    const SurveyedRun other(Size, IsWall, cut, 30000);
    EXPECT_EQ(other.GetSurvey().GetSums().GetCells().GetNumbers(), part.GetSurvey().GetSums().GetCells().GetNumbers());
    EXPECT_EQ(other.GetBestSlices(), part.GetBestSlices());
  }
}
