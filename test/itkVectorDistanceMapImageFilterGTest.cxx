// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Options, errors and outputs of the vector distance filter.

#include "itkMedialVoxelFilterAccess.h"
#include "itkVectorDistanceMapImageFilter.h"

#include "MedialVoxelTestRuns.h"

#include <sstream>

template class itk::VectorDistanceMapImageFilter<itk::Image<unsigned char, 2>>;
template class itk::VectorDistanceMapImageFilter<itk::Image<short, 3>, itk::Image<itk::Vector<double, 3>, 3>>;

namespace
{
using namespace MedialVoxelTest;

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

const Vector3 CraniumSpacing{ { 0.9570312, 0.9570312, 1.5 } };

Volume
Part()
{
  return RandomBoxes({ { 19, 17, 15 } }, CraniumSpacing, 9, 111);
}

VectorFilter<3>::Pointer
MakeVectorFilter(const Volume & volume)
{
  auto filter = VectorFilter<3>::New();
  filter->SetInput(MakeImage<MaskImage<3>>(volume));
  return filter;
}

std::vector<unsigned char>
Everywhere(const Volume & volume)
{
  return std::vector<unsigned char>(volume.object.size(), 1);
}

BoundarySide
SideOf(itk::MedialVoxelBoundary boundary)
{
  return boundary == itk::MedialVoxelBoundary::Object ? BoundarySide::Object : BoundarySide::Background;
}

/** Signed distances by brute force, as floats; NaN beyond `maximum`, zero outside `region`. */
std::vector<float>
ExpectedDistances(const Volume &                     volume,
                  const std::vector<Index3> &        sites,
                  const std::vector<unsigned char> & region,
                  bool                               insideIsPositive,
                  bool                               squared)
{
  std::vector<float> distances(volume.object.size(), 0.0f);
  for (std::size_t i = 0; i < distances.size(); ++i)
  {
    const Index3 v = volume.IndexAt(i);
    const long   nearest = region[i] ? NearestSite(volume, sites, v) : -1;
    if (nearest >= 0)
    {
      const double length = PhysicalDistance(volume, v, sites[nearest]);
      const double sign = (volume.object[i] != 0) == insideIsPositive ? 1.0 : -1.0;
      distances[i] = static_cast<float>(sign * (squared ? length * length : length));
    }
  }
  return distances;
}
} // namespace

TEST(VectorDistanceMapImageFilter, HasTheDocumentedDefaults)
{
  auto filter = VectorFilter<3>::New();
  EXPECT_STREQ(filter->GetNameOfClass(), "VectorDistanceMapImageFilter");
  EXPECT_EQ(filter->GetBoundary(), itk::MedialVoxelBoundary::Object);
  EXPECT_EQ(filter->GetRegion(), itk::MedialVoxelRegion::Both);
  EXPECT_EQ(filter->GetMaximumDistance(), Infinity);
  EXPECT_EQ(filter->GetBackgroundValue(), 0);
  EXPECT_EQ(filter->GetLowerThreshold(), -Infinity);
  EXPECT_EQ(filter->GetUpperThreshold(), Infinity);
  EXPECT_TRUE(filter->GetUseImageSpacing());
  EXPECT_FALSE(filter->GetGenerateDistance());
  EXPECT_FALSE(filter->GetInsideIsPositive());
  EXPECT_FALSE(filter->GetSquaredDistance());
  EXPECT_EQ(filter->GetDistanceOutput(), nullptr);
}

TEST(VectorDistanceMapImageFilter, PrintsItsParameters)
{
  auto filter = VectorFilter<3>::New();
  filter->SetMaximumDistance(12.75);
  std::ostringstream text;
  filter->Print(text);
  for (const char * word : { "Boundary: ",
                             "Region: ",
                             "MaximumDistance: 12.75",
                             "GenerateDistance",
                             "InsideIsPositive",
                             "SquaredDistance" })
  {
    EXPECT_NE(text.str().find(word), std::string::npos) << word;
  }
}

TEST(VectorDistanceMapImageFilter, RefusesAMaximumDistanceThatIsNotPositive)
{
  for (const double distance : { 0.0, -1.0, NaN, -Infinity })
  {
    auto filter = MakeVectorFilter(Part());
    filter->SetMaximumDistance(distance);
    EXPECT_THROW(filter->Update(), itk::ExceptionObject) << distance;
    filter->SetMaximumDistance(Infinity);
    EXPECT_NO_THROW(filter->Update());
  }
}

TEST(VectorDistanceMapImageFilter, RefusesImpossibleThresholds)
{
  auto reversed = MakeVectorFilter(Part());
  reversed->SetLowerThreshold(1.5);
  reversed->SetUpperThreshold(0.5);
  EXPECT_THROW(reversed->Update(), itk::ExceptionObject);
  auto lower = MakeVectorFilter(Part());
  lower->SetLowerThreshold(NaN);
  EXPECT_THROW(lower->Update(), itk::ExceptionObject);
  auto upper = MakeVectorFilter(Part());
  upper->SetUpperThreshold(NaN);
  EXPECT_THROW(upper->Update(), itk::ExceptionObject);
  EXPECT_THROW(VectorFilter<3>::New()->Update(), itk::ExceptionObject);
}

TEST(VectorDistanceMapImageFilter, VectorsAndDistancesAreBruteForce)
{
  for (const Volume & volume :
       { Part(), InVoxelUnits(Part()), RandomVolume({ { 14, 13, 12 } }, CraniumSpacing, 0.5, 112) })
  {
    for (const auto boundary : { itk::MedialVoxelBoundary::Object, itk::MedialVoxelBoundary::Background })
    {
      const auto sites = BoundarySites(volume, SideOf(boundary));
      for (const auto & flags : { std::make_pair(false, false), { true, false }, { false, true }, { true, true } })
      {
        auto filter = MakeVectorFilter(volume);
        filter->SetBoundary(boundary);
        filter->GenerateDistanceOn();
        filter->SetInsideIsPositive(flags.first);
        filter->SetSquaredDistance(flags.second);
        filter->Update();
        EXPECT_TRUE(
          VectorsAreEqual(PixelsOf(filter->GetOutput()), ExpectedVectors<3>(volume, sites, Everywhere(volume))));
        const auto actual = PixelsOf(filter->GetDistanceOutput());
        const auto expected = ExpectedDistances(volume, sites, Everywhere(volume), flags.first, flags.second);
        for (std::size_t i = 0; i < actual.size(); ++i)
        {
          ASSERT_NEAR(actual[i], expected[i], 2e-7 * std::abs(expected[i])) << i;
        }
      }
    }
  }
}

TEST(VectorDistanceMapImageFilter, RegionChoosesTheSide)
{
  const Volume volume = Part();
  const auto   background = Complement(volume).object;
  for (const auto boundary : { itk::MedialVoxelBoundary::Object, itk::MedialVoxelBoundary::Background })
  {
    const auto sites = BoundarySites(volume, SideOf(boundary));
    for (const auto & region : { std::make_pair(itk::MedialVoxelRegion::Inside, volume.object),
                                 { itk::MedialVoxelRegion::Outside, background },
                                 { itk::MedialVoxelRegion::Both, Everywhere(volume) } })
    {
      auto filter = MakeVectorFilter(volume);
      filter->SetBoundary(boundary);
      filter->SetRegion(region.first);
      filter->GenerateDistanceOn();
      filter->Update();
      EXPECT_TRUE(VectorsAreEqual(PixelsOf(filter->GetOutput()), ExpectedVectors<3>(volume, sites, region.second)));
      const auto distances = PixelsOf(filter->GetDistanceOutput());
      const auto expected = ExpectedDistances(volume, sites, region.second, false, false);
      for (std::size_t i = 0; i < distances.size(); ++i)
      {
        ASSERT_NEAR(distances[i], expected[i], 2e-7 * std::abs(expected[i])) << i;
      }
    }
  }
}

TEST(VectorDistanceMapImageFilter, NothingLiesBeyondTheMaximumDistance)
{
  for (const Volume & volume : { Ball({ { 22, 21, 20 } }, UnitSpacing, { { 10, 10, 10 } }, 8.3),
                                 Ball({ { 22, 21, 20 } }, CraniumSpacing, { { 10, 10, 10 } }, 8.3) })
  {
    const auto sites = BoundarySites(volume, BoundarySide::Object);
    // 5 is the length of (3, 4, 0) and (5, 0, 0): a voxel at exactly the maximum keeps its vector.
    for (const double maximum : { 0.5, 1.0, 2.5, 5.0, 7.0, 1e9 })
    {
      auto filter = MakeVectorFilter(volume);
      filter->SetMaximumDistance(maximum);
      filter->GenerateDistanceOn();
      filter->Update();
      auto expected = ExpectedVectors<3>(volume, sites, Everywhere(volume));
      for (std::size_t i = 0; i < expected.size(); ++i)
      {
        const Index3 v = volume.IndexAt(i);
        if (PhysicalDistance(volume, v, sites[NearestSite(volume, sites, v)]) > maximum)
        {
          expected[i].Fill(std::numeric_limits<float>::quiet_NaN());
        }
      }
      EXPECT_TRUE(VectorsAreEqual(PixelsOf(filter->GetOutput()), expected)) << "maximum " << maximum;
      const auto distances = PixelsOf(filter->GetDistanceOutput());
      for (std::size_t i = 0; i < distances.size(); ++i)
      {
        ASSERT_EQ(std::isnan(distances[i]), std::isnan(expected[i][0])) << i;
      }
    }
  }
}

TEST(VectorDistanceMapImageFilter, MaximumDistanceIsInVoxelsWithoutSpacing)
{
  const Volume volume = AxisPlate({ { 5, 5, 20 } }, { { 3.0, 3.0, 3.0 } }, 2, 0, 10);
  auto         filter = MakeVectorFilter(volume);
  filter->UseImageSpacingOff();
  filter->SetMaximumDistance(4.0);
  filter->Update();
  const auto vectors = PixelsOf(filter->GetOutput());
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    const int away = std::abs(9 - volume.IndexAt(i)[2]);
    EXPECT_EQ(std::isnan(vectors[i][2]), away > 4) << i;
    EXPECT_TRUE(away > 4 || std::abs(vectors[i][2]) == away) << i;
  }
}

TEST(VectorDistanceMapImageFilter, ANarrowBandReadsLittle)
{
  const Volume volume = AxisPlate({ { 10, 9, 100 } }, UnitSpacing, 2, 0, 100); // full: no boundary anywhere
  auto         source = RecordingSource<MaskImage<3>>::New();
  source->SetImage(MakeImage<MaskImage<3>>(volume));
  auto filter = VectorFilter<3>::New();
  filter->SetInput(source->GetOutput());
  filter->SetMaximumDistance(3.0);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 4);
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion(itk::ImageRegion<3>({ { 0, 0, 50 } }, { { 10, 9, 4 } }));
  filter->GetOutput()->PropagateRequestedRegion();
  filter->GetOutput()->UpdateOutputData();
  for (const auto & request : source->GetRequests())
  {
    EXPECT_GE(request.GetIndex(2), 50 - 12);
    EXPECT_LE(request.GetUpperIndex()[2], 53 + 12);
  }
  EXPECT_TRUE(std::isnan(PixelsOf(filter->GetOutput())[0][0]));
}

TEST(VectorDistanceMapImageFilter, ImagesWithoutBoundaryAreNaN)
{
  for (const Volume & volume :
       { Volume({ { 6, 5, 4 } }, UnitSpacing), Complement(Volume({ { 6, 5, 4 } }, UnitSpacing)) })
  {
    auto filter = MakeVectorFilter(volume);
    filter->GenerateDistanceOn();
    filter->Update();
    for (const auto & vector : PixelsOf(filter->GetOutput()))
    {
      EXPECT_TRUE(std::isnan(vector[0]) && std::isnan(vector[1]) && std::isnan(vector[2]));
    }
    for (const float distance : PixelsOf(filter->GetDistanceOutput()))
    {
      EXPECT_TRUE(std::isnan(distance));
    }
  }
}

TEST(VectorDistanceMapImageFilter, DistanceOutputComesAndGoes)
{
  auto filter = MakeVectorFilter(Part());
  EXPECT_EQ(filter->GetNumberOfOutputs(), 1u);
  filter->GenerateDistanceOn();
  ASSERT_NE(filter->GetDistanceOutput(), nullptr);
  EXPECT_EQ(filter->GetNumberOfIndexedOutputs(), 1u);
  filter->UpdateOutputInformation();
  const itk::ImageRegion<3> request({ { 1, 2, 3 } }, { { 4, 3, 2 } });
  filter->GetDistanceOutput()->SetRequestedRegion(request);
  filter->GetDistanceOutput()->PropagateRequestedRegion();
  filter->GetDistanceOutput()->UpdateOutputData();
  EXPECT_EQ(filter->GetOutput()->GetBufferedRegion(), request);
  EXPECT_EQ(filter->GetDistanceOutput()->GetBufferedRegion(), request);
  filter->GenerateDistanceOff();
  EXPECT_EQ(filter->GetDistanceOutput(), nullptr);
  EXPECT_EQ(filter->GetNumberOfOutputs(), 1u);
  filter->UpdateLargestPossibleRegion();
  EXPECT_TRUE(
    VectorsAreEqual(PixelsOf(filter->GetOutput()),
                    ExpectedVectors<3>(Part(), BoundarySites(Part(), BoundarySide::Object), Everywhere(Part()))));
}

TEST(VectorDistanceMapImageFilter, OutputsHaveTheGeometryOfTheInput)
{
  auto         image = MakeImage<MaskImage<3>>(Part(), 5);
  const double origin[3] = { 1.0, 2.0, 3.0 };
  image->SetOrigin(origin);
  auto filter = VectorFilter<3>::New();
  filter->SetInput(image);
  filter->GenerateDistanceOn();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetOrigin(), image->GetOrigin());
  EXPECT_EQ(filter->GetOutput()->GetSpacing(), image->GetSpacing());
  EXPECT_EQ(filter->GetOutput()->GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
  EXPECT_EQ(filter->GetDistanceOutput()->GetOrigin(), image->GetOrigin());
  EXPECT_EQ(filter->GetDistanceOutput()->GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
}

TEST(VectorDistanceMapImageFilter, MedialFilterGivesTheSameVectorsInside)
{
  for (const auto boundary : { itk::MedialVoxelBoundary::Object, itk::MedialVoxelBoundary::Background })
  {
    auto vectors = MakeVectorFilter(Part());
    vectors->SetBoundary(boundary);
    vectors->SetRegion(itk::MedialVoxelRegion::Inside);
    vectors->Update();
    auto medial = MakeMedialFilter<3>(Part(), 3.0);
    medial->GenerateVectorDistanceOn();
    medial->SetVectorDistanceBoundary(boundary);
    medial->Update();
    EXPECT_TRUE(VectorsAreEqual(PixelsOf(medial->GetVectorDistanceOutput()), PixelsOf(vectors->GetOutput())));
  }
}
