// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLengthTask_h
#define itkMedialVoxelLengthTask_h

#include "itkMedialVoxelDistanceTransform.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelFeatureTransform.h"
#include "itkMedialVoxelTileTask.h"

#include "MedialVoxelExport.h"

namespace itk
{

/** \class MedialVoxelLengthTask
 * \brief Finds the distances to the nearest boundary voxels in a tile, without their places.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelLengthTask : public MedialVoxelTileTask
{
public:
  /** Whether this task gives all requested results, bit for bit as MedialVoxelDistanceTask would. */
  static bool
  CanDo(const MedialVoxelGrid & grid, const MedialVoxelDistanceMap & settings);

  /** Bytes of a worker, beside the distance transform, for boxes of searched voxels of this size. */
  static std::uint64_t
  GetBytes(const MedialVoxelGrid & grid, const MedialVoxelIndex & searchedSize);

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

  void
  TakeDoubtful(const MedialVoxelBox &          tile,
               const MedialVoxelMovingWindow & window,
               TileWorkspace &                 workspace,
               MedialVoxelEngineClient &       client) const;

  MedialVoxelBoundary          m_Boundary;
  double                       m_Spacing;
  MedialVoxelFeatureTransform  m_Features; // for the few voxels whose rounded lengths depend on the boundary voxel
  MedialVoxelDistanceTransform m_Transform;
};

} // end namespace itk

#endif
