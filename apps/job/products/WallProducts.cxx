// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"
#include "JobClock.h"
#include "MeshPlacement.h"
#include "Outputs.h"
#include "Products.h"
#include "SheetMesh.h"
#include "SheetObserver.h"
#include "Text.h"
#include "ThreadedTasks.h"
#include "VolumeFormats.h"
#include "WallJson.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{
namespace
{

/** \class SheetInMemory
 * \brief The sheet of a job with the cell of each point. */
class SheetInMemory : public itk::MedialVoxelSurfaceConsumer
{
public:
  /** Of a point, its triangles and what finding the walls takes for a while. */
  static constexpr std::uint64_t BytesPerPoint = 300;

  /** \param memory that it may take */
  explicit SheetInMemory(const std::uint64_t memory)
    : m_Most(std::min<std::uint64_t>(memory / BytesPerPoint, std::numeric_limits<std::uint32_t>::max() / 8))
  {}

  void
  AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices) override
  {
    if (sheet.points.size() + vertices.size() > m_Most)
    {
      Fail(ExitStatus::Refused,
           "the sheet has so many cells that the walls need more than the ",
           FormatBytes(m_Most * BytesPerPoint),
           " of memory that are left for them; allow more with --memory, or leave out --walls and the tables");
    }
    for (const itk::MedialVoxelSurfaceVertex & vertex : vertices)
    {
      sheet.points.push_back(vertex.point);
      sheet.thickness.push_back(static_cast<float>(vertex.thickness));
      cells.push_back(vertex.cell);
    }
  }

  void
  AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads) override
  {
    for (const itk::MedialVoxelSurfaceQuad & quad : quads)
    {
      std::array<std::uint32_t, 4> corners{};
      std::transform(quad.vertices.begin(), quad.vertices.end(), corners.begin(), [](const std::uint64_t vertex) {
        return static_cast<std::uint32_t>(vertex);
      });
      sheet.AddQuad(corners);
    }
  }

  itk::MedialVoxelSheet                    sheet;
  std::vector<std::array<std::int32_t, 3>> cells; ///< by z, y, x

private:
  std::uint64_t m_Most;
};

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
    const auto runTasks = [](const std::size_t count, const itk::MedialVoxelTask & task) {
      RunInThreads(count, [&task](const std::size_t number) { task(number, [] {}); });
    };
    result.walls = itk::MedialVoxelFindWalls(m_Sheet->sheet, runTasks);
    std::vector<itk::MedialVoxelVector3> points;
    points.swap(m_Sheet->sheet.points);
    m_Sheet->sheet = {};
    end.progress(0.8 * share);
    if (m_Volume != nullptr)
    {
      this->WriteVolume(result.input.geometry, result.walls->wallOf);
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
  /** A cell of two walls has the smaller number. */
  void
  WriteVolume(const VolumeGeometry & geometry, const std::vector<std::uint32_t> & walls)
  {
    const std::uint64_t        perSlice = geometry.GetVoxelsPerSlice();
    std::vector<std::uint32_t> slice(perSlice);
    std::size_t                next = 0;
    for (std::uint64_t z = 0; z < geometry.GetNumberOfVoxels() / perSlice; ++z)
    {
      std::fill(slice.begin(), slice.end(), 0u);
      for (; next < walls.size() && static_cast<std::uint64_t>(m_Sheet->cells[next][2]) == z; ++next)
      {
        const auto &    cell = m_Sheet->cells[next];
        std::uint32_t & value =
          slice[static_cast<std::uint64_t>(cell[1]) * geometry.size[0] + static_cast<std::uint64_t>(cell[0])];
        value = value == 0 ? walls[next] : std::min(value, walls[next]);
      }
      m_Volume->Write(z * perSlice, perSlice, slice.data());
    }
  }

  std::string                                      m_VolumeName;
  VolumeHeader                                     m_Header;
  std::unique_ptr<SheetInMemory>                   m_Sheet;
  std::unique_ptr<itk::MedialVoxelSurfaceObserver> m_Observer;
  SheetMesh *                                      m_Mesh{ nullptr }; ///< gives the sheet, where one is made
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
