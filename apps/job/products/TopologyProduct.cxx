// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "TopologyProduct.h"

#include "Errors.h"
#include "JobClock.h"
#include "MeshPlacement.h"
#include "Options.h"
#include "Outputs.h"
#include "Text.h"
#include "TopologyJson.h"
#include "VolumeFormats.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

using Cell = itk::MedialVoxelTopologyCell;

constexpr VoxelLayout CellLayout{ PixelType::UInt16, 1 };

void
WriteCells(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  tile.WriteTopologyCells(static_cast<std::uint16_t *>(target.first), target.strides);
}

/** \class LabelWriter
 * \brief Writes the slices of the labels, whose order is that of the cells that are added. */
class LabelWriter
{
public:
  LabelWriter(const VoxelOutput & cells, const std::uint64_t perSlice, VoxelOutput & labels)
    : m_Cells(cells)
    , m_PerSlice(perSlice)
    , m_Labels(labels)
    , m_Packed(perSlice)
    , m_Slice(perSlice)
  {}

  void
  Write(const itk::MedialVoxelBits & added)
  {
    m_Cells.Read(m_Number * m_PerSlice, m_PerSlice, m_Packed.data());
    std::transform(m_Packed.begin(), m_Packed.end(), m_Slice.begin(), [](const std::uint16_t cell) {
      return Cell::Unpack(cell).label;
    });
    itk::MedialVoxelSameTopology::Label(added, m_Slice.data(), { 1, added.GetBox().upper[0], 0 });
    m_Labels.Write(m_Number * m_PerSlice, m_PerSlice, m_Slice.data());
    ++m_Number;
  }

  std::uint64_t
  GetNumberOfSlices() const
  {
    return m_Number;
  }

private:
  const VoxelOutput &        m_Cells;
  std::uint64_t              m_PerSlice;
  VoxelOutput &              m_Labels;
  std::vector<std::uint16_t> m_Packed;
  std::vector<std::uint8_t>  m_Slice;
  std::uint64_t              m_Number{ 0 };
};

} // namespace

void
CheckTopologyMemory(const itk::MedialVoxelSameTopology & topology, const JobPlan & plan)
{
  const std::uint64_t allowed = plan.memory.limit - std::min(plan.memory.limit, plan.memory.fixed);
  if (plan.memory.limit != NoMemoryLimit && topology.GetHeldBytes() > allowed)
  {
    FailForMemory("walls thicker than ",
                  PlannedWallThickness,
                  " voxels, or noise: the cells for the topology of the object need more than the ",
                  FormatBytes(allowed),
                  " of memory that are left for them; allow more with --memory, or leave out --same-topology");
  }
}

TopologyProduct::TopologyProduct(const ExtractOptions & options, VolumeRequest labels)
  : Product({})
  , m_Options(options)
  , m_Labels(std::move(labels))
  , m_Cells(m_Labels)
{
  m_Cells.role = "cells";
  m_Cells.fileName = GetCellsFile(m_Labels.fileName);
  m_Cells.layout = CellLayout;
  m_Cells.write = WriteCells;
  m_Cells.isPublished = false;
  m_Links.request = &m_Cells;
}

void
TopologyProduct::AddTo(Footprint & footprint, const VolumeHeader & header) const
{
  footprint.engines.front().perVoxel += CellLayout.GetBytes();
  const std::uint64_t        perVoxel = 2 * CellLayout.GetBytes() + m_Labels.layout.GetBytes();
  const itk::MedialVoxelGrid grid = GetGrid(header);
  footprint.ofEnd = perVoxel * header.geometry.GetVoxelsPerSlice() +
                    itk::MedialVoxelSameTopology::GetUsualBytes(
                      grid, GetParameters(m_Options, grid).maximumPoreSize, PlannedWallThickness);
  ProductFootprint own;
  own.beside = GetOutputMemory(m_Labels.fileName, header.geometry, m_Labels.layout, m_Options);
  own.scratch = { GetScratchFolder(m_Options, m_Labels.fileName),
                  header.geometry.GetNumberOfVoxels() * CellLayout.GetBytes() };
  footprint.Add(own);
  footprint.rowsOfLayer = 0;
}

void
TopologyProduct::MakeFile(OutputSet & outputs)
{
  Product::MakeFile(outputs);
  m_LabelVolume = outputs.AddVolumeOfEnd(m_Labels);
}

void
TopologyProduct::FillVolumes(JobResult & result, const ProductEnd & end)
{
  const auto                start = JobClock::now();
  VoxelOutput &             cells = *m_Links.volume;
  const itk::MedialVoxelBox image = GetGrid(result.input).GetVoxelBox();
  const auto                perSlice = static_cast<std::uint64_t>(image.Extent(0) * image.Extent(1));
  const auto                slices = static_cast<std::uint64_t>(image.Extent(2));
  cells.Finish();
  LabelWriter                  writer(cells, perSlice, *m_LabelVolume);
  itk::MedialVoxelSameTopology topology(GetGrid(result.input),
                                        GetParameters(m_Options, GetGrid(result.input)).maximumPoreSize,
                                        [&writer](const itk::MedialVoxelBits & added) { writer.Write(added); });
  std::vector<std::uint16_t>   packed(perSlice);
  for (std::uint64_t slice = 0; slice < slices; ++slice)
  {
    cells.Read(slice * perSlice, perSlice, packed.data());
    topology.AddSlice(packed.data());
    CheckTopologyMemory(topology, result.plan);
    end.progress(static_cast<double>(slice + 1) / static_cast<double>(slices));
  }
  while (writer.GetNumberOfSlices() < slices)
  {
    writer.Write({}); // the last one has no cells
  }
  result.topology = DescribeTopology(topology.GetSums());
  result.seconds.topology = SecondsSince(start);
}

} // end namespace medialvoxel
