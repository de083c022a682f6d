// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The same bytes for any thread count, tile, slab, division and requested region (invariant I2).

#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelFilterAccess.h"
#include "itkImageRegionSplitterDirection.h"
#include "itkImageRegionSplitterMultidimensional.h"
#include "itkImageRegionSplitterSlowDimension.h"
#include "itkStreamingImageFilter.h"

namespace
{
using namespace MedialVoxelTest;

struct Subject
{
  std::string name;
  Volume      volume;
  double      thickness;
};

/** Thin walls, thick solids, voxels far from any boundary, rows longer than a word, both kinds of spacing. */
std::vector<Subject>
Subjects()
{
  const Vector3 cranium{ { 0.9570312, 0.9570312, 1.5 } };
  return { { "boxes", RandomBoxes({ { 75, 37, 29 } }, UnitSpacing, 30, 71), 3.0 },
           { "boxes, cranium spacing", RandomBoxes({ { 41, 33, 30 } }, cranium, 25, 72), 3.0 },
           { "boxes, long paths", RandomBoxes({ { 40, 31, 28 } }, UnitSpacing, 25, 73), 7.0 },
           { "solid with one hole",
             MakeVolume({ { 40, 35, 38 } }, UnitSpacing, [](const Index3 & v) { return v != Index3{ { 2, 3, 1 } }; }),
             3.0 },
           { "lattice", LatticeOfHoles({ { 35, 24, 23 } }, UnitSpacing, 5), 2.0 } };
}

using Vectors = MedialFilter<3>::VectorImageType;
using Thicknesses = MedialFilter<3>::ThicknessImageType;

MedialFilter<3>::Pointer
MakeFilter(const Subject & subject)
{
  auto filter = MakeMedialFilter<3>(subject.volume, subject.thickness);
  filter->GenerateVectorDistanceOn();
  filter->SetVectorDistanceBoundary(itk::MedialVoxelBoundary::Background);
  filter->GenerateThicknessOn();
  return filter;
}

/** Everything an execution leaves behind. */
struct Outcome
{
  std::vector<unsigned char>         labels;
  std::vector<itk::Vector<float, 3>> vectors;
  std::vector<float>                 thicknesses;
  Counts                             counts;
};

Outcome
OutcomeOf(MedialFilter<3> * filter)
{
  filter->UpdateLargestPossibleRegion();
  return { PixelsOf(filter->GetOutput()),
           PixelsOf(filter->GetVectorDistanceOutput()),
           PixelsOf(filter->GetThicknessOutput()),
           CountsOf(filter) };
}

void
ExpectSame(const Outcome & actual, const Outcome & expected)
{
  EXPECT_TRUE(AreEqual(actual.labels, expected.labels));
  EXPECT_TRUE(VectorsAreEqual(actual.vectors, expected.vectors));
  EXPECT_TRUE(AreEqual(actual.thicknesses, expected.thicknesses));
  EXPECT_EQ(actual.counts, expected.counts);
}

/** Disjoint boxes that fill a region, cut at random, in random order. */
std::vector<itk::ImageRegion<3>>
RandomPieces(const itk::ImageRegion<3> & whole, int cuts, unsigned int seed)
{
  std::mt19937                     generator(seed);
  std::vector<itk::ImageRegion<3>> pieces{ whole };
  for (int cut = 0; cut < cuts; ++cut)
  {
    auto &     piece = pieces[generator() % pieces.size()];
    const auto axis = generator() % 3;
    const auto length = piece.GetSize(axis);
    if (length > 1)
    {
      const auto first = 1 + generator() % (length - 1);
      auto       rest = piece;
      rest.SetIndex(axis, piece.GetIndex(axis) + static_cast<itk::IndexValueType>(first));
      rest.SetSize(axis, length - first);
      piece.SetSize(axis, first);
      pieces.push_back(rest);
    }
  }
  std::shuffle(pieces.begin(), pieces.end(), generator);
  return pieces;
}

/** Copies what a filter produced for a region into whole-image arrays. */
void
CopyPiece(MedialFilter<3> * filter, const Volume & volume, const itk::ImageRegion<3> & region, Outcome & to)
{
  itk::ImageRegionConstIteratorWithIndex<MaskImage<3>> label(filter->GetOutput(), region);
  itk::ImageRegionConstIteratorWithIndex<Vectors>      vector(filter->GetVectorDistanceOutput(), region);
  itk::ImageRegionConstIteratorWithIndex<Thicknesses>  thickness(filter->GetThicknessOutput(), region);
  for (; !label.IsAtEnd(); ++label, ++vector, ++thickness)
  {
    const auto   index = label.GetIndex();
    const Index3 v{ { static_cast<int>(index[0]), static_cast<int>(index[1]), static_cast<int>(index[2]) } };
    to.labels[volume.Offset(v)] = label.Get();
    to.vectors[volume.Offset(v)] = vector.Get();
    to.thicknesses[volume.Offset(v)] = thickness.Get();
  }
}
} // namespace

TEST(MedialVoxelIdentity, WorkUnitsDoNotMatter)
{
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    auto reference = MakeFilter(subject);
    reference->SetNumberOfWorkUnits(1);
    const Outcome expected = OutcomeOf(reference);
    EXPECT_EQ(expected.labels, RunMedialFilter<3>(subject.volume, subject.thickness).labels);
    for (const unsigned int units : { 2u, 5u, 64u })
    {
      auto filter = MakeFilter(subject);
      filter->SetNumberOfWorkUnits(units);
      ExpectSame(OutcomeOf(filter), expected);
    }
  }
}

TEST(MedialVoxelIdentity, ThreadersDoNotMatter)
{
  const Subject subject = Subjects()[0];
  const Outcome expected = OutcomeOf(MakeFilter(subject));
  for (const unsigned int threads : { 1u, 2u, 5u })
  {
    auto filter = MakeFilter(subject);
    filter->GetMultiThreader()->SetMaximumNumberOfThreads(threads);
    filter->GetMultiThreader()->SetNumberOfWorkUnits(threads);
    ExpectSame(OutcomeOf(filter), expected);
  }
}

TEST(MedialVoxelIdentity, TilesAndSlabsDoNotMatter)
{
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    const Outcome expected = OutcomeOf(MakeFilter(subject));
    for (const auto & sizes : { std::make_pair(1u, 1u), { 5u, 3u }, { 8u, 64u }, { 64u, 2u }, { 200u, 200u } })
    {
      SCOPED_TRACE("tile " + std::to_string(sizes.first) + ", slab " + std::to_string(sizes.second));
      auto filter = MakeFilter(subject);
      itk::MedialVoxelFilterAccess::SetTileSize(*filter, sizes.first);
      itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, sizes.second);
      ExpectSame(OutcomeOf(filter), expected);
    }
  }
}

TEST(MedialVoxelIdentity, DisjointRequestsInAnyOrderGiveTheWhole)
{
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    const Outcome expected = OutcomeOf(MakeFilter(subject));
    for (const unsigned int seed : { 1u, 2u })
    {
      auto    filter = MakeFilter(subject);
      Outcome actual = expected;
      std::fill(actual.labels.begin(), actual.labels.end(), 77);
      std::fill(actual.thicknesses.begin(), actual.thicknesses.end(), -1.0f);
      filter->UpdateOutputInformation();
      for (const auto & piece : RandomPieces(filter->GetOutput()->GetLargestPossibleRegion(), 11, seed))
      {
        filter->GetOutput()->SetRequestedRegion(piece);
        filter->GetOutput()->PropagateRequestedRegion();
        filter->GetOutput()->UpdateOutputData();
        EXPECT_EQ(filter->GetOutput()->GetBufferedRegion(), piece);
        EXPECT_EQ(filter->GetVectorDistanceOutput()->GetBufferedRegion(), piece);
        CopyPiece(filter, subject.volume, piece, actual);
      }
      actual.counts = CountsOf(filter.GetPointer());
      ExpectSame(actual, expected);
    }
  }
}

TEST(MedialVoxelIdentity, SingleVoxelRequestsAgreeWithTheWhole)
{
  const Subject subject = Subjects()[1];
  const Outcome expected = OutcomeOf(MakeFilter(subject));
  auto          filter = MakeFilter(subject);
  Outcome       actual = expected;
  filter->UpdateOutputInformation();
  for (std::size_t i = 0; i < subject.volume.object.size(); i += 997)
  {
    const Index3              v = subject.volume.IndexAt(i);
    const itk::ImageRegion<3> request({ { v[0], v[1], v[2] } }, { { 1, 1, 1 } });
    actual.labels[i] = 77;
    actual.thicknesses[i] = -1.0f;
    filter->GetOutput()->SetRequestedRegion(request);
    filter->GetOutput()->PropagateRequestedRegion();
    filter->GetOutput()->UpdateOutputData();
    CopyPiece(filter, subject.volume, request, actual);
  }
  EXPECT_TRUE(AreEqual(actual.labels, expected.labels));
  EXPECT_TRUE(VectorsAreEqual(actual.vectors, expected.vectors));
  EXPECT_TRUE(AreEqual(actual.thicknesses, expected.thicknesses));
}

TEST(MedialVoxelIdentity, StreamedPiecesGiveTheWhole)
{
  std::vector<itk::ImageRegionSplitterBase::Pointer> splitters;
  splitters.emplace_back(itk::ImageRegionSplitterSlowDimension::New().GetPointer());
  splitters.emplace_back(itk::ImageRegionSplitterMultidimensional::New().GetPointer());
  auto alongX = itk::ImageRegionSplitterDirection::New();
  alongX->SetDirection(2); // not split along z
  splitters.emplace_back(alongX.GetPointer());
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    const Outcome expected = OutcomeOf(MakeFilter(subject));
    for (const auto & splitter : splitters)
    {
      for (const unsigned int divisions : { 2u, 7u, 27u })
      {
        SCOPED_TRACE(std::string(splitter->GetNameOfClass()) + ", divisions " + std::to_string(divisions));
        auto filter = MakeFilter(subject);
        auto streamer = itk::StreamingImageFilter<MaskImage<3>, MaskImage<3>>::New();
        streamer->SetInput(filter->GetOutput());
        streamer->SetRegionSplitter(splitter);
        streamer->SetNumberOfStreamDivisions(divisions);
        streamer->Update();
        EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), expected.labels));
        EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
      }
    }
  }
}

TEST(MedialVoxelIdentity, StreamedVectorsGiveTheWhole)
{
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    auto filter = MakeFilter(subject);
    auto streamer = itk::StreamingImageFilter<Vectors, Vectors>::New();
    streamer->SetInput(filter->GetVectorDistanceOutput());
    streamer->SetNumberOfStreamDivisions(6);
    streamer->Update();
    EXPECT_TRUE(VectorsAreEqual(PixelsOf(streamer->GetOutput()), OutcomeOf(MakeFilter(subject)).vectors));
  }
}

TEST(MedialVoxelIdentity, StreamedDistanceMapsGiveTheWhole)
{
  for (const Subject & subject : Subjects())
  {
    SCOPED_TRACE(subject.name);
    auto whole = VectorFilter<3>::New();
    whole->SetInput(MakeImage<MaskImage<3>>(subject.volume));
    whole->Update();
    auto filter = VectorFilter<3>::New();
    filter->SetInput(MakeImage<MaskImage<3>>(subject.volume));
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, 9);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 4);
    auto streamer =
      itk::StreamingImageFilter<VectorFilter<3>::OutputImageType, VectorFilter<3>::OutputImageType>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(9);
    streamer->SetRegionSplitter(itk::ImageRegionSplitterMultidimensional::New());
    streamer->Update();
    EXPECT_TRUE(VectorsAreEqual(PixelsOf(streamer->GetOutput()), PixelsOf(whole->GetOutput())));
  }
}

TEST(MedialVoxelIdentity, PlaneImagesAreTheSameInPieces)
{
  const Volume volume = RandomBoxes({ { 90, 61, 1 } }, { { 0.6, 1.0, 1.0 } }, 30, 74);
  const auto   expected = RunMedialFilter<2>(volume, 3.0);
  for (const unsigned int divisions : { 2u, 5u, 16u })
  {
    auto filter = MakeMedialFilter<2>(volume, 3.0);
    itk::MedialVoxelFilterAccess::SetTileSize(*filter, 7);
    itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 5);
    auto streamer = itk::StreamingImageFilter<MaskImage<2>, MaskImage<2>>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetRegionSplitter(itk::ImageRegionSplitterMultidimensional::New());
    streamer->SetNumberOfStreamDivisions(divisions);
    streamer->Update();
    EXPECT_TRUE(AreEqual(PixelsOf(streamer->GetOutput()), expected.labels));
    EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
  }
}

TEST(MedialVoxelIdentity, ThinObjectsAreReadInWindowsByTheCallingThread)
{
  const Volume volume = AxisPlate({ { 24, 20, 120 } }, UnitSpacing, 1, 8, 3);
  auto         source = RecordingSource<MaskImage<3>>::New();
  source->SetImage(MakeImage<MaskImage<3>>(volume));
  auto filter = MedialFilter<3>::New();
  filter->SetInput(source->GetOutput());
  filter->SetThickness(3.0);
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, 8);
  filter->UpdateLargestPossibleRegion();
  EXPECT_TRUE(AreEqual(PixelsOf(filter->GetOutput()), RunMedialFilter<3>(volume, 3.0).labels));
  EXPECT_GT(source->GetRequests().size(), 4u);
  EXPECT_TRUE(source->WasAskedByOneThread());
  EXPECT_LT(source->GetLargestRequest(), volume.object.size() / 3);
}

TEST(MedialVoxelIdentity, GrowingWindowsReachFarBoundaries)
{
  // The only boundary lies at the far end of a solid, 60 slices away from the requested slice.
  const Volume volume = AxisPlate({ { 9, 8, 64 } }, UnitSpacing, 2, 2, 62);
  auto         source = RecordingSource<MaskImage<3>>::New();
  source->SetImage(MakeImage<MaskImage<3>>(volume));
  auto filter = VectorFilter<3>::New();
  filter->SetInput(source->GetOutput());
  filter->SetBoundary(itk::MedialVoxelBoundary::Background);
  filter->UpdateOutputInformation();
  const itk::ImageRegion<3> request({ { 2, 3, 63 } }, { { 4, 2, 1 } });
  filter->GetOutput()->SetRequestedRegion(request);
  filter->GetOutput()->PropagateRequestedRegion();
  filter->GetOutput()->UpdateOutputData();
  for (const auto & vector : PixelsOf(filter->GetOutput()))
  {
    EXPECT_EQ(vector[0], 0.0f);
    EXPECT_EQ(vector[1], 0.0f);
    EXPECT_EQ(vector[2], -62.0f);
  }
  EXPECT_GT(source->GetRequests().size(), 1u);
  EXPECT_TRUE(source->WasAskedByOneThread());
}

TEST(MedialVoxelIdentity, WhatIsKeptBetweenPiecesNeverOutlivesItsReason)
{
  // Piece by piece through one filter, while input, thresholds, thickness and spacing change between the pieces.
  using ImageType = itk::Image<short, 3>;
  const Volume first = RandomBoxes({ { 36, 30, 40 } }, UnitSpacing, 20, 75);
  const Volume second = RandomBoxes({ { 36, 30, 40 } }, { { 1.0, 1.0, 1.5 } }, 20, 76);
  auto         source = RecordingSource<ImageType>::New();
  auto         filter = itk::MedialVoxelImageFilter<ImageType>::New();
  source->SetImage(MakeImage<ImageType>(first, 0, 100, 10));
  filter->SetInput(source->GetOutput());
  filter->SetLowerThreshold(50);
  const auto expectPiece = [&](int z, const Volume & volume, double thickness) {
    filter->GetOutput()->SetRequestedRegion(itk::ImageRegion<3>({ { 0, 0, z } }, { { 36, 30, 6 } }));
    filter->Update();
    const auto labels = RunMedialFilter<3>(volume, thickness).labels;
    const auto slice = static_cast<std::ptrdiff_t>(36 * 30);
    EXPECT_TRUE(
      AreEqual(PixelsOf(filter->GetOutput()), { labels.begin() + z * slice, labels.begin() + (z + 6) * slice }))
      << "piece at " << z;
  };
  expectPiece(0, first, 3.0);
  expectPiece(6, first, 3.0);
  source->SetImage(MakeImage<ImageType>(second, 0, 100, 10));
  expectPiece(12, second, 3.0);
  filter->SetLowerThreshold(5); // all is object
  expectPiece(18, MakeVolume(second.size, second.spacing, [](const Index3 &) { return true; }), 3.0);
  filter->SetLowerThreshold(50);
  filter->SetThickness(6.0);
  expectPiece(22, second, 6.0);
  filter->UseImageSpacingOff();
  expectPiece(26, InVoxelUnits(second), 6.0);
  source->SetImage(MakeImage<ImageType>(first, 0, 100, 10));
  expectPiece(34, first, 6.0);
  expectPiece(0, first, 6.0);
}
