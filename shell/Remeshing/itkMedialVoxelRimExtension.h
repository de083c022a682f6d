// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRimExtension_h
#define itkMedialVoxelRimExtension_h

#include "itkMedialVoxelSheet.h"
#include "itkMedialVoxelTasks.h"

#include <functional>

namespace itk
{

/** Parallel rays from places of the sheet near a rim to the surface of the part. */
struct MedialVoxelRimRays
{
  std::vector<MedialVoxelVector3> starts;
  MedialVoxelVector3              direction{}; ///< of length 1
  double                          most{ 0 };   ///< that a ray may be long, units of the points
};

/** The length of each ray to where it first leaves the part; not finite: it starts outside, or is longer. Several
 * threads may call it. */
using MedialVoxelMeasureRimRays = std::function<std::vector<double>(const MedialVoxelRimRays & rays)>;

/** A plane that rims are not carried on beyond: what is inside has products with the normal up to the limit. */
struct MedialVoxelRimLimit
{
  MedialVoxelVector3 normal{}; ///< of any length
  double             limit{ 0 };
};
using MedialVoxelRimLimits = std::vector<MedialVoxelRimLimit>;

/** The point itself, or the nearest one on the planes that it is beyond, which are across to each other. */
MedialVoxelVector3
MedialVoxelMoveWithin(const MedialVoxelVector3 & point, const MedialVoxelRimLimits & limits);

/** What became of rims. Lengths are in the units of the points. */
struct MedialVoxelRimExtensionSummary
{
  double        rimLength{ 0 };      ///< of all rims, before
  double        length{ 0 };         ///< that rims were carried on, mean over their points
  double        longest{ 0 };        ///< the same, at most
  double        area{ 0 };           ///< that was added
  std::uint64_t points{ 0 };         ///< of rims
  std::uint64_t cutBack{ 0 };        ///< of them, where another wall or rim is too near
  std::uint64_t sides{ 0 };          ///< of rims
  std::uint64_t withoutSurface{ 0 }; ///< sides of rims that no ray found the surface from; half the thickness was taken
};

/** Carries a sheet on from its rims, in the plane of its walls and across to the rims, with a strip of triangles each.
 *
 * The medial surface of a wall ends half its thickness before a free edge, because it forks to the corners there. What
 * is added is as long as the rays to the surface are, or half the thickness where none is found. Thickness is that of
 * the wall some way inside; points of rims get it too. Where two rims meet at an angle, the strips meet in a corner.
 * Strips that meet at a junction share its line. A strip stops halfway to other walls and rims.
 * \param sheet   without triangles of one place, of triangles about as long as the walls are thick, or half as long
 * \param measure may be empty: no surface is known
 * \param limits  of the volume, beyond which nothing is known
 * \param origins of each point of the result, the number of the one it was carried on from, or its own
 * \param runTasks does rims, which are the same for any order */
MedialVoxelRimExtensionSummary
MedialVoxelExtendRims(MedialVoxelSheet &                sheet,
                      const MedialVoxelMeasureRimRays & measure,
                      const MedialVoxelRimLimits &      limits,
                      std::vector<std::uint32_t> &      origins,
                      const MedialVoxelRunTasks &       runTasks);

} // end namespace itk

#endif
