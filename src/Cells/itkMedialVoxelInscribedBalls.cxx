// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelInscribedBalls.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cmath>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

MedialVoxelInscribedBalls::MedialVoxelInscribedBalls(const MedialVoxelGrid & grid)
  : m_Grid(grid)
  , m_Sieve(grid)
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
    MedialVoxelCheckAbort();
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

/** Balls take the open cells that they cover, the largest ball first. */
class MedialVoxelInscribedBalls::Sweep
{
public:
  Sweep(const MedialVoxelRankedBits & cells,
        MedialVoxelBits &             open,
        std::vector<WordType> &       rows,
        std::vector<double> &         radii)
    : m_Cells(cells)
    , m_Open(open)
    , m_Rows(rows)
    , m_Radii(radii)
    , m_Box(open.GetBox())
    , m_NumberOfOpenCells(open.Count(m_Box))
    , m_FirstPart(open.GetFirstWord() * PartsPerWord)
    , m_Parts(open.GetWordsPerRow() * PartsPerWord)
    , m_Groups((m_Box.Extent(1) + MedialVoxelBits::BitsPerWord - 1) / MedialVoxelBits::BitsPerWord)
  {
    m_Rows.assign(static_cast<std::size_t>(m_Box.Extent(2) * m_Parts * m_Groups), 0);
    for (std::int64_t z = m_Box.lower[2]; z < m_Box.upper[2]; ++z)
    {
      MedialVoxelCheckAbort();
      for (std::int64_t y = m_Box.lower[1]; y < m_Box.upper[1]; ++y)
      {
        for (std::int64_t part = m_FirstPart; part < m_FirstPart + m_Parts; ++part)
        {
          this->GroupOf(part, y, z) |= WordType{ this->HasOpenCells(part, y, z) } << ((y - m_Box.lower[1]) & 63);
        }
      }
    }
  }

  bool
  IsDone() const
  {
    return m_NumberOfOpenCells == 0;
  }

  void
  Take(const MedialVoxelInscribedBall & ball, const Shape & shape)
  {
    const std::int64_t lowerZ = std::max(ball.center[2] - shape.margin[2], m_Box.lower[2]);
    const std::int64_t upperZ = std::min(ball.center[2] + shape.margin[2] + 1, m_Box.upper[2]);
    for (std::int64_t z = lowerZ; z < upperZ; ++z)
    {
      m_Checker.Count(StepsOfSlice);
      this->TakeSlice(ball, shape, z);
    }
  }

private:
  // Cells of the part of a row that has a bit: balls are mostly narrower.
  static constexpr std::int64_t BitsPerPart = 16;
  static constexpr std::int64_t PartsPerWord = MedialVoxelBits::BitsPerWord / BitsPerPart;

  // A slice of a ball takes as long as so many short steps.
  static constexpr std::uint32_t StepsOfSlice = 16;

  /** Bits of 64 rows along y, of a part along x. */
  WordType &
  GroupOf(const std::int64_t part, const std::int64_t y, const std::int64_t z)
  {
    const std::int64_t partOfSlice = (z - m_Box.lower[2]) * m_Parts + part - m_FirstPart;
    return m_Rows[static_cast<std::size_t>(partOfSlice * m_Groups + ((y - m_Box.lower[1]) >> 6))];
  }

  bool
  HasOpenCells(const std::int64_t part, const std::int64_t y, const std::int64_t z) const
  {
    const WordType word = m_Open.GetRow(y, z)[part / PartsPerWord - m_Open.GetFirstWord()];
    return ((word >> (BitsPerPart * (part % PartsPerWord))) & ((WordType{ 1 } << BitsPerPart) - 1)) != 0;
  }

  void
  TakeSlice(const MedialVoxelInscribedBall & ball, const Shape & shape, const std::int64_t z)
  {
    const std::int64_t slice = z - ball.center[2] + shape.margin[2];
    const std::int64_t width = shape.widths[static_cast<std::size_t>(slice)];
    const std::int64_t lowerX = std::max(ball.center[0] - shape.margin[0], m_Box.lower[0]);
    const std::int64_t upperX = std::min(ball.center[0] + shape.margin[0] + 1, m_Box.upper[0]);
    const std::int64_t lowerY = std::max(ball.center[1] - width, m_Box.lower[1]);
    const std::int64_t upperY = std::min(ball.center[1] + width + 1, m_Box.upper[1]);
    if (lowerX >= upperX || lowerY >= upperY)
    {
      return;
    }
    for (std::int64_t y = lowerY; y < upperY; y = m_Box.lower[1] + (((y - m_Box.lower[1]) | 63) + 1))
    {
      WordType rows = 0;
      for (std::int64_t part = lowerX / BitsPerPart; part <= (upperX - 1) / BitsPerPart; ++part)
      {
        rows |= this->GroupOf(part, y, z);
      }
      const std::int64_t group = (y - m_Box.lower[1]) >> 6;
      rows &= MedialVoxelBits::RangeMask(group, lowerY - m_Box.lower[1], upperY - m_Box.lower[1]);
      for (; rows != 0; rows &= rows - 1)
      {
        const std::int64_t rowY = m_Box.lower[1] + 64 * group + MedialVoxelLowestBit(rows);
        const std::int64_t row = slice * (2 * shape.margin[1] + 1) + rowY - ball.center[1] + shape.margin[1];
        const std::int64_t reach = shape.reaches[static_cast<std::size_t>(row)];
        this->TakeRow(std::max(ball.center[0] - reach, m_Box.lower[0]),
                      std::min(ball.center[0] + reach + 1, m_Box.upper[0]),
                      rowY,
                      z,
                      ball.radius);
      }
    }
  }

  void
  TakeRow(const std::int64_t lower,
          const std::int64_t upper,
          const std::int64_t y,
          const std::int64_t z,
          const double       radius)
  {
    if (lower >= upper)
    {
      return;
    }
    WordType * const open = m_Open.GetRow(y, z);
    WordType         any = 0;
    for (std::int64_t word = lower >> 6; word <= (upper - 1) >> 6; ++word)
    {
      const std::int64_t i = word - m_Open.GetFirstWord();
      WordType           hits = open[i] & MedialVoxelBits::RangeMask(word, lower, upper);
      any |= hits;
      open[i] &= ~hits;
      for (; hits != 0; hits &= hits - 1)
      {
        double & own = m_Radii[m_Cells.RankOf(i, y, z, hits & (~hits + 1))];
        own = std::max(own, radius);
        --m_NumberOfOpenCells;
      }
    }
    for (std::int64_t part = lower / BitsPerPart; any != 0 && part <= (upper - 1) / BitsPerPart; ++part)
    {
      if (!this->HasOpenCells(part, y, z))
      {
        this->GroupOf(part, y, z) &= ~(WordType{ 1 } << ((y - m_Box.lower[1]) & 63));
      }
    }
  }

  const MedialVoxelRankedBits & m_Cells;
  MedialVoxelBits &             m_Open;
  std::vector<WordType> &       m_Rows;
  std::vector<double> &         m_Radii;
  MedialVoxelBox                m_Box;
  std::uint64_t                 m_NumberOfOpenCells;
  std::int64_t                  m_FirstPart;
  std::int64_t                  m_Parts;
  std::int64_t                  m_Groups;
  MedialVoxelAbortChecker       m_Checker;
};

void
MedialVoxelInscribedBalls::Raise(const std::vector<MedialVoxelInscribedBall> & all,
                                 const MedialVoxelRankedBits &                 cells,
                                 Workspace &                                   workspace,
                                 std::vector<double> &                         radii) const
{
  if (all.empty() || radii.empty())
  {
    return;
  }
  auto & balls = workspace.balls;
  m_Sieve.Sieve(cells, radii, all, workspace.sieve, balls, workspace.open);
  // The first ball that covers a cell is the largest.
  std::sort(balls.begin(), balls.end(), [](const MedialVoxelInscribedBall & a, const MedialVoxelInscribedBall & b) {
    return a.radius > b.radius;
  });
  Sweep  sweep(cells, workspace.open, workspace.rows, radii);
  Shape  shape;
  double radiusOfShape = 0.0;
  for (auto ball = balls.begin(); ball != balls.end() && !sweep.IsDone(); ++ball)
  {
    if (ball->radius != radiusOfShape)
    {
      radiusOfShape = ball->radius;
      this->FindShape(ball->radius * ball->radius, shape);
    }
    sweep.Take(*ball, shape);
  }
}

} // end namespace itk
