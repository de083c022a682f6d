// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelDistanceTask_h
#define itkMedialVoxelDistanceTask_h

#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelTileTask.h"

namespace itk
{

/** \class MedialVoxelDistanceTask
 * \brief Finds the nearest boundary voxels of the voxels of a tile.
 * \ingroup MedialVoxel
 */
class MedialVoxelDistanceTask : public MedialVoxelTileTask
{
public:
  MedialVoxelDistanceTask(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings);

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

  MedialVoxelBoundary         m_Boundary;
  MedialVoxelFeatureTransform m_Transform;
};

} // end namespace itk

#endif
