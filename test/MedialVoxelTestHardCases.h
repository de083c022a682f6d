// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestHardCases_h
#define MedialVoxelTestHardCases_h

// Volumes and settings with which a single tile takes long, and seconds that a test may wait.

#include "MedialVoxelTestRuns.h"

#include <chrono>
#include <cstdlib>
#include <functional>
#include <vector>

namespace MedialVoxelTest
{
using Clock = std::chrono::steady_clock;

/** How many times longer than usual a test may wait for what must not take long. */
inline double
Patience()
{
  const char * const text = std::getenv("MEDIALVOXEL_PATIENCE");
  return text == nullptr ? 1.0 : std::atof(text);
}

inline double
SecondsSince(const Clock::time_point & start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/** Noise in which each geodesic search goes far. */
inline const Volume &
Noise()
{
  static const Volume volume = RandomVolume({ { 200, 200, 200 } }, UnitSpacing, 0.75, 11);
  return volume;
}

/** Plates with a gap that is small in comparison with the thickness that is asked for. */
inline const Volume &
Plates()
{
  static const Volume volume = MakeVolume(
    { { 260, 240, 220 } }, UnitSpacing, [](const Index3 & v) { return v[2] % 24 < 12 && v[0] > 3 && v[1] > 3; });
  return volume;
}

/** Thick walls with small holes, so that no cell is far from a boundary. */
inline const Volume &
Swiss()
{
  static const Volume volume = MakeVolume({ { 200, 180, 160 } }, UnitSpacing, [](const Index3 & v) {
    return v[0] > 2 && v[0] < 190 && v[1] > 2 && v[1] < 170 && (v[0] * 7 + v[1] * 11 + v[2] * 13) % 4096 != 0;
  });
  return volume;
}

struct HardCase
{
  const char * name;
  const Volume & (*volume)();
  std::function<void(MedialFilter<3> & medial)> prepare;
};

inline const std::vector<HardCase> &
HardCases()
{
  using Mode = itk::MedialVoxelThicknessMode;
  static const std::vector<HardCase> cases{
    { "noise, thickness 40", Noise, [](MedialFilter<3> & medial) { medial.SetThickness(40.0); } },
    { "noise, thickness 154", Noise, [](MedialFilter<3> & medial) { medial.SetThickness(154.0); } },
    { "plates, thickness 154", Plates, [](MedialFilter<3> & medial) { medial.SetThickness(154.0); } },
    { "plates, thickness 154, bound of the paper",
      Plates,
      [](MedialFilter<3> & medial) {
        medial.SetThickness(154.0);
        medial.SetPseudoGeodesicBound(itk::MedialVoxelPseudoGeodesicBound::Paper);
      } },
    { "thick walls, thickness 5", Swiss, [](MedialFilter<3> & medial) { medial.SetThickness(5.0); } },
    { "thick walls, automatic to 60 voxels, measured",
      Swiss,
      [](MedialFilter<3> & medial) {
        medial.SetThicknessMode(Mode::Automatic);
        medial.SetMaximumThickness(60.0);
        medial.GenerateThicknessOn();
      } },
    { "noise, automatic to 30 voxels, measured between voxels",
      Noise,
      [](MedialFilter<3> & medial) {
        medial.SetThicknessMode(Mode::Automatic);
        medial.SetMaximumThickness(30.0);
        medial.GenerateThicknessOn();
        medial.SetLowerThreshold(1.0);
        medial.SubvoxelThicknessOn();
      } },
    { "noise, pores of 100,000 voxels", Noise, [](MedialFilter<3> & medial) { medial.SetMaximumPoreSize(100000); } },
  };
  return cases;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestHardCases_h
