// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FuzzScene.h"

namespace MedialVoxelFuzz
{

using namespace MedialVoxelTest;

namespace
{

Index3
ChooseSize(Choices & choices, unsigned int dimension)
{
  const bool isLarge = choices.Rarely(32);
  const int  voxels = isLarge ? 2500 : 250;
  // Rows longer than a word of bits stay possible.
  const int x = choices.Next(1, choices.Next(0, 7) == 0 ? 140 : 14);
  const int y = choices.Next(1, std::max(1, std::min(isLarge ? 40 : 14, voxels / x)));
  return { { x, y, dimension == 2 ? 1 : choices.Next(1, std::max(1, std::min(40, voxels / (x * y)))) } };
}

/** Of any size that the filters take; now and then wildly unequal. */
Vector3
ChooseSpacing(Choices & choices, unsigned int dimension)
{
  const std::array<double, 6>  lengths{ { 1.0, 0.5, 0.7, 1.3, 2.0, 0.25 } };
  const std::array<double, 10> wild{ { 1.0, 0.5, 0.7, 3.0, 6.25, 12.0, 15.0, 99.0, 0.1, 1.0 / 7.0 } };
  const std::array<double, 6>  units{ { 1e-10, 1e-3, 1e3, 1e9, 5e9, 0x1p-30 } };
  const double                 unit = choices.Rarely(4) ? choices.OneOf(units) : 1.0;
  const double                 x = choices.OneOf(lengths);
  Vector3                      spacing{ { x, x, x } };
  if (choices.Flag())
  {
    const bool   isWild = choices.Rarely(4);
    const auto   next = [&] { return isWild ? choices.OneOf(wild) : choices.OneOf(lengths); };
    const double y = next();
    spacing = { { x, y, next() } };
  }
  for (double & length : spacing)
  {
    length *= unit;
  }
  spacing[2] = dimension == 2 ? 1.0 : spacing[2];
  return spacing;
}

void
ChoosePlace(Choices & choices, unsigned int dimension, Scene & scene)
{
  scene.useImageSpacing = choices.Next(0, 3) != 0;
  scene.start = choices.OneOf(std::array<int, 4>{ { 0, 0, -7, 100 } });
  const int turn = choices.Next(0, 3) == 0 ? choices.Next(0, static_cast<int>(dimension) - 1) : 0;
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    scene.axisOf[axis] = static_cast<int>((axis + static_cast<unsigned int>(turn)) % dimension);
    scene.signOf[axis] = choices.Next(0, 7) == 0 ? -1 : 1;
  }
}

/** Either one bit per voxel, or boxes that add and remove object. */
void
FillVolume(Choices & choices, Volume & volume)
{
  if (choices.Flag())
  {
    unsigned int bits = 0;
    for (std::size_t i = 0; i < volume.object.size(); ++i)
    {
      bits = i % 8 == 0 ? choices.Byte() : bits >> 1;
      volume.object[i] = bits & 1;
    }
    return;
  }
  while (!choices.IsAtEnd())
  {
    const bool isObject = choices.Next(0, 1) == 0;
    Index3     low;
    Index3     high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = choices.Next(0, volume.size[axis] - 1);
      high[axis] = std::min(volume.size[axis], low[axis] + choices.Next(1, volume.size[axis]));
    }
    for (int z = low[2]; z < high[2]; ++z)
    {
      for (int y = low[1]; y < high[1]; ++y)
      {
        for (int x = low[0]; x < high[0]; ++x)
        {
          volume.Set({ { x, y, z } }, isObject);
        }
      }
    }
  }
}

/** Numbers without a pattern, the same ones for the same input. */
class Noise
{
public:
  explicit Noise(unsigned int seed)
    : m_State(seed)
  {}

  /** From 0 to below \a end. */
  unsigned int
  Below(unsigned int end)
  {
    m_State = m_State * 6364136223846793005U + 1442695040888963407U;
    return static_cast<unsigned int>(m_State >> 33) % end;
  }

private:
  std::uint64_t m_State;
};

/** Of an object from 73 to 127, so far as there are thresholds, which differ by less than one from that. */
float
ChooseValue(Noise & noise, const Scene & scene, bool isObject, float fraction)
{
  const auto step = static_cast<float>(noise.Below(50));
  if (!scene.HasThresholds())
  {
    return isObject ? scene.backgroundValue + 1.0F + step + fraction : scene.backgroundValue;
  }
  const bool isLow = !scene.upperThreshold || (scene.lowerThreshold && noise.Below(2) == 0);
  if (isObject)
  {
    return isLow ? 73.0F + step + fraction : 127.0F - step - fraction;
  }
  return isLow ? 72.0F - step + fraction : 128.0F + step - fraction;
}

} // namespace

Scene
ChooseScene(Choices & choices, unsigned int dimension)
{
  Scene scene;
  scene.volume.size = ChooseSize(choices, dimension);
  scene.volume.spacing = ChooseSpacing(choices, dimension);
  ChoosePlace(choices, dimension, scene);
  // Bit 0: a lower threshold, bit 1: an upper one.
  const int  rule = choices.Next(0, 3);
  const bool isBetween = choices.Flag();
  if ((rule & 1) != 0)
  {
    scene.lowerThreshold = isBetween ? 72.5 : 73.0;
  }
  if ((rule & 2) != 0)
  {
    scene.upperThreshold = isBetween ? 127.5 : 127.0;
  }
  scene.backgroundValue = isBetween ? 0.0F : 5.0F;
  return scene;
}

void
FillScene(Choices & choices, Values kind, Scene & scene)
{
  Noise      noise(choices.Byte());
  const bool isReal = kind == Values::Real && choices.Flag();
  const bool hasNan = kind == Values::Real && choices.Next(0, 3) == 0;
  scene.volume = Volume(scene.volume.size, scene.volume.spacing);
  FillVolume(choices, scene.volume);
  for (const unsigned char isObject : scene.volume.object)
  {
    const float fraction = isReal ? static_cast<float>(noise.Below(128)) / 256.0F : 0.0F;
    const bool  isNan = hasNan && isObject == 0 && noise.Below(4) == 0;
    scene.values.push_back(isNan ? std::numeric_limits<float>::quiet_NaN()
                                 : ChooseValue(noise, scene, isObject != 0, fraction));
    scene.notANumbers += isNan ? 1 : 0;
  }
}

} // namespace MedialVoxelFuzz
