// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallThicknessTask_h
#define itkMedialVoxelWallThicknessTask_h

#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelTileTask.h"
#include "itkMedialVoxelWallBalls.h"
#include "itkMedialVoxelWallPainter.h"

namespace itk
{

/** \class MedialVoxelWallThicknessTask
 * \brief Finds, for each object voxel of a tile, the thickness of the wall whose ball is the largest that covers it. Of
 * equal balls the thickest wall counts.
 * \ingroup MedialVoxel
 */
class MedialVoxelWallThicknessTask : public MedialVoxelTileTask
{
public:
  /** Edge of the tiles that are best: balls around each are painted again. */
  static constexpr std::int64_t TileEdge = 64;

  /** \param balls  all that reach the regions of runs, when they begin */
  MedialVoxelWallThicknessTask(const MedialVoxelGrid &           grid,
                               const MedialVoxelLocalThickness & settings,
                               const MedialVoxelWallBalls &      balls);

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

  float                        m_Maximum; // thickness
  MedialVoxelWallPainter       m_Painter;
  const MedialVoxelWallBalls & m_Balls;
};

} // end namespace itk

#endif
