// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SystemFile.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>
#include <sys/stat.h>

namespace
{
using medialvoxel::AddName;
using medialvoxel::FileAccess;
using medialvoxel::GetFileStatus;
using medialvoxel::MakeFolder;
using medialvoxel::Rename;
using medialvoxel::SystemFile;
using medialvoxel::TakenName;
using medialvoxel::TemporaryFolder;

TEST(SystemFile, ATakenNameStaysIsLostOrChanges)
{
  const TemporaryFolder folder;
  folder.Write("a", "of a");
  folder.Write("b", "of b");
  EXPECT_FALSE(Rename(folder / "a", folder / "b", TakenName::Stays));
  EXPECT_EQ(errno, EEXIST);
  EXPECT_EQ(folder.Read("b"), "of b");
  if (Rename(folder / "a", folder / "b", TakenName::Exchanges))
  {
    EXPECT_EQ(folder.Read("a"), "of b");
    EXPECT_EQ(folder.Read("b"), "of a");
  }
  else
  {
    EXPECT_EQ(errno, ENOSYS);
  }
  const std::string last = folder.Read("a");
  EXPECT_TRUE(Rename(folder / "a", folder / "b", TakenName::IsLost));
  EXPECT_EQ(folder.Read("b"), last);
  EXPECT_TRUE(Rename(folder / "b", folder / "c", TakenName::Stays));
  EXPECT_FALSE(Rename(folder / "b", folder / "d", TakenName::Stays));
  EXPECT_EQ(errno, ENOENT);
}

TEST(SystemFile, SecondNamesAreCounted)
{
  const TemporaryFolder folder;
  folder.Write("a", "text");
  ASSERT_TRUE(AddName(folder / "a", folder / "b"));
  EXPECT_FALSE(AddName(folder / "a", folder / "b"));
  EXPECT_EQ(errno, EEXIST);
  const auto a = GetFileStatus(folder / "a");
  const auto b = GetFileStatus(folder / "b");
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->numberOfNames, 2u);
  EXPECT_EQ(a->numberOfBytes, 4u);
  EXPECT_EQ(a->number, b->number);
  EXPECT_TRUE(a->isFile && a->isOfThisUser && !a->isFolder);
  EXPECT_TRUE(MakeFolder(folder / "c"));
  EXPECT_FALSE(MakeFolder(folder / "c"));
  EXPECT_EQ(errno, EEXIST);
  EXPECT_TRUE(GetFileStatus(folder / "c")->isFolder);
}

TEST(SystemFile, AccessSaysWhatBecomesOfAFile)
{
  const TemporaryFolder folder;
  EXPECT_FALSE(SystemFile(folder / "a", FileAccess::Change).IsOpen());
  EXPECT_EQ(errno, ENOENT);
  SystemFile made(folder / "a", FileAccess::Make);
  ASSERT_TRUE(made.WriteAt(0, "text", 4));
  EXPECT_EQ(SystemFile(folder / "a", FileAccess::Make).GetSize(), 4u);
  EXPECT_FALSE(SystemFile(folder / "a", FileAccess::MakeNew).IsOpen());
  EXPECT_EQ(errno, EEXIST);
  EXPECT_TRUE(SystemFile(folder / "a", FileAccess::MakeLog).Append(" more", 5));
  EXPECT_EQ(folder.Read("a"), "text more");
  EXPECT_FALSE(SystemFile(folder / "a", FileAccess::Read).WriteAt(0, "x", 1));
  EXPECT_EQ(errno, EBADF);
  std::string text(12, '\0');
  EXPECT_FALSE(made.ReadAt(0, text.data(), text.size()));
  EXPECT_EQ(errno, ENODATA);
  EXPECT_EQ(SystemFile(folder / "a", FileAccess::MakeEmpty).GetSize(), 0u);
}

TEST(SystemFile, APipeIsNotWaitedFor)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const SystemFile pipe(folder / "pipe", FileAccess::Read);
  ASSERT_TRUE(pipe.IsOpen());
  EXPECT_FALSE(pipe.GetStatus()->isFile);
}

TEST(SystemFile, AScratchFileHasNoName)
{
  const TemporaryFolder folder;
  SystemFile            file = SystemFile::MakeScratch(folder / "");
  ASSERT_TRUE(file.WriteAt(7, "x", 1));
  EXPECT_EQ(file.GetSize(), 8u);
  EXPECT_EQ(file.GetStatus()->numberOfNames, 0u);
  EXPECT_FALSE(SystemFile::MakeScratch(folder / "none").IsOpen());
  EXPECT_EQ(errno, ENOENT);
}

TEST(SystemFile, TheErrorStaysWhenAFileIsClosed)
{
  const TemporaryFolder folder;
  {
    const SystemFile file(folder / "none", FileAccess::Read);
  }
  EXPECT_EQ(errno, ENOENT);
  EXPECT_FALSE(SystemFile(folder / "none", FileAccess::Read).Sync());
  EXPECT_EQ(errno, ENOENT);
}

} // namespace
