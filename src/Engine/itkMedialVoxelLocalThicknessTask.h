// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLocalThicknessTask_h
#define itkMedialVoxelLocalThicknessTask_h

#include "itkMedialVoxelBallPainter.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelTileTask.h"

namespace itk
{

/** \class MedialVoxelLocalThicknessTask
 * \brief Finds the largest ball that covers each object voxel of a tile.
 * \ingroup MedialVoxel
 */
class MedialVoxelLocalThicknessTask : public MedialVoxelTileTask
{
public:
  /** Edge of the tiles that are best: distances and balls around each are found again. */
  static constexpr std::int64_t TileEdge = 128;

  MedialVoxelLocalThicknessTask(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & settings);

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

  float                       m_Maximum;
  MedialVoxelBallPainter      m_Painter;
  MedialVoxelFeatureTransform m_Transform;
};

} // end namespace itk

#endif
