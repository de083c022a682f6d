// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The objects of a label map: what they count, when they are found again, what is refused.

#include "MedialVoxelTestLabelMaps.h"

#include <algorithm>
#include <functional>
#include <sstream>

namespace
{
using namespace MedialVoxelTest;

/** Two plates that touch, and a bar far away. */
LabelVolume
TwoPlatesAndABar()
{
  LabelVolume map{ { { 40, 20, 16 } }, UnitSpacing, {} };
  for (int z = 0; z < 16; ++z)
  {
    for (int y = 0; y < 20; ++y)
    {
      for (int x = 0; x < 40; ++x)
      {
        const bool isInside = y >= 3 && y < 17 && z >= 3 && z < 13;
        const int  label = x >= 4 && x < 8 ? 7 : x >= 8 && x < 12 ? 3 : x >= 28 && x < 32 ? 120 : 0;
        map.labels.push_back(isInside ? label : 0);
      }
    }
  }
  return map;
}

using ByteFilter = ObjectFilter<unsigned char, 3>;

ByteFilter::Pointer
MakeObjectFilter(const LabelVolume & map)
{
  auto filter = ByteFilter::New();
  filter->SetInput(MakeLabelImage<itk::Image<unsigned char, 3>>(map));
  return filter;
}

/** An update fails with a message that has these words. */
template <typename TFilter>
void
ExpectRefused(TFilter & filter, const std::vector<std::string> & words)
{
  try
  {
    filter.Update();
    FAIL() << "no exception that says " << words.front();
  }
  catch (const itk::ExceptionObject & exception)
  {
    for (const std::string & word : words)
    {
      EXPECT_NE(std::string(exception.GetDescription()).find(word), std::string::npos) << exception.GetDescription();
    }
  }
}
} // namespace

TEST(MedialVoxelSeparateObjects, ShareCellsPassesAndSums)
{
  auto filter = MakeObjectFilter(TwoPlatesAndABar());
  filter->Update();
  EXPECT_EQ(filter->GetFoundLabels(), (std::vector<std::int64_t>{ 3, 7, 120 }));
  EXPECT_EQ(filter->GetNumberOfPasses(), 2u);
  EXPECT_EQ(filter->GetNumberOfVoxelsWithLabel(7), 4u * 14 * 10);
  EXPECT_EQ(filter->GetNumberOfMedialCellsWithLabel(3), filter->GetNumberOfMedialCellsWithLabel(7));
  // A second update counts the same again, and one on a part counts the part.
  const auto medial = filter->GetNumberOfMedialCellsWithLabel(120);
  EXPECT_GT(medial, 0u);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfMedialCellsWithLabel(120), medial);
  auto region = filter->GetOutput()->GetLargestPossibleRegion();
  region.SetSize(0, 20);
  filter->Modified();
  filter->GetOutput()->SetRequestedRegion(region);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfMedialCellsWithLabel(120), 0u);
  EXPECT_EQ(filter->GetNumberOfVoxelsWithLabel(120), 4u * 14 * 10);
}

TEST(MedialVoxelSeparateObjects, AreAllOrThoseThatAreChosen)
{
  auto filter = MakeObjectFilter(TwoPlatesAndABar());
  EXPECT_STREQ(filter->GetNameOfClass(), "MedialVoxelObjectsImageFilter");
  EXPECT_TRUE(filter->GetObjectLabels().empty());
  EXPECT_EQ(filter->GetNumberOfPasses(), 0u);
  filter->Update();
  const auto all = PixelsOf(filter->GetOutput());
  auto       time = filter->GetMTime();
  filter->SetObjectLabels({ 7, 3, 7 });
  EXPECT_GT(filter->GetMTime(), time);
  EXPECT_EQ(filter->GetObjectLabels(), (std::vector<std::int64_t>{ 3, 7 }));
  time = filter->GetMTime();
  filter->SetObjectLabels({ 3, 7 });
  EXPECT_EQ(filter->GetMTime(), time);
  filter->Update();
  EXPECT_NE(PixelsOf(filter->GetOutput()), all);
  EXPECT_EQ(filter->GetFoundLabels(), filter->GetObjectLabels());
  EXPECT_EQ(filter->GetObjectOutput()->GetOrigin(), filter->GetOutput()->GetOrigin());
  EXPECT_EQ(filter->GetNumberOfIndexedOutputs(), 1u);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("ObjectLabels: 3 7\n"), std::string::npos);
}

TEST(MedialVoxelSeparateObjects, AreFoundAgainWhenTheInputChanges)
{
  LabelVolume map = TwoPlatesAndABar();
  const auto  image = MakeLabelImage<itk::Image<unsigned char, 3>>(map);
  auto        filter = ByteFilter::New();
  filter->SetInput(image);
  filter->Update();
  std::replace(image->GetBufferPointer(), image->GetBufferPointer() + map.labels.size(), 120, 121);
  image->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetFoundLabels(), (std::vector<std::int64_t>{ 3, 7, 121 }));
}

TEST(MedialVoxelSeparateObjects, OfAnEmptyMapAreNone)
{
  LabelVolume map = TwoPlatesAndABar();
  std::fill(map.labels.begin(), map.labels.end(), 0);
  auto filter = MakeObjectFilter(map);
  filter->Update();
  EXPECT_TRUE(filter->GetFoundLabels().empty());
  EXPECT_EQ(filter->GetNumberOfPasses(), 1u);
  EXPECT_EQ(filter->GetCounts().candidateCells, 0u);
  EXPECT_EQ(PixelsOf(filter->GetOutput()), std::vector<unsigned char>(map.labels.size(), 0));
  EXPECT_EQ(PixelsOf(filter->GetObjectOutput()), std::vector<unsigned char>(map.labels.size(), 0));
}

TEST(MedialVoxelSeparateObjects, NotANumberCountsOnce)
{
  const LabelVolume map = TwoPlatesAndABar();
  const auto        image = MakeLabelImage<itk::Image<float, 3>>(map);
  image->GetBufferPointer()[0] = std::numeric_limits<float>::quiet_NaN();
  auto filter = ObjectFilter<float, 3>::New();
  filter->SetInput(image);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfPasses(), 2u);
  EXPECT_EQ(filter->GetCounts().notANumberVoxels, 1u);
}

TEST(MedialVoxelSeparateObjects, TheSearchForThemCanBeAborted)
{
  auto filter = MakeObjectFilter(TwoPlatesAndABar());
  filter->Update();
  const auto medial = filter->GetNumberOfMedialCellsWithLabel(3);
  const auto labels = PixelsOf(filter->GetOutput());
  // The first progress event comes while the objects are looked for.
  const auto tag =
    filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) { filter->AbortGenerateDataOn(); });
  filter->Modified();
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  filter->RemoveObserver(tag);
  filter->AbortGenerateDataOff();
  filter->Update();
  EXPECT_EQ(PixelsOf(filter->GetOutput()), labels);
  EXPECT_EQ(filter->GetNumberOfMedialCellsWithLabel(3), medial);
}

TEST(MedialVoxelSeparateObjects, OtherDefinitionsOfTheObjectAreRefused)
{
  const LabelVolume map = TwoPlatesAndABar();
  using ChangeType = std::function<void(ByteFilter &)>;
  for (const ChangeType & change : { ChangeType([](ByteFilter & filter) { filter.SetLowerThreshold(2); }),
                                     ChangeType([](ByteFilter & filter) { filter.SetUpperThreshold(2); }),
                                     ChangeType([](ByteFilter & filter) { filter.SetObjectValue(3); }),
                                     ChangeType([](ByteFilter & filter) { filter.SetBackgroundValue(3); }) })
  {
    auto filter = MakeObjectFilter(map);
    change(*filter);
    ExpectRefused(*filter, { "LowerThreshold", "must not be set" });
  }
  auto filter = MakeObjectFilter(map);
  filter->GenerateVectorDistanceOn();
  ExpectRefused(*filter, { "Vectors", "one object" });
  filter->GenerateVectorDistanceOff();
  EXPECT_NO_THROW(filter->Update());
}

TEST(MedialVoxelSeparateObjects, WrongLabelsAreRefused)
{
  auto filter = MakeObjectFilter(TwoPlatesAndABar());
  for (const std::int64_t label : { 0, -1, 256 })
  {
    filter->SetObjectLabels({ 3, label });
    ExpectRefused(*filter, { "ObjectLabels has " + std::to_string(label), "from 0 to 255" });
  }
  filter->SetObjectLabels({ 3, 9 });
  ExpectRefused(*filter, { "No voxel", "label 9" });
  filter->SetObjectLabels({ 3 });
  filter->Update();
  EXPECT_THROW(filter->GetNumberOfVoxelsWithLabel(7), itk::ExceptionObject);
  EXPECT_THROW(filter->GetNumberOfMedialCellsWithLabel(0), itk::ExceptionObject);

  auto realFilter = ObjectFilter<float, 3>::New();
  realFilter->SetInput(MakeLabelImage<itk::Image<float, 3>>(TwoPlatesAndABar()));
  realFilter->SetObjectLabels({ 16777217 });
  ExpectRefused(*realFilter, { "ObjectLabels has 16777217" });
}

TEST(MedialVoxelSeparateObjects, WrongValuesAreRefused)
{
  const auto image = MakeLabelImage<itk::Image<float, 3>>(TwoPlatesAndABar());
  auto       filter = ObjectFilter<float, 3>::New();
  filter->SetInput(image);
  image->GetBufferPointer()[5] = 2.5f;
  ExpectRefused(*filter, { "not a label map", "2.5", "whole numbers" });
  image->GetBufferPointer()[5] = 1e30f;
  image->Modified();
  ExpectRefused(*filter, { "not a label map", "e+30", "2^63" });

  LabelVolume map{ { { 300, 300, 1 } }, UnitSpacing, {} };
  for (std::int64_t label = 0; label < 300 * 300; ++label)
  {
    map.labels.push_back(label);
  }
  auto manyFilter = ObjectFilter<int, 2>::New();
  manyFilter->SetInput(MakeLabelImage<itk::Image<int, 2>>(map));
  ExpectRefused(*manyFilter, { "more than 65535" });
}
