// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestWalls_h
#define MedialVoxelTestWalls_h

// Parts with walls of several thicknesses, whose mid-surface is known, and the noise of scans.

#include "MedialVoxelTestPores.h"

#include <utility>

namespace MedialVoxelTest
{
/** A strip of a plate, one voxel wide, that runs inwards from a square rim. Coordinates are turned ones. */
struct RimStrip
{
  Vector3 edge;   ///< where the mid-plane meets the face of the rim
  int     inward; ///< axis
  double  sign;   ///< of the way inwards along it
  int     along;  ///< axis of the rim
  int     across; ///< axis of the thickness
  double  half;   ///< half the thickness of the plate: the medial axis of a square rim begins so far inwards
};

/** A point of a mid-surface, and the thickness of its wall. */
struct SheetPoint
{
  Vector3 place;
  double  wall;
};

/** A part around the origin. Lengths are voxels. */
struct Part
{
  std::string name;
  Index3      size;

  /** Negative inside, and the distance to the surface as far as noise needs it. */
  std::function<double(const Vector3 &)> surface;

  /** Distance to the mid-surface. */
  std::function<double(const Vector3 &)> middle;

  /** Points of the mid-surface that a sheet must cover: farther from rims than where the sheet begins. */
  std::vector<SheetPoint> samples;

  /** Of free rims, one for each voxel of their length; none near corners and junctions. */
  std::vector<RimStrip> rims;
};

enum class Noise
{
  None,
  Shift, // the surface of each voxel is shifted by up to 1
  Flip,  // a tenth of the voxels next to the surface changes sides
  Scan,  // blurred, with noise of 18 % of the contrast
  Pores, // cavities of 1 to 8 voxels begin at 0.2 % of the voxels that are deeper than 2
  PoresAndFlip
};

/** Those that leave no pores inside. */
inline constexpr std::pair<const char *, Noise> NoisesOfSurfaces[] = { { "flip", Noise::Flip },
                                                                       { "shift", Noise::Shift },
                                                                       { "scan", Noise::Scan } };

/** Center of the volume, in voxels. */
inline Vector3
CenterOf(const Part & part)
{
  return { { (part.size[0] - 1) / 2.0, (part.size[1] - 1) / 2.0, (part.size[2] - 1) / 2.0 } };
}

inline Vector3
PositionIn(const Part & part, const Vector3 & index)
{
  const Vector3 center = CenterOf(part);
  return { { index[0] - center[0], index[1] - center[1], index[2] - center[2] } };
}

/** Coordinates along three axes that are not those of the volume. */
inline Vector3
Turned(const Vector3 & p)
{
  // Columns of a rotation: orthonormal up to rounding.
  const Vector3 u{ { 0.8660254037844386, 0.4330127018922193, 0.25 } };
  const Vector3 v{ { -0.5, 0.75, 0.4330127018922193 } };
  const Vector3 w{ { 0.0, -0.5, 0.8660254037844386 } };
  return { { Dot(u, p), Dot(v, p), Dot(w, p) } };
}

/** From turned coordinates back. */
inline Vector3
TurnedBack(const Vector3 & t)
{
  const Vector3 x{ { 0.8660254037844386, -0.5, 0.0 } };
  const Vector3 y{ { 0.4330127018922193, 0.75, -0.5 } };
  const Vector3 z{ { 0.25, 0.4330127018922193, 0.8660254037844386 } };
  return { { Dot(x, t), Dot(y, t), Dot(z, t) } };
}

/** Outside distance to a box around a center with half sizes; negative inside. */
inline double
BoxDistance(const Vector3 & p, const Vector3 & center, const Vector3 & half)
{
  double outside = 0.0;
  double inside = -std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double d = std::abs(p[axis] - center[axis]) - half[axis];
    outside += d > 0.0 ? d * d : 0.0;
    inside = std::max(inside, d);
  }
  return inside > 0.0 ? std::sqrt(outside) : inside;
}

/** A plate of a box's two longer axes; the third half size is half the thickness. */
struct Plate
{
  Vector3 center;
  Vector3 half;
};

/** The strips of all rims that keep off other rims and plates. */
inline std::vector<RimStrip>
RimsOf(const std::vector<Plate> & plates)
{
  constexpr double      margin = 2.5;
  std::vector<RimStrip> rims;
  for (std::size_t k = 0; k < plates.size(); ++k)
  {
    const Plate & plate = plates[k];
    const int    across = static_cast<int>(std::min_element(plate.half.begin(), plate.half.end()) - plate.half.begin());
    const double clear = plate.half[across] + margin;
    for (int side = 0; side < 4; ++side)
    {
      const int    inward = (across + 1 + side % 2) % 3;
      const int    along = (across + 2 - side % 2) % 3;
      const double sign = side < 2 ? 1.0 : -1.0;
      for (double place = clear - plate.half[along]; place <= plate.half[along] - clear; place += 1.0)
      {
        Vector3 edge = plate.center;
        edge[inward] -= sign * plate.half[inward];
        edge[along] += place;
        bool isFree = true;
        for (std::size_t other = 0; other < plates.size(); ++other)
        {
          isFree = isFree && (other == k || BoxDistance(edge, plates[other].center, plates[other].half) > clear);
        }
        if (isFree)
        {
          rims.push_back({ edge, inward, sign, along, across, plate.half[across] });
        }
      }
    }
  }
  return rims;
}

/** Distance of a point of the volume to turned plates together; right inside too where they overlap enough. */
inline double
DistanceTo(const std::vector<Plate> & plates, const Vector3 & p)
{
  double distance = std::numeric_limits<double>::infinity();
  for (const Plate & plate : plates)
  {
    distance = std::min(distance, BoxDistance(Turned(p), plate.center, plate.half));
  }
  return distance;
}

/** Plates together, turned; samples keep off the rims that are not covered by other plates. */
inline Part
PartOfPlates(const std::string & name, int size, const std::vector<Plate> & plates)
{
  Part part;
  part.name = name;
  part.size = { { size, size, size } };
  part.surface = [plates](const Vector3 & p) { return DistanceTo(plates, p); };
  part.rims = RimsOf(plates);
  const auto across = [](const Plate & plate) {
    return static_cast<int>(std::min_element(plate.half.begin(), plate.half.end()) - plate.half.begin());
  };
  part.middle = [plates, across](const Vector3 & p) {
    double distance = std::numeric_limits<double>::infinity();
    for (const Plate & plate : plates)
    {
      Vector3 flat = plate.half;
      flat[across(plate)] = 0.0;
      distance = std::min(distance, std::max(0.0, BoxDistance(Turned(p), plate.center, flat)));
    }
    return distance;
  };
  for (const Plate & plate : plates)
  {
    const int    axis = across(plate);
    const int    i = (axis + 1) % 3;
    const int    j = (axis + 2) % 3;
    const double rim = plate.half[axis] + 2.5;
    for (double s = rim - plate.half[i]; s <= plate.half[i] - rim; s += 0.7)
    {
      for (double t = rim - plate.half[j]; t <= plate.half[j] - rim; t += 0.7)
      {
        Vector3 sample = plate.center;
        sample[i] += s;
        sample[j] += t;
        part.samples.push_back({ TurnedBack(sample), 2.0 * plate.half[axis] });
      }
    }
  }
  return part;
}

/** One plate with the thickness 2, 3, 4, 6, 10, 16 in a row. */
inline Part
StepsPart()
{
  std::vector<Plate> plates;
  const double       width = 18.0;
  double             u = -6 * width / 2;
  for (const double thickness : { 2.0, 3.0, 4.0, 6.0, 10.0, 16.0 })
  {
    plates.push_back({ { { u + width / 2, 0.0, 0.0 } }, { { width / 2, 22.0, thickness / 2 } } });
    u += width;
  }
  Part part = PartOfPlates("steps", 124, plates);
  // Neighboring plates are one: where they touch is no surface. So each goes on inside the thicker ones.
  std::vector<Plate> nested = plates;
  for (Plate & plate : nested)
  {
    const double left = plate.center[0] - plate.half[0];
    plate.center[0] = (left + u) / 2;
    plate.half[0] = (u - left) / 2;
  }
  part.surface = [nested](const Vector3 & p) { return DistanceTo(nested, p); };
  // Their sheets are one too.
  part.samples.clear();
  for (std::size_t k = 0; k < plates.size(); ++k)
  {
    const double rim = plates[k].half[2] + 2.5;
    const double left = plates[k].center[0] - plates[k].half[0] + (k == 0 ? rim : 0.0);
    const double right = plates[k].center[0] + plates[k].half[0] - (k + 1 == plates.size() ? rim : 0.0);
    for (double s = left; s <= right; s += 0.7)
    {
      for (double t = rim - 22.0; t <= 22.0 - rim; t += 0.7)
      {
        part.samples.push_back({ TurnedBack({ { s, t, 0.0 } }), 2.0 * plates[k].half[2] });
      }
    }
  }
  return part;
}

/** A plate of 4 with ribs of 2, 3, 5 and 8 on it, and a bend. */
inline Part
RibsPart()
{
  std::vector<Plate> plates{ { { { 0.0, 0.0, -16.0 } }, { { 46.0, 20.0, 2.0 } } } };
  double             u = -36.0;
  for (const double thickness : { 2.0, 3.0, 5.0, 8.0 })
  {
    plates.push_back({ { { u, 0.0, 0.0 } }, { { thickness / 2, 20.0, 16.0 } } });
    u += 21.0;
  }
  plates.push_back({ { { 44.0, 0.0, 0.0 } }, { { 2.0, 20.0, 18.0 } } });
  return PartOfPlates("ribs", 112, plates);
}

/** A T of a wall of 4 and a wall of 4. */
inline Part
TeePart()
{
  return PartOfPlates(
    "T",
    72,
    { { { { 0.0, 0.0, -12.0 } }, { { 24.0, 20.0, 2.0 } } }, { { { 0.0, 0.0, 4.0 } }, { { 2.0, 20.0, 16.0 } } } });
}

/** An L of walls of 4. */
inline Part
BendPart()
{
  return PartOfPlates(
    "L",
    72,
    { { { { 0.0, 0.0, -14.0 } }, { { 22.0, 20.0, 2.0 } } }, { { { -20.0, 0.0, 2.0 } }, { { 2.0, 20.0, 18.0 } } } });
}

/** A closed shell. */
inline Part
ShellPart(double thickness)
{
  const double radius = 24.0;
  Part         part;
  part.name = "shell " + std::to_string(static_cast<int>(thickness));
  part.size = { { 72, 72, 72 } };
  part.surface = [=](const Vector3 & p) { return std::abs(std::sqrt(Dot(p, p)) - radius) - thickness / 2; };
  part.middle = [=](const Vector3 & p) { return std::abs(std::sqrt(Dot(p, p)) - radius); };
  for (int i = 0; i < 4000; ++i)
  {
    const double  z = 1.0 - (2.0 * i + 1.0) / 4000.0;
    const double  angle = 2.399963229728653 * i;
    const double  ring = std::sqrt(1.0 - z * z);
    const Vector3 place{ { radius * ring * std::cos(angle), radius * ring * std::sin(angle), radius * z } };
    part.samples.push_back({ place, thickness });
  }
  return part;
}

/** A gyroid with the period 64 that the volume cuts. */
inline Part
GyroidPart()
{
  Part part;
  part.name = "gyroid";
  part.size = { { 96, 96, 96 } };
  const double frequency = 2.0 * 3.14159265358979323846 / 64.0;
  const auto   value = [=](const Vector3 & p) {
    const double x = frequency * p[0], y = frequency * p[1], z = frequency * p[2];
    return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
  };
  const auto slope = [=](const Vector3 & p) {
    const double x = frequency * p[0], y = frequency * p[1], z = frequency * p[2];
    const double a = std::cos(x) * std::cos(y) - std::sin(z) * std::sin(x);
    const double b = std::cos(y) * std::cos(z) - std::sin(x) * std::sin(y);
    const double c = std::cos(z) * std::cos(x) - std::sin(y) * std::sin(z);
    return frequency * std::sqrt(a * a + b * b + c * c);
  };
  part.surface = [=](const Vector3 & p) { return (std::abs(value(p)) - 0.4) / slope(p); };
  part.middle = [=](const Vector3 & p) { return std::abs(value(p)) / slope(p); };
  for (double z = -40.0; z <= 40.0; z += 1.0)
  {
    for (double y = -40.0; y <= 40.0; y += 1.0)
    {
      for (double x = -40.0; x < 40.0; x += 1.0)
      {
        const double here = value({ { x, y, z } });
        const double next = value({ { x + 1.0, y, z } });
        if ((here < 0.0) != (next < 0.0))
        {
          const Vector3 place{ { x + here / (here - next), y, z } };
          part.samples.push_back({ place, 0.8 / slope(place) });
        }
      }
    }
  }
  return part;
}

/** Gray values of the part, one inside and zero outside, blurred by a Gaussian of 0.76 voxels. */
inline std::vector<double>
BlurredValues(const Volume & volume)
{
  std::vector<double> values(volume.object.begin(), volume.object.end());
  const double        weights[] = { 0.5246, 0.2208, 0.0169 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double> from = values;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const Index3 v = volume.IndexAt(i);
      double       sum = 0.0;
      for (int step = -2; step <= 2; ++step)
      {
        Index3 n = v;
        n[axis] = std::min(std::max(n[axis] + step, 0), volume.size[axis] - 1);
        sum += weights[std::abs(step)] * from[volume.Offset(n)];
      }
      values[i] = sum;
    }
  }
  return values;
}

/** Cavities of 1 to 8 voxels; some merge, or open to the surface. */
template <typename TDepth, typename TUniform>
void
AddPores(Volume & volume, TDepth && depth, TUniform && uniform)
{
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    Index3 v = volume.IndexAt(i);
    if (depth(v) > -2.0 || uniform() >= 0.002)
    {
      continue;
    }
    const int voxels = 1 + static_cast<int>(8 * uniform());
    for (int voxel = 0; voxel < voxels; ++voxel)
    {
      volume.Set(v, false);
      const int side = static_cast<int>(6 * uniform());
      v[side / 2] += side % 2 == 0 ? -1 : 1;
      if (!volume.Contains(v))
      {
        break;
      }
    }
  }
}

/** A tenth of the voxels next to the surface changes sides. */
template <typename TUniform>
void
FlipSurface(Volume & volume, TUniform && uniform)
{
  const Volume clean = volume;
  for (std::size_t i = 0; i < clean.object.size(); ++i)
  {
    const Index3 v = clean.IndexAt(i);
    bool         isNext = false;
    for (int side = 0; side < 6; ++side)
    {
      Index3 n = v;
      n[side / 2] += side % 2 == 0 ? -1 : 1;
      isNext = isNext || (clean.Contains(n) && clean.IsObject(n) != clean.IsObject(v));
    }
    volume.object[i] = isNext && uniform() < 0.1 ? 1 - clean.object[i] : clean.object[i];
  }
}

/** The size of pores and grains that an automatic thickness leaves out. */
constexpr std::size_t AutomaticPoreSize = 32;

/** The voxels of a part, after noise, without pores and grains of up to so many voxels. */
inline Volume
Voxelize(const Part & part, Noise noise, unsigned int seed, std::size_t poreSize = AutomaticPoreSize)
{
  std::mt19937 generator(seed);
  const auto   uniform = [&generator]() { return generator() / 4294967296.0; };
  const auto   depth = [&part](const Index3 & v) {
    return part.surface(PositionIn(part, { { double(v[0]), double(v[1]), double(v[2]) } }));
  };
  Volume volume = MakeVolume(part.size, UnitSpacing, [&](const Index3 & v) {
    return depth(v) < (noise == Noise::Shift ? 2.0 * uniform() - 1.0 : 0.0);
  });
  if (noise == Noise::Pores || noise == Noise::PoresAndFlip)
  {
    AddPores(volume, depth, uniform);
  }
  if (noise == Noise::Flip || noise == Noise::PoresAndFlip)
  {
    FlipSurface(volume, uniform);
  }
  if (noise == Noise::Scan)
  {
    const auto values = BlurredValues(volume);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      double sum = -6.0; // of twelve numbers: nearly normal
      for (int k = 0; k < 12; ++k)
      {
        sum += uniform();
      }
      volume.object[i] = values[i] + 0.18 * sum > 0.5 ? 1 : 0;
    }
  }
  return noise == Noise::None ? volume : WithoutPores(volume, poreSize);
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestWalls_h
