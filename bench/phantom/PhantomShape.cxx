// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "PhantomShape.h"

#include <stdexcept>

namespace phantom
{
namespace
{
/** The center of `wall` whole voxels in the middle of `size` voxels; between voxels when the wall is even. */
double
CenterOfWall(std::int64_t size, double wall)
{
  return std::floor(0.5 * (static_cast<double>(size) - wall)) + 0.5 * (wall - 1.0);
}

Vector
CenterOf(const Size & size)
{
  return { 0.5 * (size[0] - 1), 0.5 * (size[1] - 1), 0.5 * (size[2] - 1) };
}

class Plate : public Shape
{
public:
  explicit Plate(const ShapeParameters & parameters)
    : m_Wall(parameters.wall)
    , m_Normal(parameters.normal)
    , m_Center(CenterOf(parameters.size))
  {
    const double length = Length(m_Normal);
    if (!(length > 0.0))
    {
      throw std::invalid_argument("the normal of a plate must not be zero");
    }
    m_Normal = { m_Normal.x / length, m_Normal.y / length, m_Normal.z / length };
    m_Center = { AxisCenter(m_Normal.x, parameters.size[0], m_Center.x),
                 AxisCenter(m_Normal.y, parameters.size[1], m_Center.y),
                 AxisCenter(m_Normal.z, parameters.size[2], m_Center.z) };
  }

  double
  Evaluate(const Vector & position) const override
  {
    return Sheet(Dot(position - m_Center, m_Normal), m_Wall);
  }

private:
  double
  AxisCenter(double normal, std::int64_t size, double middle) const
  {
    return std::abs(normal) == 1.0 ? CenterOfWall(size, m_Wall) : middle;
  }

  double m_Wall;
  Vector m_Normal;
  Vector m_Center;
};

/** Plates of 1 to 8 voxels across z, in eight equal slots. */
class Plates : public Shape
{
public:
  explicit Plates(const Size & size)
    : m_Slot(size[2] / 8)
  {}

  double
  Evaluate(const Vector & position) const override
  {
    double distance = 1.0e9;
    for (int wall = 1; wall <= 8; ++wall)
    {
      const double center = static_cast<double>((wall - 1) * m_Slot) + CenterOfWall(m_Slot, wall);
      distance = std::min(distance, Sheet(position.z - center, wall));
    }
    return distance;
  }

private:
  std::int64_t m_Slot;
};

class SphericalShell : public Shape
{
public:
  SphericalShell(const Vector & center, double radius, double wall)
    : m_Center(center)
    , m_Radius(radius)
    , m_Wall(wall)
  {}

  double
  Evaluate(const Vector & position) const override
  {
    return Sheet(Length(position - m_Center) - m_Radius, m_Wall);
  }

private:
  Vector m_Center;
  double m_Radius;
  double m_Wall;
};

/** Eight spheres, one an octant, with walls of 1 to 8 voxels. */
class Shells : public Shape
{
public:
  explicit Shells(const Size & size)
  {
    const double radius = 0.2 * static_cast<double>(*std::min_element(size.begin(), size.end()));
    for (int octant = 0; octant < 8; ++octant)
    {
      const Vector center{ size[0] * (octant & 1 ? 0.75 : 0.25) + 0.3,
                           size[1] * (octant & 2 ? 0.75 : 0.25) - 0.2,
                           size[2] * (octant & 4 ? 0.75 : 0.25) + 0.1 };
      m_Spheres.emplace_back(center, radius, octant + 1.0);
    }
  }

  double
  Evaluate(const Vector & position) const override
  {
    double distance = 1.0e9;
    for (const SphericalShell & sphere : m_Spheres)
    {
      distance = std::min(distance, sphere.Evaluate(position));
    }
    return distance;
  }

private:
  std::vector<SphericalShell> m_Spheres;
};

/** A plate across z and a web that stands on it, in the plane x = middle. */
class TJunction : public Shape
{
public:
  TJunction(const Size & size, double wall)
    : m_Wall(wall)
    , m_WebCenter(CenterOfWall(size[0], wall))
    , m_PlateCenter(CenterOfWall(size[2], wall))
  {}

  double
  Evaluate(const Vector & position) const override
  {
    const double height = position.z - m_PlateCenter;
    return std::min(Sheet(height, m_Wall), std::max(Sheet(position.x - m_WebCenter, m_Wall), -height));
  }

private:
  double m_Wall;
  double m_WebCenter;
  double m_PlateCenter;
};

/** |sin x cos y + sin y cos z + sin z cos x| < 0.4 with a period of 64 voxels. */
class Gyroid : public Shape
{
public:
  double
  Evaluate(const Vector & position) const override
  {
    const double sx = Sine(position.x / period), cx = Cosine(position.x / period);
    const double sy = Sine(position.y / period), cy = Cosine(position.y / period);
    const double sz = Sine(position.z / period), cz = Cosine(position.z / period);
    const double value = sx * cy + sy * cz + sz * cx;
    return (std::abs(value) - level) / slope;
  }

  double
  GetLipschitzConstant() const override
  {
    return 1.3;
  }

private:
  static constexpr double period = 64.0;
  static constexpr double level = 0.4;
  // Mean gradient of the field on the two level surfaces; the largest is 1.3 times as much.
  static constexpr double slope = 1.35 * 6.283185307179586 / period;
};
} // namespace

const std::vector<std::string> &
GetKinds()
{
  static const std::vector<std::string> kinds{ "side-frame", "cover", "solids", "gyroid",    "plate",
                                               "plates",     "shell", "shells", "t-junction" };
  return kinds;
}

Size
GetDefaultSize(const std::string & kind)
{
  const std::vector<std::string> & kinds = GetKinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
  {
    throw std::invalid_argument("unknown kind \"" + kind + "\"");
  }
  if (kind == "side-frame")
  {
    return { 708, 965, 325 };
  }
  if (kind == "cover")
  {
    return { 1500, 1500, 668 };
  }
  return kind == "solids" ? Size{ 512, 512, 512 } : Size{ 256, 256, 256 };
}

std::unique_ptr<Shape>
MakeShape(const std::string & kind, const ShapeParameters & requested)
{
  ShapeParameters parameters = requested;
  if (parameters.size == Size{ 0, 0, 0 })
  {
    parameters.size = GetDefaultSize(kind);
  }
  if (!(parameters.wall > 0.0))
  {
    throw std::invalid_argument("the wall must be more than 0 voxels");
  }
  const Size & size = parameters.size;
  if (kind == "side-frame")
  {
    return MakeSideFrame(size);
  }
  if (kind == "cover")
  {
    return MakeCover(size);
  }
  if (kind == "solids")
  {
    return MakeSolids(size);
  }
  if (kind == "gyroid")
  {
    return std::make_unique<Gyroid>();
  }
  if (kind == "plate")
  {
    return std::make_unique<Plate>(parameters);
  }
  if (kind == "plates")
  {
    return std::make_unique<Plates>(size);
  }
  if (kind == "shell")
  {
    const double radius = 0.4 * static_cast<double>(*std::min_element(size.begin(), size.end()));
    return std::make_unique<SphericalShell>(CenterOf(size), radius, parameters.wall);
  }
  if (kind == "shells")
  {
    return std::make_unique<Shells>(size);
  }
  if (kind == "t-junction")
  {
    return std::make_unique<TJunction>(size, parameters.wall);
  }
  throw std::invalid_argument("unknown kind \"" + kind + "\"");
}
} // namespace phantom
