// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallBalls.h"

#include "itkMedialVoxelSlabPlan.h"

#include <algorithm>
#include <utility>

namespace itk
{

namespace
{

/** Rows of a strip. */
constexpr std::int64_t RowsOfStrip = 32;

} // namespace

struct MedialVoxelWallBalls::TileBalls : public Workspace
{
  std::vector<Ball> balls;
};

MedialVoxelWallBalls::MedialVoxelWallBalls(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & settings)
  : m_SlowestAxis(MedialVoxelSlowestAxis(grid.GetVoxelBox()))
  , m_Margin(static_cast<std::uint64_t>(
      MedialVoxelWallPainter(grid, 0.5 * settings.maximumThickness).GetMargin()[m_SlowestAxis]))
  , m_MaximumRadius(0.5 * settings.maximumThickness / grid.GetMetricUnit())
  , m_Maximum(static_cast<float>(settings.maximumThickness))
  , m_Pairs(grid, settings.walls->parameters.epsilon)
  , m_Threshold(grid, settings.walls->parameters)
{}

template <typename TIndex>
auto
MedialVoxelWallBalls::KeyOf(const TIndex & cell) const -> Key
{
  return { cell[m_SlowestAxis], m_SlowestAxis > 0 ? cell[m_SlowestAxis - 1] / RowsOfStrip : 0 };
}

/** Whether a box lies beside the known region or in it along the slowest axis, and in it along the others. */
bool
MedialVoxelWallBalls::Follows(const MedialVoxelBox & box) const
{
  bool follows = !m_Known.IsEmpty() && box.lower[m_SlowestAxis] <= m_Known.upper[m_SlowestAxis] &&
                 box.upper[m_SlowestAxis] >= m_Known.lower[m_SlowestAxis];
  for (unsigned int axis = 0; axis < m_SlowestAxis; ++axis)
  {
    follows = follows && box.lower[axis] >= m_Known.lower[axis] && box.upper[axis] <= m_Known.upper[axis];
  }
  return follows;
}

std::vector<MedialVoxelBox>
MedialVoxelWallBalls::FindMissing(const MedialVoxelBox & cells) const
{
  if (!this->Follows(cells))
  {
    return { cells };
  }
  std::vector<MedialVoxelBox> missing;
  MedialVoxelBox              box = m_Known;
  if (cells.lower[m_SlowestAxis] < m_Known.lower[m_SlowestAxis])
  {
    box.lower[m_SlowestAxis] = cells.lower[m_SlowestAxis];
    box.upper[m_SlowestAxis] = m_Known.lower[m_SlowestAxis];
    missing.push_back(box);
  }
  if (cells.upper[m_SlowestAxis] > m_Known.upper[m_SlowestAxis])
  {
    box.lower[m_SlowestAxis] = m_Known.upper[m_SlowestAxis];
    box.upper[m_SlowestAxis] = cells.upper[m_SlowestAxis];
    missing.push_back(box);
  }
  return missing;
}

void
MedialVoxelWallBalls::DropBefore(const MedialVoxelBox & cells)
{
  std::int64_t & lower = m_Known.lower[m_SlowestAxis];
  lower = std::max(lower, std::min(cells.lower[m_SlowestAxis], m_Known.upper[m_SlowestAxis]));
  m_Balls.erase(m_Balls.begin(), m_Balls.lower_bound({ lower, 0 }));
}

void
MedialVoxelWallBalls::Copy(const MedialVoxelBox & cells, std::vector<Ball> & balls) const
{
  balls.clear();
  const Key      last = this->KeyOf(MedialVoxelIndex{ { cells.upper[0] - 1, cells.upper[1] - 1, cells.upper[2] - 1 } });
  Key            key = this->KeyOf(cells.lower);
  const auto     firstStrip = key[1];
  MedialVoxelBox box = cells;
  for (; key[0] <= last[0]; ++key[0])
  {
    key[1] = firstStrip;
    for (auto strip = m_Balls.lower_bound(key);
         strip != m_Balls.end() && strip->first[0] == key[0] && strip->first[1] <= last[1];
         ++strip)
    {
      std::copy_if(strip->second.begin(), strip->second.end(), std::back_inserter(balls), [&box](const Ball & ball) {
        return box.Contains(MedialVoxelIndex{ { ball.cell[0], ball.cell[1], ball.cell[2] } });
      });
    }
  }
}

auto
MedialVoxelWallBalls::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  return std::make_unique<TileBalls>();
}

void
MedialVoxelWallBalls::Begin()
{
  m_Pending.clear();
}

MedialVoxelBits::WordType
MedialVoxelWallBalls::SelectCells(const MedialVoxelCellRow & row) const
{
  return row.byBound | row.byGeodesic;
}

void
MedialVoxelWallBalls::Observe(const MedialVoxelClassifiedTile & tile, Workspace * const workspace)
{
  auto & balls = static_cast<TileBalls &>(*workspace).balls;
  balls.clear();
  MedialVoxelForEachWall(tile.rows, tile.walls, [&](const MedialVoxelIndex & cell, const MedialVoxelWall & wall) {
    MedialVoxelDiagonal widest;
    if (wall.IsMeasured() && m_Pairs.Choose(tile.features, m_Pairs.CellAt(tile.features, cell), 0, widest))
    {
      balls.push_back({ { { static_cast<std::int32_t>(cell[0]),
                            static_cast<std::int32_t>(cell[1]),
                            static_cast<std::int32_t>(cell[2]) } },
                        std::min(wall.thickness, m_Maximum),
                        std::min(m_Threshold.RadiusOf(widest), m_MaximumRadius) });
    }
  });
  const std::lock_guard<std::mutex> lock(m_Mutex);
  for (auto first = balls.begin(); first != balls.end();)
  {
    const Key  key = this->KeyOf(first->cell);
    const auto last =
      std::find_if(first, balls.end(), [&](const Ball & ball) { return this->KeyOf(ball.cell) != key; });
    auto & strip = m_Pending[key];
    strip.insert(strip.end(), first, last);
    first = last;
  }
}

/** Balls that are known already stay. */
void
MedialVoxelWallBalls::Commit()
{
  bool isAsWide = true;
  for (unsigned int axis = 0; axis < m_SlowestAxis; ++axis)
  {
    isAsWide = isAsWide && m_Region.lower[axis] == m_Known.lower[axis] && m_Region.upper[axis] == m_Known.upper[axis];
  }
  if (!isAsWide || !this->Follows(m_Region))
  {
    m_Balls = std::exchange(m_Pending, {});
    m_Known = m_Region;
    return;
  }
  for (auto & [key, strip] : m_Pending)
  {
    if (key[0] < m_Known.lower[m_SlowestAxis] || key[0] >= m_Known.upper[m_SlowestAxis])
    {
      m_Balls[key] = std::move(strip);
    }
  }
  m_Pending.clear();
  m_Known = m_Known.Union(m_Region);
}

} // end namespace itk
