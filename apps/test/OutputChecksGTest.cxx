// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputChecks.h"

#include "TemporaryFolder.h"
#include "VolumeFormats.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>

using namespace medialvoxel;

namespace
{

void
Write(const std::filesystem::path & name, const std::string & text)
{
  std::ofstream(name) << text;
}

} // namespace

TEST(MedialVoxelOutputChecks, VoxelsThatAnotherProcessReplacesMeanwhile)
{
  const TemporaryFolder       folder;
  const std::filesystem::path voxels = folder / "out.raw";
  Write(folder / "in.mha", "");
  Write(folder / "out.mhd", "ObjectType = Image\nElementDataFile = out.raw\n");
  VolumeHeader input;
  input.fileName = input.dataFile = folder / "in.mha";
  input.format = &FindInputFormat(input.fileName);
  const std::vector<OutputRequest> outputs = { { "medial voxels", folder / "out.mhd", VoxelLayout{} } };

  std::atomic<bool> isDone{ false };
  std::thread       other([&voxels, &isDone] {
    while (!isDone)
    {
      Write(voxels, "");
      std::filesystem::remove(voxels);
    }
  });
  constexpr int     checks = 20000;
  for (int check = 0; check < checks && !HasFailure(); ++check)
  {
    EXPECT_NO_THROW(CheckOutputs(outputs, input, true));
  }
  isDone = true;
  other.join();
}
