// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputFile.h"

#include "Errors.h"
#include "ProcessIdentity.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace medialvoxel;

TEST(OutputFile, AppearsOnlyWhenPublished)
{
  const TemporaryFolder folder;
  OutputFile            file(folder / "a", false);
  file.Create(6, true);
  file.WriteAt(3, "def", 3);
  file.WriteAt(0, "abc", 3);
  file.Finish();
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  file.Publish();
  EXPECT_EQ(folder.Read("a"), "abcdef");
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
}

TEST(OutputFile, LeavesNothingBehindWhenGivenUp)
{
  const TemporaryFolder folder;
  folder.Write("a", "old");
  {
    OutputFile nameless(folder / "a", true);
    nameless.Create(1 << 20, true);
    OutputFile file(folder / "a", true);
    file.CreateNamed(1 << 20, true);
    EXPECT_TRUE(std::filesystem::exists(file.GetTemporaryName()));
  }
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  EXPECT_EQ(folder.Read("a"), "old");
}

TEST(OutputFile, KeepsAFileThatCameUpMeanwhile)
{
  const TemporaryFolder folder;
  OutputFile            file(folder / "a", false);
  file.Create(0, false);
  folder.Write("a", "of somebody else");
  try
  {
    file.Publish();
    FAIL() << "replaced a file";
  }
  catch (const JobError & error)
  {
    EXPECT_EQ(error.GetStatus(), ExitStatus::Refused);
  }
  EXPECT_EQ(folder.Read("a"), "of somebody else");
}

TEST(OutputFile, NoticesAWrongSize)
{
  const TemporaryFolder folder;
  OutputFile            file(folder / "a", false);
  file.CreateNamed(10, false);
  std::filesystem::resize_file(file.GetTemporaryName(), 9);
  EXPECT_THROW(file.Finish(), JobError);
}

TEST(OutputFile, TwoOfOneNameDoNotMeet)
{
  const TemporaryFolder folder;
  OutputFile            first(folder / "a", true);
  OutputFile            second(folder / "a", true);
  first.CreateNamed(0, false);
  second.CreateNamed(0, false);
  EXPECT_NE(first.GetTemporaryName(), second.GetTemporaryName());
}

TEST(OutputFile, HasNoNameBeforeItsOwn)
{
  const TemporaryFolder folder;
  OutputFile            file(folder / "a", true);
  file.Create(5, true);
  if (!file.GetTemporaryName().empty())
  {
    GTEST_SKIP() << "no files without a name in " << (folder / "");
  }
  file.WriteAt(0, "words", 5);
  file.Finish();
  EXPECT_EQ(folder.GetNumberOfFiles(), 0);
  file.Publish();
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  EXPECT_EQ(folder.Read("a"), "words");

  OutputFile second(folder / "a", true);
  second.Create(0, false);
  WriteText(second, "other words");
  EXPECT_EQ(folder.Read("a"), "words");
  second.Publish();
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  EXPECT_EQ(folder.Read("a"), "other words");
}

TEST(OutputFile, HasThePermissionsOfAnyNewFile)
{
  const TemporaryFolder folder;
  folder.Write("other", "");
  OutputFile file(folder / "a", true);
  file.Create(0, false);
  file.Finish();
  file.Publish();
  EXPECT_EQ(std::filesystem::status(folder / "a").permissions(),
            std::filesystem::status(folder / "other").permissions());
}

TEST(OutputFile, LosesANameThatWasForNow)
{
  const TemporaryFolder folder;
  folder.Write("taken", "of somebody else");
  for (const bool keeps : { false, true })
  {
    {
      OutputFile file(folder / "a", false);
      file.Create(0, false);
      WriteText(file, "words");
      file.SetFileName(folder / "taken");
      EXPECT_FALSE(file.PublishForNow());
      file.SetFileName(folder / "free");
      EXPECT_TRUE(file.PublishForNow());
      EXPECT_EQ(folder.Read("free"), "words");
      if (keeps)
      {
        file.KeepName();
      }
    }
    EXPECT_EQ(folder.GetNumberOfFiles(), keeps ? 2 : 1);
    EXPECT_EQ(folder.Read("taken"), "of somebody else");
  }
}

TEST(OutputFile, KeepsWhatItExchanges)
{
  const TemporaryFolder folder;
  for (const bool exists : { false, true })
  {
    OutputFile file(folder / "a", true);
    file.Create(0, false);
    WriteText(file, exists ? "new" : "old");
    EXPECT_EQ(file.PublishByExchange(), exists);
    EXPECT_EQ(folder.Read("a"), exists ? "new" : "old");
    EXPECT_EQ(exists ? folder.Read(file.GetTemporaryName().filename().string()) : "old", "old");
    file.KeepName();
  }
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  OutputFile file(folder / "a", false);
  file.Create(0, false);
  EXPECT_THROW(file.PublishByExchange(), JobError);
  EXPECT_EQ(folder.Read("a"), "new");
}

TEST(OutputFile, DoesNotReplaceAFolderThatCameUpMeanwhile)
{
  const TemporaryFolder folder;
  for (const bool exchanges : { false, true })
  {
    OutputFile file(folder / "a", true);
    file.Create(0, false);
    std::filesystem::create_directory(folder / "a");
    folder.Write("a/precious", "words");
    EXPECT_THROW(exchanges ? static_cast<void>(file.PublishByExchange()) : file.Publish(), JobError);
    EXPECT_EQ(folder.Read("a/precious"), "words");
  }
}

TEST(OutputFile, RefusesALongNameAtOnce)
{
  const TemporaryFolder folder;
  OutputFile            file(folder / std::string(300, 'a'), false);
  EXPECT_THROW(file.Create(0, false), JobError);
  const std::string longest(255, 'a');
  for (const bool overwrites : { false, true })
  {
    // The temporary name, which the second file needs, is cut.
    OutputFile fits(folder / longest, overwrites);
    fits.Create(0, false);
    fits.Finish();
    fits.Publish();
  }
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
}

TEST(OutputFile, SparseWritingSkipsZerosAndNothingElse)
{
  constexpr std::uint64_t size = 5 << 20;
  std::vector<char>       data(size, 0);
  for (const std::uint64_t position :
       { std::uint64_t{ 0 }, std::uint64_t{ 65535 }, std::uint64_t{ 3 << 20 }, size - 1 })
  {
    data[position] = 'x';
  }
  const TemporaryFolder folder;
  OutputFile            file(folder / "a", false);
  constexpr char        header[] = "header of some bytes";
  file.Create(sizeof(header) + size, false);
  file.WriteAt(0, header, sizeof(header));
  file.WriteSparseAt(sizeof(header), data.data(), size);
  file.Finish();
  file.Publish();

  const std::string content = folder.Read("a");
  EXPECT_EQ(content.substr(sizeof(header)), std::string(data.begin(), data.end()));
}

TEST(OutputFile, RefusesAFolderThatCannotBeWritten)
{
  OutputFile file("/proc/medialvoxel-test", false);
  try
  {
    file.Create(0, false);
    FAIL() << "created a file";
  }
  catch (const JobError & error)
  {
    EXPECT_EQ(error.GetStatus(), ExitStatus::Refused);
  }
}

TEST(OutputFile, IsTheSamePastThePageCache)
{
  const TemporaryFolder folder;
  std::string           expected(600 * UncachedWriter::BlockSize + 77, '\0');
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    expected[i] = static_cast<char>(i * 2654435761u >> 13);
  }
  // Lengths below, at and above a block, and so large that one buffer does not hold them.
  for (const std::size_t piece : { std::size_t{ 1000 }, std::size_t{ 4096 }, std::size_t{ 12345 }, expected.size() })
  {
    OutputFile file(folder / "a", true);
    file.Create(expected.size(), true);
    file.BypassPageCache();
    for (std::size_t begin = 0; begin < expected.size(); begin += piece)
    {
      file.WriteAt(begin, expected.data() + begin, std::min(piece, expected.size() - begin));
    }
    std::string back(expected.size(), '\0');
    file.ReadAt(0, back.data(), back.size());
    EXPECT_EQ(back, expected);
    file.Finish();
    file.Publish();
    EXPECT_EQ(folder.Read("a"), expected);
  }
}

TEST(OutputFile, IsWrittenWhereThePageCacheCannotBeBypassed)
{
  // This file system of the kernel has nothing but the page cache.
  const char * const memory = "/dev/shm";
  if (!std::filesystem::is_directory(memory))
  {
    GTEST_SKIP() << "no " << memory;
  }
  const std::string name = std::string(memory) + "/medialvoxel-" + std::to_string(GetThisProcess().number);
  OutputFile        file(name, false);
  file.Create(20000, true);
  file.BypassPageCache();
  const std::string expected(20000, 'x');
  file.WriteAt(0, expected.data(), expected.size());
  std::string back(expected.size(), '\0');
  file.ReadAt(0, back.data(), back.size());
  EXPECT_EQ(back, expected);
}
