// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"

#include "VolumeFormats.h"

#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

using namespace medialvoxel;

namespace
{

VolumeHeader
MakeHeader(const std::vector<std::uint64_t> & size)
{
  VolumeHeader header;
  header.fileName = "volume.mha";
  header.dataFile = header.fileName;
  header.format = &FindInputFormat("in.mha");
  header.geometry.size = size;
  return header;
}

Footprint
MakeFootprint(const VolumeHeader & header, std::uint64_t bytesPerVoxel)
{
  Footprint    footprint;
  const auto & size = header.geometry.size;
  footprint.grid = { { { std::int64_t(size[0]), std::int64_t(size[1]), std::int64_t(size[2]) } }, { { 1, 1, 1 } } };
  footprint.engines.emplace_back();
  footprint.engines.back().settings.task = itk::MedialVoxelDistanceMap{};
  footprint.engines.back().perVoxel = bytesPerVoxel;
  return footprint;
}

JobPlan
MakePlanFor(const JobOptions & options, const VolumeHeader & header, std::uint64_t bytesPerVoxel)
{
  return MakePlan(options, header, {}, MakeFootprint(header, bytesPerVoxel));
}

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

} // namespace

TEST(Plan, PiecesCoverEverySliceOnce)
{
  for (const std::uint64_t slices : { 1, 2, 7, 64, 1000 })
  {
    for (const std::uint64_t divisions : { 1, 2, 3, 7, 5000 })
    {
      JobOptions options;
      options.divisions = divisions;
      const JobPlan plan = MakePlanFor(options, MakeHeader({ 4, 5, slices }), 1);
      std::uint64_t next = 0;
      std::uint64_t largest = plan.GetMaximumSlices();
      for (std::uint64_t piece = 0; piece < plan.divisions; ++piece)
      {
        const SliceRange range = plan.GetPiece(piece);
        EXPECT_EQ(range.begin, next);
        EXPECT_GT(range.end, next);
        EXPECT_LE(range.end - range.begin, largest);
        largest = range.end - range.begin;
        next = range.end;
      }
      EXPECT_EQ(next, slices);
      EXPECT_EQ(plan.divisions, std::min(slices, divisions));
    }
  }
}

TEST(Plan, PiecesAreWholeLayersOfChunksWhereTheyFit)
{
  const VolumeHeader header = MakeHeader({ 500, 500, 670 });
  Footprint          footprint = MakeFootprint(header, 1);
  footprint.slicesOfLayer = 31;
  JobOptions options;
  options.threads = 2;
  const JobPlan plan = MakePlan(options, header, {}, footprint);
  std::uint64_t next = 0;
  for (std::uint64_t piece = 0; piece < plan.divisions; ++piece)
  {
    const SliceRange range = plan.GetPiece(piece);
    EXPECT_EQ(range.begin, next);
    EXPECT_EQ(range.begin % 31, 0u);
    EXPECT_LE(range.end - range.begin, plan.GetMaximumSlices());
    next = range.end;
  }
  EXPECT_GT(plan.divisions, 1u);
  EXPECT_EQ(next, 670u);

  footprint.slicesOfLayer = 600;
  EXPECT_EQ(MakePlan(options, header, {}, footprint).sliceUnit, 1u);
  footprint.slicesOfLayer = 31;
  options.divisions = 670;
  EXPECT_EQ(MakePlan(options, header, {}, footprint).divisions, 670u);
}

TEST(Plan, LargeResultsAreDivided)
{
  JobOptions options;
  options.threads = 2;
  EXPECT_EQ(MakePlanFor(options, MakeHeader({ 100, 100, 100 }), 1).divisions, 1u);
  const JobPlan plan = MakePlanFor(options, MakeHeader({ 1000, 1000, 1000 }), 16);
  EXPECT_GE(plan.divisions, 32u);
  EXPECT_LT(plan.memory.planned, 700 * MiB);
}

TEST(Plan, LessMemoryMeansMorePiecesUntilItIsRefused)
{
  const VolumeHeader header = MakeHeader({ 500, 500, 500 });
  JobOptions         options;
  options.threads = 1;
  std::uint64_t divisions = 0;
  for (const std::uint64_t memory : { 400 * MiB, 150 * MiB, 40 * MiB })
  {
    options.memoryLimit = memory;
    const JobPlan plan = MakePlanFor(options, header, 13);
    EXPECT_LE(plan.memory.planned, memory);
    EXPECT_GE(plan.divisions, divisions);
    divisions = plan.divisions;
  }
  options.memoryLimit = 10 * MiB;
  try
  {
    MakePlanFor(options, header, 13);
    FAIL() << "planned the impossible";
  }
  catch (const JobError & error)
  {
    EXPECT_EQ(error.GetStatus(), ExitStatus::Refused);
  }
}

TEST(Plan, TheValuesOfACompressedVolumeAreInMemoryWhereTheyFit)
{
  JobOptions   options;
  VolumeHeader header = MakeHeader({ 1000, 1000, 1000 });
  header.compressed = true;
  options.threads = 1;
  options.memoryLimit = 1300 * MiB;
  options.scratchFolder = "folder";
  EXPECT_TRUE(MakePlanFor(options, header, 1).scratchFolder.empty());
  options.memoryLimit = 100 * MiB;
  const JobPlan plan = MakePlanFor(options, header, 1);
  EXPECT_EQ(plan.scratchFolder, "folder");
  EXPECT_LE(plan.memory.planned, 100 * MiB);
  options.scratchFolder.clear();
  EXPECT_THROW(MakePlanFor(options, header, 1), JobError);
}

TEST(Plan, TakesAsManyThreadsAsHalfOfTheMemoryHolds)
{
  const auto wanted = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(64);
  const VolumeHeader header = MakeHeader({ 500, 500, 500 });
  unsigned int       fewest = 64;
  unsigned int       most = 1;
  for (const std::uint64_t memory : { 4096 * MiB, 150 * MiB, 80 * MiB, 50 * MiB, 30 * MiB })
  {
    JobOptions options;
    options.memoryLimit = memory;
    const JobPlan plan = MakePlanFor(options, header, 1);
    EXPECT_LE(plan.memory.planned, memory);
    fewest = std::min(fewest, plan.threads);
    most = std::max(most, plan.threads);
    if (plan.threads < 64)
    {
      // Half of the memory is left for thicker walls.
      options.threads = plan.threads + 1;
      options.memoryLimit = memory / 2;
      EXPECT_THROW(MakePlanFor(options, header, 1), JobError) << memory;
    }
  }
  EXPECT_EQ(most, 64u);
  EXPECT_LT(fewest, 16u);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(wanted);
}

TEST(Plan, WritesBehindWhereTheMemoryHoldsTwoPieces)
{
  const VolumeHeader header = MakeHeader({ 500, 500, 500 });
  JobOptions         options;
  options.threads = 2;
  options.memoryLimit = 600 * MiB;
  const JobPlan ample = MakePlanFor(options, header, 1);
  EXPECT_TRUE(ample.writesBehind);
  EXPECT_EQ(ample.GetResults(3), 6 * ample.memory.perSlice);
  EXPECT_LE(ample.memory.planned, 600 * MiB);

  options.divisions = 1;
  EXPECT_FALSE(MakePlanFor(options, header, 1).writesBehind);
  options.divisions.reset();
  options.threads = 1;
  EXPECT_TRUE(MakePlanFor(options, header, 1).writesBehind);
  options.threads = 2;

  // Filters that take turns on a piece use each other's memory.
  Footprint two = MakeFootprint(header, 1);
  two.engines.push_back(two.engines.front());
  EXPECT_FALSE(MakePlan(options, header, {}, two).writesBehind);
  // Not with pieces of hundreds of megabytes, whoever chose them.
  options.divisions = 3;
  EXPECT_FALSE(MakePlanFor(options, header, 8).writesBehind);
  EXPECT_TRUE(MakePlanFor(options, header, 1).writesBehind);
  options.divisions.reset();
  options.memoryLimit = 8192 * MiB;
  EXPECT_TRUE(MakePlanFor(options, header, 40).writesBehind);
  EXPECT_FALSE(MakePlanFor(options, header, 80).writesBehind);
}

TEST(Plan, ThinnerSlabsComeBeforeWaitingForTheDisk)
{
  const VolumeHeader header = MakeHeader({ 500, 500, 500 });
  JobOptions         options;
  options.threads = 2;
  options.memoryLimit = 600 * MiB;
  const std::uint64_t widest = MakePlanFor(options, header, 16).slabSlices;
  std::uint64_t       thinnest = widest;
  bool                isBehind = true;
  for (std::uint64_t memory = 600 * MiB; memory > 25 * MiB && isBehind; memory -= MiB / 4)
  {
    options.memoryLimit = memory;
    const JobPlan plan = MakePlanFor(options, header, 16);
    EXPECT_LE(plan.memory.planned, memory);
    isBehind = plan.writesBehind;
    if (isBehind)
    {
      EXPECT_LE(plan.slabSlices, thinnest);
      thinnest = plan.slabSlices;
    }
  }
  EXPECT_FALSE(isBehind);
  EXPECT_EQ(thinnest, widest / 4);
}

TEST(Plan, LargeResultsHalveTheSlabsOfTheEngine)
{
  const VolumeHeader header = MakeHeader({ 500, 500, 500 });
  JobOptions         options;
  options.threads = 2;
  options.memoryLimit = 8192 * MiB;
  const JobPlan small = MakePlanFor(options, header, 1);
  EXPECT_EQ(small.slabThickness, 0u);
  const JobPlan large = MakePlanFor(options, header, 40);
  EXPECT_EQ(large.slabThickness, small.slabSlices / 2);
  EXPECT_EQ(large.slabSlices, small.slabSlices / 2);
  EXPECT_EQ(MakePlanFor(options, header, 400).slabThickness, small.slabSlices / 2);
}

TEST(Plan, ShorterPiecesLeaveMoreToTheEngines)
{
  const VolumeHeader header = MakeHeader({ 500, 500, 500 });
  JobOptions         options;
  options.threads = 1;
  options.memoryLimit = 150 * MiB;
  const JobPlan       plan = MakePlanFor(options, header, 13);
  const std::uint64_t slices = plan.GetMaximumSlices();
  ASSERT_GT(slices, 1u);
  const std::uint64_t limit = plan.GetEngineLimit(slices);
  EXPECT_EQ(limit + plan.GetResults(slices) + plan.memory.fixed, 150 * MiB);
  EXPECT_EQ(plan.GetEngineLimit(slices - 1), limit + plan.GetResults(1));
  // 0 would be without limit.
  EXPECT_EQ(plan.GetEngineLimit(1000000), 1u);
}

TEST(Plan, EachEngineHasRoomInItsShare)
{
  const VolumeHeader header = MakeHeader({ 300, 300, 300 });
  JobOptions         options;
  options.threads = 1;
  options.memoryLimit = 16384 * MiB;
  Footprint                      footprint = MakeFootprint(header, 1);
  itk::MedialVoxelLocalThickness thickness;
  thickness.maximumThickness = 100.0;
  footprint.engines.front().settings.task = thickness;
  const auto getMemoryOfEngines = [&] {
    const JobPlan plan = MakePlan(options, header, {}, footprint);
    return plan.memory.planned - plan.memory.fixed - plan.GetResults(plan.GetSlicesAtOnce());
  };
  const std::uint64_t one = getMemoryOfEngines();
  // Shares are equal, so that a small engine takes as much as a large one.
  footprint.engines.emplace_back();
  footprint.engines.back().settings.task = itk::MedialVoxelDistanceMap{};
  EXPECT_EQ(getMemoryOfEngines(), 2 * one);
}

TEST(Plan, WhatWaitsForItsPieceGetsAPartOfTheMemoryThatIsLeft)
{
  const VolumeHeader header = MakeHeader({ 300, 300, 300 });
  JobOptions         options;
  options.threads = 1;
  std::uint64_t before = 0;
  bool          isLimited = false;
  for (const std::uint64_t memory : { 40, 60, 100, 400, 4000 })
  {
    options.memoryLimit = memory * MiB;
    const JobPlan without = MakePlanFor(options, header, 1);
    Footprint     footprint = MakeFootprint(header, 1);
    footprint.surplus = { 8, 1 };
    const JobPlan       plan = MakePlan(options, header, {}, footprint);
    const std::uint64_t slices = plan.GetMaximumSlices();
    const std::uint64_t most = 8 * slices * header.geometry.GetVoxelsPerSlice();
    EXPECT_EQ(slices, without.GetMaximumSlices());
    EXPECT_EQ(plan.memory.surplus, std::min(most, (memory * MiB - without.memory.planned) / 4));
    EXPECT_EQ(plan.memory.fixed, without.memory.fixed + plan.memory.surplus);
    EXPECT_EQ(plan.memory.planned, without.memory.planned + std::min(plan.memory.surplus, most / 8));
    EXPECT_LE(plan.memory.planned, memory * MiB);
    EXPECT_GE(plan.memory.surplus, before);
    before = plan.memory.surplus;
    isLimited |= plan.memory.surplus < most;
  }
  EXPECT_TRUE(isLimited);
  EXPECT_GT(before, 0u);
}
