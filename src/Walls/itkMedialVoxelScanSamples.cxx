// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelScanSamples.h"

#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelWallFit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

using BackgroundSample = MedialVoxelScanSamples::Background;
using MaterialSample = MedialVoxelScanSamples::Material;
using SurfaceSample = MedialVoxelScanSamples::Surface;

/** Fewer samples say nothing. */
constexpr std::size_t FewestLevels = 200;
constexpr std::size_t FewestSurfaces = 60;

/** With fewer means around background, outliers cannot be found. */
constexpr std::size_t FewestMeans = 2000;

/** From material to the faces of its wall, in units of the blur: there the value is lower by 1 %. */
constexpr double SmallestWay = 2.7;

/** Blur of a scan; masks, and walls that are only averaged over the voxels, have less. */
constexpr double SmallestBlur = 0.4;
constexpr double LargestBlur = 3.0;

/** The middle one; the values change their order. */
double
TakeMedian(std::vector<double> & values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Standard deviation of normal values that a few others do not change. */
double
TakeDeviation(std::vector<double> values)
{
  const double median = TakeMedian(values);
  for (double & value : values)
  {
    value = std::abs(value - median);
  }
  return 1.4826 * TakeMedian(values);
}

std::vector<double>
ListKnown(const std::vector<BackgroundSample> & samples, double BackgroundSample::* const mean)
{
  std::vector<double> means;
  for (const BackgroundSample & sample : samples)
  {
    if (!std::isnan(sample.*mean))
    {
      means.push_back(sample.*mean);
    }
  }
  return means;
}

/** Background whose means are usual: walls that the object lacks raise the others. The usual ones are within three
 * deviations of the middle of the shortest interval that holds half of them. Nothing when too few means are known. */
std::vector<BackgroundSample>
SelectUsual(const std::vector<BackgroundSample> & samples, double BackgroundSample::* const mean)
{
  std::vector<double> means = ListKnown(samples, mean);
  if (means.size() < FewestMeans)
  {
    return {};
  }
  std::sort(means.begin(), means.end());
  const std::size_t half = means.size() / 2;
  std::size_t       first = 0;
  for (std::size_t i = 1; i + half < means.size(); ++i)
  {
    first = means[i + half] - means[i] < means[first + half] - means[first] ? i : first;
  }
  const double middle = 0.5 * (means[first] + means[first + half]);
  const double limit = 3.0 * 1.4826 * (0.5 * (means[first + half] - means[first]));

  std::vector<BackgroundSample> usual;
  for (const BackgroundSample & sample : samples)
  {
    if (std::abs(sample.*mean - middle) <= limit)
    {
      usual.push_back(sample);
    }
  }
  return usual;
}

/** By the largest means that are known; all when there are none. */
std::vector<BackgroundSample>
SelectBackground(std::vector<BackgroundSample> samples)
{
  for (double BackgroundSample::* const mean : { &BackgroundSample::largeMean, &BackgroundSample::smallMean })
  {
    std::vector<BackgroundSample> usual = SelectUsual(samples, mean);
    if (!usual.empty())
    {
      return usual;
    }
  }
  return samples;
}

struct MaterialLevel
{
  double value;
  double toFace; // from the places of the values
};

/** The value of the material in walls as thick as there are. */
std::optional<MaterialLevel>
FindMaterial(const std::vector<MaterialSample> & samples)
{
  for (double depth = MedialVoxelScanSamples::LargestDepth; depth >= MedialVoxelScanSamples::SmallestDepth;
       depth -= 0.5)
  {
    std::vector<double> values;
    for (const MaterialSample & sample : samples)
    {
      if (sample.depth >= depth)
      {
        values.push_back(sample.value);
      }
    }
    if (values.size() >= FewestLevels)
    {
      return MaterialLevel{ TakeMedian(values), depth - 0.5 };
    }
  }
  return std::nullopt;
}

/** Ratio of a variance of means to the variance for independent values, at least 1. */
double
FindCorrelation(const std::vector<BackgroundSample> & samples,
                double BackgroundSample::* const mean,
                const double                     number,
                const double                     noise)
{
  const std::vector<double> means = ListKnown(samples, mean);
  if (means.size() < FewestLevels || !(noise > 0.0))
  {
    return 1.0;
  }
  const double ratio = TakeDeviation(means) / noise;
  return std::max(1.0, number * ratio * ratio);
}

/** Surfaces with flat values on both sides count. */
bool
IsClean(const SurfaceSample & samples, const double limit)
{
  double sums[2] = {};
  double weights[2] = {};
  for (std::size_t i = 0; i < samples.GetNumber(); ++i)
  {
    const double along = static_cast<double>(samples.GetAlong()[i]);
    const double weight = static_cast<double>(samples.GetWeights()[i]);
    if (std::abs(along) >= MedialVoxelScanSamples::NearestFlat)
    {
      const unsigned int side = along > 0.0 ? 1 : 0;
      sums[side] += weight * static_cast<double>(samples.GetValues()[i]);
      weights[side] += weight;
    }
  }
  return weights[0] > 0.0 && weights[1] > 0.0 && std::abs(sums[0] / weights[0]) < limit &&
         std::abs(sums[1] / weights[1] - 1.0) < limit;
}

std::optional<double>
FindBlur(std::vector<SurfaceSample> & surfaces, const MedialVoxelScan & scan)
{
  const double        limit = 0.1 + scan.GetRelativeNoise() * std::sqrt(scan.correlation) / 4.0;
  std::vector<double> blurs;
  for (SurfaceSample & surface : surfaces)
  {
    surface.Normalize(scan.background, scan.material);
    if (IsClean(surface, limit))
    {
      MedialVoxelCheckAbort();
      blurs.push_back(MedialVoxelWallFit::FitBlur(surface).value_or(0.0));
    }
  }
  return blurs.size() >= FewestSurfaces ? std::optional<double>(TakeMedian(blurs)) : std::nullopt;
}

} // namespace

MedialVoxelScanSurvey::Result
MedialVoxelSummarizeScan(MedialVoxelScanSamples &                     samples,
                         const unsigned int                           numberOfActiveAxes,
                         const double                                 threshold,
                         const std::optional<MedialVoxelScanLevels> & levels)
{
  if (samples.sides.AreOfMask() || 2 * samples.faces.sharp >= samples.faces.all)
  {
    return MedialVoxelScanResult::OfMask();
  }
  const std::vector<BackgroundSample> background = SelectBackground(samples.background.Take());
  const std::vector<MaterialSample>   material = samples.material.Take();
  std::vector<SurfaceSample>          surfaces = samples.surfaces.Take();
  std::vector<double>                 values;
  values.reserve(background.size());
  for (const BackgroundSample & sample : background)
  {
    values.push_back(sample.value);
  }
  if (values.size() < FewestLevels)
  {
    return { std::nullopt, "there is too little background beside the walls" };
  }
  MedialVoxelScan scan;
  scan.noise = TakeDeviation(values);
  const bool isSolid = numberOfActiveAxes == 3;
  scan.correlation =
    std::max(FindCorrelation(background, &BackgroundSample::smallMean, isSolid ? 27.0 : 9.0, scan.noise),
             FindCorrelation(background, &BackgroundSample::largeMean, isSolid ? 125.0 : 25.0, scan.noise));
  const std::optional<MaterialLevel> level =
    levels ? MaterialLevel{ levels->material, std::numeric_limits<double>::infinity() } : FindMaterial(material);
  if (!level)
  {
    return { std::nullopt, "too few walls are 5 voxels thick, so that the value of the material is not known" };
  }
  scan.background = levels ? levels->background : TakeMedian(values);
  scan.material = level->value;
  if (!(std::min(scan.background, scan.material) < threshold && threshold < std::max(scan.background, scan.material)))
  {
    return { std::nullopt, "the threshold is not between the values of background and material" };
  }
  if (!(scan.GetRelativeNoise() < 1.0))
  {
    return { std::nullopt, "the noise is larger than the contrast" };
  }
  const std::optional<double> blur = FindBlur(surfaces, scan);
  if (!blur)
  {
    return { std::nullopt,
             surfaces.size() < FewestSurfaces
               ? "too few walls are 5 voxels thick, so that the blur is not known"
               : "the values beside too many walls are not flat, so that the blur is not known" };
  }
  if (!(*blur >= SmallestBlur && *blur <= LargestBlur))
  {
    return { std::nullopt, *blur < SmallestBlur ? "the edges are too sharp for a fit" : "the blur is too large" };
  }
  if (level->toFace < SmallestWay * *blur)
  {
    return { std::nullopt, "no wall is thick enough for the blur, so that the value of the material is not known" };
  }
  scan.blur = *blur;
  return { scan, {} };
}

} // end namespace itk
