// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestSmallParts_h
#define MedialVoxelTestSmallParts_h

// Small parts at random places, of which the topology of the mid-surface is known, and where its sheets meet.

#include "MedialVoxelTestPhantoms.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace MedialVoxelTest
{
/** Turned and moved. */
struct Pose
{
  std::array<Vector3, 3> axes;
  Vector3                center;

  Vector3
  ToLocal(const Vector3 & point) const
  {
    const Vector3 r{ { point[0] - center[0], point[1] - center[1], point[2] - center[2] } };
    return { { Dot(axes[0], r), Dot(axes[1], r), Dot(axes[2], r) } };
  }
};

/** A wall or a body: negative inside, and about the distance to its surface. */
using Solid = std::function<double(const Vector3 &)>;

struct SmallPart
{
  std::string name;
  double      thickness{ 0 }; ///< of the thickest wall
  int         euler{ 0 };     ///< of the mid-surface
  Solid       solid;

  /** Where sheets can meet: nowhere when empty. */
  std::function<bool(const Vector3 &)> mayMeet;

  double lengthOfMeetings{ 0 }; ///< in voxels, at least
};

/** Kinds of parts: from Tee on sheets may meet. */
enum class PartKind
{
  Plate,
  Disc,
  Tube,
  Torus,
  Shell,
  HalfTube,
  Tee,
  Cross,
  FilletedCross,
  DiscAcrossTube,
  HollowBox,
  Union
};

/** \class SmallParts
 * \brief Makes parts in a cube of voxels, far enough from its faces. */
class SmallParts
{
public:
  static constexpr int    Size = 40;
  static constexpr double Reach = 17.0; ///< of a part around its center

  static constexpr unsigned int NumberOfKinds = 12;

  explicit SmallParts(unsigned int seed)
    : m_Generator(seed)
  {}

  double
  Between(double low, double high)
  {
    return low + (high - low) * (m_Generator() / 4294967296.0);
  }

  SmallPart
  Make(PartKind kind)
  {
    const Pose pose = this->RandomPose();
    SmallPart  part = this->MakeLocal(kind);
    part.solid = [solid = part.solid, pose](const Vector3 & p) { return solid(pose.ToLocal(p)); };
    if (part.mayMeet)
    {
      part.mayMeet = [mayMeet = part.mayMeet, pose](const Vector3 & p) { return mayMeet(pose.ToLocal(p)); };
    }
    return part;
  }

  static Volume
  Fill(const SmallPart & part)
  {
    return MakeVolume({ { Size, Size, Size } }, UnitSpacing, [&](const Index3 & v) {
      return part.solid({ { double(v[0]), double(v[1]), double(v[2]) } }) <= 0.0;
    });
  }

private:
  /** Every third part lies along the axes, where ties are. */
  Pose
  RandomPose()
  {
    Pose pose;
    for (double & c : pose.center)
    {
      c = (Size - 1) / 2.0 + this->Between(-0.5, 0.5);
    }
    std::array<double, 4> q;
    double                sum = 0.0;
    for (double & c : q)
    {
      c = this->Between(-1.0, 1.0);
      sum += c * c;
    }
    if (m_Generator() % 3 == 0)
    {
      q = { { 1.0, 0.0, 0.0, 0.0 } };
      sum = 1.0;
    }
    const double s = 2.0 / sum;
    const auto [w, x, y, z] = q;
    pose.axes = { { { { 1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w) } },
                    { { s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w) } },
                    { { s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y) } } } };
    return pose;
  }

  /** A box with sharp edges around the origin. */
  static double
  Box(const Vector3 & p, const Vector3 & half)
  {
    return std::max({ std::abs(p[0]) - half[0], std::abs(p[1]) - half[1], std::abs(p[2]) - half[2] });
  }

  /** Both, with a fillet of about this radius where they meet. */
  static double
  SmoothUnion(double a, double b, double radius)
  {
    const double h = std::max(radius - std::abs(a - b), 0.0);
    return std::min(a, b) - h * h / (4.0 * radius);
  }

  /** A part around the origin. */
  SmallPart
  MakeLocal(PartKind kind)
  {
    const double t = this->Between(2.0, 6.0);
    const double h = t / 2.0;
    const double a = this->Between(8.0, 11.0);
    const double b = this->Between(8.0, 11.0);
    switch (kind)
    {
      case PartKind::Plate:
        return { "plate", t, 1, [=](const Vector3 & p) { return Box(p, { { a, b, h } }); }, {} };
      case PartKind::Disc:
        return { "disc",
                 t,
                 1,
                 [=](const Vector3 & p) { return std::hypot(std::max(std::hypot(p[0], p[1]) - a, 0.0), p[2]) - h; },
                 {} };
      case PartKind::Tube: {
        const double r = this->Between(6.0 + h, 12.0);
        return { "tube",
                 t,
                 0,
                 [=](const Vector3 & p) {
                   return std::max(std::abs(std::hypot(p[0], p[1]) - r) - h, std::abs(p[2]) - b);
                 },
                 {} };
      }
      case PartKind::Torus: {
        const double wall = this->Between(1.0, 2.0);
        const double small = this->Between(wall + 1.5, 6.0 - wall);
        const double large = Reach - 1.0 - small - wall;
        return { "torus",
                 2.0 * wall,
                 0,
                 [=](const Vector3 & p) {
                   return std::abs(std::hypot(std::hypot(p[0], p[1]) - large, p[2]) - small) - wall;
                 },
                 {} };
      }
      case PartKind::Shell: {
        const Vector3 axes{ { this->Between(8.0, 14.0), this->Between(8.0, 14.0), this->Between(8.0, 14.0) } };
        return { "shell",
                 t,
                 2,
                 [=](const Vector3 & p) {
                   const Vector3 u{ { p[0] / axes[0], p[1] / axes[1], p[2] / axes[2] } };
                   const Vector3 g{ { u[0] / axes[0], u[1] / axes[1], u[2] / axes[2] } };
                   const double  length = std::sqrt(Dot(u, u));
                   return length > 0.1 ? std::abs(length * (length - 1.0) / std::sqrt(Dot(g, g))) - h : 1.0;
                 },
                 {} };
      }
      case PartKind::HalfTube: {
        const double r = this->Between(7.0 + h, 14.0);
        return { "half tube",
                 t,
                 1,
                 [=](const Vector3 & p) {
                   const double wall = std::abs(std::hypot(p[0], p[1] + r / 2) - r) - h;
                   return std::max({ wall, std::abs(p[2]) - b, -p[1] - r / 2 });
                 },
                 {} };
      }
      default:
        return this->MakeJunction(kind, t, a, b);
    }
  }

  /** Parts of which sheets may meet: mostly on the line x = z = 0. */
  SmallPart
  MakeJunction(PartKind kind, double t, double a, double b)
  {
    const double h = t / 2.0;
    const double rib = std::max(1.0, this->Between(0.7, 1.3) * h);
    const double zone = 2.0 * std::max(h, rib) + 2.0;
    const auto   isNearLine = [=](const Vector3 & p) { return std::hypot(p[0], p[2]) < zone; };
    switch (kind)
    {
      case PartKind::Tee:
        return { "T",
                 2.0 * std::max(h, rib),
                 1,
                 [=](const Vector3 & p) {
                   return std::min(Box(p, { { 13.0, b, h } }),
                                   Box({ { p[0], p[1], p[2] - 6.5 } }, { { rib, b, 6.5 } }));
                 },
                 isNearLine,
                 b / 2.0 };
      case PartKind::Cross:
        return { "cross",
                 2.0 * std::max(h, rib),
                 1,
                 [=](const Vector3 & p) { return std::min(Box(p, { { 13.0, b, h } }), Box(p, { { rib, b, 13.0 } })); },
                 isNearLine,
                 b / 2.0 };
      case PartKind::FilletedCross: {
        const double fillet = this->Between(1.0, 3.0);
        return { "filleted cross",
                 2.0 * std::max(h, rib) + fillet / 2.0,
                 1,
                 [=](const Vector3 & p) {
                   return SmoothUnion(Box(p, { { 13.0, b, h } }), Box(p, { { rib, b, 13.0 } }), fillet);
                 },
                 [=](const Vector3 & p) { return std::hypot(p[0], p[2]) < zone + fillet; },
                 b / 2.0 };
      }
      case PartKind::DiscAcrossTube: {
        // A disc closes the tube at its middle.
        const double wall = this->Between(1.0, 2.0);
        const double r = this->Between(6.5, 8.0);
        const double close = 4.0 * wall + 2.0;
        return { "disc across a tube",
                 2.0 * wall,
                 1,
                 [=](const Vector3 & p) {
                   const double fromAxis = std::hypot(p[0], p[1]);
                   return std::min(std::max(fromAxis - 16.0, std::abs(p[2]) - wall),
                                   std::max(std::abs(fromAxis - r) - wall, std::abs(p[2]) - a));
                 },
                 [=](const Vector3 & p) { return std::hypot(std::hypot(p[0], p[1]) - r, p[2]) < close; },
                 30.0 };
      }
      case PartKind::HollowBox: {
        // From its edges thin sheets go inwards where the threshold is too small for them.
        const Vector3 half{ { this->Between(8.0, 12.0), this->Between(8.0, 12.0), this->Between(8.0, 12.0) } };
        return { "hollow box",
                 t,
                 2,
                 [=](const Vector3 & p) { return std::abs(Box(p, half)) - h; },
                 [=](const Vector3 & p) {
                   int sides = 0;
                   for (int axis = 0; axis < 3; ++axis)
                   {
                     sides += std::abs(p[axis]) > half[axis] - h - 2.0 ? 1 : 0;
                   }
                   return sides > 1;
                 } };
      }
      default:
        return this->MakeUnion();
    }
  }

  /** Two or three parts with fillets between them. */
  SmallPart
  MakeUnion()
  {
    static constexpr std::array<PartKind, 4> kinds{
      { PartKind::Plate, PartKind::Disc, PartKind::Tube, PartKind::HalfTube }
    };
    const double       fillet = this->Between(0.5, 3.0);
    std::vector<Solid> solids;
    double             thickness = 0.0;
    for (unsigned int number = 2 + m_Generator() % 2; number > 0; --number)
    {
      const SmallPart part = this->MakeLocal(kinds[m_Generator() % kinds.size()]);
      Pose            pose = this->RandomPose();
      for (double & c : pose.center)
      {
        c = this->Between(-4.0, 4.0);
      }
      solids.push_back([solid = part.solid, pose](const Vector3 & p) { return solid(pose.ToLocal(p)); });
      thickness = std::max(thickness, part.thickness);
    }
    const double zone = thickness + fillet + 2.0;
    return { "union",
             thickness,
             0,
             [=](const Vector3 & p) {
               double distance = solids[0](p);
               for (std::size_t i = 1; i < solids.size(); ++i)
               {
                 distance = SmoothUnion(distance, solids[i](p), fillet);
               }
               return distance;
             },
             [=](const Vector3 & p) {
               return std::count_if(
                        solids.begin(), solids.end(), [&](const Solid & solid) { return solid(p) < zone; }) > 1;
             } };
  }

  std::mt19937 m_Generator;
};
} // namespace MedialVoxelTest

#endif // MedialVoxelTestSmallParts_h
