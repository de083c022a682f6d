// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelThickWalls.h"

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelThickness.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <exception>
#include <mutex>
#include <numeric>
#include <vector>

namespace itk
{
namespace
{

using WordType = MedialVoxelBits::WordType;

constexpr std::int64_t SmallestStep = 4;
constexpr std::int64_t LargestStep = 16;

/** Blocks of an image, but for the largest images. */
constexpr std::int64_t MostBlocks = std::int64_t{ 1 } << 24;

/** Where walls meet they read thicker by up to so many coarse voxels. */
constexpr double CoarseError = 0.75;

/** Thinner walls of the coarse object are left out: noise. */
constexpr double LeastCoarseVoxels = 2.0;

/** Of the maximum. At twice the default a run takes about ten times as long, where all walls are so thick. */
constexpr double MostTimes = 2.0;

/** Of the walls by area, as thick corners are part of thinner walls; of the object, as lumps have little sheet. */
constexpr double EnoughArea = 0.25;
constexpr double EnoughVolume = 0.2;
constexpr double NearlyAll = 0.99;

std::int64_t
ChooseStep(const MedialVoxelGrid & grid)
{
  std::int64_t step = SmallestStep;
  const auto   countBlocks = [&] {
    std::int64_t blocks = 1;
    for (const std::int64_t size : grid.GetSize())
    {
      blocks *= (size + step - 1) / step;
    }
    return blocks;
  };
  while (step < LargestStep && countBlocks() > MostBlocks)
  {
    step *= 2;
  }
  return step;
}

/** Adds the bits of a row to the counts of blocks of \a step voxels, a power of two below 64. */
void
CountRow(const WordType * row, const std::int64_t words, const std::int64_t step, std::vector<std::uint16_t> & counts)
{
  const std::int64_t blocksPerWord = MedialVoxelBits::BitsPerWord / step;
  const WordType     mask = (WordType{ 1 } << step) - 1;
  for (std::int64_t word = 0; word < words; ++word)
  {
    std::uint16_t * count = counts.data() + word * blocksPerWord;
    for (WordType bits = row[word]; bits != 0; bits >>= step, ++count)
    {
      *count = static_cast<std::uint16_t>(*count + MedialVoxelPopulationCount(bits & mask));
    }
  }
}

/** Threads that work on the coarse object, which is small; more would want smaller tiles. */
constexpr unsigned int MostWorkers = 4;

/** \class WallAreas
 * \brief Takes the walls of a run: their area by thickness, in whole numbers, whose sums have no order. */
class WallAreas : public MedialVoxelEngineClient
{
public:
  /** \param binWidth of thickness
   * \param face     area of a face of a voxel */
  WallAreas(const double                                      binWidth,
            const std::size_t                                 numberOfBins,
            const double                                      face,
            const std::function<void()> &                     checkAbort,
            const MedialVoxelThickWalls::RunWorkersFunction & runWorkers)
    : m_BinWidth(binWidth)
    , m_Scale(UnitsOfFace / face)
    , m_Areas(numberOfBins)
    , m_CheckAbort(checkAbort)
    , m_RunWorkers(runWorkers)
  {}

  void
  RunWorkers(const unsigned int numberOfWorkers, const std::function<void()> & work) override
  {
    m_RunWorkers(numberOfWorkers, work);
  }

  void
  TakeTile(const MedialVoxelTileResult & tile) override
  {
    if (tile.isEmpty)
    {
      return;
    }
    const std::lock_guard<std::mutex> lock(m_Mutex);
    for (const MedialVoxelWall & wall : *tile.walls)
    {
      const auto bin = static_cast<std::size_t>(static_cast<double>(wall.thickness) / m_BinWidth);
      if (wall.IsMeasured())
      {
        const std::int64_t area = std::llround(static_cast<double>(wall.area) * m_Scale);
        m_Total += area;
        bin < m_Areas.size() ? m_Areas[bin] += area : 0;
      }
    }
  }

  bool
  IsAborted() const override
  {
    try
    {
      m_CheckAbort();
    }
    catch (...)
    {
      m_Abort = std::current_exception();
    }
    return m_Abort != nullptr;
  }

  std::exception_ptr
  GetAbortException() const override
  {
    return m_Abort;
  }

  /** Whether walls from a bin on are many, of an object of this volume. */
  bool
  AreMany(const std::size_t first, const double objectVolume) const
  {
    double area = 0.0;
    double volume = 0.0;
    for (std::size_t bin = first; bin < m_Areas.size(); ++bin)
    {
      const auto ofBin = static_cast<double>(m_Areas[bin]);
      area += ofBin;
      volume += ofBin / m_Scale * (static_cast<double>(bin) + 0.5) * m_BinWidth;
    }
    return area > 0.0 && area >= EnoughArea * static_cast<double>(m_Total) && volume >= EnoughVolume * objectVolume;
  }

  /** The thickness below which this share of the area is. */
  double
  GetQuantile(const double share) const
  {
    double left = share * static_cast<double>(std::accumulate(m_Areas.begin(), m_Areas.end(), std::int64_t{ 0 }));
    std::size_t bin = 0;
    for (; bin + 1 < m_Areas.size() && left > static_cast<double>(m_Areas[bin]); ++bin)
    {
      left -= static_cast<double>(m_Areas[bin]);
    }
    return static_cast<double>(bin + 1) * m_BinWidth;
  }

private:
  static constexpr double UnitsOfFace = 1 << 20;

  double                                    m_BinWidth;
  double                                    m_Scale;
  std::mutex                                m_Mutex;
  std::int64_t                              m_Total{ 0 };
  std::vector<std::int64_t>                 m_Areas;
  std::function<void()>                     m_CheckAbort;
  MedialVoxelThickWalls::RunWorkersFunction m_RunWorkers;
  mutable std::exception_ptr                m_Abort;
};

} // namespace

MedialVoxelThickWalls::MedialVoxelThickWalls(const MedialVoxelGrid & grid, const double maximum)
  : m_Step(ChooseStep(grid))
  , m_Maximum(maximum)
  , m_Image(grid.GetVoxelBox())
{
  MedialVoxelIndex             size{};
  MedialVoxelGrid::SpacingType spacing = grid.GetSpacing();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_Block[axis] = grid.IsActive(axis) ? m_Step : 1;
    size[axis] = (grid.GetSize()[axis] + m_Block[axis] - 1) / m_Block[axis];
    spacing[axis] *= static_cast<double>(m_Block[axis]);
  }
  m_Grid = MedialVoxelGrid(size, spacing);
  m_Object.Reshape(m_Grid.GetVoxelBox());
}

void
MedialVoxelThickWalls::Add(const MedialVoxelBits & object, const MedialVoxelBox & box)
{
  assert(box.lower[0] == 0 && box.upper[0] == m_Image.upper[0] && object.GetFirstWord() == 0);
  assert(box.lower[1] % m_Block[1] == 0 && box.lower[2] % m_Block[2] == 0);
  const std::int64_t         words = object.GetWordsPerRow();
  std::vector<std::uint16_t> counts(static_cast<std::size_t>(words * MedialVoxelBits::BitsPerWord / m_Step));
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; z += m_Block[2])
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; y += m_Block[1])
    {
      const std::int64_t endY = std::min(y + m_Block[1], box.upper[1]);
      const std::int64_t endZ = std::min(z + m_Block[2], box.upper[2]);
      std::fill(counts.begin(), counts.end(), std::uint16_t{ 0 });
      for (std::int64_t row = 0; row < (endY - y) * (endZ - z); ++row)
      {
        CountRow(object.GetRow(y + row % (endY - y), z + row / (endY - y)), words, m_Step, counts);
      }
      WordType * const coarse = m_Object.GetRow(y / m_Block[1], z / m_Block[2]);
      for (std::int64_t x = 0; x < m_Grid.GetSize()[0]; ++x)
      {
        const std::int64_t width = std::min(m_Step, m_Image.upper[0] - x * m_Step);
        const bool         isObject = 2 * counts[static_cast<std::size_t>(x)] > width * (endY - y) * (endZ - z);
        coarse[x >> 6] |= WordType{ isObject } << (x & 63);
      }
    }
  }
}

void
MedialVoxelThickWalls::Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets)
{
  assert(targets.notANumber == nullptr && targets.gray == nullptr);
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const WordType * const source = m_Object.GetRow(y, z);
      WordType * const       target = targets.object->GetRow(y, z) - targets.object->GetFirstWord();
      for (std::int64_t word = box.lower[0] >> 6; word <= (box.upper[0] - 1) >> 6; ++word)
      {
        target[word] |= source[word] & MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
      }
    }
  }
}

std::optional<double>
MedialVoxelThickWalls::FindNeededMaximum(const std::function<void()> & checkAbort, const RunWorkersFunction & runWorkers)
{
  if (m_Grid.GetNumberOfActiveAxes() < 2)
  {
    return std::nullopt;
  }
  const double step = m_Grid.GetShortestEdge();
  const double most = MostTimes * m_Maximum;

  MedialVoxelParameters::Settings settings;
  settings.mode = MedialVoxelThicknessMode::Automatic;
  settings.minimumThickness = LeastCoarseVoxels * step;
  settings.maximumThickness = most;
  settings.maximumPoreSize = 0;
  MedialVoxelSheetExtraction extraction;
  extraction.parameters = MedialVoxelParameters::ForSettings(m_Grid, settings);
  extraction.measuresThickness = true;
  MedialVoxelEngineSettings engine;
  engine.task = extraction;
  engine.numberOfWorkers = MostWorkers;

  // Edges are rounded by half a coarse voxel.
  constexpr double binsPerStep = 4.0;
  const double     binWidth = step / binsPerStep;
  const auto       numberOfBins = static_cast<std::size_t>((most + step / 2.0) / binWidth);
  WallAreas        walls(binWidth, numberOfBins, step * step, checkAbort, runWorkers);
  const auto       sums = MedialVoxelEngine(m_Grid, engine).Run(m_Grid.GetVoxelBox(), *this, walls);
  double           voxel = 1.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    voxel *= m_Grid.IsActive(axis) ? m_Grid.GetSpacing()[axis] : 1.0;
  }
  const auto firstThick = static_cast<std::size_t>((m_Maximum + CoarseError * step) / binWidth);
  if (!walls.AreMany(firstThick, voxel * static_cast<double>(sums.counts.objectVoxels)))
  {
    return std::nullopt;
  }
  return std::min(std::ceil(walls.GetQuantile(NearlyAll) / step + 0.5) * step, most);
}

} // end namespace itk
