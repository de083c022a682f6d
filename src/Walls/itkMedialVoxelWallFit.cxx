// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallFit.h"

#include "itkMedialVoxelLanes.h"
#include "itkMedialVoxelNormalDistribution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace itk
{
namespace
{

using Samples = MedialVoxelGrayLocal::Samples;

/** Steps of a fit, at most; shorter steps, in voxels, end it. Standard deviations of the blur beyond a surface up to
 * which values count. */
constexpr int    Iterations = 12;
constexpr double ShortestStep = 1e-3;
constexpr double Tail = 2.5;

/** Thicknesses that a fit may have. */
constexpr double Thinnest = 0.05;
constexpr double Thickest = 12.0;

/** Standard deviation, in voxels, from which on a fit fails: values do not define the places of the surfaces. */
constexpr double LargestDeviation = 1.0;

/** Largest way of a surface from the start of its fit. Farther away, other values would have to count. */
constexpr double LongestWay = 2.5;

/** Share of the determinant without second derivatives that the one with them needs to have, or it is not trusted. */
constexpr double LeastDeterminant = 0.1;

/** Largest distance of the middle of a wall from the start of the search. */
constexpr double LargestShift = 2.5;

/** \class BlurredSurface
 * \brief Values of a surface at the place 0 that a Gaussian has blurred, and their slope. */
class BlurredSurface
{
public:
  explicit BlurredSurface(const double blur)
    : m_Distribution(MedialVoxelNormalDistribution::Get())
    , m_Inverse(1.0 / blur)
  {}

  MedialVoxelNormalDistribution::Values
  At(const double place) const
  {
    auto values = m_Distribution.Evaluate(place * m_Inverse);
    values.density *= m_Inverse;
    return values;
  }

private:
  const MedialVoxelNormalDistribution & m_Distribution;
  double                                m_Inverse;
};

/** \class NormalEquations
 * \brief Of a fit with two parameters: a symmetric matrix and a right side. */
struct NormalEquations
{
  double aa{ 0.0 };
  double ab{ 0.0 };
  double bb{ 0.0 };
  double a{ 0.0 };
  double b{ 0.0 };

  void
  Add(const double weight, const double ofA, const double ofB, const double rest)
  {
    aa += weight * ofA * ofA;
    ab += weight * ofA * ofB;
    bb += weight * ofB * ofB;
    a += weight * ofA * rest;
    b += weight * ofB * rest;
  }

  double
  GetDeterminant() const
  {
    return aa * bb - ab * ab;
  }
};

} // namespace

MedialVoxelWallFit::MedialVoxelWallFit(const MedialVoxelScan & scan, const unsigned int numberOfActiveAxes)
  : m_Blur(scan.blur)
  , m_Noise(scan.GetRelativeNoise() * std::sqrt(scan.correlation))
  , m_Number(MedialVoxelGrayLocal::GetEffectiveNumber(numberOfActiveAxes))
{}

/** A sample counts at the eight places within a voxel from it, with a weight that falls in a straight line. Samples
 * between two places differ by their distance to the lower one alone, so their sums suffice. */
class MedialVoxelWallFit::Bins
{
public:
  explicit Bins(const Samples & samples)
  {
    for (std::size_t i = 0; i < samples.GetNumber(); ++i)
    {
      const float at = samples.GetAlong()[i] * static_cast<float>(1.0 / Step) + static_cast<float>(Side);
      if (!(at >= 0.0F) || !(at < static_cast<float>(Places)))
      {
        continue;
      }
      const auto  place = static_cast<int>(at);
      const float distance = at - static_cast<float>(place);
      const float weight = samples.GetWeights()[i];
      const float value = weight * samples.GetValues()[i];
      const float added[4] = { weight, value, distance * weight, distance * value };
      m_Bins[static_cast<std::size_t>(place + HalfWidth)] += MedialVoxelLoad<Sums>(added);
    }
  }

  /** As linear interpolation has it on lines along an axis. */
  double
  GetValue(const int place) const
  {
    Sums sums{};
    Sums lower{};
    Sums upper{};
    for (int k = 0; k < HalfWidth; ++k)
    {
      const float  weight = 1.0F - static_cast<float>(Step) * static_cast<float>(k);
      const Sums & above = m_Bins[static_cast<std::size_t>(place + HalfWidth + k)];
      const Sums & below = m_Bins[static_cast<std::size_t>(place + HalfWidth - k - 1)];
      sums += weight * above + (weight - static_cast<float>(Step)) * below;
      upper += above;
      lower += below;
    }
    const double weight = static_cast<double>(sums[0] + static_cast<float>(Step) * (lower[2] - upper[2]));
    const double value = static_cast<double>(sums[1] + static_cast<float>(Step) * (lower[3] - upper[3]));
    return weight > 0.0 ? value / weight : 0.0;
  }

  Profile
  GetProfile() const
  {
    Profile profile;
    for (int i = 0; i < Places; ++i)
    {
      profile[static_cast<std::size_t>(i)] = this->GetValue(i);
    }
    return profile;
  }

private:
  using Sums = MedialVoxelLanesOf<float, 4>; // of weights, of values, and of both times the distance

  static constexpr int                     HalfWidth = static_cast<int>(1.0 / Step);
  std::array<Sums, Places + 2 * HalfWidth> m_Bins{};
};

auto
MedialVoxelWallFit::Smooth(const Profile & profile) -> Profile
{
  // The outermost places are continued.
  std::array<double, Places + 4> wide;
  std::copy(profile.begin(), profile.end(), wide.begin() + 2);
  wide[0] = wide[1] = profile.front();
  wide[Places + 2] = wide[Places + 3] = profile.back();
  Profile smooth;
  for (std::size_t i = 0; i < Places; ++i)
  {
    smooth[i] = (wide[i] + wide[i + 4] + 4.0 * (wide[i + 1] + wide[i + 3]) + 6.0 * wide[i + 2]) / 16.0;
  }
  return smooth;
}

std::optional<double>
MedialVoxelWallFit::FindCrossing(const Profile & profile, const int from, const int direction)
{
  for (int i = from; i + direction >= 0 && i + direction < Places; i += direction)
  {
    const double here = profile[static_cast<std::size_t>(i)];
    const double next = profile[static_cast<std::size_t>(i + direction)];
    if (here >= 0.5 && next < 0.5)
    {
      return PlaceOf(i) + direction * Step * (here - 0.5) / (here - next);
    }
  }
  return std::nullopt;
}

auto
MedialVoxelWallFit::FindEnd(const Profile & smooth, const int peak, const double crossing, const int direction) const
  -> End
{
  const double rise = std::max(0.06, 0.8 * m_Noise);
  const double far = std::min(std::abs(crossing) + 3.0 * m_Blur, ReachOfWall);
  const double last = std::min(far + 2.0 * m_Blur, ReachOfWall);
  const double top = smooth[static_cast<std::size_t>(peak)];
  double       lowest = top;
  int          valley = peak;
  for (int i = peak + direction; i >= 0 && i < Places && direction * PlaceOf(i) <= last; i += direction)
  {
    const double value = smooth[static_cast<std::size_t>(i)];
    if (value < lowest)
    {
      lowest = value;
      valley = i;
    }
    if (value > lowest + rise && lowest < top - rise)
    {
      const double place = PlaceOf(valley);
      return direction * place < far ? End{ place, true } : End{ direction * far, false };
    }
  }
  return { direction * far, false };
}

auto
MedialVoxelWallFit::FitWall(const Samples & samples) const -> std::optional<Wall>
{
  const Profile profile = Bins(samples).GetProfile();
  const Profile smooth = Smooth(profile);
  const auto    highest = [](const Profile & values) {
    constexpr int range = 7; // 1.75 voxels
    return static_cast<int>(std::max_element(values.begin() + (Side - range), values.begin() + (Side + range + 1)) -
                            values.begin());
  };
  const int                   peak = highest(smooth);
  const int                   top = highest(profile);
  const std::optional<double> before = FindCrossing(profile, top, -1);
  const std::optional<double> after = FindCrossing(profile, top, 1);
  const bool                  hasBoth = before && after;
  const double                lower = hasBoth ? *before : PlaceOf(peak) - 0.5;
  const double                upper = hasBoth ? *after : PlaceOf(peak) + 0.5;
  const End                   left = this->FindEnd(smooth, peak, std::min(lower, PlaceOf(peak)), -1);
  const End                   right = this->FindEnd(smooth, peak, std::max(upper, PlaceOf(peak)), 1);

  double mass = 0.0;
  double moment = 0.0;
  for (int i = 0; i < Places; ++i)
  {
    // The share of the step around the place that is between both ends.
    const double share = std::clamp(
      std::min(PlaceOf(i) + 0.5 * Step, right.place) - std::max(PlaceOf(i) - 0.5 * Step, left.place), 0.0, Step);
    mass += share * profile[static_cast<std::size_t>(i)];
    moment += share * profile[static_cast<std::size_t>(i)] * PlaceOf(i);
  }
  if (!(mass > Thinnest) || !(mass < Thickest))
  {
    return std::nullopt;
  }
  Wall wall;
  wall.thickness = mass;
  wall.isCut = left.isValley || right.isValley;
  wall.center = wall.isCut ? moment / mass : 0.5 * (lower + upper);
  const MedialVoxelFitSums sums(samples, wall.center, 0.5 * wall.thickness + Tail * m_Blur);
  if (wall.isCut)
  {
    wall.deviation = m_Noise * std::sqrt((right.place - left.place) / m_Number);
  }
  else if (!this->Fit(sums, wall))
  {
    return std::nullopt;
  }
  if (!(std::abs(wall.center) <= LargestShift) || !std::isfinite(wall.thickness) ||
      !(wall.deviation <= LargestDeviation))
  {
    return std::nullopt;
  }
  wall.isResolved = this->IsResolved(sums, wall);
  return wall;
}

bool
MedialVoxelWallFit::Fit(const MedialVoxelFitSums & sums, Wall & wall) const
{
  const Wall start = wall;
  for (int iteration = 0; iteration < Iterations; ++iteration)
  {
    const auto   sum = sums.SumWall(wall.center, wall.thickness, m_Blur);
    const double determinant = sum.tt * sum.cc - sum.tc * sum.tc;
    if (!(determinant > 0.0))
    {
      return false;
    }
    const double u = sum.cc / determinant;
    const double v = -sum.tc / determinant;
    wall.deviation = m_Noise * std::sqrt(u * u * sum.squaredTT + 2.0 * u * v * sum.squaredTC + v * v * sum.squaredCC);
    // Newton's step where the sum of squares bends upwards, otherwise the one of Gauss.
    double tt = sum.tt - sum.bendTT;
    double tc = sum.tc - sum.bendTC;
    double cc = sum.cc - sum.bendCC;
    if (!(tt > 0.0) || !(tt * cc - tc * tc > LeastDeterminant * determinant))
    {
      tt = sum.tt;
      tc = sum.tc;
      cc = sum.cc;
    }
    const double inverse = 1.0 / (tt * cc - tc * tc);
    const double thicker = (cc * sum.rt - tc * sum.rc) * inverse;
    const double farther = (tt * sum.rc - tc * sum.rt) * inverse;
    wall.thickness = std::clamp(wall.thickness + std::clamp(thicker, -1.0, 1.0), Thinnest, Thickest);
    wall.center += std::clamp(farther, -0.5, 0.5);
    if (std::abs(wall.center - start.center) + 0.5 * std::abs(wall.thickness - start.thickness) > LongestWay)
    {
      return false;
    }
    if (std::max(std::abs(thicker), std::abs(farther)) < ShortestStep)
    {
      return true;
    }
  }
  return false;
}

/** Values in the middle of two walls that the blur has joined are lower than in one wall. */
bool
MedialVoxelWallFit::IsResolved(const MedialVoxelFitSums & sums, const Wall & wall) const
{
  const auto misfit = sums.SumMisfit(wall.center, wall.thickness, m_Blur, std::max(0.5, 0.25 * wall.thickness));
  return misfit.rest >= -std::max(0.12 * misfit.weight, 3.0 * m_Noise * std::sqrt(misfit.squaredWeight));
}

auto
MedialVoxelWallFit::FitSurface(const Samples & samples) const -> std::optional<Surface>
{
  // From the place outwards, so that few values are found: the last step has crossings as far away as the one before.
  const Bins            bins(samples);
  std::optional<double> crossing;
  double                before = bins.GetValue(Side);
  double                after = before;
  for (int steps = 0, last = static_cast<int>(ReachOfSurface / Step); steps < last; ++steps)
  {
    const double below = bins.GetValue(Side - steps - 1);
    const double above = bins.GetValue(Side + steps + 1);
    const auto   take = [&](const int i, const double here, const double next) {
      if (here < 0.5 && next >= 0.5)
      {
        const double place = PlaceOf(i) + Step * (0.5 - here) / (next - here);
        const bool   isNearer = !crossing || std::abs(place) < std::abs(*crossing) ||
                              (std::abs(place) == std::abs(*crossing) && place < *crossing);
        crossing = isNearer ? place : *crossing;
        last = std::min(last, steps + 2);
      }
    };
    take(Side - steps - 1, below, before);
    take(Side + steps, after, above);
    before = below;
    after = above;
  }
  if (!crossing)
  {
    return std::nullopt;
  }
  Surface                  surface{ *crossing, 0.0 };
  const MedialVoxelFitSums sums(samples, *crossing, 1.5 * m_Blur);
  for (int iteration = 0; iteration < Iterations; ++iteration)
  {
    const auto sum = sums.SumSurface(surface.place, m_Blur);
    if (!(sum.pp > 0.0))
    {
      return std::nullopt;
    }
    const double bent = sum.pp - sum.bend;
    const double deeper = sum.rp / (bent > LeastDeterminant * sum.pp ? bent : sum.pp);
    surface.place += std::clamp(deeper, -0.5, 0.5);
    surface.deviation = m_Noise * std::sqrt(sum.squaredPP) / sum.pp;
    if (!(std::abs(surface.place - *crossing) < LongestWay))
    {
      return std::nullopt;
    }
    if (std::abs(deeper) < ShortestStep)
    {
      return surface.deviation <= LargestDeviation ? std::optional<Surface>(surface) : std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<double>
MedialVoxelWallFit::FitBlur(const Samples & samples)
{
  double place = 0.0;
  double blur = 0.8;
  for (int iteration = 0; iteration < 2 * Iterations; ++iteration)
  {
    const BlurredSurface surface(blur);
    NormalEquations      equations;
    for (std::size_t i = 0; i < samples.GetNumber(); ++i)
    {
      const double s = static_cast<double>(samples.GetAlong()[i]) - place;
      const auto   model = surface.At(s);
      equations.Add(static_cast<double>(samples.GetWeights()[i]),
                    -model.density,
                    -model.density * s / blur,
                    static_cast<double>(samples.GetValues()[i]) - model.cumulative);
    }
    const double determinant = equations.GetDeterminant();
    if (!(determinant > 0.0))
    {
      return std::nullopt;
    }
    place += std::clamp((equations.bb * equations.a - equations.ab * equations.b) / determinant, -0.5, 0.5);
    blur += std::clamp((equations.aa * equations.b - equations.ab * equations.a) / determinant, -0.3, 0.3);
    blur = std::clamp(blur, 0.1, 4.0);
  }
  return std::abs(place) < 2.0 && blur > 0.1 && blur < 4.0 ? std::optional<double>(blur) : std::nullopt;
}

} // end namespace itk
