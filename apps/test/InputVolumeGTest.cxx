// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Boxes of opened volumes hold the bits and values of the volumes that were written, in all formats.

#include "InputVolume.h"
#include "RandomVolume.h"
#include "ReadVolumeHeader.h"
#include "UnpackedVolume.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace medialvoxel;

namespace
{

/** A box in the volume, often all of it along an axis. */
itk::MedialVoxelBox
DrawBox(Dice & dice, const RandomVolume & volume)
{
  itk::MedialVoxelBox box{ { { 0, 0, 0 } }, { { 1, 1, 1 } } };
  for (std::size_t axis = 0; axis < volume.size.size(); ++axis)
  {
    const int size = static_cast<int>(volume.size[axis]);
    box.lower[axis] = dice.OneIn(2) ? 0 : dice.Roll(0, size - 1);
    box.upper[axis] = dice.OneIn(2) ? size : dice.Roll(static_cast<int>(box.lower[axis]) + 1, size);
  }
  return box;
}

double
GetValue(const RandomVolume & volume, const itk::MedialVoxelIndex & voxel)
{
  const auto sizeX = static_cast<std::int64_t>(volume.size[0]);
  const auto sizeY = static_cast<std::int64_t>(volume.size[1]);
  return volume.values[static_cast<std::size_t>((voxel[2] * sizeY + voxel[1]) * sizeX + voxel[0])];
}

/** Calls function(voxel) for the voxels of a box. */
template <typename TFunction>
void
ForEachVoxel(const itk::MedialVoxelBox & box, TFunction && function)
{
  itk::MedialVoxelIndex voxel;
  for (voxel[2] = box.lower[2]; voxel[2] < box.upper[2]; ++voxel[2])
  {
    for (voxel[1] = box.lower[1]; voxel[1] < box.upper[1]; ++voxel[1])
    {
      for (voxel[0] = box.lower[0]; voxel[0] < box.upper[0]; ++voxel[0])
      {
        function(voxel);
      }
    }
  }
}

void
CheckObject(const RandomVolume & volume, const itk::MedialVoxelBox & box, InputVolume & input)
{
  itk::MedialVoxelBits object(box);
  input.GetInput().Fill(box, { &object, nullptr, nullptr });
  std::uint64_t wrong = 0;
  ForEachVoxel(box, [&](const itk::MedialVoxelIndex & voxel) {
    wrong += object.Test(voxel) != (GetValue(volume, voxel) >= RandomVolume::ObjectValue) ? 1 : 0;
  });
  EXPECT_EQ(wrong, 0u);
}

void
CheckValues(const RandomVolume & volume, const itk::MedialVoxelBox & box, InputVolume & input)
{
  itk::MedialVoxelBits notANumber(box);
  itk::MedialVoxelGray gray;
  gray.Reframe(box, box);
  input.GetInput().Fill(box, { nullptr, &notANumber, &gray });
  std::uint64_t wrong = 0;
  ForEachVoxel(box, [&](const itk::MedialVoxelIndex & voxel) {
    const double value = GetValue(volume, voxel);
    const bool   isSame = gray.Get(voxel) == value || (std::isnan(gray.Get(voxel)) && std::isnan(value));
    wrong += isSame && notANumber.Test(voxel) == std::isnan(value) ? 0 : 1;
  });
  EXPECT_EQ(wrong, 0u);
}

class MedialVoxelInputVolume : public testing::TestWithParam<int>
{};

TEST_P(MedialVoxelInputVolume, BoxesHoldWhatWasWritten)
{
  Dice         dice(20261122u + static_cast<unsigned int>(GetParam()));
  JobOptions   options;
  ProgressSink sink;
  options.lowerThreshold = RandomVolume::ObjectValue;
  for (int repetition = 0; repetition < 10; ++repetition)
  {
    const TemporaryFolder folder;
    const RandomVolume    volume = DrawVolume(dice);
    const VolumeFile      file = WriteVolume(volume, GetParam(), folder);
    const auto            scratchFolder = dice.OneIn(2) ? folder / "" : std::filesystem::path();
    const VolumeHeader    header = UnpackVolume(ReadVolumeHeader(file.fileName, file.raw), scratchFolder, sink);
    InputVolume           input(header, options, 0, Smoothing::Off);
    input.Prepare([](double) {});
    for (int box = 0; box < 20; ++box)
    {
      CheckObject(volume, DrawBox(dice, volume), input);
      CheckValues(volume, DrawBox(dice, volume), input);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, MedialVoxelInputVolume, testing::Range(0, NumberOfVolumeFormats));

} // namespace
