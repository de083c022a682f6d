// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectUnion.h"

#include "itkMedialVoxelParameters.h"

#include <algorithm>
#include <utility>

namespace itk
{

MedialVoxelObjectUnion::MedialVoxelObjectUnion(MedialVoxelObjectMap &   map,
                                               const MedialVoxelIndex & size,
                                               const std::uint64_t      maximumPoreSize)
  : m_Map(map)
  , m_Region(map, size, maximumPoreSize)
{}

void
MedialVoxelObjectUnion::Begin(const MedialVoxelBox & region, std::vector<Values> values)
{
  m_Box = region;
  m_Values = std::move(values);
  m_Labels.assign(static_cast<std::size_t>(region.NumberOfVoxels()), 0);
  m_Objects.assign(m_Labels.size(), 0);
  m_Sums = {};
  m_PoreCells.clear();
  m_Region.Read(region);
}

void
MedialVoxelObjectUnion::TakeTile(const MedialVoxelTileResult & tile)
{
  if (tile.isEmpty)
  {
    return;
  }
  const MedialVoxelStrides            strides{ 1, tile.box.Extent(0), tile.box.Extent(0) * tile.box.Extent(1) };
  std::vector<std::vector<std::byte>> values;
  for (const Values & kind : m_Values)
  {
    values.emplace_back(static_cast<std::size_t>(tile.box.NumberOfVoxels()) * kind.bytesPerVoxel);
    kind.write(tile, values.back().data(), strides);
  }
  const unsigned int    pass = m_Map.GetShownPass();
  Sums                  sums;
  std::vector<PoreCell> poreCells;
  MedialVoxelForEachRow(tile.box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
    MedialVoxelIndex index = row.lower;
    for (auto voxel = static_cast<std::size_t>(offset); index[0] < row.upper[0]; ++index[0], ++voxel)
    {
      const std::uint8_t label = tile.labels[voxel];
      if (label == MedialVoxelLabel::NoObject)
      {
        continue;
      }
      const auto valueOf = [&](const std::size_t kind) {
        return values[kind].data() + voxel * m_Values[kind].bytesPerVoxel;
      };
      if (const auto object = m_Region.FindObject(index, pass))
      {
        this->TakeCell(m_Box.OffsetOf(index), label, object, valueOf, sums);
        continue;
      }
      poreCells.push_back({ index, label, {} });
      for (std::size_t kind = 0; kind < m_Values.size(); ++kind)
      {
        poreCells.back().values.emplace_back(valueOf(kind), valueOf(kind) + m_Values[kind].bytesPerVoxel);
      }
    }
  });
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_Sums.shared += sums.shared;
  for (const auto & [object, cells] : sums.cells)
  {
    m_Sums.cells[object].candidate += cells.candidate;
    m_Sums.cells[object].medial += cells.medial;
  }
  std::move(poreCells.begin(), poreCells.end(), std::back_inserter(m_PoreCells));
}

template <typename TValueOf>
void
MedialVoxelObjectUnion::TakeCell(const std::size_t             offset,
                                 const std::uint8_t            label,
                                 const MedialVoxelObjectNumber object,
                                 const TValueOf &              valueOf,
                                 Sums &                        sums)
{
  std::uint8_t &            knownLabel = m_Labels[offset];
  MedialVoxelObjectNumber & owner = m_Objects[offset];
  const std::uint8_t        mark = knownLabel & SharedMark;
  const bool                isMedial = label >= MedialVoxelLabel::MedialByBound;
  const bool                wasMedial = (knownLabel & ~SharedMark) >= MedialVoxelLabel::MedialByBound;
  Cells &                   cells = sums.cells[object];
  ++cells.candidate;
  cells.medial += isMedial ? 1 : 0;
  if (owner == object)
  {
    return; // a tile of a pass that is run again
  }
  const bool areBoth = isMedial && wasMedial;
  sums.shared += areBoth && mark == 0 ? 1 : 0;
  const std::uint8_t newMark = areBoth ? SharedMark : mark;
  const bool         isTaken = owner == 0 || (isMedial == wasMedial ? object < owner : isMedial);
  if (isTaken)
  {
    owner = object;
    for (std::size_t kind = 0; kind < m_Values.size(); ++kind)
    {
      const std::size_t bytes = m_Values[kind].bytesPerVoxel;
      std::copy_n(valueOf(kind), bytes, m_Values[kind].first + offset * bytes);
    }
  }
  knownLabel = static_cast<std::uint8_t>((isTaken ? label : knownLabel & ~SharedMark) | newMark);
}

void
MedialVoxelObjectUnion::FinishPass()
{
  for (const PoreCell & cell : m_PoreCells)
  {
    const auto valueOf = [&cell](const std::size_t kind) { return cell.values[kind].data(); };
    const auto object = m_Region.FindObjectOfPore(cell.index, m_Map.GetShownPass());
    this->TakeCell(m_Box.OffsetOf(cell.index), cell.label, object, valueOf, m_Sums);
  }
  m_PoreCells.clear();
}

void
MedialVoxelObjectUnion::Finish()
{
  std::transform(m_Labels.begin(), m_Labels.end(), m_Labels.begin(), [](const std::uint8_t label) {
    return static_cast<std::uint8_t>(label & ~SharedMark);
  });
}

} // end namespace itk
