// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SystemFile.h"

#include "ProcessIdentity.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

namespace
{
using medialvoxel::AddName;
using medialvoxel::FileAccess;
using medialvoxel::GetFileStatus;
using medialvoxel::MakeFolder;
using medialvoxel::OpenStream;
using medialvoxel::RemoveName;
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
#ifdef _WIN32
  EXPECT_EQ(errno, EACCES);
#else
  EXPECT_EQ(errno, EBADF);
#endif
  std::string text(12, '\0');
  EXPECT_FALSE(made.ReadAt(0, text.data(), text.size()));
  EXPECT_EQ(errno, ENODATA);
  EXPECT_EQ(SystemFile(folder / "a", FileAccess::MakeEmpty).GetSize(), 0u);
}

TEST(SystemFile, AScratchFileVanishes)
{
  const TemporaryFolder folder;
  {
    SystemFile file = SystemFile::MakeScratch(folder / "");
    ASSERT_TRUE(file.WriteAt(7, "x", 1));
    EXPECT_EQ(file.GetSize(), 8u);
#ifndef _WIN32
    EXPECT_EQ(file.GetStatus()->numberOfNames, 0u);
#endif
  }
  EXPECT_EQ(folder.GetNumberOfFiles(), 0);
  EXPECT_FALSE(SystemFile::MakeScratch(folder / "none").IsOpen());
  EXPECT_EQ(errno, ENOENT);
}

TEST(SystemFile, OneOpenFileLocksAByteThatOthersRead)
{
  const TemporaryFolder folder;
  folder.Write("a", "text");
  SystemFile first(folder / "a", FileAccess::Change);
  SystemFile second(folder / "a", FileAccess::Change);
  ASSERT_TRUE(first.LockByte(1));
  EXPECT_FALSE(second.LockByte(1));
  EXPECT_EQ(errno, EAGAIN);
  EXPECT_TRUE(second.IsByteLocked(1));
  EXPECT_FALSE(second.IsByteLocked(2));
  EXPECT_TRUE(second.LockByte(2));
  EXPECT_EQ(folder.Read("a"), "text");
  first.UnlockByte(1);
  EXPECT_TRUE(second.LockByte(1));
}

TEST(SystemFile, AnOpenFileIsRenamedAndReplaced)
{
  const TemporaryFolder folder;
  folder.Write("a", "of a");
  const SystemFile a(folder / "a", FileAccess::Change);
  EXPECT_TRUE(Rename(folder / "a", folder / "b", TakenName::Stays));
  folder.Write("c", "of c");
  const bool isReplaced = Rename(folder / "c", folder / "b", TakenName::IsLost);
  // Some file systems of Windows do not replace a file while it is open.
#ifdef _WIN32
  EXPECT_TRUE(isReplaced || errno == EACCES);
#else
  EXPECT_TRUE(isReplaced);
#endif
  EXPECT_EQ(folder.Read("b"), isReplaced ? "of c" : "of a");
  std::string text(4, '\0');
  EXPECT_TRUE(a.ReadAt(0, text.data(), 4));
  EXPECT_EQ(text, "of a");
}

TEST(SystemFile, NamesAreUnicode)
{
  const TemporaryFolder       folder;
  const std::filesystem::path name = folder / u8"K\u00f6rper \u9aa8 \U0001f9b4";
  EXPECT_TRUE(SystemFile(name, FileAccess::MakeNew).WriteAt(0, "text", 4));
  EXPECT_EQ(GetFileStatus(name)->numberOfBytes, 4u);
  std::FILE * const stream = OpenStream(name);
  ASSERT_NE(stream, nullptr);
  EXPECT_EQ(std::fgetc(stream), 't');
  std::fclose(stream);
  RemoveName(name);
  EXPECT_EQ(folder.GetNumberOfFiles(), 0);
}

TEST(SystemFile, TheLengthFollowsWhatIsReservedOrSet)
{
  const TemporaryFolder folder;
  SystemFile            file(folder / "a", FileAccess::MakeNew);
  EXPECT_TRUE(file.Reserve(1000));
  EXPECT_TRUE(file.SetSize(10));
  EXPECT_EQ(file.GetSize(), 10u);
  EXPECT_TRUE(file.WriteAt(20, "x", 1));
  EXPECT_TRUE(file.SyncData());
  EXPECT_TRUE(SystemFile(folder / "a", FileAccess::Read).Sync());
  EXPECT_TRUE(SystemFile(folder / "", FileAccess::Read).Sync());
  EXPECT_EQ(folder.Read("a"), std::string(20, '\0') + "x");
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

TEST(ProcessIdentity, TellsTheFileOfTheProgram)
{
  const std::filesystem::path file = medialvoxel::GetProgramFile();
  EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
  EXPECT_EQ(file.stem(), "MedialVoxelJobGTestDriver");
}

} // namespace
