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
#include "itkMedialVoxelWallThicknessTask.h"

#include <algorithm>
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

MedialVoxelSlabWalker::Settings
GetSettingsOfWalls(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & thickness)
{
  const MedialVoxelWallPainter painter(grid, 0.5 * thickness.maximumThickness);
  auto                         settings = GetSettingsOf(grid, MedialVoxelWallThicknessTask::GetExtraction(thickness));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    settings.tileMargin[axis] += painter.GetMargin()[axis];
    settings.halo[axis] += painter.GetMargin()[axis];
  }
  settings.preferredTileEdge = MedialVoxelWallThicknessTask::TileEdge;
  settings.bytesPerVoxel += MedialVoxelWallPainter::BytesPerVoxel + sizeof(float);
  return settings;
}

MedialVoxelSlabWalker::Settings
GetSettingsOf(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & thickness)
{
  if (thickness.walls)
  {
    return GetSettingsOfWalls(grid, thickness);
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

std::unique_ptr<const MedialVoxelTileTask>
MakeTask(const MedialVoxelGrid & grid, const MedialVoxelSheetExtraction & extraction)
{
  return std::make_unique<const MedialVoxelExtractionTask>(grid, extraction);
}

std::unique_ptr<const MedialVoxelTileTask>
MakeTask(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & distances)
{
  if (MedialVoxelLengthTask::CanDo(grid, distances))
  {
    return std::make_unique<const MedialVoxelLengthTask>(grid, distances);
  }
  return std::make_unique<const MedialVoxelDistanceTask>(grid, distances);
}

std::unique_ptr<const MedialVoxelTileTask>
MakeTask(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & thickness)
{
  if (thickness.walls)
  {
    return std::make_unique<const MedialVoxelWallThicknessTask>(grid, thickness);
  }
  return std::make_unique<const MedialVoxelLocalThicknessTask>(grid, thickness);
}

} // namespace

class MedialVoxelEngine::Implementation
{
public:
  Implementation(const MedialVoxelGrid & grid, const MedialVoxelEngineSettings & settings)
    : m_Grid(grid)
    , m_Settings(settings)
    , m_Walker(grid, GetWalkerSettings(grid, settings))
  {}

  /** Made for the first run, because a plan does not need its tables. */
  const MedialVoxelTileTask &
  GetTask()
  {
    if (!m_Task)
    {
      m_Task = std::visit([this](const auto & task) { return MakeTask(m_Grid, task); }, m_Settings.task);
    }
    return *m_Task;
  }

  MedialVoxelGrid                            m_Grid;
  MedialVoxelEngineSettings                  m_Settings;
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
  return m_Implementation->m_Walker.GetBytes(region);
}

std::int64_t
MedialVoxelEngine::GetSlabThickness(const MedialVoxelBox & region) const
{
  return m_Implementation->m_Walker.GetSlabThickness(region);
}

std::vector<MedialVoxelBox>
MedialVoxelEngine::GetMissingObjectBoxes(const MedialVoxelBox & region) const
{
  return m_Implementation->m_Walker.GetMissingObjectBoxes(region);
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
  MedialVoxelExecution execution(
    region, m_Implementation->GetTask(), m_Implementation->m_Walker, source, client, m_Implementation->m_Workspaces);
  return execution.Run(nextRegion);
}

} // end namespace itk
