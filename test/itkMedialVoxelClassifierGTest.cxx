// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelClassifier.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelClassifier;

class AbortAfterRows : public itk::MedialVoxelProgress
{
public:
  explicit AbortAfterRows(int rows)
    : m_Rows(rows)
  {}
  bool
  IsAborted() const override
  {
    return m_Asked++ >= m_Rows;
  }
  void
  Advance(std::uint64_t) override
  {}
  int
  GetAsked() const
  {
    return m_Asked;
  }

private:
  int         m_Rows;
  mutable int m_Asked{ 0 };
};

/** Everything that a classifier reads, by brute force. */
struct Inputs
{
  Volume              volume;
  std::vector<Index3> sites;
  std::vector<long>   nearest;

  explicit Inputs(Volume v)
    : volume(std::move(v))
    , sites(BoundarySites(volume))
    , nearest(NearestBoundaryPoints(volume, sites))
  {}

  itk::MedialVoxelFeatures
  Features(const itk::MedialVoxelBox & box) const
  {
    itk::MedialVoxelFeatures features;
    features.Reset(box);
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & index) {
      const Index3 v = OracleIndex(index);
      const auto   i = features.OffsetOf(index[0], index[1], index[2]);
      if (volume.IsObject(v))
      {
        const long n = nearest[volume.Offset(v)];
        features.dx[i] = n < 0 ? itk::MedialVoxelNoDisplacement : sites[n][0] - v[0];
        features.dy[i] = n < 0 ? itk::MedialVoxelNoDisplacement : sites[n][1] - v[1];
        features.dz[i] = n < 0 ? itk::MedialVoxelNoDisplacement : sites[n][2] - v[2];
      }
    });
    return features;
  }
};

itk::MedialVoxelParameters
ParametersOf(double thickness, itk::MedialVoxelPseudoGeodesicBound bound)
{
  itk::MedialVoxelParameters parameters;
  parameters.epsilon = EpsilonOf(thickness);
  parameters.bound = bound;
  return parameters;
}

std::vector<Inputs>
Cases()
{
  std::vector<Inputs> cases;
  cases.emplace_back(RandomBoxes({ { 75, 9, 8 } }, UnitSpacing, 14, 191));
  cases.emplace_back(RandomVolume({ { 12, 11, 10 } }, { { 0.7, 1.1, 1.3 } }, 0.8, 192));
  cases.emplace_back(RandomVolume({ { 30, 1, 25 } }, UnitSpacing, 0.85, 193));
  cases.emplace_back(RandomVolume({ { 30, 25, 1 } }, { { 0.7, 1.1, 1.3 } }, 0.85, 194));
  cases.emplace_back(Complement(Volume({ { 9, 8, 7 } }, UnitSpacing)));
  return cases;
}
} // namespace

TEST(MedialVoxelClassifier, TilesAreTheDefinitions)
{
  const itk::MedialVoxelNoProgress progress;
  MedialVoxelClassifier::Workspace workspace;
  for (const Inputs & inputs : Cases())
  {
    const auto image = GridOf(inputs.volume).GetVoxelBox();
    const auto object = ObjectBits(inputs.volume, image);
    const auto bits = SiteBits(inputs.sites, image);
    for (const auto & bound : { std::make_pair(Bound::FreeSpace, itk::MedialVoxelPseudoGeodesicBound::FreeSpace),
                                { Bound::Paper, itk::MedialVoxelPseudoGeodesicBound::Paper },
                                { Bound::Off, itk::MedialVoxelPseudoGeodesicBound::Off } })
    {
      const auto                  expected = Classify(inputs.volume, 2.5, bound.first);
      const MedialVoxelClassifier classifier(GridOf(inputs.volume), ParametersOf(2.5, bound.second));
      itk::MedialVoxelCounts      sum;
      std::mt19937                generator(7);
      for (const auto & tile :
           { image, RandomBox(inputs.volume.size, generator), RandomBox(inputs.volume.size, generator) })
      {
        std::vector<std::uint8_t> labels;
        itk::MedialVoxelCounts    counts;
        const auto                voxels = classifier.GetVoxelBox(tile);
        EXPECT_EQ(voxels, tile.Expanded({ { 1, 1, 1 } }).Intersection(image).Intersection({ tile.lower, image.upper }));
        EXPECT_TRUE(
          classifier.Classify({ &object, &bits }, tile, inputs.Features(voxels), progress, workspace, labels, counts)
            .IsEmpty());
        std::vector<std::uint8_t> wanted;
        ForEachVoxel(tile, [&](const itk::MedialVoxelIndex & v) {
          wanted.push_back(expected.labels[inputs.volume.Offset(OracleIndex(v))]);
        });
        EXPECT_EQ(labels, wanted);
        EXPECT_EQ(counts.candidateCells,
                  counts.trivialCells + counts.boundCells + counts.geodesicMedialCells + counts.geodesicNonMedialCells);
        if (tile == image)
        {
          EXPECT_EQ(counts.candidateCells, expected.counts.candidateCells);
          EXPECT_EQ(counts.trivialCells, expected.counts.trivialCells);
          EXPECT_EQ(counts.boundCells, expected.counts.boundCells);
          EXPECT_EQ(counts.geodesicMedialCells, expected.counts.geodesicMedialCells);
          EXPECT_EQ(counts.geodesicNonMedialCells, expected.counts.geodesicNonMedialCells);
        }
      }
    }
  }
}

TEST(MedialVoxelClassifier, SmallWindowsSayWhatTheyMiss)
{
  const itk::MedialVoxelNoProgress progress;
  MedialVoxelClassifier::Workspace workspace;
  const Inputs                     inputs(AxisPlate({ { 40, 40, 20 } }, UnitSpacing, 2, 8, 4));
  const auto                       image = GridOf(inputs.volume).GetVoxelBox();
  const auto                       object = ObjectBits(inputs.volume, image);
  const auto                       tile = MakeBox({ { 16, 16, 9 } }, { { 20, 20, 11 } });
  const MedialVoxelClassifier      classifier(GridOf(inputs.volume),
                                         ParametersOf(6.0, itk::MedialVoxelPseudoGeodesicBound::Off));
  const auto                       features = inputs.Features(classifier.GetVoxelBox(tile));
  std::vector<std::uint8_t>        labels;
  itk::MedialVoxelCounts           counts;
  const auto                       small = SiteBits(inputs.sites, tile.Expanded({ { 2, 2, 4 } }));
  const auto missing = classifier.Classify({ &object, &small }, tile, features, progress, workspace, labels, counts);
  ASSERT_FALSE(missing.IsEmpty());
  const auto             enough = SiteBits(inputs.sites, missing.Union(small.GetBox()).Intersection(image));
  itk::MedialVoxelCounts second;
  EXPECT_TRUE(classifier.Classify({ &object, &enough }, tile, features, progress, workspace, labels, second).IsEmpty());
  EXPECT_EQ(second.geodesicMedialCells, 16u); // the mid-plane of four layers lies between z = 9 and 10
}

TEST(MedialVoxelClassifier, StopsBeforeTheNextRowWhenAborted)
{
  MedialVoxelClassifier::Workspace workspace;
  const Inputs                     inputs(RandomBoxes({ { 20, 9, 8 } }, UnitSpacing, 9, 195));
  const auto                       image = GridOf(inputs.volume).GetVoxelBox();
  const auto                       object = ObjectBits(inputs.volume, image);
  const auto                       bits = SiteBits(inputs.sites, image);
  const MedialVoxelClassifier      classifier(GridOf(inputs.volume),
                                         ParametersOf(3.0, itk::MedialVoxelPseudoGeodesicBound::FreeSpace));
  std::vector<std::uint8_t>        labels;
  itk::MedialVoxelCounts           counts;
  itk::MedialVoxelCounts           all;
  const AbortAfterRows             soon(3);
  const itk::MedialVoxelNoProgress never;
  classifier.Classify({ &object, &bits }, image, inputs.Features(image), soon, workspace, labels, counts);
  classifier.Classify({ &object, &bits }, image, inputs.Features(image), never, workspace, labels, all);
  EXPECT_EQ(soon.GetAsked(), 4);
  EXPECT_LT(counts.candidateCells, all.candidateCells);
}
