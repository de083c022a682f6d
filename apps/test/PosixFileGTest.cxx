// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "JsonFile.h"
#include "OutputFile.h"
#include "SystemFile.h"
#include "TemporaryFolder.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <string>
#include <sys/stat.h>

// What Windows lacks: pipes in folders, and holes in files without asking for them.

using namespace medialvoxel;

TEST(PosixFile, APipeIsNotWaitedFor)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const SystemFile pipe(folder / "pipe", FileAccess::Read);
  ASSERT_TRUE(pipe.IsOpen());
  EXPECT_FALSE(pipe.GetStatus()->isFile);
  try
  {
    ReadJsonFile(folder / "pipe", 10);
    ADD_FAILURE();
  }
  catch (const JobError & error)
  {
    EXPECT_EQ(error.GetStatus(), ExitStatus::Failure);
  }
}

TEST(PosixFile, ZerosTakeNoSpace)
{
  std::string data(5 << 20, '\0');
  data[65535] = data[3 << 20] = 'x';
  constexpr char        header[] = "header of some bytes";
  const auto            size = sizeof(header) + data.size();
  const TemporaryFolder folder;
  OutputFile            file(folder / "a", false);
  file.Create(size, false);
  file.WriteAt(0, header, sizeof(header));
  file.WriteSparseAt(sizeof(header), data.data(), data.size());
  file.Finish();
  file.Publish();
  struct stat status = {};
  ASSERT_EQ(stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_size, static_cast<std::int64_t>(size));
  EXPECT_LT(status.st_blocks * 512, static_cast<std::int64_t>(size / 4));
}
