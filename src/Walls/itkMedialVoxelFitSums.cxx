// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFitSums.h"

#include "itkMedialVoxelLanes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace itk
{
namespace
{

using Lanes = MedialVoxelLanes;
using Arrays = MedialVoxelFitSums::Arrays;

/** \struct NormalDistribution
 * \brief The share of the standard normal distribution below some numbers, and its density there. */
struct NormalDistribution
{
  Lanes cumulative;
  Lanes density;
};

/** exp(-x^2 / 2), and Hastings' formula for the rest (Abramowitz and Stegun, 26.2.17). */
MEDIALVOXEL_INLINE void
Evaluate(const Lanes & x, NormalDistribution & values)
{
  constexpr float log2OfE = 1.44269504F;
  constexpr float atZero = 0.398942280F;
  constexpr float lowest = -100.0F;
  // A power of 2, from the series of exp() between two whole exponents and the bits of a number.
  Lanes exponent = (-0.5F * log2OfE) * (x * x);
  exponent = MedialVoxelSelect(exponent > lowest, exponent, Lanes{} + lowest);
  const MedialVoxelIntegerLanes whole = MedialVoxelConvert<MedialVoxelIntegerLanes>(exponent) - 1;
  const Lanes                   rest = (exponent - MedialVoxelConvert<Lanes>(whole) - 0.5F) * 0.693147181F;
  Lanes                         power = 1.0F / 120 + rest * (1.0F / 720);
  power = 1.0F / 6 + rest * (1.0F / 24 + rest * power);
  power = 1.0F + rest * (1.0F + rest * (0.5F + rest * power));
  values.density = power * (1.41421356F * atZero) * MedialVoxelPowerOfTwo(whole);
  const Lanes absolute = MedialVoxelSelect(x < 0.0F, -x, x);
  const Lanes t = 1.0F / (1.0F + 0.2316419F * absolute);
  Lanes       tail = -1.821255978F + t * 1.330274429F;
  tail = -0.356563782F + t * (1.781477937F + t * tail);
  tail = values.density * (t * (0.319381530F + t * tail));
  values.cumulative = MedialVoxelSelect(x < 0.0F, tail, 1.0F - tail);
}

/** The parts of MedialVoxelFitSums::Wall, but for bendTT, which is a quarter of bendCC. */
MEDIALVOXEL_INLINE void
SumOfWall(const Arrays &          arrays,
          const float             center,
          const float             half,
          const float             inverseBlur,
          std::array<Lanes, 10> & sums)
{
  Lanes tt{};
  Lanes tc{};
  Lanes cc{};
  Lanes rt{};
  Lanes rc{};
  Lanes bendTC{};
  Lanes bendCC{};
  Lanes squaredTT{};
  Lanes squaredTC{};
  Lanes squaredCC{};
  for (std::size_t i = 0; i < arrays.number; i += MedialVoxelNumberOfLanes)
  {
    const Lanes        s = MedialVoxelLoad(arrays.along + i) - center;
    const Lanes        weight = MedialVoxelLoad(arrays.weight + i);
    const Lanes        x1 = (s + half) * inverseBlur;
    const Lanes        x2 = (s - half) * inverseBlur;
    NormalDistribution first;
    NormalDistribution second;
    Evaluate(x1, first);
    Evaluate(x2, second);
    first.density *= inverseBlur;
    second.density *= inverseBlur;
    const Lanes t = 0.5F * (first.density + second.density);
    const Lanes c = second.density - first.density;
    const Lanes weightedT = weight * t;
    const Lanes weightedC = weight * c;
    const Lanes rest = MedialVoxelLoad(arrays.value + i) - (first.cumulative - second.cumulative);
    // Slopes of both densities.
    const Lanes slope1 = x1 * first.density;
    const Lanes slope2 = x2 * second.density;
    const Lanes weightedRest = (weight * rest) * inverseBlur;
    tt += weightedT * t;
    tc += weightedT * c;
    cc += weightedC * c;
    rt += weightedT * rest;
    rc += weightedC * rest;
    bendCC += weightedRest * (slope2 - slope1);
    bendTC += 0.5F * weightedRest * (slope1 + slope2);
    squaredTT += weightedT * weightedT;
    squaredTC += weightedT * weightedC;
    squaredCC += weightedC * weightedC;
  }
  sums = { { tt, tc, cc, rt, rc, bendTC, bendCC, squaredTT, squaredTC, squaredCC } };
}

/** The parts of MedialVoxelFitSums::Surface. */
MEDIALVOXEL_INLINE void
SumOfSurface(const Arrays & arrays, const float place, const float inverseBlur, std::array<Lanes, 4> & sums)
{
  Lanes pp{};
  Lanes rp{};
  Lanes bend{};
  Lanes squared{};
  for (std::size_t i = 0; i < arrays.number; i += MedialVoxelNumberOfLanes)
  {
    const Lanes        x = (MedialVoxelLoad(arrays.along + i) - place) * inverseBlur;
    const Lanes        weight = MedialVoxelLoad(arrays.weight + i);
    NormalDistribution model;
    Evaluate(x, model);
    model.density *= inverseBlur;
    const Lanes weighted = weight * model.density;
    const Lanes rest = MedialVoxelLoad(arrays.value + i) - model.cumulative;
    pp += weighted * model.density;
    rp -= weighted * rest;
    bend -= weighted * rest * x * inverseBlur;
    squared += weighted * weighted;
  }
  sums = { { pp, rp, bend, squared } };
}

/** The parts of MedialVoxelFitSums::Misfit. */
MEDIALVOXEL_INLINE void
SumOfMisfit(const Arrays &         arrays,
            const float            center,
            const float            half,
            const float            inverseBlur,
            const float            core,
            std::array<Lanes, 3> & sums)
{
  Lanes rests{};
  Lanes weights{};
  Lanes squares{};
  for (std::size_t i = 0; i < arrays.number; i += MedialVoxelNumberOfLanes)
  {
    const Lanes        s = MedialVoxelLoad(arrays.along + i) - center;
    const Lanes        distance = MedialVoxelSelect(s < 0.0F, -s, s);
    const Lanes        weight = MedialVoxelSelect(distance <= core, MedialVoxelLoad(arrays.weight + i), Lanes{});
    NormalDistribution first;
    NormalDistribution second;
    Evaluate((s + half) * inverseBlur, first);
    Evaluate((s - half) * inverseBlur, second);
    rests += weight * (MedialVoxelLoad(arrays.value + i) - (first.cumulative - second.cumulative));
    weights += weight;
    squares += weight * weight;
  }
  sums = { { rests, weights, squares } };
}

} // namespace

MedialVoxelFitSums::MedialVoxelFitSums(const MedialVoxelGrayLocal::Samples & samples,
                                       const double                          place,
                                       const double                          reach)
  : m_Room((samples.GetNumber() / MedialVoxelNumberOfLanes + 1) * MedialVoxelNumberOfLanes)
  , m_Samples(new float[3 * m_Room])
{
  const auto  middle = static_cast<float>(place);
  const auto  limit = static_cast<float>(reach);
  std::size_t number = 0;
  for (std::size_t i = 0; i < samples.GetNumber(); ++i)
  {
    const float along = samples.GetAlong()[i];
    m_Samples[number] = along;
    m_Samples[m_Room + number] = samples.GetWeights()[i];
    m_Samples[2 * m_Room + number] = samples.GetValues()[i];
    number += std::abs(along - middle) <= limit ? 1 : 0;
  }
  // The last lanes are filled with samples that do not count.
  for (; number % MedialVoxelNumberOfLanes != 0; ++number)
  {
    m_Samples[number] = middle;
    m_Samples[m_Room + number] = 0.0F;
    m_Samples[2 * m_Room + number] = 0.0F;
  }
  m_Number = number;
}

auto
MedialVoxelFitSums::GetArrays() const -> Arrays
{
  const float * const samples = m_Samples.get();
  return { samples, samples + m_Room, samples + 2 * m_Room, m_Number };
}

auto
MedialVoxelFitSums::SumWall(const double center, const double thickness, const double blur) const -> Wall
{
  std::array<Lanes, 10> sums;
  MedialVoxelKernel<SumOfWall>::Run(this->GetArrays(),
                                    static_cast<float>(center),
                                    static_cast<float>(0.5 * thickness),
                                    static_cast<float>(1.0 / blur),
                                    sums);
  std::array<double, 10> s;
  std::transform(sums.begin(), sums.end(), s.begin(), [](const Lanes & lanes) { return MedialVoxelSumOf(lanes); });
  return { s[0], s[1], s[2], s[3], s[4], 0.25 * s[6], s[5], s[6], s[7], s[8], s[9] };
}

auto
MedialVoxelFitSums::SumSurface(const double place, const double blur) const -> Surface
{
  std::array<Lanes, 4> sums;
  MedialVoxelKernel<SumOfSurface>::Run(
    this->GetArrays(), static_cast<float>(place), static_cast<float>(1.0 / blur), sums);
  return { MedialVoxelSumOf(sums[0]), MedialVoxelSumOf(sums[1]), MedialVoxelSumOf(sums[2]), MedialVoxelSumOf(sums[3]) };
}

auto
MedialVoxelFitSums::SumMisfit(const double center, const double thickness, const double blur, const double core) const
  -> Misfit
{
  std::array<Lanes, 3> sums;
  MedialVoxelKernel<SumOfMisfit>::Run(this->GetArrays(),
                                      static_cast<float>(center),
                                      static_cast<float>(0.5 * thickness),
                                      static_cast<float>(1.0 / blur),
                                      static_cast<float>(core),
                                      sums);
  return { MedialVoxelSumOf(sums[0]), MedialVoxelSumOf(sums[1]), MedialVoxelSumOf(sums[2]) };
}

} // end namespace itk
