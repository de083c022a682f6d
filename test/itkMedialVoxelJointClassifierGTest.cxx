// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelClassifier.h"

#include "MedialVoxelTestAutomatic.h"
#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;
using itk::MedialVoxelClassifier;
using BoundEnum = itk::MedialVoxelPseudoGeodesicBound;
using Labels = std::vector<unsigned char>;

itk::MedialVoxelParameters
ParametersOf(const WallLimits & limits, BoundEnum bound)
{
  auto parameters = itk::MedialVoxelParameters::ForWalls(limits.minimum, limits.maximum, bound);
  parameters.thicknessFactor = limits.factor;
  return parameters;
}

/** Everything that a classifier reads of a volume. */
struct Inputs
{
  Volume               volume;
  itk::MedialVoxelGrid grid;
  itk::MedialVoxelBits object;
  itk::MedialVoxelBits sites;

  explicit Inputs(Volume v)
    : volume(std::move(v))
    , grid(GridOf(volume))
    , object(ObjectBits(volume, grid.GetVoxelBox()))
    , sites(SiteBits(BoundarySites(volume), grid.GetVoxelBox()))
  {}

  itk::MedialVoxelFeatures
  Features(const itk::MedialVoxelBox & box, const itk::MedialVoxelBits * asked = nullptr) const
  {
    const itk::MedialVoxelFeatureTransform      transform(grid);
    itk::MedialVoxelFeatureTransform::Workspace workspace;
    itk::MedialVoxelFeatures                    features;
    EXPECT_TRUE(transform.Compute({ &object, &sites, asked }, box, workspace, features).IsEmpty());
    return features;
  }

  Labels
  Classify(const MedialVoxelClassifier & classifier,
           const itk::MedialVoxelBox &   tile,
           itk::MedialVoxelCounts &      counts) const
  {
    const itk::MedialVoxelNoProgress progress;
    MedialVoxelClassifier::Workspace workspace;
    Labels                           labels;
    const auto                       window = classifier.FindAsked({ &object, &sites }, tile, false, workspace);
    const auto                       voxels = classifier.GetFeatureBox(window, tile, workspace);
    EXPECT_TRUE(
      classifier.Classify(window, tile, Features(voxels, window.asked), progress, workspace, labels, counts).IsEmpty());
    this->ExpectSameWithAllVoxels(classifier, tile, labels);
    return labels;
  }

  /** The balls of all cells. */
  std::vector<itk::MedialVoxelInscribedBall>
  FindBalls(const MedialVoxelClassifier & classifier) const
  {
    const auto &                               threshold = classifier.GetThreshold();
    const auto                                 features = this->Features(grid.GetVoxelBox());
    std::vector<itk::MedialVoxelInscribedBall> balls;
    ForEachVoxel(grid.GetCellBox(), [&](const itk::MedialVoxelIndex & cell) {
      const double radius = threshold.FindRadius(features, cell);
      if (threshold.CanRaise(radius))
      {
        balls.push_back({ cell, radius });
      }
    });
    return balls;
  }

  /** What no ball reaches from changes nothing. */
  void
  ExpectSameWithAllVoxels(const MedialVoxelClassifier & classifier,
                          const itk::MedialVoxelBox &   tile,
                          const Labels &                labels) const
  {
    const itk::MedialVoxelNoProgress progress;
    MedialVoxelClassifier::Workspace workspace;
    itk::MedialVoxelCounts           counts;
    Labels                           all;
    const auto                       features = this->Features(classifier.GetVoxelBox(tile));
    EXPECT_TRUE(classifier.Classify({ &object, &sites }, tile, features, progress, workspace, all, counts).IsEmpty());
    EXPECT_EQ(all, labels);
  }

  Labels
  Classify(const WallLimits & limits, BoundEnum bound = BoundEnum::FreeSpace) const
  {
    itk::MedialVoxelCounts counts;
    return Classify(MedialVoxelClassifier(grid, ParametersOf(limits, bound)), grid.GetVoxelBox(), counts);
  }
};

struct Case
{
  Inputs     inputs;
  WallLimits limits;
};

/** Thin and thick walls, corners, cavities and noise; the factors keep thresholds away from path lengths. */
std::vector<Case>
Cases()
{
  const Vector3     unequal{ { 0.7, 1.1, 1.3 } };
  std::vector<Case> cases;
  cases.push_back({ Inputs(RandomBoxes({ { 30, 19, 18 } }, UnitSpacing, 14, 501)), { 3.0, 9.0, 2.9 } });
  cases.push_back({ Inputs(RandomBoxes({ { 24, 21, 20 } }, { { 0.5, 0.5, 0.5 } }, 11, 502)), { 1.0, 16.0, 2.3 } });
  cases.push_back({ Inputs(RandomBoxes({ { 21, 18, 15 } }, unequal, 11, 503)), { 2.1, 9.0, 2.9 } });
  cases.push_back({ Inputs(RandomVolume({ { 18, 15, 14 } }, UnitSpacing, 0.93, 504)), { 1.5, 6.0, 2.9 } });
  cases.push_back({ Inputs(RandomVolume({ { 12, 11, 10 } }, unequal, 0.9, 505)), { 0.4, 4.0, 1.9 } });
  cases.push_back({ Inputs(RandomBoxes({ { 70, 61, 1 } }, UnitSpacing, 21, 506)), { 3.0, 16.0, 2.9 } });
  cases.push_back({ Inputs(RandomVolume({ { 30, 1, 25 } }, UnitSpacing, 0.85, 507)), { 2.0, 9.0, 2.7 } });
  cases.push_back({ Inputs(RandomVolume({ { 30, 25, 1 } }, unequal, 0.9, 508)), { 0.5, 9.0, 2.9 } });
  cases.push_back({ Inputs(RandomVolume({ { 60, 1, 1 } }, UnitSpacing, 0.8, 509)), { 3.0, 16.0, 2.9 } });
  cases.push_back({ Inputs(Complement(Volume({ { 9, 8, 7 } }, UnitSpacing))), { 3.0, 16.0, 3.0 } });
  return cases;
}

const std::vector<Case> &
AllCases()
{
  static const std::vector<Case> cases = Cases();
  return cases;
}

bool
IsMedial(unsigned char label)
{
  return label >= itk::MedialVoxelLabel::MedialByBound;
}
} // namespace

TEST(MedialVoxelJointClassifier, TilesAreTheDefinitions)
{
  std::array<std::uint64_t, 4> seen{};
  for (const Case & c : AllCases())
  {
    const auto image = c.inputs.grid.GetVoxelBox();
    for (const auto & bound : { std::make_pair(Bound::FreeSpace, BoundEnum::FreeSpace),
                                { Bound::Paper, BoundEnum::Paper },
                                { Bound::Off, BoundEnum::Off } })
    {
      const auto expected = MedialVoxelTest::JointClassifier(c.inputs.volume, c.limits).Run(bound.first);
      const MedialVoxelClassifier classifier(c.inputs.grid, ParametersOf(c.limits, bound.second));
      std::mt19937                generator(7);
      for (const auto & tile :
           { image, RandomBox(c.inputs.volume.size, generator), RandomBox(c.inputs.volume.size, generator) })
      {
        itk::MedialVoxelCounts counts;
        const auto             labels = c.inputs.Classify(classifier, tile, counts);
        Labels                 wanted;
        ForEachVoxel(tile, [&](const itk::MedialVoxelIndex & v) {
          wanted.push_back(expected.labels[c.inputs.volume.Offset(OracleIndex(v))]);
        });
        ASSERT_EQ(labels, wanted) << "size " << c.inputs.volume.size[0] << ", bound " << static_cast<int>(bound.first);
        EXPECT_EQ(counts.candidateCells,
                  counts.trivialCells + counts.boundCells + counts.geodesicMedialCells + counts.geodesicNonMedialCells);
        if (tile == image)
        {
          EXPECT_EQ(counts.trivialCells, expected.counts.trivialCells);
          EXPECT_EQ(counts.boundCells, expected.counts.boundCells);
          EXPECT_EQ(counts.geodesicMedialCells, expected.counts.geodesicMedialCells);
          EXPECT_EQ(counts.geodesicNonMedialCells, expected.counts.geodesicNonMedialCells);
          seen[0] += counts.trivialCells;
          seen[1] += counts.boundCells;
          seen[2] += counts.geodesicMedialCells;
          seen[3] += counts.geodesicNonMedialCells;
        }
      }
    }
  }
  for (const std::uint64_t cells : seen)
  {
    EXPECT_GT(cells, 100u);
  }
}

TEST(MedialVoxelJointClassifier, ThresholdsAreThoseOfBruteForce)
{
  std::size_t raised = 0;
  for (const Case & c : AllCases())
  {
    const MedialVoxelTest::JointClassifier oracle(c.inputs.volume, c.limits);
    const MedialVoxelClassifier            classifier(c.inputs.grid, ParametersOf(c.limits, BoundEnum::FreeSpace));
    const auto &                           threshold = classifier.GetThreshold();
    std::mt19937                           generator(8);
    const auto                             box =
      RandomBox(c.inputs.volume.size, generator).Expanded({ { 6, 6, 6 } }).Intersection(c.inputs.grid.GetVoxelBox());
    itk::MedialVoxelLocalThreshold::Workspace workspace;
    workspace.cells.Reshape(box);
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      if (IsCandidate(c.inputs.volume, OracleIndex(v)) && std::bernoulli_distribution(0.7)(generator))
      {
        workspace.cells.Set(v);
      }
    });
    workspace.cells.Rank();
    threshold.Compute(c.inputs.FindBalls(classifier), c.inputs.Features(classifier.GetVoxelBox(box)), workspace);
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      if (workspace.cells.GetBits().Test(v))
      {
        const double epsilon = threshold.EpsilonOf(workspace.radii[workspace.cells.RankOf(v)]);
        EXPECT_EQ(epsilon, oracle.EpsilonOf(c.inputs.volume.Offset(OracleIndex(v))));
        raised += epsilon > EpsilonOf(c.limits.minimum) ? 1 : 0;
      }
    });
  }
  EXPECT_GT(raised, 1000u);
}

TEST(MedialVoxelJointClassifier, RowsBeginInTheTile)
{
  // A tile in the middle of words, whose cells are looked at together with those before it.
  const Inputs                     inputs(RandomBoxes({ { 150, 24, 22 } }, UnitSpacing, 40, 511));
  const MedialVoxelClassifier      classifier(inputs.grid, ParametersOf({ 3.0, 9.0, 2.9 }, BoundEnum::FreeSpace));
  const auto                       tile = MakeBox({ { 37, 5, 4 } }, { { 133, 20, 19 } });
  const itk::MedialVoxelNoProgress progress;
  MedialVoxelClassifier::Workspace workspace;
  workspace.keepsRows = true;
  itk::MedialVoxelCounts counts;
  Labels                 labels;
  const auto             window = classifier.FindAsked({ &inputs.object, &inputs.sites }, tile, false, workspace);
  const auto             features = inputs.Features(classifier.GetFeatureBox(window, tile, workspace), window.asked);
  ASSERT_TRUE(classifier.Classify(window, tile, features, progress, workspace, labels, counts).IsEmpty());
  Labels fromRows(labels.size(), itk::MedialVoxelLabel::NoObject);
  for (const auto & row : workspace.rows)
  {
    ASSERT_TRUE(tile.Contains(row.first));
    for (auto rest = row.candidates; rest != 0; rest &= rest - 1)
    {
      const int  x = itk::MedialVoxelLowestBit(rest);
      const bool isByBound = ((row.byBound >> x) & 1u) != 0;
      const bool isByGeodesic = ((row.byGeodesic >> x) & 1u) != 0;
      fromRows[tile.OffsetOf(row.first) + static_cast<std::size_t>(x)] =
        isByBound ? itk::MedialVoxelLabel::MedialByBound
                  : (isByGeodesic ? itk::MedialVoxelLabel::MedialByGeodesic : itk::MedialVoxelLabel::NonMedial);
    }
  }
  EXPECT_EQ(fromRows, labels);
}

TEST(MedialVoxelJointClassifier, LargerLimitsNeverAddMedialCells)
{
  for (const Case & c : AllCases())
  {
    const auto labels = c.inputs.Classify(c.limits);
    for (const WallLimits & larger : { WallLimits{ 1.4 * c.limits.minimum, c.limits.maximum, c.limits.factor },
                                       WallLimits{ c.limits.minimum, 1.6 * c.limits.maximum, c.limits.factor },
                                       WallLimits{ c.limits.minimum, c.limits.maximum, 1.3 * c.limits.factor } })
    {
      const auto fewer = c.inputs.Classify(larger);
      for (std::size_t i = 0; i < labels.size(); ++i)
      {
        ASSERT_LE(IsMedial(fewer[i]), IsMedial(labels[i]));
      }
    }
  }
}

TEST(MedialVoxelJointClassifier, WallsAreDecidedWithTheirOwnThickness)
{
  // A plate of 2 and one of 10 voxels: one cell per column away from the rims, and none at the edges of the thick one.
  const Inputs inputs(MakeVolume({ { 48, 48, 40 } }, UnitSpacing, [](const Index3 & v) {
    const bool isInside = v[0] >= 3 && v[0] < 45 && v[1] >= 3 && v[1] < 45;
    return isInside && ((v[2] >= 4 && v[2] < 6) || (v[2] >= 14 && v[2] < 24));
  }));
  const auto   labels = inputs.Classify({ 3.0, 16.0 });
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 0; x < 48; ++x)
    {
      for (int z = 0; z < 40; ++z)
      {
        const bool isMiddle = z == 4 || z == 18;
        const int  inner = z < 10 ? 5 : 12;
        const bool isInner = x >= inner && y >= inner && x < 47 - inner && y < 47 - inner;
        const bool isSheet = IsMedial(labels[inputs.volume.Offset({ { x, y, z } })]);
        ASSERT_TRUE(isMiddle ? (isSheet || !isInner) : !isSheet) << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(MedialVoxelJointClassifier, SmallWindowsSayWhatTheyMiss)
{
  const itk::MedialVoxelNoProgress progress;
  MedialVoxelClassifier::Workspace workspace;
  const Inputs                     inputs(AxisPlate({ { 60, 60, 30 } }, UnitSpacing, 2, 9, 10));
  const auto                       tile = MakeBox({ { 26, 26, 13 } }, { { 34, 34, 15 } });
  const MedialVoxelClassifier      classifier(inputs.grid, ParametersOf({ 3.0, 16.0 }, BoundEnum::Off));
  const auto                       features = inputs.Features(classifier.GetVoxelBox(tile));
  const auto                       small = SiteBits(BoundarySites(inputs.volume), tile.Expanded({ { 4, 4, 8 } }));
  Labels                           labels;
  itk::MedialVoxelCounts           counts;
  const auto                       missing =
    classifier.Classify({ &inputs.object, &small }, tile, features, progress, workspace, labels, counts);
  ASSERT_FALSE(missing.IsEmpty());
  const auto enough =
    SiteBits(BoundarySites(inputs.volume), missing.Union(small.GetBox()).Intersection(inputs.grid.GetVoxelBox()));
  itk::MedialVoxelCounts second;
  EXPECT_TRUE(
    classifier.Classify({ &inputs.object, &enough }, tile, features, progress, workspace, labels, second).IsEmpty());
  EXPECT_EQ(second.geodesicMedialCells, 64u); // the mid-plane of ten layers lies between z = 13 and 14
}
