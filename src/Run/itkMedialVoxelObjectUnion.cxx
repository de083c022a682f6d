// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelObjectUnion.h"

#include "itkMedialVoxelParameters.h"

#include <algorithm>
#include <utility>

namespace itk
{
namespace
{

/** The cell belongs to the object with the highest rank; 0: it is not in the sheet. */
int
RankOf(const std::uint8_t label)
{
  return label < MedialVoxelLabel::MedialByBound ? 0 : label == MedialVoxelLabel::AddedForTopology ? 1 : 2;
}

} // namespace

auto
MedialVoxelObjectUnion::Sums::operator+=(const Sums & other) -> Sums &
{
  shared += other.shared;
  topology += other.topology;
  for (const auto & [object, own] : other.cells)
  {
    cells[object] += own;
  }
  return *this;
}

MedialVoxelObjectUnion::MedialVoxelObjectUnion(MedialVoxelObjectMap &   map,
                                               const MedialVoxelIndex & size,
                                               const std::uint64_t      maximumPoreSize)
  : m_Map(map)
  , m_Region(map, size)
  , m_MaximumPoreSize(maximumPoreSize)
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
  m_AddedCells.clear();
  m_Region.Read(region);
  this->BeginTopology();
}

void
MedialVoxelObjectUnion::BeginAgain(const MedialVoxelBox &               region,
                                   std::vector<std::uint8_t>            labels,
                                   std::vector<MedialVoxelObjectNumber> objects)
{
  this->Begin(region, {});
  m_Labels = std::move(labels);
  m_Objects = std::move(objects);
}

void
MedialVoxelObjectUnion::BeginTopology()
{
  m_Topology.reset();
  if (m_Grid)
  {
    m_Topology = std::make_unique<MedialVoxelSameTopology>(
      *m_Grid, m_MaximumPoreSize, [this](const MedialVoxelBits & added) { this->TakeAddedCells(added); });
  }
}

void
MedialVoxelObjectUnion::TakeTile(const MedialVoxelTileResult & tile)
{
  if (m_Topology)
  {
    m_Topology->TakeTile(tile);
  }
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
  m_Sums += sums;
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
  Cells & cells = sums.cells[object];
  ++cells.candidate;
  cells.medial += RankOf(label) > 0 ? 1 : 0;
  const bool isGiven = this->Give(offset, label, object, sums);
  for (std::size_t kind = 0; kind < m_Values.size() && isGiven; ++kind)
  {
    const std::size_t bytes = m_Values[kind].bytesPerVoxel;
    std::copy_n(valueOf(kind), bytes, m_Values[kind].first + offset * bytes);
  }
}

bool
MedialVoxelObjectUnion::Give(const std::size_t             offset,
                             const std::uint8_t            label,
                             const MedialVoxelObjectNumber object,
                             Sums &                        sums)
{
  const auto                mark = static_cast<std::uint8_t>(m_Labels[offset] & SharedMark);
  const auto                known = static_cast<std::uint8_t>(m_Labels[offset] & ~SharedMark);
  MedialVoxelObjectNumber & owner = m_Objects[offset];
  if (owner == object)
  {
    // A tile of a pass that is run again gives the same label.
    m_Labels[offset] = static_cast<std::uint8_t>(std::max(label, known) | mark);
    return false;
  }
  const bool areBoth = RankOf(label) > 0 && RankOf(known) > 0;
  sums.shared += areBoth && mark == 0 ? 1 : 0;
  const bool isGiven = owner == 0 || (RankOf(label) == RankOf(known) ? object < owner : RankOf(label) > RankOf(known));
  owner = isGiven ? object : owner;
  m_Labels[offset] = static_cast<std::uint8_t>((isGiven ? label : known) | (areBoth ? SharedMark : mark));
  return isGiven;
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
  if (m_Topology)
  {
    m_Sums.topology += m_Topology->GetSums();
    this->BeginTopology();
  }
  for (const MedialVoxelBits & added : m_AddedCells)
  {
    this->GiveAddedCells(added);
  }
  m_AddedCells.clear();
}

void
MedialVoxelObjectUnion::GiveAddedCells(const MedialVoxelBits & added)
{
  MedialVoxelSameTopology::ForEachCell(added, [this](const MedialVoxelIndex & cell) {
    const auto object = m_Region.FindOwner(cell, m_Map.GetShownPass());
    ++m_Sums.cells[object].added;
    this->Give(static_cast<std::size_t>(m_Box.OffsetOf(cell)), MedialVoxelLabel::AddedForTopology, object, m_Sums);
  });
}

void
MedialVoxelObjectUnion::RemoveMarks(std::vector<std::uint8_t> & labels)
{
  std::transform(labels.begin(), labels.end(), labels.begin(), [](const std::uint8_t label) {
    return static_cast<std::uint8_t>(label & ~SharedMark);
  });
}

} // end namespace itk
