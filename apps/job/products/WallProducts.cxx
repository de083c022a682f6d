// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JobClock.h"
#include "MeshPlacement.h"
#include "Outputs.h"
#include "Products.h"
#include "SheetInMemory.h"
#include "SheetMesh.h"
#include "SheetObserver.h"
#include "SheetSurvey.h"
#include "TaskRunner.h"
#include "ThreadedTasks.h"
#include "VolumeFormats.h"
#include "WallJson.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class WallProduct
 * \brief Walls and seams of the sheet, and the volume of their numbers. */
class WallProduct : public ExtractProduct
{
public:
  WallProduct(const ExtractOptions & options, std::string fileName)
    : ExtractProduct(options, {})
    , m_VolumeName(std::move(fileName))
  {}

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    if (m_Options.meshFile.empty())
    {
      footprint.Add(GetSheetFootprint(m_Options, header.geometry, footprint.grid));
      footprint.needsSlices = true;
    }
    if (!m_VolumeName.empty())
    {
      footprint.beside += GetOutputMemory(m_VolumeName, header.geometry, WallLayout, m_Options) +
                          WallLayout.GetBytes() * header.geometry.GetVoxelsPerSlice();
    }
  }

  double
  GetShareOfEnd() const override
  {
    return 0.2;
  }

  void
  Start(ProductStart & start) override
  {
    const VolumeHeader & header = start.job.input;
    const JobPlan &      plan = start.job.plan;
    m_Sheet = std::make_unique<SheetInMemory>(plan.memory.limit - std::min(plan.memory.limit, plan.memory.fixed));
    m_Header = header;
    m_Mesh = start.mesh;
    m_Shown = start.sheet;
    if (m_Mesh != nullptr)
    {
      m_Mesh->AlsoGiveTo(*m_Sheet);
      return;
    }
    m_Observer = MakeSheetObserver(
      m_Options,
      header.geometry,
      GetGrid(header),
      plan.GetSurplusShare(),
      [](const std::size_t count, const auto & task) { RunInThreads(count, task); },
      *m_Sheet);
    m_Links.observer = m_Observer.get();
  }

  void
  MakeFile(OutputSet & outputs) override
  {
    const auto isOwn = [](const VolumeRequest & request) { return request.filler == VolumeFiller::Product; };
    if (!m_VolumeName.empty())
    {
      const auto volumes = ListVolumes(m_Options, m_Header);
      m_Volume = &outputs.AddVolume(*std::find_if(volumes.begin(), volumes.end(), isOwn));
    }
  }

  void
  FillVolumes(JobResult & result, const ProductEnd & end) override
  {
    const auto start = JobClock::now();
    m_Mesh != nullptr ? m_Mesh->CompleteSheet() : m_Observer->Finish();
    const double share = m_Mesh != nullptr ? 0.3 : 1.0;
    end.progress(0.2 * share);
    result.walls =
      itk::MedialVoxelFindWalls(m_Sheet->sheet, MakeTaskRunner(result.plan.threads, [&end] { end.progress(0.0); }));
    std::vector<itk::MedialVoxelVector3> points;
    points.swap(m_Sheet->sheet.points);
    m_Sheet->sheet = {};
    end.progress(0.8 * share);
    if (m_Volume != nullptr)
    {
      std::uint64_t first = 0;
      m_Sheet->ForEachSlice(result.input.geometry, result.walls->wallOf, [&](const auto & slice) {
        m_Volume->Write(first, slice.size(), slice.data());
        first += slice.size();
      });
    }
    if (m_Shown != nullptr)
    {
      result.wallOfPoint = m_Shown->GetPoints().FindNumbers(m_Sheet->cells, result.walls->wallOf);
    }
    m_Sheet.reset();
    std::vector<std::uint32_t> wallOf;
    wallOf.swap(result.walls->wallOf);
    if (m_Options.meshWalls)
    {
      m_Mesh->SetWalls(std::move(points), std::move(wallOf));
    }
    end.progress(share);
    result.seconds.walls = SecondsSince(start);
  }

private:
  std::string                                      m_VolumeName;
  VolumeHeader                                     m_Header;
  std::unique_ptr<SheetInMemory>                   m_Sheet;
  std::unique_ptr<itk::MedialVoxelSurfaceObserver> m_Observer;
  SheetMesh *                                      m_Mesh{ nullptr };  ///< gives the sheet, where one is made
  const SheetSurvey *                              m_Shown{ nullptr }; ///< on a page, where there is one
  VoxelOutput *                                    m_Volume{ nullptr };
};

/** \class WallTableProduct
 * \brief A table of the walls. */
template <std::string (*VMakeText)(const itk::MedialVoxelSheetWalls &)>
class WallTableProduct : public ExtractProduct
{
  using ExtractProduct::ExtractProduct;

  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    return VMakeText(*result.walls);
  }
};

} // namespace

const ProductRow WallRow{ &ExtractOptions::wallsFile, Make<WallProduct>, NumbersWalls };
const ProductRow WallTableRow{ &ExtractOptions::wallTableFile, Make<WallTableProduct<MakeWallsCsv>> };
const ProductRow SeamTableRow{ &ExtractOptions::seamTableFile, Make<WallTableProduct<MakeSeamsCsv>> };

} // end namespace medialvoxel
