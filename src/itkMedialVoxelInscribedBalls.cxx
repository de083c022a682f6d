// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelInscribedBalls.h"

#include <algorithm>
#include <cmath>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

MedialVoxelInscribedBalls::MedialVoxelInscribedBalls(const MedialVoxelGrid & grid)
  : m_Grid(grid)
{}

void
MedialVoxelInscribedBalls::FindShape(const double squaredRadius, Shape & shape) const
{
  const MedialVoxelIndex margin = m_Grid.MarginForMetricLength(std::sqrt(squaredRadius));
  shape.margin = margin;
  shape.reaches.clear();
  shape.widths.clear();
  for (std::int64_t dz = -margin[2]; dz <= margin[2]; ++dz)
  {
    std::int64_t width = -1;
    for (std::int64_t dy = -margin[1]; dy <= margin[1]; ++dy)
    {
      std::int64_t reach = margin[0];
      while (reach >= 0 && m_Grid.SquaredMetricLength(reach, dy, dz) > squaredRadius)
      {
        --reach;
      }
      shape.reaches.push_back(reach);
      width = reach >= 0 ? std::max(width, dy) : width;
    }
    shape.widths.push_back(width);
  }
}

namespace
{

/** Set a bit for each row of \a bits that has one. */
void
FindRows(const MedialVoxelBits & bits, const std::size_t wordsPerSlice, std::vector<WordType> & rows)
{
  const MedialVoxelBox & box = bits.GetBox();
  rows.assign(wordsPerSlice * static_cast<std::size_t>(box.Extent(2)), 0);
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    WordType * const slice = rows.data() + static_cast<std::size_t>(z - box.lower[2]) * wordsPerSlice;
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const WordType * const row = bits.GetRow(y, z);
      const bool         any = std::any_of(row, row + bits.GetWordsPerRow(), [](const WordType w) { return w != 0; });
      const std::int64_t dy = y - box.lower[1];
      slice[dy >> 6] |= WordType{ any } << (dy & 63);
    }
  }
}

} // namespace

void
MedialVoxelInscribedBalls::Cover(std::vector<MedialVoxelInscribedBall> & balls,
                                 const MedialVoxelRankedBits &           cells,
                                 Workspace &                             workspace,
                                 std::vector<double> &                   radii) const
{
  radii.assign(cells.GetNumberOfBits(), 0.0);
  std::size_t left = cells.GetNumberOfBits();
  // The first ball that covers a cell is the largest.
  std::sort(balls.begin(), balls.end(), [](const MedialVoxelInscribedBall & a, const MedialVoxelInscribedBall & b) {
    return a.radius > b.radius;
  });
  workspace.uncovered = cells.GetBits();
  MedialVoxelBits &      uncovered = workspace.uncovered;
  const MedialVoxelBox & box = uncovered.GetBox();
  const std::int64_t     firstWord = uncovered.GetFirstWord();
  const std::int64_t     wordsPerRow = uncovered.GetWordsPerRow();
  const auto             wordsPerSlice = static_cast<std::size_t>((box.Extent(1) + 63) >> 6);
  FindRows(uncovered, wordsPerSlice, workspace.rows);

  Shape  shape;
  double radiusOfShape = 0.0;
  for (const MedialVoxelInscribedBall & ball : balls)
  {
    if (left == 0)
    {
      return;
    }
    if (ball.radius != radiusOfShape)
    {
      radiusOfShape = ball.radius;
      this->FindShape(ball.radius * ball.radius, shape);
    }
    const std::int64_t rowsOfShape = 2 * shape.margin[1] + 1;
    const std::int64_t lowerZ = std::max(ball.center[2] - shape.margin[2], box.lower[2]);
    const std::int64_t upperZ = std::min(ball.center[2] + shape.margin[2] + 1, box.upper[2]);
    for (std::int64_t z = lowerZ; z < upperZ; ++z)
    {
      const std::int64_t slice = z - ball.center[2] + shape.margin[2];
      const std::int64_t width = shape.widths[static_cast<std::size_t>(slice)];
      const std::int64_t lowerY = std::max(ball.center[1] - width, box.lower[1]) - box.lower[1];
      const std::int64_t upperY = std::min(ball.center[1] + width + 1, box.upper[1]) - box.lower[1];
      if (lowerY >= upperY)
      {
        continue;
      }
      WordType * const rows = workspace.rows.data() + static_cast<std::size_t>(z - box.lower[2]) * wordsPerSlice;
      for (std::int64_t group = lowerY >> 6; group <= (upperY - 1) >> 6; ++group)
      {
        for (WordType rest = rows[group] & MedialVoxelBits::RangeMask(group, lowerY, upperY); rest != 0;
             rest &= rest - 1)
        {
          const std::int64_t y = box.lower[1] + 64 * group + MedialVoxelLowestBit(rest);
          const std::int64_t row = slice * rowsOfShape + y - ball.center[1] + shape.margin[1];
          const std::int64_t reach = shape.reaches[static_cast<std::size_t>(row)];
          const std::int64_t lower = std::max(ball.center[0] - reach, box.lower[0]);
          const std::int64_t upper = std::min(ball.center[0] + reach + 1, box.upper[0]);
          if (lower >= upper)
          {
            continue;
          }
          WordType * const bits = uncovered.GetRow(y, z);
          bool             any = false;
          for (std::int64_t word = lower >> 6; word <= (upper - 1) >> 6; ++word)
          {
            const std::int64_t i = word - firstWord;
            WordType           hits = bits[i] & MedialVoxelBits::RangeMask(word, lower, upper);
            any = any || hits != 0;
            bits[i] &= ~hits;
            for (; hits != 0; hits &= hits - 1)
            {
              radii[cells.RankOf(i, y, z, hits & (~hits + 1))] = ball.radius;
              --left;
            }
          }
          if (any && std::all_of(bits, bits + wordsPerRow, [](const WordType w) { return w == 0; }))
          {
            rows[group] &= ~(rest & (~rest + 1));
          }
        }
      }
    }
  }
}

} // end namespace itk
