// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRemeshedSheet_h
#define itkMedialVoxelRemeshedSheet_h

#include "itkMedialVoxelElementSize.h"
#include "itkMedialVoxelShellElements.h"
#include "itkMedialVoxelTasks.h"
#include "itkMedialVoxelWallsLeftOut.h"

#include <functional>
#include <optional>

namespace itk
{

/** What became of a sheet. Lengths are in the units of the points. */
struct MedialVoxelRemeshingSummary
{
  /** Distances of samples: the largest, what 99 % do not exceed, and the mean. */
  struct Distances
  {
    double largest{ 0 };
    double most{ 0 };
    double mean{ 0 };
  };

  Distances toFine;   ///< of the elements, the mean by area; MedialVoxelSheetDistances measures them
  Distances fromFine; ///< of the points of the fine sheet

  /** Means as in toFine, of elements of rims, junctions and bends, and of the others, whose share of the area this is.
   */
  double toFineAtLines{ 0 };
  double toFineElsewhere{ 0 };
  double shareElsewhere{ 0 };

  double        fineArea{ 0 };
  double        area{ 0 };
  std::uint64_t walls{ 0 };            ///< of the fine sheet
  std::uint64_t holesClosed{ 0 };      ///< narrower than the wall is thick, or than an element
  std::uint64_t trianglesLeftOut{ 0 }; ///< of strips and fins too narrow for elements
  std::uint64_t orientationConflicts{ 0 };

  std::vector<MedialVoxelWallLeftOut> wallsLeftOut; ///< the largest first

  std::optional<MedialVoxelRimExtensionSummary> rims; ///< unless they stay where they are
};

/** A sheet of elements, in an order that its geometry decides. */
struct MedialVoxelRemeshedSheet
{
  std::vector<MedialVoxelVector3>      points;
  std::vector<double>                  thickness; ///< between the points of the fine sheet; 0: unknown
  std::vector<std::uint32_t>           finePoint; ///< of each point, one of the fine sheet that is near
  std::vector<MedialVoxelShellElement> elements;
  MedialVoxelRemeshingSummary          summary;
};

/** Memory that remeshing takes for each triangle of the fine sheet, which is part of it. */
std::uint64_t
MedialVoxelRemeshingBytesPerTriangle();

/** A coarse sheet of the same points, whose rims are extended if that is asked for, and elements that are made of it.
 * \param sheet    without triangles of one place; its points are those of its triangles
 * \param progress called often with the share that is done; may throw to stop
 * \param runTasks does parts of the work, which are the same for any order */
MedialVoxelRemeshedSheet
MedialVoxelRemesh(MedialVoxelSheet                    sheet,
                  const MedialVoxelElementSize &      size,
                  const std::function<void(double)> & progress,
                  const MedialVoxelRunTasks &         runTasks = MedialVoxelRunInOrder);

} // end namespace itk

#endif
