// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef PhantomGeometry_h
#define PhantomGeometry_h

#include <algorithm>
#include <cmath>

/** Signed-distance arithmetic with additions, products, quotients and square roots only: the same bits on every
 * machine. Negative is inside; all lengths are in voxels; every function is 1-Lipschitz in its position unless it says
 * otherwise.
 */
namespace phantom
{
struct Vector
{
  double x, y, z;
};

inline Vector
operator-(const Vector & a, const Vector & b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

inline double
Dot(const Vector & a, const Vector & b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline double
Length(double x, double y)
{
  return std::sqrt(x * x + y * y);
}

inline double
Length(const Vector & a)
{
  return std::sqrt(Dot(a, a));
}

/** sin(2 pi turns) by its Taylor polynomial of degree 17, error below 1e-10. */
inline double
Sine(double turns)
{
  double t = turns - std::floor(turns + 0.5);
  t = t > 0.25 ? 0.5 - t : (t < -0.25 ? -0.5 - t : t);
  const double x = t * 6.283185307179586;
  const double q = x * x;
  double       sum = 1.0;
  for (int k = 16; k >= 2; k -= 2)
  {
    sum = 1.0 - q * sum / (k * (k + 1));
  }
  return x * sum;
}

inline double
Cosine(double turns)
{
  return Sine(turns + 0.25);
}

/** (1 - r^2)^2 inside the unit radius and 0 outside; the slope is at most 1.54. */
inline double
Bump(double squaredRadius)
{
  const double s = std::max(0.0, 1.0 - squaredRadius);
  return s * s;
}

/** Distance to the nearest multiple of the period: repeats what lies at 0. */
inline double
Fold(double x, double period)
{
  return std::abs(x - period * std::floor(x / period + 0.5));
}

/** Intersection whose edge is rounded with the radius; 1-Lipschitz when the two surfaces meet at right angles, else
 * sqrt(2). */
inline double
RoundIntersection(double a, double b, double radius)
{
  return std::min(std::max(a, b), -radius) + Length(std::max(a + radius, 0.0), std::max(b + radius, 0.0));
}

/** Union whose inner edge is filled with the radius. */
inline double
RoundUnion(double a, double b, double radius)
{
  return -RoundIntersection(-a, -b, radius);
}

inline double
Rectangle(double x, double y, double halfX, double halfY, double radius)
{
  return RoundIntersection(std::abs(x) - halfX, std::abs(y) - halfY, radius);
}

/** The part of the line between two values. */
inline double
Between(double x, double low, double high)
{
  return std::max(low - x, x - high);
}

/** A sheet of the given thickness around the zero level. */
inline double
Sheet(double distance, double thickness)
{
  return std::abs(distance) - 0.5 * thickness;
}

inline double
Capsule(const Vector & p, const Vector & a, const Vector & b, double radius)
{
  const Vector ab = b - a;
  const Vector ap = p - a;
  const double t = std::clamp(Dot(ap, ab) / Dot(ab, ab), 0.0, 1.0);
  return Length({ ap.x - t * ab.x, ap.y - t * ab.y, ap.z - t * ab.z }) - radius;
}
} // namespace phantom

#endif
