// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Checksum.h"
#include "ClusterRange.h"
#include "Errors.h"
#include "JobFolder.h"
#include "OutputVolume.h"
#include "Report.h"
#include "SealedJson.h"
#include "TemporaryFolder.h"
#include "Version.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <set>
#include <utility>
#include <vector>

using namespace medialvoxel;

namespace
{

Manifest
MakeManifest()
{
  Manifest manifest;
  manifest.version = medialvoxel::GetVersion();
  manifest.jobId = "0123456789abcdef";
  manifest.folder = "/somewhere";
  manifest.options.input = "in \"1\".raw";
  manifest.options.output = "out.mha";
  manifest.options.thickness = 0.1;
  manifest.options.lowerThreshold = -std::numeric_limits<double>::infinity();
  manifest.options.upperThreshold = 1e300;
  manifest.options.vectorBoundary = itk::MedialVoxelBoundary::Background;
  manifest.options.raw = RawDescription{ { 3, 4, 100 }, PixelType::Int16, 5, true };
  manifest.options.memoryLimit = 123456789;
  manifest.input.push_back({ "/in.raw", 2405, -5 });
  manifest.numberOfSlices = 100;
  manifest.numberOfClusters = 7;
  manifest.perSlice = 12;
  return manifest;
}

VolumeGeometry
MakeGeometry()
{
  VolumeGeometry geometry;
  geometry.size = { 3, 2, 5 };
  geometry.spacing = { 1, 1, 1 };
  geometry.origin = { 0, 0, 0 };
  geometry.SetIdentityDirection();
  return geometry;
}

constexpr VoxelLayout Bytes{ PixelType::UInt8, 1 };

} // namespace

TEST(ClusterRange, Parses)
{
  const auto list = [](const std::string & text) { return ListClusters(ParseClusters(text).value(), 10); };
  EXPECT_EQ(list("3"), (std::vector<std::uint64_t>{ 3 }));
  EXPECT_EQ(list("7-9,0,2-3,3"), (std::vector<std::uint64_t>{ 0, 2, 3, 7, 8, 9 }));
  EXPECT_EQ(ListClusters({}, 3), (std::vector<std::uint64_t>{ 0, 1, 2 }));
  for (const char * const text : { "", "-", "1-", "-1", "2-1", "1,", ",1", "a", "1 ", "99999999999999999999" })
  {
    EXPECT_FALSE(ParseClusters(text)) << text;
  }
  EXPECT_THROW(list("10"), JobError);
  EXPECT_THROW(list("0-9223372036854775807"), JobError);
}

TEST(ClusterRange, Formats)
{
  EXPECT_EQ(FormatClusters({}), "");
  EXPECT_EQ(FormatClusters({ 5 }), "5");
  EXPECT_EQ(FormatClusters({ 0, 1, 2, 4, 7, 8 }), "0-2,4,7-8");
}

TEST(ClusterRange, ChoosesWhatFollows)
{
  using Set = std::set<std::uint64_t>;
  EXPECT_EQ(ChooseCluster({ 0, 1, 2, 3 }, {}, std::nullopt), 0u);
  EXPECT_EQ(ChooseCluster({ 0, 1, 2, 3 }, {}, 2), 3u);
  EXPECT_EQ(ChooseCluster({ 0, 1, 4, 5, 6, 9 }, {}, 2), 4u);
  EXPECT_EQ(ChooseCluster({ 1, 2, 3, 4 }, { 0 }, std::nullopt), 3u);
  EXPECT_EQ(ChooseCluster({ 5 }, { 4, 6 }, std::nullopt), 5u);
  // Processes that take turns take runs of their own.
  Set                                       free;
  std::vector<std::optional<std::uint64_t>> last(3);
  std::vector<std::vector<std::uint64_t>>   done(3);
  for (std::uint64_t cluster = 0; cluster < 30; ++cluster)
  {
    free.insert(cluster);
  }
  while (!free.empty())
  {
    for (std::size_t process = 0; process < 3 && !free.empty(); ++process)
    {
      Set busy;
      for (const auto & other : last)
      {
        busy.insert(other.value_or(1000));
      }
      last[process] = ChooseCluster(free, busy, last[process]);
      free.erase(*last[process]);
      done[process].push_back(*last[process]);
    }
  }
  std::size_t starts = 0;
  for (const auto & clusters : done)
  {
    for (std::size_t i = 0; i < clusters.size(); ++i)
    {
      starts += i == 0 || clusters[i] != clusters[i - 1] + 1 ? 1 : 0;
    }
  }
  EXPECT_LE(starts, 8u);
}

TEST(Checksum, IsThatOfZlib)
{
  EXPECT_EQ(GetChecksum("123456789"), 0xcbf43926u);
  Checksum parts;
  parts.Add("1234", 4);
  parts.Add("56789", 5);
  EXPECT_EQ(parts.GetValue(), 0xcbf43926u);
}

TEST(Checksum, OfZerosIsNoOther)
{
  std::string text(50000, '\0');
  text[20000] = 'x';
  Checksum bytes;
  for (const char byte : text)
  {
    bytes.Add(&byte, 1);
  }
  EXPECT_EQ(GetChecksum(text), bytes.GetValue());
}

TEST(Manifest, ComesBackAsItWas)
{
  const TemporaryFolder folder;
  const Manifest        manifest = MakeManifest();
  WriteManifest(folder / "m.json", manifest);
  const Manifest back = ReadManifest(folder / "m.json").value();
  EXPECT_EQ(FindDifference(manifest.options, back.options), "");
  EXPECT_EQ(back.options.raw->pixelType, PixelType::Int16);
  EXPECT_EQ(back.options.memoryLimit, manifest.options.memoryLimit);
  EXPECT_EQ(back.jobId, manifest.jobId);
  EXPECT_EQ(back.input[0].modified, -5);
  EXPECT_EQ(back.perSlice, 12u);
  EXPECT_EQ(back.GetCluster(0).end, 15u);
  EXPECT_EQ(back.GetCluster(6).end, 100u);
  EXPECT_FALSE(ReadManifest(folder / "none.json"));
}

TEST(Manifest, EveryByteCounts)
{
  const TemporaryFolder folder;
  WriteManifest(folder / "m.json", MakeManifest());
  const std::string good = folder.Read("m.json");
  for (std::size_t i = 0; i + 1 < good.size(); ++i)
  {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    folder.Write("m.json", bad);
    if (std::isspace(static_cast<unsigned char>(good[i])) == 0)
    {
      EXPECT_THROW(ReadManifest(folder / "m.json"), JobError) << i;
    }
  }
}

TEST(Manifest, RefusesWhatHasTheChecksumButAnotherForm)
{
  const TemporaryFolder folder;
  Json                  deep = 0;
  for (int depth = 0; depth < 100; ++depth)
  {
    deep = Json::array({ std::move(deep) });
  }
  for (const Json & object : { Json{ { "version", 7 } },
                               Json{ { "version", medialvoxel::GetVersion() }, { "format", "1" } },
                               Json{ { "version", medialvoxel::GetVersion() }, { "format", 1 } },
                               Json{ { "version", deep } } })
  {
    WriteSealed(folder / "m.json", object);
    try
    {
      ReadManifest(folder / "m.json");
      ADD_FAILURE() << object;
    }
    catch (const JobError & error)
    {
      EXPECT_EQ(error.GetStatus(), ExitStatus::Failure);
      EXPECT_NE(std::string(error.what()).find("m.json"), std::string::npos) << error.what();
    }
  }
}

TEST(Manifest, FormatsAreWholeNumbers)
{
  const TemporaryFolder folder;
  for (const char * const format : { "1e36", "1.5", "-2147483649", "true" })
  {
    WriteSealed(folder / "m.json", Json{ { "version", medialvoxel::GetVersion() }, { "format", Json::parse(format) } });
    try
    {
      ReadManifest(folder / "m.json");
      ADD_FAILURE() << format;
    }
    catch (const JobError & error)
    {
      EXPECT_NE(std::string(error.what()).find("is not a whole number in range"), std::string::npos) << error.what();
    }
  }
}

TEST(SealedJson, WholeNumbersAreNotConverted)
{
  const auto read = [](const char * text, auto number) {
    ReadWhole(Json::parse(text), number);
    return number;
  };
  EXPECT_EQ(read("18446744073709551615", std::uint64_t{}), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(read("-9223372036854775808", std::int64_t{}), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(read("4294967295", std::uint32_t{}), 4294967295u);
  EXPECT_EQ(read("null", std::optional<unsigned int>(3)), std::nullopt);
  for (const char * const text : { "-1", "4294967296", "1.0", "1e300", "true", "\"1\"", "null", "[1]" })
  {
    EXPECT_THROW(read(text, std::uint32_t{}), std::invalid_argument) << text;
  }
  EXPECT_THROW(read("9223372036854775808", std::int64_t{}), std::invalid_argument);
  EXPECT_THROW(read("-1", std::optional<std::uint64_t>()), std::invalid_argument);
}

TEST(Manifest, NamesTheDifference)
{
  const ExtractOptions present = MakeManifest().options;
  ExtractOptions       wanted = present;
  wanted.thickness.reset();
  EXPECT_EQ(FindDifference(wanted, present), "--thickness is unset, not 0.1");
  wanted = present;
  wanted.raw->size[2] = 101;
  EXPECT_NE(FindDifference(wanted, present), "");
  wanted = present;
  wanted.memoryLimit.reset();
  wanted.threads = 3;
  EXPECT_EQ(FindDifference(wanted, present), "");
  wanted.overwrite = !present.overwrite;
  EXPECT_EQ(FindDifference(wanted, present), "");
  wanted.divisions = 3;
  EXPECT_EQ(FindDifference(wanted, present), "--divisions is 3, not 0");
}

TEST(Manifest, RefusesNamesThatAreNotText)
{
  const TemporaryFolder folder;
  Manifest              manifest = MakeManifest();
  manifest.options.input = "\xff";
  EXPECT_THROW(WriteManifest(folder / "m.json", manifest), JobError);
  EXPECT_EQ(folder.GetNumberOfFiles(), 0);
}

TEST(JobLocks, BelongToOne)
{
  const TemporaryFolder folder;
  JobLocks              one(folder / "locks");
  EXPECT_FALSE(IsLocked(folder / "none", 3));
  {
    const auto lock = one.TryLock(3);
    EXPECT_TRUE(lock);
    EXPECT_TRUE(one.TryLock(4));
#ifdef F_OFD_SETLK
    JobLocks other(folder / "locks");
    EXPECT_FALSE(other.TryLock(3));
    EXPECT_TRUE(other.TryLock(JobLocks::Finalizing));
    EXPECT_TRUE(IsLocked(folder / "locks", 3));
    EXPECT_FALSE(IsLocked(folder / "locks", 4));
#endif
  }
  EXPECT_FALSE(IsLocked(folder / "locks", 3));
  EXPECT_TRUE(one.TryLock(3));
}

TEST(SharedVolume, AnotherFileIsNotTakenForOneThatIsPublished)
{
  const TemporaryFolder folder;
  OutputVolume          other(folder / "a.mha", false, false);
  other.Create(MakeGeometry(), Bytes);
  other.Finish();
  other.Publish();
  OutputVolume volume(folder / "a.mha", true, false);
  EXPECT_THROW(volume.OpenToPublish(MakeGeometry(), Bytes, ".job", { "", false }), JobError);
}

TEST(SharedVolume, IsWrittenByManyAndPublishedByOne)
{
  for (const char * const name : { "a.mha", "a.mhd", "a.nrrd", "a.nhdr" })
  {
    const TemporaryFolder folder;
    const std::string     content = "abcdefghijklmnopqrstuvwxyz1234";
    {
      OutputVolume plain(folder / (std::string("plain-") + name), false, false);
      plain.Create(MakeGeometry(), Bytes);
      plain.Write(0, content.size(), content.data());
      plain.Finish();
      plain.Publish();
    }

    OutputVolume(folder / name, false, false).CreateShared(MakeGeometry(), Bytes, ".job");
    EXPECT_FALSE(std::filesystem::exists(folder / name));
    for (const std::size_t first : { 18, 0, 6, 24, 12 })
    {
      OutputVolume worker(folder / name, false, false);
      worker.OpenShared(MakeGeometry(), Bytes, ".job");
      worker.StartCluster();
      worker.Write(first, 2, content.data() + first);
      worker.Write(first + 2, 4, content.data() + first + 2);
      worker.Sync();
      EXPECT_EQ(worker.GetChecksum(), GetChecksum(content.substr(first, 6)));
    }
    const std::filesystem::path dataName = OutputVolume(folder / name, false, false).FindFreeDataName();
    for (int round = 0; round < 2; ++round) // the second one as after an interruption
    {
      OutputVolume last(folder / name, round > 0, false);
      last.OpenToPublish(MakeGeometry(), Bytes, ".job", { dataName, round > 0 });
      EXPECT_EQ(last.ReadChecksum(6, 20), GetChecksum(content.substr(6, 20)));
      last.Finish();
      last.Publish();
    }
    std::string       header = folder.Read(name);
    const std::size_t position = header.find("a.raw");
    if (position != std::string::npos)
    {
      header.replace(position, 1, "plain-a");
      EXPECT_EQ(folder.Read("a.raw"), content);
    }
    EXPECT_EQ(header, folder.Read(std::string("plain-") + name));
    EXPECT_EQ(folder.GetNumberOfFiles(), position == std::string::npos ? 2 : 4);
  }
}
