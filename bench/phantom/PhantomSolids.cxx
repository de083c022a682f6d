// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "PhantomShape.h"

namespace phantom
{
namespace
{
/** A forged block with bores, pockets and round cavities that leave a ball of more than 100 voxels (512^3) untouched.
 */
class Solids : public Shape
{
public:
  explicit Solids(const Size & size)
    : m_Half{ 0.5 * size[0], 0.5 * size[1], 0.5 * size[2] }
    , m_Unit(static_cast<double>(*std::min_element(size.begin(), size.end())) / 512.0)
  {}

  double
  Evaluate(const Vector & position) const override
  {
    const Vector p = position - m_Half;
    const double u = m_Unit;
    const double walls = Rectangle(p.x, p.y, m_Half.x - 10.0 * u, m_Half.y - 10.0 * u, 60.0 * u);
    const double block = RoundIntersection(walls, std::abs(p.z) - (m_Half.z - 10.0 * u), 40.0 * u);
    const double bores = std::min({ Length(p.x - 160.0 * u, p.y - 150.0 * u) - 66.0 * u,
                                    Length(p.y + 170.0 * u, p.z - 150.0 * u) - 58.0 * u,
                                    Length(p.x + 175.0 * u, p.z - 140.0 * u) - 50.0 * u });
    const double cavities = std::min({ Length(p - Vector{ -150.0 * u, 160.0 * u, -150.0 * u }) - 84.0 * u,
                                       Length(p - Vector{ 150.0 * u, -170.0 * u, -150.0 * u }) - 92.0 * u,
                                       Length(p - Vector{ 18.0 * u, -22.0 * u, 12.0 * u }) - 34.0 * u });
    return std::max({ block, -bores, -cavities });
  }

private:
  Vector m_Half;
  double m_Unit;
};
} // namespace

std::unique_ptr<Shape>
MakeSolids(const Size & size)
{
  return std::make_unique<Solids>(size);
}
} // namespace phantom
