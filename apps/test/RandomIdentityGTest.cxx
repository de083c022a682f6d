// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The same bytes and counts for any memory budget, division, number of threads and format, on volumes drawn at random
// (invariant I2). MEDIALVOXEL_TEST_SEED sets the seed; each --gtest_repeat iteration draws anew.

#include "RandomVolume.h"
#include "RunJob.h"

#include "Errors.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

using namespace medialvoxel;

namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

/** A new one for each test of each iteration; its output on failure repeats the draw. */
unsigned int
NextSeed()
{
  static unsigned int numberOfCalls = 0;
  const char * const  text = std::getenv("MEDIALVOXEL_TEST_SEED");
  const unsigned int  first = text ? static_cast<unsigned int>(std::strtoul(text, nullptr, 10)) : 20261121u;
  return first + 1000u * numberOfCalls++;
}

/** Bytes of the outputs by name, and the counts. */
struct Outcome
{
  std::map<std::string, std::string> volumes;
  std::vector<std::uint64_t>         counts;
};

Outcome
Collect(const TemporaryFolder & folder, const std::vector<std::string> & names, const JobResult & result)
{
  Outcome outcome;
  for (const NamedCount & count : NamedCounts)
  {
    outcome.counts.push_back(result.sums.counts.*count.member);
  }
  for (const std::string & name : names)
  {
    outcome.volumes[name] = folder.Read(name);
  }
  return outcome;
}

/** How one of the two jobs is run on a given input with given limits. */
class Subject
{
public:
  virtual ~Subject() = default;
  virtual JobResult
  Run(const JobOptions & limits) const = 0;
  virtual std::vector<std::string>
  GetOutputs() const = 0;
};

/** Copies the members that do not belong to the result: input, memory, threads, pieces, form of the files. */
template <typename TOptions>
TOptions
WithLimits(TOptions options, const JobOptions & limits)
{
  options.input = limits.input;
  options.raw = limits.raw;
  options.spacing = limits.spacing;
  options.scratchFolder = limits.scratchFolder;
  options.memoryLimit = limits.memoryLimit;
  options.threads = limits.threads;
  options.divisions = limits.divisions;
  options.sparse = limits.sparse;
  options.overwrite = true;
  options.dryRun = limits.dryRun;
  return options;
}

void
DrawObject(JobOptions & options, const RandomVolume & volume, Dice & dice)
{
  // Values of 0 and 100 make the same object with and without a limit; one in three relies on that of zero.
  if (volume.pixelType == PixelType::Float32 || !dice.OneIn(3))
  {
    options.lowerThreshold = RandomVolume::ObjectValue;
  }
}

class ExtractSubject : public Subject
{
public:
  ExtractSubject(const RandomVolume & volume, Dice & dice, const TemporaryFolder & folder)
  {
    DrawObject(m_Options, volume, dice);
    m_Options.output = (folder / "labels.mha").string();
    m_Options.thickness = dice.Pick<double>({ 0.8, 1.5, 3.0, 6.0 });
    if (dice.OneIn(2))
    {
      m_Options.vectorFile = (folder / "vectors.mha").string();
      m_Options.vectorBoundary =
        dice.Pick<itk::MedialVoxelBoundary>({ itk::MedialVoxelBoundary::Object, itk::MedialVoxelBoundary::Background });
    }
    if (dice.OneIn(3))
    {
      m_Options.distanceFile = (folder / "distance.mha").string();
    }
    if (dice.OneIn(3))
    {
      m_Options.previewFile = (folder / "preview.png").string();
    }
    if (dice.OneIn(2))
    {
      m_Options.thicknessFile = (folder / "thickness.mha").string();
    }
    if (dice.OneIn(2))
    {
      m_Options.maximumPoreSize = dice.Pick<std::uint64_t>({ 1, 8, 40 });
    }
  }

  JobResult
  Run(const JobOptions & limits) const override
  {
    ProgressSink sink;
    return RunJob(WithLimits(m_Options, limits), sink);
  }

  std::vector<std::string>
  GetOutputs() const override
  {
    std::vector<std::string> names{ "labels.mha" };
    for (const auto & [file, name] : { std::make_pair(m_Options.vectorFile, "vectors.mha"),
                                       { m_Options.distanceFile, "distance.mha" },
                                       { m_Options.thicknessFile, "thickness.mha" },
                                       { m_Options.previewFile, "preview.png" } })
    {
      if (!file.empty())
      {
        names.emplace_back(name);
      }
    }
    return names;
  }

private:
  ExtractOptions m_Options;
};

class DistanceSubject : public Subject
{
public:
  DistanceSubject(const RandomVolume & volume, Dice & dice, const TemporaryFolder & folder)
  {
    DrawObject(m_Options, volume, dice);
    m_Options.output = (folder / "vectors.mha").string();
    m_Options.distanceFile = (folder / "distance.mha").string();
    m_Options.boundary =
      dice.Pick<itk::MedialVoxelBoundary>({ itk::MedialVoxelBoundary::Object, itk::MedialVoxelBoundary::Background });
    m_Options.region = dice.Pick<itk::MedialVoxelRegion>(
      { itk::MedialVoxelRegion::Inside, itk::MedialVoxelRegion::Outside, itk::MedialVoxelRegion::Both });
    if (dice.OneIn(2))
    {
      m_Options.maximumDistance = dice.Pick<double>({ 1.0, 4.0, 12.5 });
    }
  }

  JobResult
  Run(const JobOptions & limits) const override
  {
    ProgressSink sink;
    return RunJob(WithLimits(m_Options, limits), sink);
  }

  std::vector<std::string>
  GetOutputs() const override
  {
    return { "vectors.mha", "distance.mha" };
  }

private:
  DistanceOptions m_Options;
};

bool
IsAccepted(const Subject & subject, JobOptions limits)
{
  limits.dryRun = true;
  try
  {
    subject.Run(limits);
    return true;
  }
  catch (const JobError & error)
  {
    if (error.GetStatus() != ExitStatus::Refused)
    {
      throw;
    }
    return false;
  }
}

/** The smallest memory, to a part in a thousand, that these limits can be planned for. */
std::uint64_t
FindSmallestMemory(const Subject & subject, JobOptions limits)
{
  std::uint64_t refused = 0;
  std::uint64_t accepted = 4096 * MiB;
  while (accepted - refused > accepted / 1000)
  {
    limits.memoryLimit = refused + (accepted - refused) / 2;
    (IsAccepted(subject, limits) ? accepted : refused) = *limits.memoryLimit;
  }
  return accepted;
}

/** Limits that can be met, half of them just. */
JobOptions
DrawLimits(const Subject & subject, const VolumeFile & file, Dice & dice, const TemporaryFolder & folder)
{
  JobOptions limits;
  limits.input = file.fileName;
  limits.raw = file.raw;
  limits.spacing = file.spacing;
  limits.sparse = dice.OneIn(2);
  limits.threads = static_cast<unsigned int>(dice.Roll(1, 5));
  if (dice.OneIn(2))
  {
    limits.scratchFolder = (folder / "").string();
  }
  if (dice.OneIn(2))
  {
    limits.divisions = static_cast<std::uint64_t>(dice.Roll(1, 90));
  }
  const std::uint64_t smallest = FindSmallestMemory(subject, limits);
  limits.memoryLimit = dice.OneIn(2) ? smallest : smallest + static_cast<std::uint64_t>(dice.Roll(0, 40)) * MiB / 10;
  return limits;
}

std::string
Describe(const JobOptions & limits)
{
  std::ostringstream text;
  text << limits.input << ", memory " << *limits.memoryLimit << ", threads " << *limits.threads << ", divisions "
       << limits.divisions.value_or(0) << (limits.sparse ? ", sparse" : "");
  return text.str();
}

/** Plans are made for walls of a usual thickness; thicker walls may need more memory than a run has. */
template <typename TSubject>
std::optional<JobResult>
RunUnlessWallsAreTooThick(const TSubject & subject, const JobOptions & limits)
{
  try
  {
    return subject.Run(limits);
  }
  catch (const JobError & error)
  {
    EXPECT_EQ(error.GetStatus(), ExitStatus::Refused) << error.what();
    return std::nullopt;
  }
}

/** Runs a subject without limits and then with several drawn ones. */
template <typename TSubject>
void
CompareRuns(unsigned int seed)
{
  constexpr int         numberOfRuns = 4;
  const TemporaryFolder folder;
  Dice                  dice(seed);
  const RandomVolume    volume = DrawVolume(dice);
  const TSubject        subject(volume, dice, folder);

  JobOptions unlimited;
  unlimited.input = WriteVolume(volume, 0, folder).fileName;
  unlimited.memoryLimit = 4096 * MiB;
  unlimited.threads = 1;
  unlimited.divisions = 1;
  const Outcome expected = Collect(folder, subject.GetOutputs(), subject.Run(unlimited));
  for (int run = 0; run < numberOfRuns; ++run)
  {
    const VolumeFile file = WriteVolume(volume, dice.Roll(0, NumberOfVolumeFormats - 1), folder);
    const JobOptions limits = DrawLimits(subject, file, dice, folder);
    SCOPED_TRACE(Describe(limits));
    const auto result = RunUnlessWallsAreTooThick(subject, limits);
    if (!result)
    {
      continue;
    }
    const Outcome actual = Collect(folder, subject.GetOutputs(), *result);
    EXPECT_EQ(actual.counts, expected.counts);
    for (const auto & [name, bytes] : expected.volumes)
    {
      EXPECT_TRUE(actual.volumes.at(name) == bytes) << name << " differs";
    }
  }
}

constexpr unsigned int NumberOfVolumes = 25;

} // namespace

TEST(RandomIdentity, Extract)
{
  const unsigned int first = NextSeed();
  for (unsigned int seed = first; seed < first + NumberOfVolumes && !HasFailure(); ++seed)
  {
    SCOPED_TRACE("MEDIALVOXEL_TEST_SEED=" + std::to_string(seed));
    CompareRuns<ExtractSubject>(seed);
  }
}

TEST(RandomIdentity, Distance)
{
  const unsigned int first = NextSeed();
  for (unsigned int seed = first; seed < first + NumberOfVolumes && !HasFailure(); ++seed)
  {
    SCOPED_TRACE("MEDIALVOXEL_TEST_SEED=" + std::to_string(seed));
    CompareRuns<DistanceSubject>(seed);
  }
}
