// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Many objects in one update: the results are those of updates on one object at a time, put together.

#include "itkMedialVoxelFilterAccess.h"

#include "MedialVoxelTestLabelMaps.h"

#include <algorithm>

namespace
{
using namespace MedialVoxelTest;

/** Settings that change results. */
struct Settings
{
  bool   isAutomatic;
  double thickness;
  bool   usesSpacing;
  int    maximumPoreSize; ///< -1: the default
  bool   sameTopology;
};

Settings
RollSettings(Dice & dice)
{
  return { dice.Roll(0, 1) == 1,
           dice.Choose<double>({ 1.5, 3.0, 5.0 }),
           dice.Roll(0, 1) == 1,
           dice.Choose<int>({ -1, -1, 0, 40, 300 }),
           dice.Roll(0, 1) == 1 };
}

template <typename TFilter>
void
Apply(TFilter & filter, const Settings & settings)
{
  filter.SetThicknessMode(settings.isAutomatic ? itk::MedialVoxelThicknessMode::Automatic
                                               : itk::MedialVoxelThicknessMode::Fixed);
  filter.SetThickness(settings.thickness);
  filter.SetUseImageSpacing(settings.usesSpacing);
  if (settings.maximumPoreSize >= 0)
  {
    filter.SetMaximumPoreSize(static_cast<itk::SizeValueType>(settings.maximumPoreSize));
  }
  filter.SetSameTopology(settings.sameTopology);
  filter.GenerateThicknessOn();
}

/** Results of single objects and the sums of their counts. */
struct Expected
{
  CellResults                         all;
  Counts                              counts{};
  std::map<std::int64_t, std::size_t> candidates;
  std::map<std::int64_t, std::size_t> medial;
  std::map<std::int64_t, std::size_t> added;
};

/** By binary images, so that nothing of labels is in it. */
template <unsigned int D>
Expected
RunSingle(const LabelVolume & map, const std::set<std::int64_t> & labels, const Settings & settings)
{
  std::map<std::int64_t, CellResults> single;
  Expected                            expected;
  for (const std::int64_t label : labels)
  {
    auto filter = MakeMedialFilter<D>(map.Select(label), 3.0);
    Apply(*filter, settings);
    filter->Update();
    CellResults & results = single[label];
    results.labels = PixelsOf(filter->GetOutput());
    results.thicknesses = PixelsOf(filter->GetThicknessOutput());
    const Counts counts = CountsOf(filter.GetPointer());
    expected.counts.objectVoxels += counts.objectVoxels;
    expected.counts.boundaryVoxels += counts.boundaryVoxels;
    expected.counts.candidateCells += counts.candidateCells;
    expected.counts.trivialCells += counts.trivialCells;
    expected.counts.boundCells += counts.boundCells;
    expected.counts.geodesicMedialCells += counts.geodesicMedialCells;
    expected.counts.geodesicNonMedialCells += counts.geodesicNonMedialCells;
    expected.candidates[label] = counts.candidateCells;
    expected.medial[label] = counts.boundCells + counts.geodesicMedialCells;
    expected.added[label] = filter->GetNumberOfAddedCells();
  }
  expected.all = PutTogether(single, map.labels.size());
  return expected;
}

/** Updates region after region as one streamed update, and puts the outputs together. */
template <typename TFilter>
CellResults
RunInRegions(TFilter & filter, const std::vector<typename TFilter::OutputImageRegionType> & regions)
{
  filter.UpdateOutputInformation();
  const auto  whole = filter.GetOutput()->GetLargestPossibleRegion();
  CellResults results;
  results.labels.assign(whole.GetNumberOfPixels(), 99);
  results.objects.assign(whole.GetNumberOfPixels(), -99);
  results.thicknesses.assign(whole.GetNumberOfPixels(), -99.0f);
  auto frame = TFilter::OutputImageType::New();
  frame->SetRegions(whole);
  for (const auto & region : regions)
  {
    filter.GetOutput()->SetRequestedRegion(region);
    filter.GetOutput()->PropagateRequestedRegion();
    filter.GetOutput()->UpdateOutputData();
    EXPECT_EQ(filter.GetOutput()->GetBufferedRegion(), region);
    EXPECT_EQ(filter.GetObjectOutput()->GetBufferedRegion(), region);
    itk::ImageRegionConstIteratorWithIndex<typename TFilter::OutputImageType> it(filter.GetOutput(), region);
    for (; !it.IsAtEnd(); ++it)
    {
      const auto at = static_cast<std::size_t>(frame->ComputeOffset(it.GetIndex()));
      results.labels[at] = it.Get();
      results.objects[at] = static_cast<std::int64_t>(filter.GetObjectOutput()->GetPixel(it.GetIndex()));
      results.thicknesses[at] = filter.GetThicknessOutput()->GetPixel(it.GetIndex());
    }
  }
  results.sharedCells = filter.GetNumberOfSharedCells();
  return results;
}

/** The region cut along an axis. */
template <typename TRegion>
std::vector<TRegion>
Cut(const TRegion & whole, const unsigned int axis, const unsigned int pieces)
{
  std::vector<TRegion> regions;
  const auto           size = whole.GetSize(axis);
  for (unsigned int piece = 0; piece < pieces; ++piece)
  {
    const auto begin = size * piece / pieces;
    const auto end = size * (piece + 1) / pieces;
    if (end > begin)
    {
      TRegion region = whole;
      region.SetIndex(axis, whole.GetIndex(axis) + static_cast<itk::IndexValueType>(begin));
      region.SetSize(axis, end - begin);
      regions.push_back(region);
    }
  }
  return regions;
}

void
ExpectSame(const CellResults & found, const CellResults & expected)
{
  EXPECT_TRUE(AreEqual(found.labels, expected.labels));
  EXPECT_TRUE(AreEqual(found.objects, expected.objects));
  EXPECT_TRUE(AreEqual(found.thicknesses, expected.thicknesses));
  EXPECT_EQ(found.sharedCells, expected.sharedCells);
}

/** How often passes were saved, and cells were shared or in a pore, so that the maps test what they are for. */
struct Tally
{
  unsigned int savedPasses{ 0 };
  std::size_t  sharedCells{ 0 };
  std::size_t  poreCells{ 0 };
  std::size_t  addedCells{ 0 };
  unsigned int selections{ 0 };
};

/** Cells that belong to an object of which they have no corner. */
std::size_t
CountPoreCells(const LabelVolume & map, const std::vector<std::int64_t> & objects)
{
  std::map<std::int64_t, Volume> volumes;
  std::size_t                    cells = 0;
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    if (objects[i] == 0)
    {
      continue;
    }
    const Volume & volume = volumes.try_emplace(objects[i], map.Select(objects[i])).first->second;
    const Index3   lowest = volume.IndexAt(i);
    bool           hasCorner = false;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Index3 v{ { lowest[0] + corner % 2, lowest[1] + corner / 2 % 2, lowest[2] + corner / 4 } };
      hasCorner = hasCorner || (volume.Contains(v) && volume.IsObject(v));
    }
    cells += hasCorner ? 0 : 1;
  }
  return cells;
}

template <typename TPixel, unsigned int D>
void
CheckMap(Dice & dice, const std::vector<std::int64_t> & pool, Tally & tally)
{
  const bool   isFlat = D == 2;
  const Index3 size{ { dice.Choose<int>({ 2, 13, 27, 45 }),
                       dice.Choose<int>({ 1, 13, 31 }),
                       isFlat ? 1 : dice.Choose<int>({ 1, 13, 27 }) } };
  LabelVolume  map = dice.Roll(0, 2) > 0 ? RandomLabelBoxes(dice, size, pool) : RandomLabelNoise(dice, size, pool);
  map.spacing = dice.Roll(0, 1) == 1 ? UnitSpacing : Vector3{ { 1.0, 0.7, 2.5 } };
  const Settings settings = RollSettings(dice);
  const auto     start = static_cast<itk::IndexValueType>(dice.Choose<int>({ 0, -7, 5 }));

  std::set<std::int64_t> labels = map.GetLabels();
  const bool             isSelection = labels.size() > 2 && dice.Roll(0, 3) == 0;
  if (isSelection)
  {
    labels.erase(labels.begin());
    ++tally.selections;
  }
  const Expected expected = RunSingle<D>(map, labels, settings);

  using FilterType = ObjectFilter<TPixel, D>;
  const auto image = MakeLabelImage<itk::Image<TPixel, D>>(map, start);
  auto       source = RecordingSource<itk::Image<TPixel, D>>::New();
  source->SetImage(image);
  const bool isStreamed = dice.Roll(0, 1) == 1;
  auto       filter = FilterType::New();
  filter->SetInput(isStreamed ? source->GetOutput() : image.GetPointer());
  Apply(*filter, settings);
  if (isSelection)
  {
    filter->SetObjectLabels({ labels.rbegin(), labels.rend() });
  }
  filter->SetNumberOfWorkUnits(static_cast<unsigned int>(dice.Choose<int>({ 1, 2, 5 })));
  itk::MedialVoxelFilterAccess::SetTileSize(*filter, static_cast<unsigned int>(dice.Choose<int>({ 0, 3, 8 })));
  itk::MedialVoxelFilterAccess::SetSlabThickness(*filter, static_cast<unsigned int>(dice.Choose<int>({ 0, 1, 6 })));
  filter->SetWorkingMemoryLimit(dice.Roll(0, 1) == 1 ? 0 : 64 << 20);
  const auto axis = static_cast<unsigned int>(dice.Roll(0, D - 1));
  // The topology takes the whole image.
  const auto pieces = settings.sameTopology ? 1u : static_cast<unsigned int>(dice.Choose<int>({ 1, 1, 2, 5 }));
  const auto found = RunInRegions(*filter, Cut(image->GetLargestPossibleRegion(), axis, pieces));

  ExpectSame(found, expected.all);
  EXPECT_EQ(CountsOf(filter.GetPointer()), expected.counts);
  EXPECT_EQ(filter->GetFoundLabels(), std::vector<std::int64_t>(labels.begin(), labels.end()));
  EXPECT_TRUE(source->WasAskedByOneThread());
  std::size_t addedCells = 0;
  for (const std::int64_t label : labels)
  {
    EXPECT_EQ(filter->GetNumberOfVoxelsWithLabel(label),
              static_cast<std::size_t>(std::count(map.labels.begin(), map.labels.end(), label)));
    EXPECT_EQ(filter->GetNumberOfCandidateCellsWithLabel(label), expected.candidates.at(label));
    EXPECT_EQ(filter->GetNumberOfMedialCellsWithLabel(label), expected.medial.at(label));
    EXPECT_EQ(filter->GetNumberOfAddedCellsWithLabel(label), expected.added.at(label));
    addedCells += expected.added.at(label);
  }
  EXPECT_EQ(filter->GetNumberOfAddedCells(), addedCells);
  EXPECT_LE(filter->GetNumberOfPasses(), std::max<std::size_t>(labels.size(), 1));
  tally.savedPasses += filter->GetNumberOfPasses() < labels.size() ? 1 : 0;
  tally.addedCells += addedCells;
  tally.sharedCells += expected.all.sharedCells;
  tally.poreCells += CountPoreCells(map, expected.all.objects);
}

template <typename TPixel, unsigned int D>
void
CheckMaps(const std::vector<std::int64_t> & pool, const unsigned int firstSeed, Tally & tally)
{
  for (unsigned int seed = firstSeed; seed < firstSeed + 40; ++seed)
  {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    CheckMap<TPixel, D>(dice, pool, tally);
  }
}

} // namespace

TEST(MedialVoxelObjectMaps, AreThoseOfSingleUpdates)
{
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  Tally                  tally;
  CheckMaps<unsigned char, 3>({ 1, 2, 5, 200 }, 1000, tally);
  CheckMaps<unsigned char, 2>({ 1, 2, 5, 200 }, 2000, tally);
  CheckMaps<short, 3>({ -300, -1, 4, 9, 30000 }, 3000, tally);
  CheckMaps<short, 2>({ -300, -1, 4, 9, 30000 }, 4000, tally);
  CheckMaps<float, 3>({ -2, 1, 77, 65536 }, 5000, tally);
  CheckMaps<double, 2>({ -2, 1, 77, std::int64_t{ 1 } << 50 }, 6000, tally);
  CheckMaps<std::int64_t, 3>({ -largest - 1, -5, largest - 1, largest }, 7000, tally);
  CheckMaps<std::uint64_t, 3>({ 1, 2, largest - 1, largest }, 8000, tally);
  EXPECT_GT(tally.savedPasses, 10u);
  EXPECT_GT(tally.sharedCells, 100u);
  EXPECT_GT(tally.poreCells, 100u);
  EXPECT_GT(tally.addedCells, 100u);
  EXPECT_GT(tally.selections, 10u);
}
