// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEngine.h"

#include "itkMedialVoxelBallPainter.h"
#include "itkMedialVoxelDistanceTask.h"
#include "itkMedialVoxelExecution.h"
#include "itkMedialVoxelExtractionTask.h"
#include "itkMedialVoxelGrayThickness.h"
#include "itkMedialVoxelLengthTask.h"
#include "itkMedialVoxelLocalThicknessTask.h"
#include "itkMedialVoxelWallPass.h"
#include "itkMedialVoxelWallThicknessTask.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

namespace itk
{

namespace
{

MedialVoxelSlabWalker::Settings
GetSettingsOf(const MedialVoxelGrid & grid, const MedialVoxelSheetExtraction & extraction)
{
  auto settings = MedialVoxelSlabWalker::Settings::ForClassification(
    grid, extraction.parameters, extraction.vectorBoundary == MedialVoxelBoundary::Object);
  settings.bytesPerVoxel += extraction.findsLevels ? MedialVoxelCellLevels::BytesPerVoxel : 0;
  if (extraction.findsImportance)
  {
    settings.bytesPerVoxel += MedialVoxelImportance::BytesPerVoxel + sizeof(float);
    settings.bytesPerVoxel += extraction.findsImportanceThreshold ? MedialVoxelImportance::ThresholdBytesPerVoxel : 0;
  }
  if (extraction.KeepsRows())
  {
    settings.bytesPerVoxel += MedialVoxelTileWallsBytesPerVoxel + extraction.observerBytesPerVoxel;
    settings.keepsGray = extraction.grayRange.has_value();
    settings.bytesPerWorker +=
      settings.keepsGray && extraction.grayRange->scan ? MedialVoxelGrayNormals::GetBytes() : 0;
  }
  if (settings.keepsGray)
  {
    // Walls of the last cells of a tile ask for values around them.
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      settings.halo[axis] = std::max(settings.halo[axis], MedialVoxelGrayThickness::Reach);
    }
  }
  return settings;
}

MedialVoxelSlabWalker::Settings
GetSettingsOf(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & distances)
{
  return MedialVoxelLengthTask::CanDo(grid, distances)
           ? MedialVoxelSlabWalker::Settings::ForLengths(distances.boundary)
           : MedialVoxelSlabWalker::Settings::ForDistances(distances.boundary);
}

/** Only balls are painted, which a MedialVoxelWallPass finds. */
MedialVoxelSlabWalker::Settings
GetSettingsOfPainting(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & thickness)
{
  MedialVoxelSlabWalker::Settings settings;
  settings.maximumPoreSize = thickness.walls->parameters.maximumPoreSize;
  settings.halo = { { 0, 0, 0 } };
  settings.tileMargin = MedialVoxelWallPainter(grid, 0.5 * thickness.maximumThickness).GetMargin();
  settings.preferredTileEdge = MedialVoxelWallThicknessTask::TileEdge;
  settings.bytesPerVoxel = MedialVoxelWallPainter::BytesPerVoxel + sizeof(float);
  return settings;
}

MedialVoxelSlabWalker::Settings
GetSettingsOf(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & thickness)
{
  if (thickness.walls)
  {
    return GetSettingsOfPainting(grid, thickness);
  }
  const MedialVoxelBallPainter painter(grid, 0.5 * thickness.maximumThickness);
  auto settings = MedialVoxelSlabWalker::Settings::ForDistances(MedialVoxelBoundary::Background);
  settings.tileMargin = painter.GetMargin();
  settings.preferredTileEdge = MedialVoxelLocalThicknessTask::TileEdge;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    settings.halo[axis] = 2 * settings.tileMargin[axis] + 1;
  }
  settings.maximumPoreSize = thickness.maximumPoreSize;
  settings.bytesPerVoxel += MedialVoxelBallPainter::BytesPerVoxel + sizeof(float);
  return settings;
}

/** The settings of the task and of all tasks. */
MedialVoxelSlabWalker::Settings
GetWalkerSettings(const MedialVoxelGrid & grid, const MedialVoxelEngineSettings & engine)
{
  auto settings = std::visit([&grid](const auto & task) { return GetSettingsOf(grid, task); }, engine.task);
  settings.keepsNotANumber = engine.countsNotANumber;
  settings.tileSize = engine.tileSize;
  settings.slabThickness = engine.slabThickness;
  settings.memoryLimit = engine.memoryLimit;
  settings.numberOfWorkers = engine.numberOfWorkers;
  settings.readsAhead = engine.readsAhead;
  return settings;
}

/** \param walls  of a local thickness with walls */
std::unique_ptr<const MedialVoxelTileTask>
MakeTask(const MedialVoxelGrid &                    grid,
         const MedialVoxelEngineTask &              task,
         const std::optional<MedialVoxelWallPass> & walls)
{
  if (const auto * const extraction = std::get_if<MedialVoxelSheetExtraction>(&task))
  {
    return std::make_unique<const MedialVoxelExtractionTask>(grid, *extraction);
  }
  if (const auto * const distances = std::get_if<MedialVoxelDistanceMap>(&task))
  {
    if (MedialVoxelLengthTask::CanDo(grid, *distances))
    {
      return std::make_unique<const MedialVoxelLengthTask>(grid, *distances);
    }
    return std::make_unique<const MedialVoxelDistanceTask>(grid, *distances);
  }
  const auto & thickness = std::get<MedialVoxelLocalThickness>(task);
  if (walls)
  {
    return std::make_unique<const MedialVoxelWallThicknessTask>(grid, thickness, walls->GetBalls());
  }
  return std::make_unique<const MedialVoxelLocalThicknessTask>(grid, thickness);
}

bool
HasWallPass(const MedialVoxelEngineTask & task)
{
  const auto * const thickness = std::get_if<MedialVoxelLocalThickness>(&task);
  return thickness != nullptr && thickness->walls;
}

/** The part of the memory limit that is for the walls, not for painting them; 0 is without limit. */
std::uint64_t
GetLimitOfWalls(const MedialVoxelGrid & grid, MedialVoxelEngineSettings settings)
{
  const std::uint64_t limit = std::exchange(settings.memoryLimit, 0);
  if (limit == 0 || !HasWallPass(settings.task))
  {
    return 0;
  }
  const MedialVoxelBox image = grid.GetVoxelBox();
  const auto           ofWalls = static_cast<double>(MedialVoxelWallPass(grid, settings).GetBytes(image));
  const auto           ofPainting =
    static_cast<double>(MedialVoxelSlabWalker(grid, GetWalkerSettings(grid, settings)).GetBytes(image));
  return static_cast<std::uint64_t>(static_cast<double>(limit) * (ofWalls / (ofWalls + ofPainting)));
}

std::optional<MedialVoxelWallPass>
MakeWallPass(const MedialVoxelGrid & grid, MedialVoxelEngineSettings settings)
{
  if (!HasWallPass(settings.task))
  {
    return std::nullopt;
  }
  settings.memoryLimit = GetLimitOfWalls(grid, settings);
  return std::optional<MedialVoxelWallPass>(std::in_place, grid, settings);
}

MedialVoxelSlabWalker
MakeWalker(const MedialVoxelGrid & grid, MedialVoxelEngineSettings settings)
{
  settings.memoryLimit -= GetLimitOfWalls(grid, settings);
  return { grid, GetWalkerSettings(grid, settings) };
}

} // namespace

class MedialVoxelEngine::Implementation
{
public:
  Implementation(const MedialVoxelGrid & grid, const MedialVoxelEngineSettings & settings)
    : m_Grid(grid)
    , m_Settings(settings)
    , m_Walls(MakeWallPass(grid, settings))
    , m_Walker(MakeWalker(grid, settings))
  {}

  /** Made for the first run, because a plan does not need its tables. */
  const MedialVoxelTileTask &
  GetTask()
  {
    if (!m_Task)
    {
      m_Task = MakeTask(m_Grid, m_Settings.task, m_Walls);
    }
    return *m_Task;
  }

  /** Find the walls first, if the task has them. */
  MedialVoxelSums
  Run(const MedialVoxelBox &    region,
      MedialVoxelObjectSource & source,
      MedialVoxelEngineClient & client,
      const MedialVoxelBox &    nextRegion)
  {
    MedialVoxelSums sums;
    double          done = 0.0;
    if (m_Walls)
    {
      done = m_Walls->GetShare(region);
      sums = m_Walls->Run(region, source, client);
    }
    MedialVoxelStepClient last(client, done, 1.0);
    MedialVoxelExecution  execution(region, this->GetTask(), m_Walker, source, last, m_Workspaces);
    sums += execution.Run(nextRegion);
    return sums;
  }

  MedialVoxelGrid                            m_Grid;
  MedialVoxelEngineSettings                  m_Settings;
  std::optional<MedialVoxelWallPass>         m_Walls;
  MedialVoxelSlabWalker                      m_Walker;
  std::unique_ptr<const MedialVoxelTileTask> m_Task;
  MedialVoxelWorkspacePool                   m_Workspaces;
};

MedialVoxelEngine::MedialVoxelEngine(const MedialVoxelGrid & grid, const MedialVoxelEngineSettings & settings)
  : m_Implementation(std::make_unique<Implementation>(grid, settings))
{}

MedialVoxelEngine::~MedialVoxelEngine() = default;

std::uint64_t
MedialVoxelEngine::GetBytes(const MedialVoxelBox & region) const
{
  const auto & walls = m_Implementation->m_Walls;
  return m_Implementation->m_Walker.GetBytes(region) + (walls ? walls->GetBytes(region) : 0);
}

std::int64_t
MedialVoxelEngine::GetSlabThickness(const MedialVoxelBox & region) const
{
  const auto & walls = m_Implementation->m_Walls;
  return walls ? walls->GetSlabThickness(region) : m_Implementation->m_Walker.GetSlabThickness(region);
}

std::vector<MedialVoxelBox>
MedialVoxelEngine::GetMissingObjectBoxes(const MedialVoxelBox & region) const
{
  const auto & walls = m_Implementation->m_Walls;
  const auto   missing = walls ? walls->GetMissingObjectBoxes(region) : std::vector<MedialVoxelBox>{};
  return missing.empty() ? m_Implementation->m_Walker.GetMissingObjectBoxes(region) : missing;
}

bool
MedialVoxelEngine::IsLast(const MedialVoxelBox & region) const
{
  const MedialVoxelBox image = m_Implementation->m_Grid.GetVoxelBox();
  const unsigned int   axis = MedialVoxelSlowestAxis(image);
  return region.upper[axis] == image.upper[axis];
}

MedialVoxelSums
MedialVoxelEngine::Run(const MedialVoxelBox &    region,
                       MedialVoxelObjectSource & source,
                       MedialVoxelEngineClient & client,
                       const MedialVoxelBox &    nextRegion)
{
  try
  {
    return m_Implementation->Run(region, source, client, nextRegion);
  }
  catch (const MedialVoxelMemoryShortage & error)
  {
    // Of the whole limit, also when a step has a part of it.
    const std::uint64_t limit = m_Implementation->m_Settings.memoryLimit;
    throw MedialVoxelMemoryShortage(error.GetNeededBytes() + (limit - error.GetAllowedBytes()), limit);
  }
}

} // end namespace itk
