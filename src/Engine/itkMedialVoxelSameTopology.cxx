// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSameTopology.h"

#include "itkMedialVoxelClosedPores.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelThinning.h"

#include <algorithm>
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
    : m_Image(grid.GetVoxelBox())
    , m_Pores(grid, maximumPoreSize)
    , m_Thinning(grid,
                 [this, consumer = std::move(consumer)](std::int64_t, const auto &, const MedialVoxelBits & added) {
                   m_NumberOfAddedCells += added.Count(added.GetBox());
                   consumer(added);
                 })
  {}

  void
  TakeTile(const MedialVoxelTileResult & tile)
  {
    std::unique_lock<std::mutex> lock(m_Mutex);
    for (std::int64_t z = tile.box.lower[2]; z < tile.box.upper[2]; ++z)
    {
      this->AddPart(tile, z);
    }
    if (std::exchange(m_IsThinning, true))
    {
      return;
    }
    for (auto first = m_Slices.begin(); first != m_Slices.end() && this->IsComplete(*first); first = m_Slices.begin())
    {
      Slice slice = std::move(first->second);
      m_Slices.erase(first);
      ++m_NumberOfSlices;
      lock.unlock();
      this->AddSlice(std::move(slice));
      lock.lock();
    }
    m_IsThinning = false;
  }

  std::uint64_t
  GetNumberOfAddedCells() const
  {
    return m_NumberOfAddedCells;
  }

private:
  struct Slice
  {
    MedialVoxelBits        object;
    MedialVoxelBits        medial;
    std::vector<LevelType> levels;
    std::int64_t           missingVoxels;
  };

  bool
  IsComplete(const std::pair<const std::int64_t, Slice> & slice) const
  {
    return slice.first == m_NumberOfSlices && slice.second.missingVoxels == 0;
  }

  Slice
  MakeSlice(const std::int64_t z) const
  {
    MedialVoxelBox box = m_Image;
    box.lower[2] = z;
    box.upper[2] = z + 1;
    return { MedialVoxelBits(box),
             MedialVoxelBits(box),
             std::vector<LevelType>(static_cast<std::size_t>(box.NumberOfVoxels())),
             box.NumberOfVoxels() };
  }

  void
  AddPart(const MedialVoxelTileResult & tile, const std::int64_t z)
  {
    auto found = m_Slices.find(z);
    if (found == m_Slices.end())
    {
      found = m_Slices.emplace(z, this->MakeSlice(z)).first;
    }
    Slice & slice = found->second;
    slice.missingVoxels -= tile.box.Extent(0) * tile.box.Extent(1);
    for (std::int64_t y = tile.box.lower[1]; y < tile.box.upper[1] && !tile.isEmpty; ++y)
    {
      AddRow(tile, y, z, slice);
    }
  }

  static void
  AddRow(const MedialVoxelTileResult & tile, const std::int64_t y, const std::int64_t z, Slice & slice)
  {
    const MedialVoxelBox & box = tile.box;
    const std::size_t      first = box.OffsetOf({ { box.lower[0], y, z } });
    const auto             length = static_cast<std::size_t>(box.Extent(0));
    const auto             x = static_cast<std::size_t>(box.lower[0]);
    const auto             row = static_cast<std::size_t>(y * slice.object.GetBox().Extent(0));
    std::copy_n(tile.levels->data() + first, length, slice.levels.data() + row + x);
    for (std::size_t i = 0; i < length; ++i)
    {
      if (tile.labels[first + i] >= MedialVoxelLabel::MedialByBound)
      {
        slice.medial.GetRow(y, z)[(x + i) / 64] |= MedialVoxelBits::WordType{ 1 } << ((x + i) % 64);
      }
    }
    MedialVoxelBits::WordType * const       target = slice.object.GetRow(y, z);
    const MedialVoxelBits::WordType * const source = tile.object->GetRow(y, z) - tile.object->GetFirstWord();
    for (std::int64_t word = box.lower[0] / MedialVoxelBits::BitsPerWord;
         word * MedialVoxelBits::BitsPerWord < box.upper[0];
         ++word)
    {
      target[word] |= source[word] & MedialVoxelBits::RangeMask(word, box.lower[0], box.upper[0]);
    }
  }

  void
  AddSlice(Slice slice)
  {
    m_Waiting.push_back({ std::move(slice.medial), std::move(slice.levels) });
    m_Pores.AddSlice(std::move(slice.object));
    while (m_Pores.HasSlice())
    {
      auto [medial, levels] = std::move(m_Waiting.front());
      m_Waiting.pop_front();
      m_Thinning.AddSlice(m_Pores.TakeSlice(), std::move(medial), std::move(levels));
    }
  }

  MedialVoxelBox                m_Image;
  std::mutex                    m_Mutex;
  std::map<std::int64_t, Slice> m_Slices;              ///< that tiles are missing of, or that come after them
  std::int64_t                  m_NumberOfSlices{ 0 }; ///< that went on
  bool                          m_IsThinning{ false };

  // Used by the thread that thins.
  MedialVoxelClosedPores                                         m_Pores;
  std::deque<std::pair<MedialVoxelBits, std::vector<LevelType>>> m_Waiting; ///< for the pores
  MedialVoxelThinning                                            m_Thinning;
  std::uint64_t                                                  m_NumberOfAddedCells{ 0 };
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

std::uint64_t
MedialVoxelSameTopology::GetNumberOfAddedCells() const
{
  return m_Implementation->GetNumberOfAddedCells();
}

} // end namespace itk
