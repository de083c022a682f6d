// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Defaults, parameters, errors, geometry, outputs and counters of the medial voxel filter.

#include "itkMedialVoxelFilterAccess.h"
#include "itkMedialVoxelImageFilter.h"

#include "MedialVoxelTestRuns.h"

#include "itkStreamingImageFilter.h"

#include <sstream>

template class itk::MedialVoxelImageFilter<itk::Image<unsigned char, 2>>;
template class itk::MedialVoxelImageFilter<itk::Image<short, 3>>;
template class itk::MedialVoxelImageFilter<itk::Image<float, 3>, itk::Image<unsigned short, 3>>;

namespace
{
using namespace MedialVoxelTest;

const double NaN = std::numeric_limits<double>::quiet_NaN();
const double Infinity = std::numeric_limits<double>::infinity();

Volume
SmallPart()
{
  return RandomBoxes({ { 14, 12, 11 } }, { { 0.8, 0.9, 1.2 } }, 9, 81);
}

template <typename TAction>
void
ExpectErrorNaming(TAction && action, const std::string & word)
{
  try
  {
    action();
    FAIL() << "no exception";
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find(word), std::string::npos) << error.GetDescription();
  }
}
} // namespace

TEST(MedialVoxelImageFilter, HasTheDocumentedDefaults)
{
  auto filter = MedialFilter<3>::New();
  EXPECT_STREQ(filter->GetNameOfClass(), "MedialVoxelImageFilter");
  EXPECT_EQ(filter->GetThickness(), 3.0);
  EXPECT_TRUE(filter->GetUseImageSpacing());
  EXPECT_EQ(filter->GetBackgroundValue(), 0);
  EXPECT_EQ(filter->GetLowerThreshold(), -Infinity);
  EXPECT_EQ(filter->GetUpperThreshold(), Infinity);
  EXPECT_EQ(filter->GetPseudoGeodesicBound(), itk::MedialVoxelPseudoGeodesicBound::FreeSpace);
  EXPECT_FALSE(filter->GetGenerateVectorDistance());
  EXPECT_EQ(filter->GetVectorDistanceBoundary(), itk::MedialVoxelBoundary::Object);
  EXPECT_EQ(filter->GetVectorDistanceOutput(), nullptr);
  EXPECT_EQ(CountsOf(filter.GetPointer()), Counts());
  EXPECT_EQ(filter->GetCounts().notANumberVoxels, 0u);
}

TEST(MedialVoxelImageFilter, KeepsWhatIsSetAndNoticesChanges)
{
  auto       filter = MedialFilter<3>::New();
  auto       time = filter->GetMTime();
  const auto changed = [&]() {
    const bool is = filter->GetMTime() > time;
    time = filter->GetMTime();
    return is;
  };
  filter->SetThickness(4.5);
  EXPECT_TRUE(changed());
  filter->SetThickness(4.5);
  EXPECT_FALSE(changed());
  EXPECT_EQ(filter->GetThickness(), 4.5);
  filter->UseImageSpacingOff();
  EXPECT_TRUE(changed());
  EXPECT_FALSE(filter->GetUseImageSpacing());
  filter->SetBackgroundValue(7);
  EXPECT_TRUE(changed());
  EXPECT_EQ(filter->GetBackgroundValue(), 7);
  filter->SetLowerThreshold(1.5);
  EXPECT_TRUE(changed());
  EXPECT_EQ(filter->GetLowerThreshold(), 1.5);
  filter->SetUpperThreshold(99.0);
  EXPECT_TRUE(changed());
  EXPECT_EQ(filter->GetUpperThreshold(), 99.0);
  filter->SetPseudoGeodesicBound(itk::MedialVoxelPseudoGeodesicBound::Off);
  EXPECT_TRUE(changed());
  EXPECT_EQ(filter->GetPseudoGeodesicBound(), itk::MedialVoxelPseudoGeodesicBound::Off);
  filter->GenerateVectorDistanceOn();
  EXPECT_TRUE(changed());
  EXPECT_TRUE(filter->GetGenerateVectorDistance());
  filter->SetVectorDistanceBoundary(itk::MedialVoxelBoundary::Background);
  EXPECT_TRUE(changed());
  EXPECT_EQ(filter->GetVectorDistanceBoundary(), itk::MedialVoxelBoundary::Background);
}

TEST(MedialVoxelImageFilter, PrintsItsParameters)
{
  auto filter = MedialFilter<3>::New();
  filter->SetThickness(4.25);
  std::ostringstream text;
  filter->Print(text);
  for (const char * word : { "Thickness: 4.25",
                             "UseImageSpacing",
                             "BackgroundValue",
                             "LowerThreshold",
                             "UpperThreshold",
                             "PseudoGeodesicBound",
                             "FreeSpace",
                             "GenerateVectorDistance",
                             "VectorDistanceBoundary",
                             "objectVoxels 0",
                             "candidateCells 0" })
  {
    EXPECT_NE(text.str().find(word), std::string::npos) << word;
  }
}

TEST(MedialVoxelImageFilter, EnumerationsPrintTheirNames)
{
  std::ostringstream text;
  text << itk::MedialVoxelPseudoGeodesicBound::FreeSpace << ' ' << itk::MedialVoxelPseudoGeodesicBound::Paper << ' '
       << itk::MedialVoxelPseudoGeodesicBound::Off << ' ' << itk::MedialVoxelBoundary::Object << ' '
       << itk::MedialVoxelBoundary::Background << ' ' << itk::MedialVoxelRegion::Inside << ' '
       << itk::MedialVoxelRegion::Outside << ' ' << itk::MedialVoxelRegion::Both;
  for (const char * name : { "FreeSpace", "Paper", "Off", "Object", "Background", "Inside", "Outside", "Both" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
  std::ostringstream unknown;
  unknown << static_cast<itk::MedialVoxelRegion>(200) << static_cast<itk::MedialVoxelBoundary>(200)
          << static_cast<itk::MedialVoxelPseudoGeodesicBound>(200);
  EXPECT_FALSE(unknown.str().empty());
}

TEST(MedialVoxelImageFilter, RefusesThicknessThatIsNotPositiveAndFinite)
{
  for (const double thickness : { 0.0, -0.0, -1.0, NaN, Infinity, -Infinity })
  {
    SCOPED_TRACE(thickness);
    auto filter = MakeMedialFilter<3>(SmallPart(), thickness);
    ExpectErrorNaming([&]() { filter->Update(); }, "Thickness");
    filter->SetThickness(3.0);
    filter->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), Classify(SmallPart(), 3.0, Bound::FreeSpace).labels));
  }
}

TEST(MedialVoxelImageFilter, RefusesImpossibleThresholds)
{
  auto reversed = MakeMedialFilter<3>(SmallPart(), 3.0);
  reversed->SetLowerThreshold(2.0);
  reversed->SetUpperThreshold(1.0);
  ExpectErrorNaming([&]() { reversed->Update(); }, "threshold");
  auto lower = MakeMedialFilter<3>(SmallPart(), 3.0);
  lower->SetLowerThreshold(NaN);
  ExpectErrorNaming([&]() { lower->Update(); }, "threshold");
  auto upper = MakeMedialFilter<3>(SmallPart(), 3.0);
  upper->SetUpperThreshold(NaN);
  ExpectErrorNaming([&]() { upper->Update(); }, "threshold");
}

TEST(MedialVoxelImageFilter, RefusesNegativeSpacing)
{
  const auto useNegativeSpacing = []() {
    auto                      image = MakeImage<MaskImage<3>>(SmallPart());
    MaskImage<3>::SpacingType spacing = image->GetSpacing();
    spacing[1] = -1.0;
    image->SetSpacing(spacing); // some builds of ITK throw here already
    auto filter = MedialFilter<3>::New();
    filter->SetInput(image);
    filter->UpdateOutputInformation();
  };
  ExpectErrorNaming(useNegativeSpacing, "pacing");
}

TEST(MedialVoxelImageFilter, RefusesAxesBeyond32Bits)
{
  auto image = MaskImage<2>::New();
  image->SetRegions(itk::ImageRegion<2>({ { 0, 0 } }, { { itk::SizeValueType{ 1 } << 31, 2 } }));
  auto filter = MedialFilter<2>::New();
  filter->SetInput(image);
  ExpectErrorNaming([&]() { filter->UpdateOutputInformation(); }, "size");
}

TEST(MedialVoxelImageFilter, AnEmptyRequestIsNoWork)
{
  auto filter = MakeMedialFilter<3>(SmallPart(), 3.0);
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion(itk::ImageRegion<3>({ { 1, 1, 1 } }, { { 0, 3, 3 } }));
  filter->GetOutput()->PropagateRequestedRegion();
  filter->GetOutput()->UpdateOutputData();
  EXPECT_EQ(CountsOf(filter.GetPointer()), Counts());
}

TEST(MedialVoxelImageFilter, TimesAreMeasured)
{
  auto                         filter = MakeMedialFilter<3>(SmallPart(), 3.0);
  const itk::MedialVoxelSums & sums = itk::MedialVoxelFilterAccess::GetSums(*filter);
  EXPECT_EQ(sums.distanceSeconds, 0.0);
  EXPECT_EQ(sums.classificationSeconds, 0.0);
  filter->Update();
  EXPECT_GT(sums.distanceSeconds, 0.0);
  EXPECT_GT(sums.classificationSeconds, 0.0);
  EXPECT_LT(sums.distanceSeconds + sums.classificationSeconds, 60.0);
  // The threads cannot have been busy for longer than there were tiles.
  const double threads = filter->GetNumberOfWorkUnits();
  EXPECT_LE(sums.threadSeconds, threads * sums.tileSeconds);
  EXPECT_GE(sums.threadSeconds, sums.distanceSeconds + sums.classificationSeconds);
}

TEST(MedialVoxelImageFilter, RefusesToRunWithoutInput)
{
  EXPECT_THROW(MedialFilter<3>::New()->Update(), itk::ExceptionObject);
}

TEST(MedialVoxelImageFilter, TinyAndHugeThicknessAreDefined)
{
  const Volume volume = SmallPart();
  const auto   tiny = RunMedialFilter<3>(volume, 1e-300);
  EXPECT_TRUE(AreEqual(tiny.labels, Classify(volume, 1e-300, Bound::FreeSpace).labels));
  for (const double thickness : { 1e6, std::numeric_limits<double>::max() }) // epsilon of the latter is infinite
  {
    const auto huge = RunMedialFilter<3>(volume, thickness);
    EXPECT_TRUE(AreEqual(huge.labels, Classify(volume, thickness, Bound::FreeSpace).labels));
  }
}

TEST(MedialVoxelImageFilter, OutputIsShiftedByHalfAVoxelAlongTheDirection)
{
  auto                        image = MakeImage<MaskImage<3>>(SmallPart(), -3);
  MaskImage<3>::DirectionType direction;
  direction.Fill(0.0); // x -> y, y -> -x, z -> z, then tilted about the first axis
  direction[1][0] = 0.8;
  direction[2][0] = 0.6;
  direction[0][1] = -1.0;
  direction[1][2] = -0.6;
  direction[2][2] = 0.8;
  image->SetDirection(direction);
  const double origin[3] = { 10.0, -20.0, 5.0 };
  image->SetOrigin(origin);
  auto filter = MedialFilter<3>::New();
  filter->SetInput(image);
  filter->GenerateVectorDistanceOn();
  filter->Update();

  const auto * labels = filter->GetOutput();
  EXPECT_EQ(labels->GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
  EXPECT_EQ(labels->GetSpacing(), image->GetSpacing());
  EXPECT_EQ(labels->GetDirection(), image->GetDirection());
  EXPECT_NEAR(labels->GetOrigin()[0], 10.0 - 0.45, 1e-12);
  EXPECT_NEAR(labels->GetOrigin()[1], -20.0 + 0.4 * 0.8 - 0.6 * 0.6, 1e-12);
  EXPECT_NEAR(labels->GetOrigin()[2], 5.0 + 0.4 * 0.6 + 0.6 * 0.8, 1e-12);

  const auto * vectors = filter->GetVectorDistanceOutput();
  EXPECT_EQ(vectors->GetOrigin(), image->GetOrigin());
  EXPECT_EQ(vectors->GetSpacing(), image->GetSpacing());
  EXPECT_EQ(vectors->GetDirection(), image->GetDirection());
  EXPECT_EQ(vectors->GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
}

TEST(MedialVoxelImageFilter, AxesOfLengthOneAreNotShifted)
{
  auto filter = MakeMedialFilter<3>(RandomVolume({ { 9, 1, 7 } }, { { 2.0, 3.0, 4.0 } }, 0.6, 82), 3.0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetOrigin()[0], 1.0);
  EXPECT_EQ(filter->GetOutput()->GetOrigin()[1], 0.0);
  EXPECT_EQ(filter->GetOutput()->GetOrigin()[2], 2.0);
}

TEST(MedialVoxelImageFilter, VectorsAreDisplacementsInSpace)
{
  const Volume                volume = SmallPart();
  auto                        image = MakeImage<MaskImage<3>>(volume, 4);
  MaskImage<3>::DirectionType direction;
  direction.Fill(0.0);
  direction[0][1] = 0.6;
  direction[0][2] = -0.8;
  direction[1][0] = 1.0;
  direction[2][1] = 0.8;
  direction[2][2] = 0.6;
  image->SetDirection(direction);
  auto filter = MedialFilter<3>::New();
  filter->SetInput(image);
  filter->GenerateVectorDistanceOn();
  filter->SetVectorDistanceBoundary(itk::MedialVoxelBoundary::Background);
  filter->Update();
  const auto  sites = BoundarySites(volume);
  const auto  nearest = NearestBoundaryPoints(volume, sites);
  std::size_t i = 0;
  itk::ImageRegionConstIteratorWithIndex<MedialFilter<3>::VectorImageType> it(filter->GetVectorDistanceOutput(),
                                                                              image->GetLargestPossibleRegion());
  for (; !it.IsAtEnd(); ++it, ++i)
  {
    if (volume.object[i] == 0)
    {
      ASSERT_EQ(NormOf(it.Get()), 0.0);
      continue;
    }
    itk::Point<double, 3> from;
    itk::Point<double, 3> to;
    itk::Index<3>         site;
    for (int axis = 0; axis < 3; ++axis)
    {
      site[axis] = sites[nearest[i]][axis] + 4;
    }
    image->TransformIndexToPhysicalPoint(it.GetIndex(), from);
    image->TransformIndexToPhysicalPoint(site, to);
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_NEAR(from[axis] + it.Get()[axis], to[axis], 1e-5);
    }
  }
}

TEST(MedialVoxelImageFilter, VectorOutputComesAndGoes)
{
  auto filter = MakeMedialFilter<3>(SmallPart(), 3.0);
  EXPECT_EQ(filter->GetNumberOfOutputs(), 1u);
  filter->Update();
  const auto labels = PixelsOf(filter->GetOutput());
  filter->GenerateVectorDistanceOn();
  ASSERT_NE(filter->GetVectorDistanceOutput(), nullptr);
  EXPECT_EQ(filter->GetNumberOfOutputs(), 2u);
  EXPECT_EQ(filter->GetNumberOfIndexedOutputs(), 1u);
  filter->Update();
  EXPECT_EQ(filter->GetVectorDistanceOutput()->GetBufferedRegion(), filter->GetOutput()->GetBufferedRegion());
  EXPECT_EQ(PixelsOf(filter->GetOutput()), labels);
  filter->GenerateVectorDistanceOff();
  EXPECT_EQ(filter->GetVectorDistanceOutput(), nullptr);
  EXPECT_EQ(filter->GetNumberOfOutputs(), 1u);
  filter->Update();
  EXPECT_EQ(PixelsOf(filter->GetOutput()), labels);
}

TEST(MedialVoxelImageFilter, ARequestOnEitherOutputIsARequestOnBoth)
{
  auto filter = MakeMedialFilter<3>(SmallPart(), 3.0);
  filter->GenerateVectorDistanceOn();
  filter->UpdateOutputInformation();
  const itk::ImageRegion<3> first({ { 2, 3, 4 } }, { { 5, 4, 3 } });
  filter->GetVectorDistanceOutput()->SetRequestedRegion(first);
  filter->GetVectorDistanceOutput()->PropagateRequestedRegion();
  filter->GetVectorDistanceOutput()->UpdateOutputData();
  EXPECT_EQ(filter->GetOutput()->GetBufferedRegion(), first);
  EXPECT_EQ(filter->GetVectorDistanceOutput()->GetBufferedRegion(), first);
  const itk::ImageRegion<3> second({ { 0, 0, 0 } }, { { 3, 3, 3 } });
  filter->GetOutput()->SetRequestedRegion(second);
  filter->GetOutput()->PropagateRequestedRegion();
  filter->GetOutput()->UpdateOutputData();
  EXPECT_EQ(filter->GetOutput()->GetBufferedRegion(), second);
  EXPECT_EQ(filter->GetVectorDistanceOutput()->GetBufferedRegion(), second);
}

TEST(MedialVoxelImageFilter, CountsStartAnewWithEachUpdate)
{
  auto         filter = MakeMedialFilter<3>(SmallPart(), 3.0);
  const Counts expected = Classify(SmallPart(), 3.0, Bound::FreeSpace).counts;
  filter->Update();
  EXPECT_EQ(CountsOf(filter.GetPointer()), expected);
  filter->Update(); // executes nothing
  EXPECT_EQ(CountsOf(filter.GetPointer()), expected);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(CountsOf(filter.GetPointer()), expected);
  filter->UpdateOutputInformation(); // starts no sum before data are made
  EXPECT_EQ(CountsOf(filter.GetPointer()), expected);
}

TEST(MedialVoxelImageFilter, CountsOfStreamedPiecesAddUp)
{
  auto         filter = MakeMedialFilter<3>(SmallPart(), 3.0);
  const Counts expected = Classify(SmallPart(), 3.0, Bound::FreeSpace).counts;
  auto         streamer = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
  streamer->SetInput(filter->GetOutput());
  streamer->SetNumberOfStreamDivisions(5);
  for (int run = 0; run < 3; ++run)
  {
    streamer->Modified();
    filter->Modified();
    streamer->Update();
    EXPECT_EQ(CountsOf(filter.GetPointer()), expected) << "run " << run;
  }
}

TEST(MedialVoxelImageFilter, CountsAreThoseOfTheRequestedRegion)
{
  const Volume              volume = SmallPart();
  const auto                whole = Classify(volume, 3.0, Bound::FreeSpace);
  const auto                sites = BoundarySites(volume);
  const itk::ImageRegion<3> request({ { 3, 2, 4 } }, { { 6, 7, 5 } });
  auto                      filter = MakeMedialFilter<3>(volume, 3.0);
  filter->GetOutput()->SetRequestedRegion(request);
  filter->Update();
  Counts     expected;
  const auto isInside = [&](const Index3 & v) { return request.IsInside(itk::Index<3>{ { v[0], v[1], v[2] } }); };
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    const Index3 v = volume.IndexAt(i);
    expected.objectVoxels += isInside(v) && volume.object[i] ? 1 : 0;
    expected.candidateCells += isInside(v) && whole.labels[i] > 0 ? 1 : 0;
    expected.boundCells += isInside(v) && whole.labels[i] == 2 ? 1 : 0;
    expected.geodesicMedialCells += isInside(v) && whole.labels[i] == 3 ? 1 : 0;
  }
  expected.boundaryVoxels = static_cast<std::uint64_t>(std::count_if(sites.begin(), sites.end(), isInside));
  const Counts actual = CountsOf(filter.GetPointer());
  expected.trivialCells = actual.trivialCells; // not visible in the labels; the sum below holds them
  expected.geodesicNonMedialCells = actual.geodesicNonMedialCells;
  EXPECT_EQ(actual, expected);
  EXPECT_EQ(actual.trivialCells + actual.boundCells + actual.geodesicMedialCells + actual.geodesicNonMedialCells,
            actual.candidateCells);
}

TEST(MedialVoxelImageFilter, OtherOutputTypesHoldTheSameLabels)
{
  auto filter = itk::MedialVoxelImageFilter<MaskImage<3>, itk::Image<unsigned short, 3>>::New();
  filter->SetInput(MakeImage<MaskImage<3>>(SmallPart()));
  filter->Update();
  const auto expected = Classify(SmallPart(), 3.0, Bound::FreeSpace).labels;
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), std::vector<unsigned short>(expected.begin(), expected.end())));
}

TEST(MedialVoxelImageFilter, AnInputWithoutSourceIsUsedWhereItLies)
{
  auto image = MakeImage<MaskImage<3>>(SmallPart());
  auto filter = MedialFilter<3>::New();
  filter->SetInput(image);
  filter->Update();
  EXPECT_EQ(image->GetBufferedRegion(), image->GetLargestPossibleRegion());
  EXPECT_EQ(VolumeOf(image.GetPointer(), 1.0).object, SmallPart().object);
}

TEST(MedialVoxelImageFilter, SpacingDoesNotMatterInVoxelUnits)
{
  auto filter = MakeMedialFilter<3>(SmallPart(), 2.5);
  filter->UseImageSpacingOff();
  filter->Update();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), RunMedialFilter<3>(InVoxelUnits(SmallPart()), 2.5).labels));
  EXPECT_NE(PixelsOf(filter->GetOutput()), RunMedialFilter<3>(SmallPart(), 2.5).labels);
}
