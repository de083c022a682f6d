// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelRandomVolume_h
#define medialvoxelRandomVolume_h

#include "PixelType.h"
#include "TemporaryFolder.h"
#include "VolumeHeader.h"

#include <random>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Numbers that are the same on every machine for the same seed. */
class Dice
{
public:
  explicit Dice(unsigned int seed)
    : m_Generator(seed)
  {}

  /** From low to high, both included. */
  int
  Roll(int low, int high)
  {
    return low + static_cast<int>(m_Generator() % static_cast<unsigned int>(high - low + 1));
  }

  /** True in one of so many cases. */
  bool
  OneIn(int cases)
  {
    return this->Roll(1, cases) == 1;
  }

  template <typename TValue>
  TValue
  Pick(const std::vector<TValue> & values)
  {
    return values[m_Generator() % values.size()];
  }

private:
  std::mt19937 m_Generator;
};

/** Voxels with values of at least ObjectValue, the object, and smaller ones. */
struct RandomVolume
{
  static constexpr double ObjectValue = 50.0;

  std::vector<std::uint64_t> size;
  std::vector<double>        spacing;
  PixelType                  pixelType{ PixelType::UInt8 };
  std::vector<double>        values; ///< x fastest
};

/** Boxes, shells or noise, in 2 or 3 dimensions, up to about a hundred thousand voxels. */
RandomVolume
DrawVolume(Dice & dice);

/** A file of a volume, and the options to read it. */
struct VolumeFile
{
  std::string                   fileName;
  std::optional<RawDescription> raw;
  std::vector<double>           spacing{}; ///< that the file does not have
};

/** Number of the formats that WriteVolume() knows; 0 is an uncompressed MetaImage. */
constexpr int NumberOfVolumeFormats = 8;

/** Writes the volume in one of the formats that are read, compressed ones included. */
VolumeFile
WriteVolume(const RandomVolume & volume, int format, const TemporaryFolder & folder);

} // end namespace medialvoxel

#endif
