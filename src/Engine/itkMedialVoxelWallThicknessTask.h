// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallThicknessTask_h
#define itkMedialVoxelWallThicknessTask_h

#include "itkMedialVoxelCellPairs.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelExtractionTask.h"
#include "itkMedialVoxelLocalThreshold.h"
#include "itkMedialVoxelTileTask.h"
#include "itkMedialVoxelWallPainter.h"

namespace itk
{

/** \class MedialVoxelWallThicknessTask
 * \brief Finds, for each object voxel of a tile, the thickness of the wall whose ball is the largest that covers it.
 *
 * The ball of a measured medial cell q lies around its center. Its radius is d(q) of MedialVoxelLocalThreshold, at most
 * half of the maximum thickness, and its thickness that of the wall, at most the maximum. Of equal balls the thickest
 * wall counts. The cells around a tile are extracted with it, so that a result depends on the image alone.
 * \ingroup MedialVoxel
 */
class MedialVoxelWallThicknessTask : public MedialVoxelTileTask
{
public:
  /** \param settings  with walls */
  MedialVoxelWallThicknessTask(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & settings);

  /** Edge of the tiles that are best: the cells around each are extracted again. */
  static constexpr std::int64_t TileEdge = 128;

  /** The extraction that the task runs. */
  static MedialVoxelSheetExtraction
  GetExtraction(const MedialVoxelLocalThickness & settings);

  std::unique_ptr<Workspace>
  MakeWorkspace() const override;

  MedialVoxelBox
  Process(const MedialVoxelBox &          tile,
          const MedialVoxelMovingWindow & window,
          const MedialVoxelProgress &     progress,
          Workspace &                     workspace,
          MedialVoxelEngineClient &       client,
          MedialVoxelSums &               sums) const override;

private:
  struct TileWorkspace;

  MedialVoxelBox
  FindWalls(const MedialVoxelBox &          tile,
            const MedialVoxelMovingWindow & window,
            const MedialVoxelProgress &     progress,
            TileWorkspace &                 workspace,
            MedialVoxelSums &               sums) const;

  void
  ListBalls(const MedialVoxelTileResult & cells, std::vector<MedialVoxelWallPainter::Ball> & balls) const;

  double                    m_MaximumRadius; // in units of the metric
  float                     m_Maximum;       // thickness
  MedialVoxelWallPainter    m_Painter;
  MedialVoxelExtractionTask m_Extraction;
  MedialVoxelCellPairs      m_Pairs;
  MedialVoxelLocalThreshold m_Threshold;
};

} // end namespace itk

#endif
