// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRemeshedSheet_h
#define itkMedialVoxelRemeshedSheet_h

#include "itkMedialVoxelFineSheet.h"
#include "itkMedialVoxelRimExtension.h"
#include "itkMedialVoxelShellElements.h"
#include "itkMedialVoxelWallsLeftOut.h"

#include <functional>
#include <optional>

namespace itk
{

/** How large elements are to be. */
struct MedialVoxelElementSize
{
  double least{ 0 };           ///< of the sides, units of the points, > 0
  bool   atThickness{ false }; ///< at least the thickness everywhere; else so at junctions and bends
  bool   joinsTriangles{ true };
  double noise{ 0 }; ///< how far the fine sheet may be off anywhere, and steps may move it; 0: half its mean side
  double shareOfThickness{ 1 }; ///< that stands for the thickness

  bool                      extendsRims{ false }; ///< to the free edges of the part
  MedialVoxelMeasureRimRays measureRimRays{};     ///< finds these edges; empty: they are half a thickness away
  MedialVoxelRimLimits      rimLimits{};          ///< faces of the volume, where rims end at the latest

  double
  GetNoise(double meanSide) const
  {
    return noise > 0.0 ? noise : meanSide / 2.0;
  }
};

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

/** What sides are to have before rims are extended: they are about as long as what is added to them. */
MedialVoxelElementSize
MedialVoxelSizeBeforeRims(const MedialVoxelElementSize & size);

/** Memory that remeshing takes for each triangle of the fine sheet, which is part of it. */
std::uint64_t
MedialVoxelRemeshingBytesPerTriangle();

/** \param sheet    without triangles of one place; its points are those of its triangles
 * \param progress called often with the share that is done; may throw to stop */
MedialVoxelRemeshedSheet
MedialVoxelRemesh(MedialVoxelSheet                    sheet,
                  const MedialVoxelElementSize &      size,
                  const std::function<void(double)> & progress);

} // end namespace itk

#endif
