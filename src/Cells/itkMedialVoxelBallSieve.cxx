// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBallSieve.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace itk
{
namespace
{

/** Cells of a block along each axis. */
constexpr std::int64_t BlockEdge = 4;

/** Blocks of cells that cover a box. */
class Blocks
{
public:
  explicit Blocks(const MedialVoxelBox & box)
    : m_Box(box)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Number[axis] = (box.Extent(axis) + BlockEdge - 1) / BlockEdge;
    }
  }

  const MedialVoxelBox &
  GetBox() const
  {
    return m_Box;
  }

  std::size_t
  GetNumber() const
  {
    return static_cast<std::size_t>(m_Number[0] * m_Number[1] * m_Number[2]);
  }

  std::size_t
  NumberOf(const MedialVoxelIndex & cell) const
  {
    const std::int64_t y = (cell[1] - m_Box.lower[1]) / BlockEdge;
    const std::int64_t z = (cell[2] - m_Box.lower[2]) / BlockEdge;
    return static_cast<std::size_t>((z * m_Number[1] + y) * m_Number[0] + (cell[0] - m_Box.lower[0]) / BlockEdge);
  }

  /** Give each block the best value of the blocks around it and its own. */
  template <typename TBest>
  void
  Dilate(std::vector<double> & values, std::vector<double> & copy, TBest && best) const
  {
    MedialVoxelAbortChecker checker;
    std::size_t             stride = 1;
    for (const std::int64_t number : m_Number)
    {
      copy.resize(values.size());
      const auto        count = static_cast<std::size_t>(number);
      const std::size_t lineSize = stride * count;
      for (std::size_t line = 0; line < values.size(); line += lineSize)
      {
        for (std::size_t i = 0; i < count; ++i)
        {
          checker.Count(static_cast<std::uint32_t>(stride));
          const double * const own = values.data() + line + i * stride;
          const double * const before = i > 0 ? own - stride : own;
          const double * const after = i + 1 < count ? own + stride : own;
          double * const       to = copy.data() + line + i * stride;
          for (std::size_t k = 0; k < stride; ++k)
          {
            to[k] = best(best(before[k], own[k]), after[k]);
          }
        }
      }
      values.swap(copy);
      stride = lineSize;
    }
  }

private:
  MedialVoxelBox              m_Box;
  std::array<std::int64_t, 3> m_Number{};
};

double
Larger(const double a, const double b)
{
  return a > b ? a : b;
}

double
Smaller(const double a, const double b)
{
  return a < b ? a : b;
}

/** Find the cells that are smaller than the largest ball of their block, and the smallest of them in each block. */
void
KeepSmallerCells(const MedialVoxelBits &     cells,
                 const std::vector<double> & radii,
                 const Blocks &              blocks,
                 const std::vector<double> & largestBalls,
                 MedialVoxelBits &           smallerCells,
                 std::vector<double> &       smallest)
{
  smallerCells = cells;
  const MedialVoxelBox & box = cells.GetBox();
  auto                   radius = radii.begin();
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    MedialVoxelCheckAbort();
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      MedialVoxelBits::WordType * const row = smallerCells.GetRow(y, z);
      for (std::int64_t word = 0; word < cells.GetWordsPerRow(); ++word)
      {
        const std::int64_t x = (cells.GetFirstWord() + word) * MedialVoxelBits::BitsPerWord;
        for (auto rest = row[word]; rest != 0; rest &= rest - 1, ++radius)
        {
          const std::size_t block = blocks.NumberOf({ { x + MedialVoxelLowestBit(rest), y, z } });
          if (*radius < largestBalls[block])
          {
            smallest[block] = Smaller(smallest[block], *radius);
          }
          else
          {
            row[word] &= ~(rest & (~rest + 1));
          }
        }
      }
    }
  }
}

} // namespace

MedialVoxelBallSieve::MedialVoxelBallSieve(const MedialVoxelGrid & grid)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_MostReach[axis] = static_cast<std::size_t>(grid.GetSize()[axis] / BlockEdge) + 2;
    shortest = grid.IsActive(axis) ? std::min(shortest, grid.GetMetricSpacing()[axis]) : shortest;
  }
  m_BlockLength = static_cast<double>(BlockEdge) * shortest;
}

std::size_t
MedialVoxelBallSieve::ReachOf(const double radius) const
{
  std::size_t       reach = 1;
  const std::size_t all = *std::max_element(m_MostReach.begin(), m_MostReach.end());
  while (reach < all && radius > static_cast<double>(reach) * m_BlockLength)
  {
    ++reach;
  }
  return reach;
}

void
MedialVoxelBallSieve::Survey(const MedialVoxelBox &                        box,
                             const std::vector<MedialVoxelInscribedBall> & balls,
                             Workspace &                                   workspace) const
{
  double largest = 0.0;
  for (const MedialVoxelInscribedBall & ball : balls)
  {
    largest = Larger(largest, ball.radius);
  }
  const std::size_t mostReach = this->ReachOf(largest);
  MedialVoxelIndex  margin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    margin[axis] = BlockEdge * static_cast<std::int64_t>(std::min(mostReach, m_MostReach[axis]));
  }
  workspace.box = box.Expanded(margin);
  const Blocks blocks(workspace.box);
  auto &       layers = workspace.layers;
  layers.resize(mostReach + 1);
  for (auto & layer : layers)
  {
    layer.assign(blocks.GetNumber(), 0.0);
  }
  for (const MedialVoxelInscribedBall & ball : balls)
  {
    if (blocks.GetBox().Contains(ball.center))
    {
      double & value = layers[this->ReachOf(ball.radius)][blocks.NumberOf(ball.center)];
      value = Larger(value, ball.radius);
    }
  }
  for (std::size_t reach = mostReach; reach > 0; --reach)
  {
    blocks.Dilate(layers[reach], workspace.copy, Larger);
    std::transform(
      layers[reach].begin(), layers[reach].end(), layers[reach - 1].begin(), layers[reach - 1].begin(), Larger);
  }
}

double
MedialVoxelBallSieve::GetLargest(const MedialVoxelIndex & cell, const Workspace & workspace)
{
  return workspace.layers[0][Blocks(workspace.box).NumberOf(cell)];
}

void
MedialVoxelBallSieve::Sieve(const MedialVoxelRankedBits &                 cells,
                            const std::vector<double> &                   radii,
                            const std::vector<MedialVoxelInscribedBall> & all,
                            Workspace &                                   workspace,
                            std::vector<MedialVoxelInscribedBall> &       balls,
                            MedialVoxelBits &                             open) const
{
  const Blocks      blocks(workspace.box);
  auto &            layers = workspace.layers;
  const std::size_t mostReach = layers.size() - 1;

  // The smallest radius of a cell that can be raised in each block, then within each reach.
  const std::vector<double> & largestBalls = layers[0];
  std::vector<double> &       smallestCells = layers[1];
  smallestCells.assign(blocks.GetNumber(), std::numeric_limits<double>::infinity());
  KeepSmallerCells(cells.GetBits(), radii, blocks, largestBalls, open, smallestCells);
  for (std::size_t reach = 1; reach <= mostReach; ++reach)
  {
    if (reach > 1)
    {
      layers[reach] = layers[reach - 1];
    }
    blocks.Dilate(layers[reach], workspace.copy, Smaller);
  }

  const auto raisesNone = [&](const MedialVoxelInscribedBall & ball) {
    return !blocks.GetBox().Contains(ball.center) ||
           ball.radius <= layers[this->ReachOf(ball.radius)][blocks.NumberOf(ball.center)];
  };
  balls.clear();
  std::remove_copy_if(all.begin(), all.end(), std::back_inserter(balls), raisesNone);
}

} // end namespace itk
