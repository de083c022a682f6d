// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "PhantomShape.h"

namespace phantom
{
namespace
{
/** A crushed side frame of a car body: hollow members around two windows, pressed from sheets of 2 to 4 voxels.
 *
 *  Skin and two reinforcements are offset sheets of one body; bulkheads stand across the members; skins and bulkheads
 *  have lightening holes; a welding flange runs around the outline. The whole is bowed, wavy and dented.
 */
class SideFrame : public Shape
{
public:
  explicit SideFrame(const Size & size)
    : m_Half{ 0.5 * size[0], 0.5 * size[1], 0.5 * size[2] }
  {}

  double
  Evaluate(const Vector & position) const override
  {
    const Vector p = Undeformed(position);
    const double outline = Outline(p);
    const double depth = m_Half.z * (0.74 + 0.05 * Sine(p.y / m_Half.y * 0.4));
    const double body = RoundIntersection(outline, std::abs(p.z) - depth, 16.0);

    double       part = std::max(Sheet(body + 2.0, 3.0), -Hole(p.x, p.y + 20.0, 97.0, 17.0));
    const double bead = body + 27.0 + 3.0 * Sine((p.x + p.y) / 64.0);
    part = std::min(part, std::max(Sheet(bead, 3.8), -Hole(p.x + 31.0, p.y, 121.0, 24.0)));
    part = std::min(part, Sheet(body + 53.0, 2.6));
    part = std::min(part, std::max(Bulkheads(p), body + 2.0));
    return std::min(part, Flange(p, outline));
  }

  double
  GetLipschitzConstant() const override
  {
    return 2.0;
  }

private:
  /** Position in the undamaged part, from its center: bow, long waves, one dent in each pillar. */
  Vector
  Undeformed(const Vector & position) const
  {
    Vector       p = position - m_Half;
    const double x = p.x / m_Half.x;
    const double y = p.y / m_Half.y;
    p.x += 0.022 * m_Half.x * Sine(0.8 * y + 0.1);
    p.x -= 0.11 * m_Half.x * Bump(4.0 * ((x + 0.8) * (x + 0.8) + (y - 0.1) * (y - 0.1)));
    p.y += 0.012 * m_Half.y * Sine(0.9 * x);
    p.z += m_Half.z * (0.20 * y * y - 0.10 + 0.03 * Sine(1.1 * y + 0.7 * x));
    p.z += 0.22 * m_Half.z * Bump(5.0 * ((x - 0.7) * (x - 0.7) + (y + 0.3) * (y + 0.3)));
    return p;
  }

  double
  Outline(const Vector & p) const
  {
    const double radius = 0.2 * m_Half.x;
    const double outer = Rectangle(p.x, p.y, 0.88 * m_Half.x, 0.92 * m_Half.y, radius);
    const double upper =
      Rectangle(p.x - 0.02 * m_Half.x, p.y + 0.42 * m_Half.y, 0.45 * m_Half.x, 0.25 * m_Half.y, radius);
    const double slope = 0.15 * (p.x + 0.3 * p.y);
    const double lower = 0.95 * Rectangle(p.x, p.y - 0.40 * m_Half.y - slope, 0.42 * m_Half.x, 0.20 * m_Half.y, radius);
    return std::max({ outer, -upper, -lower });
  }

  static double
  Hole(double x, double y, double period, double radius)
  {
    return Length(Fold(x, period), Fold(y, period)) - radius;
  }

  /** Across the pillars they are planes of constant y, across the other members planes of constant x. */
  double
  Bulkheads(const Vector & p) const
  {
    const double pillar = 0.46 * m_Half.x - std::abs(p.x);
    const double acrossPillar = std::max(Sheet(Fold(p.y, 27.0), 2.2), pillar);
    const double acrossRail = std::max(Sheet(Fold(p.x + 11.0, 30.0), 2.4), -pillar);
    const double lightened = std::max(acrossPillar, -Hole(p.x, p.z, 74.0, 14.0));
    return std::min(lightened, std::max(acrossRail, -Hole(p.y, p.z, 81.0, 15.0)));
  }

  double
  Flange(const Vector & p, double outline) const
  {
    const double rim = std::max(Sheet(p.z + 0.2 * m_Half.z, 3.2), Between(outline, -4.0, 0.045 * m_Half.x));
    return std::max(rim, -Hole(p.x + p.y, p.x - p.y, 60.0, 4.0));
  }

  Vector m_Half;
};
} // namespace

std::unique_ptr<Shape>
MakeSideFrame(const Size & size)
{
  return std::make_unique<SideFrame>(size);
}
} // namespace phantom
