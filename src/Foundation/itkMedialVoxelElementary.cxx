// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelElementary.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace MedialVoxelElementary
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double PiRest = 1.2246467991473532e-16; // that the number of 64 bits lacks
constexpr double NaturalLogarithmOf2 = 0.69314718055994530942;
constexpr double RootOfHalf = 0.70710678118654752440;

/** x + x^3 / 6 + ..., the binomial series of the arc sine; |x| is at most 1/2. */
double
ArcSine(const double x)
{
  double nested = 1.0; // from the last term on, for the smallest error
  for (int k = 27; k > 0; --k)
  {
    nested = 1.0 + nested * (x * x) * ((2.0 * k - 1.0) * (2.0 * k - 1.0) / (2.0 * k * (2.0 * k + 1.0)));
  }
  return x * nested;
}

} // namespace

double
ArcCosine(const double cosine)
{
  const double size = std::min(std::abs(cosine), 1.0);
  if (size <= 0.5)
  {
    return (0.5 * Pi - ArcSine(cosine)) + 0.5 * PiRest;
  }
  // Half of the angle, whose sine has no difference of numbers that are nearly the same.
  const double angle = 2.0 * ArcSine(std::sqrt(0.5 * (1.0 - size)));
  return cosine < 0.0 ? (Pi - angle) + PiRest : angle;
}

double
Sine(const double radians)
{
  const double halfTurns = std::floor(radians / Pi + 0.5);
  const double rest = (radians - halfTurns * Pi) - halfTurns * PiRest;
  double       sum = rest;
  double       term = rest;
  for (int k = 2; k < 26; k += 2)
  {
    term *= -rest * rest / (k * (k + 1));
    sum += term;
  }
  return static_cast<int>(halfTurns) % 2 == 0 ? sum : -sum;
}

double
Cosine(const double radians)
{
  return Sine(radians + 0.5 * Pi);
}

double
Exponential(const double x)
{
  constexpr double least = -746.0; // below, the result is no number of 64 bits but 0
  if (x > 0.0 || x < least)
  {
    return x > 0.0 ? 1.0 / Exponential(-x) : 0.0;
  }
  if (x < -0.25) // the square of exp(x / 2) down to where a few terms of the series suffice
  {
    const double half = Exponential(0.5 * x);
    return half * half;
  }
  double sum = 1.0;
  double term = 1.0;
  for (int k = 1; k < 16; ++k)
  {
    term *= x / k;
    sum += term;
  }
  return sum;
}

double
Logarithm(const double x)
{
  int    exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < RootOfHalf)
  {
    mantissa *= 2.0;
    --exponent;
  }
  // log(m) = 2 artanh((m - 1) / (m + 1)), whose series is short near 1.
  const double share = (mantissa - 1.0) / (mantissa + 1.0);
  double       sum = 0.0;
  for (int k = 23; k > 0; k -= 2)
  {
    sum = sum * (share * share) + 1.0 / k;
  }
  return exponent * NaturalLogarithmOf2 + 2.0 * share * sum;
}

double
Power(const double base, const double exponent)
{
  return Exponential(exponent * Logarithm(base));
}

} // end namespace MedialVoxelElementary
} // end namespace itk
