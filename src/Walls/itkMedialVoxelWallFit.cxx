// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallFit.h"

#include "itkMedialVoxelNormalDistribution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace itk
{
namespace
{

using Sample = MedialVoxelGrayLocal::Sample;

/** Steps of a fit, at most; shorter steps, in voxels, end it. Standard deviations of the blur beyond a surface up to
 * which values count. */
constexpr int    Iterations = 12;
constexpr double ShortestStep = 1e-4;
constexpr double Tail = 2.5;

/** Thicknesses that a fit may have. */
constexpr double Thinnest = 0.05;
constexpr double Thickest = 12.0;

/** Standard deviation, in voxels, from which on a fit fails: values do not define the places of the surfaces. */
constexpr double LargestDeviation = 1.0;

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

/** The items of a list that are near a place. */
std::vector<Sample>
SelectNear(const std::vector<Sample> & samples, const double place, const double reach)
{
  std::vector<Sample> near;
  near.reserve(samples.size());
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(near), [&](const Sample & sample) {
    return std::abs(sample.along - place) <= reach;
  });
  return near;
}

/** \class NormalEquations
 * \brief Of a fit with two parameters: a symmetric matrix and a right side. */
struct NormalEquations
{
  double aa{ 0.0 };
  double ab{ 0.0 };
  double bb{ 0.0 };
  double a{ 0.0 };
  double b{ 0.0 };
  double squaredA{ 0.0 }; // of the weights, for the covariance
  double squaredAB{ 0.0 };
  double squaredB{ 0.0 };

  void
  Add(const double weight, const double ofA, const double ofB, const double rest)
  {
    aa += weight * ofA * ofA;
    ab += weight * ofA * ofB;
    bb += weight * ofB * ofB;
    a += weight * ofA * rest;
    b += weight * ofB * rest;
    squaredA += weight * weight * ofA * ofA;
    squaredAB += weight * weight * ofA * ofB;
    squaredB += weight * weight * ofB * ofB;
  }

  double
  GetDeterminant() const
  {
    return aa * bb - ab * ab;
  }

  /** Variance of the first parameter when that of a value is 1. */
  double
  GetVarianceOfFirst() const
  {
    const double determinant = this->GetDeterminant();
    const double u = bb / determinant;
    const double v = -ab / determinant;
    return u * u * squaredA + 2.0 * u * v * squaredAB + v * v * squaredB;
  }
};

} // namespace

MedialVoxelWallFit::MedialVoxelWallFit(const MedialVoxelScan & scan, const unsigned int numberOfActiveAxes)
  : m_Blur(scan.blur)
  , m_Noise(scan.GetRelativeNoise() * std::sqrt(scan.correlation))
  , m_Number(MedialVoxelGrayLocal::GetEffectiveNumber(numberOfActiveAxes))
{}

auto
MedialVoxelWallFit::MakeProfile(const std::vector<Sample> & samples, const double reach) -> Profile
{
  Profile sums{};
  Profile weights{};
  for (const Sample & sample : samples)
  {
    const double at = sample.along / Step + Side;
    const int    begin = std::max(0, static_cast<int>(std::ceil(at - 1.0 / Step)));
    const int    end = std::min(Places - 1, static_cast<int>(std::floor(at + 1.0 / Step)));
    for (int i = begin; i <= end; ++i)
    {
      const auto   place = static_cast<std::size_t>(i);
      const double weight = sample.weight * (1.0 - Step * std::abs(i - at));
      sums[place] += weight * sample.value;
      weights[place] += weight;
    }
  }
  Profile   profile{};
  const int side = static_cast<int>(reach / Step);
  for (int i = Side - side; i <= Side + side; ++i)
  {
    const auto place = static_cast<std::size_t>(i);
    profile[place] = weights[place] > 0.0 ? sums[place] / weights[place] : 0.0;
  }
  return profile;
}

auto
MedialVoxelWallFit::Smooth(const Profile & profile) -> Profile
{
  constexpr double weights[5] = { 1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16 };
  Profile          smooth{};
  for (int i = 0; i < Places; ++i)
  {
    for (int k = -2; k <= 2; ++k)
    {
      smooth[static_cast<std::size_t>(i)] +=
        weights[k + 2] * profile[static_cast<std::size_t>(std::clamp(i + k, 0, Places - 1))];
    }
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
MedialVoxelWallFit::FitWall(const std::vector<Sample> & samples) const -> std::optional<Wall>
{
  const Profile profile = MakeProfile(samples, ReachOfWall);
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
  if (wall.isCut)
  {
    wall.center = moment / mass;
    wall.deviation = m_Noise * std::sqrt((right.place - left.place) / m_Number);
  }
  else
  {
    wall.center = 0.5 * (lower + upper);
    this->Fit(samples, wall);
  }
  if (!(std::abs(wall.center) <= LargestShift) || !std::isfinite(wall.thickness) ||
      !(wall.deviation <= LargestDeviation))
  {
    return std::nullopt;
  }
  wall.isResolved = this->IsResolved(samples, wall);
  return wall;
}

void
MedialVoxelWallFit::Fit(const std::vector<Sample> & samples, Wall & wall) const
{
  const BlurredSurface      surface(m_Blur);
  const std::vector<Sample> near = SelectNear(samples, wall.center, 0.5 * wall.thickness + Tail * m_Blur);
  for (int iteration = 0; iteration < Iterations; ++iteration)
  {
    NormalEquations equations;
    for (const Sample & sample : near)
    {
      const double s = sample.along - wall.center;
      const auto   first = surface.At(s + 0.5 * wall.thickness);
      const auto   second = surface.At(s - 0.5 * wall.thickness);
      equations.Add(sample.weight,
                    0.5 * (first.density + second.density),
                    second.density - first.density,
                    sample.value - (first.cumulative - second.cumulative));
    }
    const double determinant = equations.GetDeterminant();
    if (!(determinant > 0.0))
    {
      wall.thickness = std::nan("");
      return;
    }
    wall.deviation = m_Noise * std::sqrt(equations.GetVarianceOfFirst());
    const double thicker = (equations.bb * equations.a - equations.ab * equations.b) / determinant;
    const double farther = (equations.aa * equations.b - equations.ab * equations.a) / determinant;
    wall.thickness = std::clamp(wall.thickness + std::clamp(thicker, -1.0, 1.0), Thinnest, Thickest);
    wall.center += std::clamp(farther, -0.5, 0.5);
    if (std::max(std::abs(thicker), std::abs(farther)) < ShortestStep)
    {
      return;
    }
  }
}

/** Values in the middle of two walls that the blur has joined are lower than in one wall. */
bool
MedialVoxelWallFit::IsResolved(const std::vector<Sample> & samples, const Wall & wall) const
{
  const double         core = std::max(0.5, 0.25 * wall.thickness);
  double               sum = 0.0;
  double               weights = 0.0;
  double               squares = 0.0;
  const BlurredSurface surface(m_Blur);
  for (const Sample & sample : samples)
  {
    const double s = sample.along - wall.center;
    if (std::abs(s) <= core)
    {
      const double first = surface.At(s + 0.5 * wall.thickness).cumulative;
      const double second = surface.At(s - 0.5 * wall.thickness).cumulative;
      sum += sample.weight * (sample.value - (first - second));
      weights += sample.weight;
      squares += sample.weight * sample.weight;
    }
  }
  return sum >= -std::max(0.12 * weights, 3.0 * m_Noise * std::sqrt(squares));
}

auto
MedialVoxelWallFit::FitSurface(const std::vector<Sample> & samples) const -> std::optional<Surface>
{
  const Profile         profile = MakeProfile(samples, ReachOfSurface);
  const int             side = static_cast<int>(ReachOfSurface / Step);
  std::optional<double> crossing;
  for (int i = Side - side; i < Side + side; ++i)
  {
    const double here = profile[static_cast<std::size_t>(i)];
    const double next = profile[static_cast<std::size_t>(i + 1)];
    if (here < 0.5 && next >= 0.5)
    {
      const double place = PlaceOf(i) + Step * (0.5 - here) / (next - here);
      crossing = !crossing || std::abs(place) < std::abs(*crossing) ? place : *crossing;
    }
  }
  if (!crossing)
  {
    return std::nullopt;
  }
  Surface                   surface{ *crossing, 0.0 };
  const BlurredSurface      blurred(m_Blur);
  const std::vector<Sample> near = SelectNear(samples, *crossing, 1.5 * m_Blur);
  for (int iteration = 0; iteration < Iterations; ++iteration)
  {
    double squares = 0.0;
    double sum = 0.0;
    double squaredWeights = 0.0;
    for (const Sample & sample : near)
    {
      const auto model = blurred.At(sample.along - surface.place);
      squares += sample.weight * model.density * model.density;
      sum += sample.weight * model.density * (model.cumulative - sample.value);
      squaredWeights += sample.weight * sample.weight * model.density * model.density;
    }
    if (!(squares > 0.0))
    {
      return std::nullopt;
    }
    const double deeper = sum / squares;
    surface.place += std::clamp(deeper, -0.5, 0.5);
    surface.deviation = m_Noise * std::sqrt(squaredWeights) / squares;
    if (std::abs(deeper) < ShortestStep)
    {
      break;
    }
  }
  const bool isFound = std::abs(surface.place - *crossing) < 1.0 && surface.deviation <= LargestDeviation;
  return isFound ? std::optional<Surface>(surface) : std::nullopt;
}

std::optional<double>
MedialVoxelWallFit::FitBlur(const std::vector<Sample> & samples)
{
  double place = 0.0;
  double blur = 0.8;
  for (int iteration = 0; iteration < 2 * Iterations; ++iteration)
  {
    const BlurredSurface surface(blur);
    NormalEquations      equations;
    for (const Sample & sample : samples)
    {
      const auto model = surface.At(sample.along - place);
      equations.Add(
        sample.weight, -model.density, -model.density * (sample.along - place) / blur, sample.value - model.cumulative);
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
