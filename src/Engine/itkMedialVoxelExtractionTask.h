// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelExtractionTask_h
#define itkMedialVoxelExtractionTask_h

#include "itkMedialVoxelCellLevels.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelImportance.h"
#include "itkMedialVoxelTileObserver.h"
#include "itkMedialVoxelTileResult.h"
#include "itkMedialVoxelTileTask.h"

#include <optional>

namespace itk
{

/** \class MedialVoxelExtractionTask
 * \brief Labels the cells of a tile, measures their walls and shows them to observers.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelExtractionTask : public MedialVoxelTileTask
{
public:
  MedialVoxelExtractionTask(const MedialVoxelGrid & grid, const MedialVoxelSheetExtraction & settings);

  std::unique_ptr<Workspace>
  MakeWorkspace() const override;

  void
  Begin() const override;

  void
  Commit() const override;

  MedialVoxelBox
  Process(const MedialVoxelBox &          tile,
          const MedialVoxelMovingWindow & window,
          const MedialVoxelProgress &     progress,
          Workspace &                     workspace,
          MedialVoxelEngineClient &       client,
          MedialVoxelSums &               sums) const override;

  /** The part of Process() before a client takes the result of a tile.
   *
   * \param workspace  of MakeWorkspace(); \a result refers to it
   * \param result     complete when its box is not empty; as it was when the run is aborted */
  MedialVoxelBox
  Extract(const MedialVoxelBox &          box,
          const MedialVoxelMovingWindow & window,
          const MedialVoxelProgress &     progress,
          Workspace &                     workspace,
          MedialVoxelTileResult &         result,
          MedialVoxelSums &               sums) const;

private:
  struct TileWorkspace;

  /** Shared by the steps of a tile. */
  struct Tile
  {
    const MedialVoxelBox &          box;
    const MedialVoxelMovingWindow & moving;
    MedialVoxelWindow               window;
    const MedialVoxelProgress &     progress;
    TileWorkspace &                 workspace;
  };

  /** Whether an observer looks at cells beside a tile. */
  bool
  LooksAround() const;

  // The steps return an empty box when they are done, otherwise the sites that must be known.

  MedialVoxelBox
  FindNearest(const Tile & tile) const;

  MedialVoxelBox
  MeasureWalls(const Tile & tile) const;

  MedialVoxelBox
  FindImportance(const Tile & tile) const;

  MedialVoxelBox
  Show(const Tile & tile) const;

  void
  HandOver(const Tile & tile, MedialVoxelTileResult & result) const;

  bool
  HasObjectVectors() const
  {
    return m_Settings.vectorBoundary == MedialVoxelBoundary::Object;
  }

  MedialVoxelSheetExtraction              m_Settings;
  MedialVoxelFeatureTransform             m_Transform;
  MedialVoxelClassifier                   m_Classifier;
  MedialVoxelThickness                    m_Thickness;
  MedialVoxelCellLevels                   m_Levels;
  std::optional<MedialVoxelGrayThickness> m_GrayThickness; // empty: walls are measured on the object
  std::optional<MedialVoxelImportance>    m_Importance;    // empty: nobody asked for it
};

} // end namespace itk

#endif
