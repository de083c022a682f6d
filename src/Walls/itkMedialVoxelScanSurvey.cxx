// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelScanSurvey.h"

#include "itkMedialVoxelGrayLocal.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelRandomSample.h"
#include "itkMedialVoxelWallFit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace itk
{
namespace
{

using Index = MedialVoxelIndex;
using Box = MedialVoxelBox;
using Vector = MedialVoxelVector3;
using Sample = MedialVoxelGrayLocal::Sample;

/** Edge of the blocks, and how many of them are looked at. */
constexpr std::int64_t  BlockSize = 64;
constexpr std::uint64_t NumberOfBlocks = 2048;

/** Voxels around an object voxel in which there is background of it, without and with the blur of the object. */
constexpr std::int64_t FarFromObject = 3;
constexpr std::int64_t NearObject = 8;

/** Voxels without object around a mean of 3^D voxels, and of 5^D. */
constexpr std::int64_t FarFromSmallMean = 5;
constexpr std::int64_t FarFromLargeMean = 6;

/** Voxels around a block that must be there. */
constexpr std::int64_t Margin = 9;

/** Sizes of the samples, and the least that count. */
constexpr std::size_t LevelSamples = 16384;
constexpr std::size_t SurfaceSamples = 512;
constexpr std::size_t FewestLevels = 200;
constexpr std::size_t FewestSurfaces = 60;

/** Blur of a scan; that of a mask is less. */
constexpr double SmallestBlur = 0.2;
constexpr double LargestBlur = 3.0;

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

struct BackgroundSample
{
  double value;
  double smallMean; // NaN where it would have values of the object
  double largeMean;
};

struct MaterialSample
{
  double       value;
  std::int64_t depth; // of object around it, from 2 to 4
};

/** Values near a surface, that lead into the object. */
using SurfaceSample = std::vector<Sample>;

struct Samples
{
  MedialVoxelRandomSample<BackgroundSample> background{ LevelSamples };
  MedialVoxelRandomSample<MaterialSample>   material{ LevelSamples };
  MedialVoxelRandomSample<SurfaceSample>    surfaces{ SurfaceSamples };

  void
  LimitTo(const Samples & other)
  {
    background.LimitTo(other.background);
    material.LimitTo(other.material);
    surfaces.LimitTo(other.surfaces);
  }

  void
  Add(Samples && other)
  {
    background.Add(std::move(other.background));
    material.Add(std::move(other.material));
    surfaces.Add(std::move(other.surfaces));
  }
};

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

/** \class BlockLook
 * \brief Takes the samples of one block. */
class BlockLook
{
public:
  BlockLook(const MedialVoxelGrid & grid, const MedialVoxelBits & object, const MedialVoxelGray & gray)
    : m_Grid(grid)
    , m_Local(grid, 0.0, 1.0)
    , m_Object(object)
    , m_Gray(gray)
  {}

  void
  Take(const Box & block, const std::uint64_t seed, Samples & samples)
  {
    MedialVoxelPollCounter poll;
    Index                  voxel;
    for (voxel[2] = block.lower[2]; voxel[2] < block.upper[2]; ++voxel[2])
    {
      for (voxel[1] = block.lower[1]; voxel[1] < block.upper[1]; ++voxel[1])
      {
        poll.Count(static_cast<std::uint32_t>(BlockSize));
        for (voxel[0] = block.lower[0]; voxel[0] < block.upper[0]; ++voxel[0])
        {
          const std::uint64_t hash = MedialVoxelHash(seed + static_cast<std::uint64_t>(block.OffsetOf(voxel)));
          if (m_Object.Test(voxel))
          {
            this->TakeObject(voxel, hash, samples);
          }
          else if (samples.background.Wants(hash))
          {
            this->TakeBackground(voxel, hash, samples);
          }
        }
      }
    }
  }

private:
  void
  TakeObject(const Index & voxel, const std::uint64_t hash, Samples & samples)
  {
    if (samples.material.Wants(hash))
    {
      std::int64_t depth = 1;
      while (depth < 4 && this->IsObject(this->Around(voxel, depth + 1)))
      {
        ++depth;
      }
      if (depth > 1)
      {
        samples.material.Add(hash, { static_cast<double>(m_Gray.Get(voxel)), depth });
      }
    }
    if (samples.surfaces.Wants(hash))
    {
      this->TakeSurface(voxel, hash, samples);
    }
  }

  void
  TakeBackground(const Index & voxel, const std::uint64_t hash, Samples & samples)
  {
    if (m_Object.Any(this->Around(voxel, FarFromObject)) || !m_Object.Any(this->Around(voxel, NearObject)))
    {
      return;
    }
    BackgroundSample sample{ static_cast<double>(m_Gray.Get(voxel)), NotANumber, NotANumber };
    if (!m_Object.Any(this->Around(voxel, FarFromSmallMean)))
    {
      sample.smallMean = this->GetMean(voxel, 1);
    }
    if (!m_Object.Any(this->Around(voxel, FarFromLargeMean)))
    {
      sample.largeMean = this->GetMean(voxel, 2);
    }
    samples.background.Add(hash, sample);
  }

  /** At the first face of a voxel that is next to background. */
  void
  TakeSurface(const Index & voxel, const std::uint64_t hash, Samples & samples)
  {
    for (unsigned int direction = 0; direction < 6; ++direction)
    {
      const unsigned int axis = direction / 2;
      Index              neighbor = voxel;
      neighbor[axis] += direction % 2 == 0 ? -1 : 1;
      if (!m_Grid.GetVoxelBox().Contains(neighbor) || m_Object.Test(neighbor))
      {
        continue;
      }
      Vector place;
      Vector inwards;
      Vector normal;
      for (unsigned int i = 0; i < 3; ++i)
      {
        place[i] = 0.5 * static_cast<double>(voxel[i] + neighbor[i]);
        inwards[i] = static_cast<double>(voxel[i] - neighbor[i]);
      }
      if (!m_Local.FindNormal(m_Gray, place, normal))
      {
        return;
      }
      if (MedialVoxelDot(normal, inwards) < 0.0)
      {
        normal = { { -normal[0], -normal[1], -normal[2] } };
      }
      SurfaceSample sample;
      m_Local.FindSamples(m_Gray, place, normal, MedialVoxelWallFit::ReachOfSurface, sample);
      samples.surfaces.Add(hash, std::move(sample));
      return;
    }
  }

  Box
  Around(const Index & voxel, const std::int64_t reach) const
  {
    const Box one{ voxel, { { voxel[0] + 1, voxel[1] + 1, voxel[2] + 1 } } };
    return one.Expanded({ { reach, reach, reach } }).Intersection(m_Grid.GetVoxelBox());
  }

  bool
  IsObject(const Box & box) const
  {
    return m_Object.Count(box) == static_cast<std::uint64_t>(box.NumberOfVoxels());
  }

  double
  GetMean(const Index & voxel, const std::int64_t reach) const
  {
    const Box box = this->Around(voxel, reach);
    double    sum = 0.0;
    Index     at;
    for (at[2] = box.lower[2]; at[2] < box.upper[2]; ++at[2])
    {
      for (at[1] = box.lower[1]; at[1] < box.upper[1]; ++at[1])
      {
        for (at[0] = box.lower[0]; at[0] < box.upper[0]; ++at[0])
        {
          sum += static_cast<double>(m_Gray.Get(at));
        }
      }
    }
    return sum / static_cast<double>(box.NumberOfVoxels());
  }

  const MedialVoxelGrid & m_Grid;
  MedialVoxelGrayLocal    m_Local;
  const MedialVoxelBits & m_Object;
  const MedialVoxelGray & m_Gray;
};

/** The value of the material in walls as thick as there are. */
std::optional<double>
FindMaterial(const std::vector<MaterialSample> & samples)
{
  for (std::int64_t depth = 4; depth >= 2; --depth)
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
      return TakeMedian(values);
    }
  }
  return std::nullopt;
}

/** Ratio of a variance of means to that of independent values, at least 1. */
double
FindCorrelation(const std::vector<BackgroundSample> & samples,
                double BackgroundSample::* const mean,
                const double                     number,
                const double                     noise)
{
  std::vector<double> means;
  for (const BackgroundSample & sample : samples)
  {
    if (!std::isnan(sample.*mean))
    {
      means.push_back(sample.*mean);
    }
  }
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
  constexpr double flat = 2.5;
  double           sums[2] = {};
  double           weights[2] = {};
  for (const Sample & sample : samples)
  {
    if (std::abs(sample.along) >= flat)
    {
      const unsigned int side = sample.along > 0.0 ? 1 : 0;
      sums[side] += sample.weight * sample.value;
      weights[side] += sample.weight;
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
    for (Sample & sample : surface)
    {
      sample.value = (sample.value - scan.background) / (scan.material - scan.background);
    }
    if (IsClean(surface, limit))
    {
      MedialVoxelPoll();
      blurs.push_back(MedialVoxelWallFit::FitBlur(surface).value_or(0.0));
    }
  }
  return blurs.size() >= FewestSurfaces ? std::optional<double>(TakeMedian(blurs)) : std::nullopt;
}

MedialVoxelScanSurvey::Result
Summarize(Samples &                                    samples,
          const unsigned int                           numberOfActiveAxes,
          const double                                 threshold,
          const std::optional<MedialVoxelScanLevels> & levels)
{
  const std::vector<BackgroundSample> background = samples.background.Take();
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
  const std::optional<double> inside = levels ? levels->material : FindMaterial(material);
  if (!inside)
  {
    return { std::nullopt, "too few walls are 5 voxels thick, so that the value of the material is not known" };
  }
  scan.background = levels ? levels->background : TakeMedian(values);
  scan.material = *inside;
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
    return { std::nullopt, "too few walls are 5 voxels thick, so that the blur is not known" };
  }
  if (!(*blur >= SmallestBlur && *blur <= LargestBlur))
  {
    return { std::nullopt, *blur < SmallestBlur ? "the values are those of a mask" : "the blur is too large" };
  }
  scan.blur = *blur;
  return { scan, {} };
}

/** All of a small image, otherwise some. */
std::vector<Box>
ChooseBlocks(const Box & image)
{
  std::int64_t blocks[3];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    blocks[axis] = (image.Extent(axis) + BlockSize - 1) / BlockSize;
  }
  MedialVoxelRandomSample<Box> chosen(NumberOfBlocks);
  std::uint64_t                number = 0;
  for (std::int64_t z = 0; z < blocks[2]; ++z)
  {
    for (std::int64_t y = 0; y < blocks[1]; ++y)
    {
      for (std::int64_t x = 0; x < blocks[0]; ++x)
      {
        const Index lower{ { x * BlockSize, y * BlockSize, z * BlockSize } };
        const Box   block{ lower, { { lower[0] + BlockSize, lower[1] + BlockSize, lower[2] + BlockSize } } };
        chosen.Add(MedialVoxelHash(number++), block.Intersection(image));
      }
    }
  }
  return chosen.Take();
}

} // namespace

MedialVoxelScanSurvey::MedialVoxelScanSurvey(const MedialVoxelGrid &                    grid,
                                             const double                               threshold,
                                             const std::optional<MedialVoxelScanLevels> levels)
  : m_Grid(grid)
  , m_Threshold(threshold)
  , m_Levels(levels)
{}

auto
MedialVoxelScanSurvey::Run(const Source & source) const -> Result
{
  const Box   image = m_Grid.GetVoxelBox();
  const Boxes blocks = ChooseBlocks(image);
  Samples     samples;
  std::mutex  mutex;
  std::size_t done = 0;
  source.observe(0.0);
  source.forEach(blocks, [&](const Box & block) {
    const Box       box = block.Expanded({ { Margin, Margin, Margin } }).Intersection(image);
    MedialVoxelBits object;
    MedialVoxelGray gray;
    object.Reshape(box);
    gray.Frame(box, box);
    source.fill(box, object, gray);
    if (object.Any(box))
    {
      Samples ofBlock;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        ofBlock.LimitTo(samples);
      }
      BlockLook(m_Grid, object, gray)
        .Take(block, MedialVoxelHash(static_cast<std::uint64_t>(image.OffsetOf(block.lower))), ofBlock);
      const std::lock_guard<std::mutex> lock(mutex);
      samples.Add(std::move(ofBlock));
    }
    const std::lock_guard<std::mutex> lock(mutex);
    source.observe(static_cast<double>(++done) / static_cast<double>(blocks.size()));
  });
  return Summarize(samples, m_Grid.GetNumberOfActiveAxes(), m_Threshold, m_Levels);
}

} // end namespace itk
