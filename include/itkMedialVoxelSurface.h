// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurface_h
#define itkMedialVoxelSurface_h

#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelSurfaceConsumer.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace itk
{

/** \class MedialVoxelSurface
 * \brief Builds the medial surface of an image while an engine extracts its medial cells.
 *
 * The runs of the engine follow each other through the image in whole slices along the last axis.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurface
{
public:
  /** \struct Settings
   * \brief The image, its classification, and the limits below which branches and components are removed.
   * \ingroup MedialVoxel
   */
  struct Settings
  {
    MedialVoxelGrid              grid; ///< in the units of the parameters
    MedialVoxelParameters        parameters;
    MedialVoxelGrid::SpacingType spacing{}; ///< in the units of the surface
    MedialVoxelSurfacePlacement  placement;

    /** Shorter branches, and components of fewer quadrilaterals, are removed. Either limit keeps the surface in memory
     * until it is finished. */
    double        minimumBranchLength{ 0.0 };
    std::uint64_t smallestComponent{ 0 };
  };

  MedialVoxelSurface(const Settings & settings, MedialVoxelSurfaceConsumer & consumer);
  ~MedialVoxelSurface();

  MedialVoxelSurface(const MedialVoxelSurface &) = delete;
  MedialVoxelSurface &
  operator=(const MedialVoxelSurface &) = delete;

  /** Who has to see the tiles of the extraction. */
  MedialVoxelTileObserver &
  GetObserver();

  /** Hand on the rest, after the last run. */
  void
  Finish();

private:
  class Implementation;

  std::unique_ptr<Implementation> m_Implementation;
};

} // end namespace itk

#endif
