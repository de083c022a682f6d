// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The vector distance filter on small images against brute force, and in pieces against itself.

#include "FuzzFilters.h"

#include "itkVectorDistanceMapImageFilter.h"

namespace
{

using namespace MedialVoxelFuzz;
using namespace MedialVoxelTest;
using itk::MedialVoxelBoundary;
using itk::MedialVoxelRegion;

/** What a run is asked for. */
struct Demand
{
  MedialVoxelBoundary boundary{ MedialVoxelBoundary::Object };
  MedialVoxelRegion   region{ MedialVoxelRegion::Both };
  double              maximumDistance{ std::numeric_limits<double>::infinity() };
  bool                insideIsPositive{ false };
  bool                squared{ false };
};

Demand
ChooseDemand(Choices & choices, double unit)
{
  Demand demand;
  demand.boundary = choices.Flag() ? MedialVoxelBoundary::Object : MedialVoxelBoundary::Background;
  demand.region = choices.OneOf(std::array<MedialVoxelRegion, 3>{
    { MedialVoxelRegion::Both, MedialVoxelRegion::Inside, MedialVoxelRegion::Outside } });
  if (choices.Flag())
  {
    // Quarters are distances too.
    demand.maximumDistance = unit * (1 + choices.Byte()) / (choices.Flag() ? 4.0 : 17.0);
  }
  demand.insideIsPositive = choices.Flag();
  demand.squared = choices.Flag();
  return demand;
}

std::vector<unsigned char>
GetWanted(const Volume & volume, MedialVoxelRegion region)
{
  std::vector<unsigned char> wanted(volume.object.size(), 1);
  for (std::size_t i = 0; i < wanted.size() && region != MedialVoxelRegion::Both; ++i)
  {
    wanted[i] = (volume.object[i] != 0) == (region == MedialVoxelRegion::Inside) ? 1 : 0;
  }
  return wanted;
}

template <typename TImage>
typename itk::VectorDistanceMapImageFilter<TImage>::Pointer
MakeFilter(const Scene & scene, const Demand & demand, const SceneInput<TImage> & input, const Cut & cut)
{
  auto filter = itk::VectorDistanceMapImageFilter<TImage>::New();
  SetScene(*filter, scene, input, cut);
  SetTiles(*filter, cut);
  filter->SetBoundary(demand.boundary);
  filter->SetRegion(demand.region);
  filter->SetMaximumDistance(demand.maximumDistance);
  filter->SetInsideIsPositive(demand.insideIsPositive);
  filter->SetSquaredDistance(demand.squared);
  return filter;
}

/** The signed length of a vector; none where there is no vector, or nothing to tell. */
void
CheckDistance(float distance, double length, bool isPositive, const Demand & demand)
{
  const double expected = (isPositive ? 1.0 : -1.0) * (demand.squared ? length * length : length);
  Require(!(std::abs(distance - expected) > 1e-6 * std::abs(expected)), "a distance differs from that by brute force");
}

/** Voxels beyond the largest distance become NaN in what is expected; those that rounding decides do as the filter. */
template <typename TFilter>
void
CheckWhole(TFilter & filter, const Scene & scene, const Demand & demand)
{
  const Volume       volume = scene.GetMeasured();
  const auto         wanted = GetWanted(volume, demand.region);
  const BoundarySide side =
    demand.boundary == MedialVoxelBoundary::Object ? BoundarySide::Object : BoundarySide::Background;
  auto                expected = VectorsByBruteForce(scene, volume, side, wanted);
  const auto * const  vectors = filter.GetOutput()->GetBufferPointer();
  const float * const distances = filter.GetDistanceOutput()->GetBufferPointer();
  constexpr float     nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    double sum = 0.0;
    for (const float component : expected[i])
    {
      sum += static_cast<double>(component) * component;
    }
    const double length = std::sqrt(sum);
    const bool   isRounded = std::abs(length - demand.maximumDistance) <= 1e-6 * length;
    if (wanted[i] != 0 && (isRounded ? std::isnan(vectors[i][0]) : length > demand.maximumDistance))
    {
      expected[i].fill(nan);
    }
    Require(std::isnan(distances[i]) == std::isnan(expected[i][0]), "a distance is NaN where its vector is not");
    CheckDistance(distances[i],
                  std::isnan(expected[i][0]) ? nan : length,
                  (volume.object[i] != 0) == demand.insideIsPositive,
                  demand);
  }
  RequireVectors(*filter.GetOutput(), expected);
}

template <typename TImage>
void
CheckRegions(Choices &                                   choices,
             itk::VectorDistanceMapImageFilter<TImage> & filter,
             itk::VectorDistanceMapImageFilter<TImage> & whole)
{
  filter.GenerateDistanceOn();
  filter.UpdateOutputInformation();
  for (int i = choices.Next(1, 3); i > 0; --i)
  {
    const auto region = ChooseRegion(choices, whole.GetOutput()->GetLargestPossibleRegion());
    filter.GetOutput()->SetRequestedRegion(region);
    filter.Update();
    RequireSame(*filter.GetOutput(), *whole.GetOutput(), region, "vectors of a region differ from the whole");
    RequireSame(
      *filter.GetDistanceOutput(), *whole.GetDistanceOutput(), region, "distances of a region differ from the whole");
  }
}

template <typename TImage>
void
Check(Choices & choices, Kind<TImage> kind)
{
  Scene        scene = ChooseScene(choices, TImage::ImageDimension);
  const Demand demand = ChooseDemand(choices, UnitOf(scene.GetMeasured()));
  const Cut    cut = ChooseCut(choices);
  const bool   streams = choices.Flag();
  const auto   divisions = static_cast<unsigned int>(choices.Next(1, 12));
  Choices      later = choices;
  FillScene(choices, kind.values, scene);

  const SceneInput<TImage> input(scene);
  const auto               whole = MakeFilter(scene, demand, input, Cut());
  whole->GenerateDistanceOn();
  whole->Update();
  CheckWhole(*whole, scene, demand);
  RunWithin(cut, [&] {
    const auto filter = MakeFilter(scene, demand, input, cut);
    if (!streams)
    {
      CheckRegions(later, *filter, *whole);
      return;
    }
    const auto vectors = Stream(*filter, divisions);
    RequireSame(*vectors,
                *whole->GetOutput(),
                vectors->GetLargestPossibleRegion(),
                "vectors of the pieces differ from the whole");
  });
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  return CheckInput(data, size, [](Choices & choices, auto kind) { Check(choices, kind); });
}
