// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelExtractionTask.h"

#include <algorithm>
#include <chrono>

namespace itk
{

namespace
{

using ClockType = std::chrono::steady_clock;

double
SecondsBetween(const ClockType::time_point & begin, const ClockType::time_point & end)
{
  return std::chrono::duration<double>(end - begin).count();
}

} // namespace

struct MedialVoxelExtractionTask::TileWorkspace : public Workspace
{
  MedialVoxelFeatureTransform::Workspace transform;
  MedialVoxelFeatures                    features;
  MedialVoxelFeatures                    objectFeatures;
  MedialVoxelClassifier::Workspace       classifier;
  std::vector<std::uint8_t>              labels;
  std::vector<std::uint16_t>             levels;
  MedialVoxelThickness::Memory           thickness;
  std::vector<MedialVoxelWall>           walls;
  MedialVoxelGrayThickness::Workspace    fits;
  MedialVoxelImportance::Workspace       paths;
  std::vector<float>                     importance;
  std::vector<float>                     thresholds;

  /** Of each observer. */
  std::vector<std::unique_ptr<MedialVoxelTileObserver::Workspace>> observers;
};

MedialVoxelExtractionTask::MedialVoxelExtractionTask(const MedialVoxelGrid &            grid,
                                                     const MedialVoxelSheetExtraction & settings)
  : m_Settings(settings)
  , m_Transform(grid)
  , m_Classifier(grid, settings.parameters)
  , m_Thickness(grid)
  , m_Levels(grid)
{
  if (settings.findsImportance)
  {
    m_Importance.emplace(grid, settings.parameters);
  }
  if (settings.grayRange)
  {
    m_GrayThickness.emplace(grid, settings.grayRange->lower, settings.grayRange->upper, settings.grayRange->scan);
    for (auto * const observer : settings.observers)
    {
      observer->MeasureOnGrayValues(*settings.grayRange);
    }
  }
}

auto
MedialVoxelExtractionTask::MakeWorkspace() const -> std::unique_ptr<Workspace>
{
  auto workspace = std::make_unique<TileWorkspace>();
  workspace->classifier.keepsRows = m_Settings.KeepsRows();
  for (const auto * const observer : m_Settings.observers)
  {
    workspace->observers.push_back(observer->MakeWorkspace());
  }
  return workspace;
}

void
MedialVoxelExtractionTask::Begin() const
{
  for (auto * const observer : m_Settings.observers)
  {
    observer->Begin();
  }
}

void
MedialVoxelExtractionTask::Commit() const
{
  for (auto * const observer : m_Settings.observers)
  {
    observer->Commit();
  }
}

MedialVoxelBox
MedialVoxelExtractionTask::Process(const MedialVoxelBox &          box,
                                   const MedialVoxelMovingWindow & moving,
                                   const MedialVoxelProgress &     progress,
                                   Workspace &                     genericWorkspace,
                                   MedialVoxelEngineClient &       client,
                                   MedialVoxelSums &               sums) const
{
  MedialVoxelTileResult result;
  const MedialVoxelBox  missing = this->Extract(box, moving, progress, genericWorkspace, result, sums);
  if (!result.box.IsEmpty())
  {
    client.TakeTile(result);
  }
  return missing;
}

MedialVoxelBox
MedialVoxelExtractionTask::Extract(const MedialVoxelBox &          box,
                                   const MedialVoxelMovingWindow & moving,
                                   const MedialVoxelProgress &     progress,
                                   Workspace &                     genericWorkspace,
                                   MedialVoxelTileResult &         result,
                                   MedialVoxelSums &               sums) const
{
  auto & workspace = static_cast<TileWorkspace &>(genericWorkspace);
  Tile   tile{ box, moving, moving.GetWindow(MedialVoxelBoundary::Background), progress, workspace };
  // Objects of neighboring tiles may have their boundary in a tile without object. Most tiles of a thin part have no
  // object.
  sums.counts.boundaryVoxels = tile.window.sites->Count(box);
  if (!tile.window.object->Any(m_Classifier.GetCornerBox(box)))
  {
    result.box = box;
    result.isEmpty = true;
    return {};
  }
  const auto           start = ClockType::now();
  const MedialVoxelBox voxels = m_Classifier.GetVoxelBox(box);
  if (!tile.window.object->GetBox().Contains(voxels))
  {
    return tile.window.sites->GetBox().Union(voxels);
  }
  tile.window = m_Classifier.FindAsked(tile.window, box, this->LooksAround(), workspace.classifier);
  MedialVoxelBox missing = this->FindNearest(tile);
  const auto     middle = ClockType::now();
  sums.distanceSeconds = SecondsBetween(start, middle);
  if (!missing.IsEmpty())
  {
    return missing;
  }
  missing = m_Classifier.Classify(
    tile.window, box, workspace.features, progress, workspace.classifier, workspace.labels, sums.counts);
  sums.classificationSeconds = SecondsBetween(middle, ClockType::now());
  if (!missing.IsEmpty() || progress.IsAborted())
  {
    return missing;
  }
  missing = this->FindImportance(tile);
  if (missing.IsEmpty())
  {
    missing = this->MeasureWalls(tile);
  }
  if (missing.IsEmpty())
  {
    missing = this->Show(tile);
  }
  if (missing.IsEmpty())
  {
    this->HandOver(tile, result);
    sums.counts.objectVoxels = tile.window.object->Count(box);
  }
  return missing;
}

bool
MedialVoxelExtractionTask::LooksAround() const
{
  return std::any_of(m_Settings.observers.begin(), m_Settings.observers.end(), [](const auto * const observer) {
    return observer->LooksAround();
  });
}

MedialVoxelBox
MedialVoxelExtractionTask::FindNearest(const Tile & tile) const
{
  TileWorkspace & workspace = tile.workspace;
  MedialVoxelBox  missing = m_Transform.Compute(tile.window,
                                               m_Classifier.GetFeatureBox(tile.window, tile.box, workspace.classifier),
                                               workspace.transform,
                                               workspace.features,
                                               &tile.progress);
  if (missing.IsEmpty() && this->HasObjectVectors())
  {
    missing = m_Transform.Compute(tile.moving.GetWindow(MedialVoxelBoundary::Object),
                                  tile.box,
                                  workspace.transform,
                                  workspace.objectFeatures,
                                  &tile.progress);
  }
  return missing;
}

MedialVoxelBox
MedialVoxelExtractionTask::FindImportance(const Tile & tile) const
{
  TileWorkspace & workspace = tile.workspace;
  return m_Importance
           ? m_Importance->Compute(
               tile.window, tile.box, workspace.features, tile.progress, workspace.paths, workspace.importance)
           : MedialVoxelBox{};
}

/** At all medial cells when their thickness is wanted, otherwise at cells that an observer selects. */
MedialVoxelBox
MedialVoxelExtractionTask::MeasureWalls(const Tile & tile) const
{
  TileWorkspace & workspace = tile.workspace;
  auto &          rows = workspace.classifier.rows;
  if (!m_Settings.KeepsRows())
  {
    return {};
  }
  for (MedialVoxelCellRow & row : rows)
  {
    const MedialVoxelBits::WordType medial = row.byBound | row.byGeodesic;
    row.measured = m_Settings.measuresThickness ? medial : 0;
    for (auto observer = m_Settings.observers.begin(); observer != m_Settings.observers.end() && row.measured != medial;
         ++observer)
    {
      row.measured |= medial & (*observer)->SelectCells(row);
    }
  }
  MedialVoxelMeasureWalls(
    m_Thickness, m_Classifier, tile.window, workspace.features, rows, workspace.thickness, workspace.walls);
  return m_GrayThickness ? MedialVoxelRefineWalls(*m_GrayThickness,
                                                  m_Classifier,
                                                  tile.moving.GetGray(),
                                                  workspace.features,
                                                  rows,
                                                  workspace.fits,
                                                  workspace.walls)
                         : MedialVoxelBox{};
}

/** Observers run only after the examination of all is complete. */
MedialVoxelBox
MedialVoxelExtractionTask::Show(const Tile & tile) const
{
  TileWorkspace &                 workspace = tile.workspace;
  const MedialVoxelClassifiedTile classified{ tile.box,
                                              tile.window,
                                              workspace.features,
                                              m_Classifier,
                                              workspace.classifier.rows,
                                              workspace.walls,
                                              workspace.classifier,
                                              tile.progress,
                                              tile.moving.GetGray(),
                                              workspace.fits,
                                              m_Importance ? &workspace.importance : nullptr };
  const auto &                    observers = m_Settings.observers;
  MedialVoxelBox                  missing;
  for (std::size_t i = 0; i < observers.size(); ++i)
  {
    missing = missing.Union(observers[i]->Examine(classified, workspace.observers[i].get()));
  }
  if (!missing.IsEmpty())
  {
    return missing;
  }
  for (std::size_t i = 0; i < observers.size(); ++i)
  {
    observers[i]->Observe(classified, workspace.observers[i].get());
  }
  return {};
}

void
MedialVoxelExtractionTask::HandOver(const Tile & tile, MedialVoxelTileResult & result) const
{
  TileWorkspace & workspace = tile.workspace;
  result.box = tile.box;
  result.labels = workspace.labels.data();
  result.object = tile.window.object;
  if (m_Settings.findsLevels)
  {
    m_Levels.Compute(tile.box, *tile.window.object, workspace.features, workspace.levels);
    result.levels = &workspace.levels;
  }
  if (m_Settings.vectorBoundary)
  {
    result.displacements = this->HasObjectVectors() ? &workspace.objectFeatures : &workspace.features;
  }
  if (m_Importance)
  {
    result.importance = &workspace.importance;
  }
  if (m_Settings.findsImportanceThreshold)
  {
    m_Importance->FindThresholds(workspace.classifier.joint.GetSurvey().balls,
                                 workspace.features,
                                 tile.box,
                                 workspace.labels,
                                 workspace.importance,
                                 workspace.paths,
                                 workspace.thresholds);
    result.importanceThresholds = &workspace.thresholds;
  }
  if (m_Settings.measuresThickness)
  {
    result.rows = &workspace.classifier.rows;
    result.walls = &workspace.walls;
  }
}

} // end namespace itk
