// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The medial voxel filter on small images against brute force, and in pieces, with tiles, slabs, threads and a memory
// limit, against itself.

#include "FuzzFilters.h"

#include "MedialVoxelTestRuns.h"

namespace
{

using namespace MedialVoxelFuzz;
using namespace MedialVoxelTest;

/** What is asked beside the labels. */
struct Extras
{
  BoundarySide side{ BoundarySide::Object };
  bool         subVoxel{ false };
};

/** All that one input stands for. */
struct Case
{
  Scene    scene;
  Question question;
  Extras   extras;
  Cut      cut;
};

template <typename TFilter>
void
SetQuestion(TFilter & filter, const Question & question)
{
  filter.SetPseudoGeodesicBound(FilterBound(question.bound));
  SetWalls(filter, question);
}

template <typename TImage>
typename itk::MedialVoxelImageFilter<TImage>::Pointer
MakeFilter(const Case & all, const SceneInput<TImage> & input, const Cut & cut)
{
  auto filter = itk::MedialVoxelImageFilter<TImage>::New();
  SetScene(*filter, all.scene, input, cut);
  SetTiles(*filter, cut);
  SetQuestion(*filter, all.question);
  return filter;
}

template <typename TFilter>
void
SetExtras(TFilter & filter, const Extras & extras)
{
  filter.GenerateVectorDistanceOn();
  filter.SetVectorDistanceBoundary(extras.side == BoundarySide::Object ? itk::MedialVoxelBoundary::Object
                                                                       : itk::MedialVoxelBoundary::Background);
  filter.GenerateThicknessOn();
  filter.SetSubvoxelThickness(extras.subVoxel);
}

template <typename TFilter>
void
CheckThickness(TFilter & filter, const Case & all, const std::vector<double> & expected)
{
  const auto          spacing = all.scene.GetMeasured().spacing;
  const double        unit = *std::max_element(spacing.begin(), spacing.end());
  const float * const thicknesses = filter.GetThicknessOutput()->GetBufferPointer();
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    Require(std::isfinite(thicknesses[i]), "a thickness is no length");
    const double difference = std::abs(std::abs(thicknesses[i]) - expected[i]); // negative at rims
    Require(all.extras.subVoxel || !(difference > 1e-5 * (unit + expected[i])),
            "a thickness differs from that by brute force");
  }
}

/** Against brute force. */
template <typename TFilter>
void
CheckWhole(TFilter & filter, const Case & all)
{
  const Volume before = all.scene.GetMeasured();
  const Volume volume = CleanedByBruteForce(before, all.question);
  Require(filter.GetCounts().notANumberVoxels == all.scene.notANumbers, "another number of NaN");
  Require(filter.GetCounts().filledVoxels == CountVoxelsOnlyIn(volume, before) &&
            filter.GetCounts().removedVoxels == CountVoxelsOnlyIn(before, volume),
          "other pores than by brute force");
  RequireVectors(*filter.GetVectorDistanceOutput(),
                 VectorsByBruteForce(all.scene, volume, all.extras.side, volume.object));
  const std::vector<unsigned char> labels = PixelsOf(filter.GetOutput());
  CheckThickness(filter, all, ThicknessByBruteForce(volume, labels));
  const auto expected = AnswerByBruteForce(volume, all.question);
  Require(!expected || labels == expected->labels, "labels differ from those by brute force");
  Require(!expected || CountsOf(&filter) == expected->counts, "counts differ from those by brute force");
}

/** The pieces of a stream are the whole, and add up. */
template <typename TImage>
void
CheckStream(const Case &                          all,
            const SceneInput<TImage> &            input,
            itk::MedialVoxelImageFilter<TImage> & whole,
            int                                   divisions)
{
  auto       filter = MakeFilter(all, input, all.cut);
  const auto labels = Stream(*filter, static_cast<unsigned int>(divisions));
  RequireSame(
    *labels, *whole.GetOutput(), labels->GetLargestPossibleRegion(), "labels of the pieces differ from the whole");
  Require(CountsOf(filter.GetPointer()) == CountsOf(&whole) &&
            filter->GetCounts().filledVoxels == whole.GetCounts().filledVoxels &&
            filter->GetCounts().removedVoxels == whole.GetCounts().removedVoxels &&
            filter->GetCounts().notANumberVoxels == whole.GetCounts().notANumberVoxels,
          "counts of the pieces do not add up");
}

/** Regions in any order have what the whole has there, all outputs of them. */
template <typename TImage>
void
CheckRegions(Choices &                             choices,
             const Case &                          all,
             const SceneInput<TImage> &            input,
             itk::MedialVoxelImageFilter<TImage> & whole)
{
  auto filter = MakeFilter(all, input, all.cut);
  SetExtras(*filter, all.extras);
  filter->UpdateOutputInformation();
  for (int i = choices.Next(1, 3); i > 0; --i)
  {
    const auto region = ChooseRegion(choices, whole.GetOutput()->GetLargestPossibleRegion());
    filter->GetOutput()->SetRequestedRegion(region);
    filter->Update();
    RequireSame(*filter->GetOutput(), *whole.GetOutput(), region, "labels of a region differ from the whole");
    RequireSame(*filter->GetVectorDistanceOutput(),
                *whole.GetVectorDistanceOutput(),
                region,
                "vectors of a region differ from the whole");
    RequireSame(*filter->GetThicknessOutput(),
                *whole.GetThicknessOutput(),
                region,
                "thicknesses of a region differ from the whole");
  }
}

/** A filter that had another question to answer before. */
template <typename TImage>
void
CheckAfterAnother(Choices &                             choices,
                  const Case &                          all,
                  const SceneInput<TImage> &            input,
                  itk::MedialVoxelImageFilter<TImage> & whole)
{
  auto     filter = MakeFilter(all, input, all.cut);
  Question other = all.question;
  other.thickness = choices.Flag() ? std::optional<double>(0.5 + choices.Byte() / 16.0) : std::nullopt;
  other.maximumPoreSize = choices.Next(0, 20);
  SetQuestion(*filter, other);
  filter->Update();
  SetQuestion(*filter, all.question);
  SetExtras(*filter, all.extras);
  filter->UpdateLargestPossibleRegion();
  const auto region = whole.GetOutput()->GetLargestPossibleRegion();
  RequireSame(*filter->GetOutput(), *whole.GetOutput(), region, "labels depend on an earlier run");
  RequireSame(
    *filter->GetThicknessOutput(), *whole.GetThicknessOutput(), region, "thicknesses depend on an earlier run");
  Require(CountsOf(filter.GetPointer()) == CountsOf(&whole), "counts depend on an earlier run");
}

template <typename TImage>
void
Check(Choices & choices, Kind<TImage> kind)
{
  Case all;
  all.scene = ChooseScene(choices, TImage::ImageDimension);
  all.question = ChooseQuestion(choices, all.scene.GetMeasured());
  all.extras.side = choices.Flag() ? BoundarySide::Object : BoundarySide::Background;
  all.extras.subVoxel = all.scene.HasThresholds() && choices.Flag();
  all.cut = ChooseCut(choices);
  const int way = choices.Next(0, 3);
  const int divisions = choices.Next(1, 12);
  Choices   later = choices;
  FillScene(choices, kind.values, all.scene);

  const SceneInput<TImage> input(all.scene);
  const auto               whole = MakeFilter(all, input, Cut());
  SetExtras(*whole, all.extras);
  whole->Update();
  CheckWhole(*whole, all);
  RunWithin(all.cut, [&] {
    if (way == 0)
    {
      CheckRegions(later, all, input, *whole);
    }
    else if (way == 1)
    {
      CheckAfterAnother(later, all, input, *whole);
    }
    else
    {
      CheckStream(all, input, *whole, divisions);
    }
  });
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  return CheckInput(data, size, [](Choices & choices, auto kind) { Check(choices, kind); });
}
