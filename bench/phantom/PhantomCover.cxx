// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "PhantomShape.h"

namespace phantom
{
namespace
{
/** A cast transmission cover: a bell with a side lobe, open at low z, walls of 3 to 12 voxels.
 *
 *  Ribs stand on the outside, a jacket, partitions with windows, webs and bearing seats are inside, bosses with bolt
 *  holes sit on the flange. Lengths scale with the smaller lateral half size (750 in the default); walls do not.
 */
class Cover : public Shape
{
public:
  explicit Cover(const Size & size)
    : m_Center{ 0.5 * size[0], 0.5 * size[1], 0.0 }
    , m_Unit(0.5 * static_cast<double>(std::min(size[0], size[1])) / 750.0)
    , m_Height(static_cast<double>(size[2]) / 668.0)
  {
    for (int bolt = 0; bolt < 20; ++bolt)
    {
      m_Bolts.push_back({ 672.0 * m_Unit * Cosine(bolt / 20.0), 672.0 * m_Unit * Sine(bolt / 20.0), 0.0 });
    }
  }

  double
  Evaluate(const Vector & position) const override
  {
    const Vector p = position - m_Center;
    const double bell = Bell(p);
    double       part = std::max(Sheet(bell, 8.4), -Windows(p));
    part = std::min(part, OuterRibs(p, bell));
    part = std::min(part, Inside(p, bell));
    part = std::max(part, 34.0 * m_Height - p.z);
    part = std::max(part, p.z - 640.0 * m_Height);
    part = std::min(part, Flange(p));
    return std::max(part, -Bores(p));
  }

  double
  GetLipschitzConstant() const override
  {
    return 2.0;
  }

private:
  /** Outer envelope: a stepped cone, and a lobe for the differential. */
  double
  Bell(const Vector & p) const
  {
    const double x = p.x / m_Unit, y = p.y / m_Unit, z = p.z / m_Height;
    const double cone = Profile(Length(x, y), z, 618.0, 205.0, 620.0);
    const double lobe = Profile(Length(x - 330.0, y - 190.0), z, 330.0, 130.0, 470.0);
    return std::min(m_Unit, m_Height) * RoundUnion(cone, lobe, 40.0);
  }

  /** Skirt, cone and top of one body of revolution. */
  static double
  Profile(double r, double z, double foot, double neck, double top)
  {
    const double rise = top - 190.0, run = foot - neck;
    const double cone = ((r - foot) * rise + (z - 150.0) * run) / Length(rise, run);
    const double skirt = r - foot + 0.08 * (z - 40.0);
    return RoundIntersection(RoundIntersection(skirt, cone, 50.0), z - top, 30.0);
  }

  double
  Windows(const Vector & p) const
  {
    return Length(p.x + 420.0 * m_Unit, p.z - 230.0 * m_Height) - 70.0 * m_Unit;
  }

  /** 32 radial ribs and rings of constant height. */
  double
  OuterRibs(const Vector & p, double bell) const
  {
    const double radial = std::max(Sheet(FoldedAngle(p), 4.6), Between(bell, -2.0, 52.0 * m_Unit));
    const double rings = std::max(Sheet(Fold(p.z - 20.0, 88.0 * m_Height), 3.6), Between(bell, -2.0, 30.0 * m_Unit));
    return std::min(radial, rings);
  }

  /** Distance to the nearest of 32 half planes through the axis, by reflection. */
  static double
  FoldedAngle(const Vector & p)
  {
    double x = std::abs(p.x), y = std::abs(p.y);
    for (int wedge = 8; wedge <= 64; wedge *= 2)
    {
      const double c = Cosine(1.0 / wedge), s = Sine(1.0 / wedge);
      const double above = std::max(0.0, y * c - x * s);
      x += 2.0 * above * s;
      y -= 2.0 * above * c;
    }
    return std::abs(y);
  }

  double
  Inside(const Vector & p, double bell) const
  {
    const double z = p.z;
    const double r = Length(p.x, p.y);
    const double seat = Length(p.x - 330.0 * m_Unit, p.y - 190.0 * m_Unit);
    const double cavity = bell + 2.0;

    double part = std::max(Sheet(bell + 46.0 * m_Unit, 4.0), z - 430.0 * m_Height);
    part = std::min(part, std::max(FoldedAngle(p) - 1.8, Between(bell, -48.0 * m_Unit, 0.0)));
    for (const double level : { 110.0, 300.0 })
    {
      part = std::min(part, Partition(p, level * m_Height, cavity));
    }
    part = std::min(part, std::max({ FoldedAngle({ p.y, p.x, z }) - 2.5, 150.0 * m_Unit - r, 440.0 * m_Height - z }));
    part = std::min(part, std::max(Sheet(r - 150.0 * m_Unit, 12.0), 360.0 * m_Height - z));
    part = std::min(part, std::max(Sheet(r - 92.0 * m_Unit, 9.0), 250.0 * m_Height - z));
    part = std::min(part, std::max(Sheet(seat - 95.0 * m_Unit, 11.0), 120.0 * m_Height - z));
    return std::max(std::min(part, Pipes(p)), cavity);
  }

  /** A wall of 6 voxels with round windows, on a grid of ribs. */
  double
  Partition(const Vector & p, double level, double cavity) const
  {
    const double hole = Length(Fold(p.x, 172.0 * m_Unit), Fold(p.y, 172.0 * m_Unit)) - 46.0 * m_Unit;
    const double plate = std::max(Sheet(p.z - level, 6.0), -hole);
    const double grid = std::min(Fold(p.x - 86.0 * m_Unit, 86.0 * m_Unit), Fold(p.y - 86.0 * m_Unit, 86.0 * m_Unit));
    return std::max(std::min(plate, std::max(grid - 1.8, Between(p.z, level, level + 62.0 * m_Height))), cavity);
  }

  /** Oil lines of 5 voxel walls. */
  double
  Pipes(const Vector & p) const
  {
    const double u = m_Unit, h = m_Height;
    const double first = Capsule(p, { -430 * u, -250 * u, 80 * h }, { 60 * u, 300 * u, 420 * h }, 22.0 * u);
    const double second = Capsule(p, { 400 * u, -300 * u, 90 * h }, { -100 * u, -120 * u, 480 * h }, 18.0 * u);
    return Sheet(std::min(first, second), 5.0);
  }

  /** The foot ring, and bosses of 12 voxels wall around the bolts. */
  double
  Flange(const Vector & p) const
  {
    const double r = Length(p.x, p.y);
    double part = std::max(Between(p.z, 30.0 * m_Height, 42.0 * m_Height), Between(r, 585.0 * m_Unit, 712.0 * m_Unit));
    const double boss = std::max(BoltDistance(p) - 13.0 - 12.0, Between(p.z, 30.0 * m_Height, 150.0 * m_Height));
    return std::min(part, boss);
  }

  double
  Bores(const Vector & p) const
  {
    return std::max(BoltDistance(p) - 13.0, p.z - 140.0 * m_Height);
  }

  double
  BoltDistance(const Vector & p) const
  {
    double squared = 1.0e18;
    for (const Vector & bolt : m_Bolts)
    {
      const double dx = p.x - bolt.x, dy = p.y - bolt.y;
      squared = std::min(squared, dx * dx + dy * dy);
    }
    return std::sqrt(squared);
  }

  Vector              m_Center;
  double              m_Unit;
  double              m_Height;
  std::vector<Vector> m_Bolts;
};
} // namespace

std::unique_ptr<Shape>
MakeCover(const Size & size)
{
  return std::make_unique<Cover>(size);
}
} // namespace phantom
