// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLengthTask_h
#define itkMedialVoxelLengthTask_h

#include "itkMedialVoxelDistanceTransform.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelTileTask.h"

namespace itk
{

/** \class MedialVoxelLengthTask
 * \brief Finds how far the nearest boundary voxels of the voxels of a tile are, but not where.
 * \ingroup MedialVoxel
 */
class MedialVoxelLengthTask : public MedialVoxelTileTask
{
public:
  /** Whether this task does all that is asked for, with the bits that MedialVoxelDistanceTask would give. */
  static bool
  CanDo(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings);

  MedialVoxelLengthTask(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings);

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

  MedialVoxelBoundary          m_Boundary;
  MedialVoxelDistanceTransform m_Transform;
};

} // end namespace itk

#endif
