// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSameTopology.h"

#include "itkMedialVoxelCellComplex.h"
#include "itkMedialVoxelClosedPores.h"
#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelThinning.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace itk
{

class MedialVoxelSameTopology::Implementation
{
public:
  using LevelType = MedialVoxelThinning::LevelType;

  Implementation(const MedialVoxelGrid & grid, const std::uint64_t maximumPoreSize, Consumer consumer)
    : m_Grid(grid)
    , m_Image(grid.GetVoxelBox())
    , m_Consumer(std::move(consumer))
    , m_Pores(grid, maximumPoreSize)
    , m_Thinning(
        grid,
        [this](std::int64_t, const MedialVoxelBits & kept, const MedialVoxelBits & added) { this->Take(kept, added); })
    , m_Object(grid)
    , m_Cells(grid)
  {}

  void
  TakeTile(const MedialVoxelTileResult & tile)
  {
    std::vector<std::uint16_t> cells(static_cast<std::size_t>(tile.box.NumberOfVoxels()));
    tile.WriteTopologyCells(cells.data(), { 1, tile.box.Extent(0), tile.box.Extent(0) * tile.box.Extent(1) });
    std::unique_lock<std::mutex> lock(m_Mutex);
    for (std::int64_t z = tile.box.lower[2]; z < tile.box.upper[2]; ++z)
    {
      this->AddPart(tile.box, cells, z);
    }
    if (std::exchange(m_IsThinning, true))
    {
      return;
    }
    for (auto first = m_Slices.begin(); first != m_Slices.end() && this->IsComplete(*first); first = m_Slices.begin())
    {
      const Slice slice = std::move(first->second);
      m_Slices.erase(first);
      ++m_NumberComplete;
      lock.unlock();
      this->AddSlice(slice.cells.data());
      lock.lock();
    }
    m_IsThinning = false;
  }

  void
  AddSlice(const std::uint16_t * const cells)
  {
    const MedialVoxelBox box = m_Thinning.GetSliceBox(m_NumberOfSlices++);
    MedialVoxelBits      object(box);
    Waiting              waiting{ MedialVoxelBits(box), std::vector<LevelType>(this->GetVoxelsPerSlice()) };
    for (std::int64_t y = 0; y < box.upper[1]; ++y)
    {
      MedialVoxelBits::WordType * const ofObject = object.GetRow(y, box.lower[2]);
      MedialVoxelBits::WordType * const ofMedial = waiting.medial.GetRow(y, box.lower[2]);
      for (std::int64_t begin = 0; begin < box.upper[0]; begin += MedialVoxelBits::BitsPerWord)
      {
        const std::int64_t count = std::min(box.upper[0] - begin, MedialVoxelBits::BitsPerWord);
        const auto         at = static_cast<std::size_t>(y * box.upper[0] + begin);
        if (MedialVoxelAreAllZero(cells + at, count))
        {
          continue; // most of a scan is background
        }
        MedialVoxelBits::WordType objectBits = 0;
        MedialVoxelBits::WordType medialBits = 0;
        for (std::int64_t i = 0; i < count; ++i)
        {
          const auto cell = MedialVoxelTopologyCell::Unpack(cells[at + static_cast<std::size_t>(i)]);
          objectBits |= MedialVoxelBits::WordType{ cell.isObject } << i;
          medialBits |= MedialVoxelBits::WordType{ cell.label >= MedialVoxelLabel::MedialByBound } << i;
          waiting.levels[at + static_cast<std::size_t>(i)] = cell.level;
          m_HasBoundary = m_HasBoundary && cell.level != MedialVoxelThinning::NoLevel;
        }
        ofObject[begin / MedialVoxelBits::BitsPerWord] = objectBits;
        ofMedial[begin / MedialVoxelBits::BitsPerWord] = medialBits;
      }
    }
    m_Waiting.push_back(std::move(waiting));
    m_Pores.AddSlice(std::move(object));
    while (m_Pores.HasSlice())
    {
      waiting = std::move(m_Waiting.front());
      m_Waiting.pop_front();
      MedialVoxelBits filled = m_Pores.TakeSlice();
      this->CountObject(filled);
      m_Thinning.AddSlice(std::move(filled), std::move(waiting.medial), std::move(waiting.levels));
    }
    if (m_NumberOfSlices == m_Image.upper[2])
    {
      this->CountLast();
    }
  }

  std::uint64_t
  GetHeldBytes() const
  {
    const std::uint64_t ofBits = MedialVoxelBits::GetBytes(m_Thinning.GetSliceBox(0));
    return m_Thinning.GetHeldBytes() + m_Objects.size() * ofBits +
           m_Waiting.size() * (2 * ofBits + this->GetVoxelsPerSlice() * sizeof(LevelType)) + m_Object.GetBytesOfRuns() +
           m_Cells.GetBytesOfRuns();
  }

  MedialVoxelTopologySums
  GetSums() const
  {
    return { m_NumberOfAddedCells,
             m_Object.GetBettiNumbers(),
             m_HasBoundary ? m_Cells.GetBettiNumbers() : MedialVoxelBettiNumbers() };
  }

private:
  /** A slice of which tiles are missing, or that comes after one. */
  struct Slice
  {
    std::vector<std::uint16_t> cells;
    std::size_t                missing;
  };

  /** A slice whose pores are not known. */
  struct Waiting
  {
    MedialVoxelBits        medial;
    std::vector<LevelType> levels;
  };

  std::size_t
  GetVoxelsPerSlice() const
  {
    return static_cast<std::size_t>(m_Image.upper[0] * m_Image.upper[1]);
  }

  bool
  IsComplete(const std::pair<const std::int64_t, Slice> & slice) const
  {
    return slice.first == m_NumberComplete && slice.second.missing == 0;
  }

  void
  AddPart(const MedialVoxelBox & tile, const std::vector<std::uint16_t> & cells, const std::int64_t z)
  {
    const std::size_t all = this->GetVoxelsPerSlice();
    Slice &           slice = m_Slices.try_emplace(z, Slice{ {}, all }).first->second;
    slice.cells.resize(all);
    slice.missing -= static_cast<std::size_t>(tile.Extent(0) * tile.Extent(1));
    for (std::int64_t y = tile.lower[1]; y < tile.upper[1]; ++y)
    {
      std::copy_n(cells.begin() + static_cast<std::ptrdiff_t>(tile.OffsetOf({ { tile.lower[0], y, z } })),
                  tile.Extent(0),
                  slice.cells.begin() + y * m_Image.upper[0] + tile.lower[0]);
    }
  }

  /** Count its cells when the slice after it is known. */
  void
  CountObject(const MedialVoxelBits & filled)
  {
    m_Objects.push_back(filled);
    if (m_Objects.size() > 1)
    {
      const MedialVoxelBits & before = m_Objects[m_Objects.size() - 2];
      m_Object.AddSlice(before, filled, MedialVoxelThinning::FindCells(m_Grid, before, filled));
    }
  }

  void
  CountLast()
  {
    const MedialVoxelBits & last = m_Objects.back();
    const MedialVoxelBits   cells = MedialVoxelThinning::FindCells(m_Grid, last, {});
    m_Object.AddSlice(last, {}, cells);
    if (m_Image.upper[2] > 1)
    {
      m_Cells.AddSlice(last, {}, cells); // it has none
    }
  }

  void
  Take(const MedialVoxelBits & kept, const MedialVoxelBits & added)
  {
    m_Cells.AddSlice(m_Objects[0], m_Image.upper[2] > 1 ? m_Objects[1] : MedialVoxelBits(), kept);
    if (m_Objects.size() > 1)
    {
      m_Objects.pop_front();
    }
    m_NumberOfAddedCells += added.Count(added.GetBox());
    m_Consumer(added);
  }

  MedialVoxelGrid               m_Grid;
  MedialVoxelBox                m_Image;
  Consumer                      m_Consumer;
  std::mutex                    m_Mutex;
  std::map<std::int64_t, Slice> m_Slices;
  std::int64_t                  m_NumberComplete{ 0 }; ///< slices that left them
  bool                          m_IsThinning{ false };

  // Used by the thread that thins.
  std::int64_t                m_NumberOfSlices{ 0 };
  MedialVoxelClosedPores      m_Pores;
  std::deque<Waiting>         m_Waiting;
  MedialVoxelThinning         m_Thinning;
  std::deque<MedialVoxelBits> m_Objects; ///< filled, from the first slice that is not thinned
  MedialVoxelCellComplex      m_Object;
  MedialVoxelCellComplex      m_Cells;
  bool                        m_HasBoundary{ true }; ///< in the image
  std::uint64_t               m_NumberOfAddedCells{ 0 };
};

MedialVoxelSameTopology::MedialVoxelSameTopology(const MedialVoxelGrid & grid,
                                                 const std::uint64_t     maximumPoreSize,
                                                 Consumer                consumer)
  : m_Implementation(std::make_unique<Implementation>(grid, maximumPoreSize, std::move(consumer)))
{}

MedialVoxelSameTopology::~MedialVoxelSameTopology() = default;

void
MedialVoxelSameTopology::TakeTile(const MedialVoxelTileResult & tile)
{
  m_Implementation->TakeTile(tile);
}

void
MedialVoxelSameTopology::AddSlice(const std::uint16_t * const cells)
{
  m_Implementation->AddSlice(cells);
}

std::uint64_t
MedialVoxelSameTopology::GetHeldBytes() const
{
  return m_Implementation->GetHeldBytes();
}

std::uint64_t
MedialVoxelSameTopology::GetUsualBytes(const MedialVoxelGrid & grid,
                                       const std::uint64_t     maximumPoreSize,
                                       const std::uint64_t     wallThickness)
{
  MedialVoxelBox slice = grid.GetVoxelBox();
  const auto     all = static_cast<std::uint64_t>(slice.upper[2]);
  slice.upper[2] = 1;
  const std::uint64_t ofBits = MedialVoxelBits::GetBytes(slice);
  const std::uint64_t waiting = std::min(maximumPoreSize, all) + 1;
  const std::uint64_t held = std::min(MedialVoxelThinning::GetMostHeldSlices(wallThickness / 2), all);
  return (held + waiting) * (MedialVoxelThinning::GetBytesOfSlice(slice) + ofBits) +
         2 * MedialVoxelCellComplex::GetUsualBytes(slice);
}

MedialVoxelTopologySums
MedialVoxelSameTopology::GetSums() const
{
  return m_Implementation->GetSums();
}

} // end namespace itk
