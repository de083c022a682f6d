// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectTopologyProduct.h"

#include "JobClock.h"
#include "LabelMap.h"
#include "MeshPlacement.h"
#include "Outputs.h"
#include "TopologyJson.h"
#include "TopologyProduct.h"
#include "VolumeFormats.h"

#include <utility>
#include <vector>

namespace medialvoxel
{

ObjectTopologyProduct::ObjectTopologyProduct(const ExtractOptions &       options,
                                             VolumeRequest                labels,
                                             std::optional<VolumeRequest> objects)
  : Product({})
  , m_Options(options)
  , m_Labels(std::move(labels))
  , m_Objects(std::move(objects))
{}

void
ObjectTopologyProduct::AddTo(Footprint & footprint, const VolumeHeader & header) const
{
  const VolumeGeometry &    geometry = header.geometry;
  const itk::MedialVoxelBox image = footprint.grid.GetVoxelBox();
  // A slice of a pass, what was put together, twice, and the voxels of two slices.
  std::uint64_t perVoxel = PassCells::BytesOfPass + 2 * PassCells::BytesOfUnion + 2 * sizeof(PassCells::ObjectNumber);
  ProductFootprint own;
  own.beside = GetOutputMemory(m_Labels.fileName, geometry, m_Labels.layout, m_Options);
  if (m_Objects)
  {
    perVoxel += m_Objects->layout.GetBytes();
    own.beside += GetOutputMemory(m_Objects->fileName, geometry, m_Objects->layout, m_Options);
  }
  own.scratch = { GetScratchFolder(m_Options, m_Labels.fileName),
                  geometry.GetNumberOfVoxels() * (PassCells::BytesOfUnion + PassCells::BytesOfPass) };
  footprint.perVoxelOfUnion += PassCells::BytesOfPass;
  footprint.ofEnd = perVoxel * static_cast<std::uint64_t>(image.Extent(0) * image.Extent(1)) +
                    itk::MedialVoxelSameTopology::GetUsualBytes(
                      footprint.grid, GetParameters(m_Options, footprint.grid).maximumPoreSize, PlannedWallThickness);
  footprint.Add(own);
  footprint.rowsOfLayer = 0;
}

void
ObjectTopologyProduct::Start(ProductStart & start)
{
  m_Map = &static_cast<LabelMap &>(*start.input).GetObjects();
  m_Cells.emplace(GetScratchFolder(m_Options, m_Labels.fileName),
                  GetGrid(start.job.input).GetVoxelBox(),
                  m_Map->GetNumberOfPasses(),
                  m_Options.sparse);
  m_Links.cells = &*m_Cells;
  if (m_Objects)
  {
    m_Objects->layout.segments = &start.job.segments;
  }
}

void
ObjectTopologyProduct::MakeFile(OutputSet & outputs)
{
  m_LabelVolume = outputs.AddVolumeOfEnd(m_Labels);
  m_ObjectVolume = m_Objects ? outputs.AddVolumeOfEnd(*m_Objects) : nullptr;
}

void
ObjectTopologyProduct::FillVolumes(JobResult & result, const ProductEnd & end)
{
  const auto                   start = JobClock::now();
  const itk::MedialVoxelGrid   grid = GetGrid(result.input);
  const std::uint64_t          poreSize = GetParameters(m_Options, grid).maximumPoreSize;
  const auto                   slices = static_cast<std::uint64_t>(grid.GetVoxelBox().Extent(2));
  const unsigned int           passes = m_Map->GetNumberOfPasses();
  itk::MedialVoxelObjectUnion  united(*m_Map, grid.GetVoxelBox().upper, poreSize);
  itk::MedialVoxelTopologySums sums;
  std::vector<std::uint16_t>   cells;
  for (unsigned int pass = 0; pass < passes; ++pass)
  {
    m_Map->ShowPass(pass);
    itk::MedialVoxelSameTopology topology(
      grid, poreSize, [&](const itk::MedialVoxelBits & added) { this->TakeAdded(united, added); });
    for (std::uint64_t slice = 0; slice < slices; ++slice)
    {
      m_Cells->ReadPass(pass, slice, cells);
      topology.AddSlice(cells.data());
      CheckTopologyMemory(topology, result.plan);
      end.progress((pass + static_cast<double>(slice + 1) / static_cast<double>(slices)) / passes);
    }
    sums += topology.GetSums();
  }
  this->WriteSlices(slices);
  result.topology = DescribeTopology(sums);
  result.objects["shared_cells"] = result.objects["shared_cells"].get<std::uint64_t>() + m_Sums.shared;
  for (Json & object : result.objects["objects"])
  {
    object["added_cells"] = m_Sums.cells[m_Map->GetTable().GetNumber(object["label"].get<std::int64_t>())].added;
  }
  result.seconds.topology = SecondsSince(start);
}

void
ObjectTopologyProduct::TakeAdded(itk::MedialVoxelObjectUnion & united, const itk::MedialVoxelBits & added)
{
  const itk::MedialVoxelBox & box = added.GetBox();
  if (added.Count(box) == 0)
  {
    return;
  }
  const auto                           slice = static_cast<std::uint64_t>(box.lower[2]);
  std::vector<std::uint8_t>            labels;
  std::vector<PassCells::ObjectNumber> objects;
  m_Cells->ReadUnion(slice, labels, objects);
  united.BeginAgain(box, std::move(labels), std::move(objects));
  united.TakeAddedCells(added);
  united.FinishPass();
  m_Cells->WriteUnion(box, united);
  m_Sums += united.GetSums();
}

void
ObjectTopologyProduct::WriteSlices(const std::uint64_t numberOfSlices)
{
  std::vector<std::uint8_t>            labels;
  std::vector<PassCells::ObjectNumber> objects;
  for (std::uint64_t slice = 0; slice < numberOfSlices; ++slice)
  {
    m_Cells->ReadUnion(slice, labels, objects);
    itk::MedialVoxelObjectUnion::RemoveMarks(labels);
    m_LabelVolume->Write(slice * labels.size(), labels.size(), labels.data());
    if (m_ObjectVolume != nullptr)
    {
      WriteObjectValues(
        objects, m_Map->GetTable(), m_Objects->layout.pixelType, labels.size(), slice * labels.size(), *m_ObjectVolume);
    }
  }
}

} // end namespace medialvoxel
