// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelNearestSite_h
#define itkMedialVoxelNearestSite_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelFeatures.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** \struct MedialVoxelOffset
 * \brief Displacement to a possible site and its squared length in metric units.
 * \ingroup MedialVoxel
 */
struct MedialVoxelOffset
{
  std::int32_t dx;
  std::int32_t dy;
  std::int32_t dz;
  double       squaredLength;
};

/** \brief All displacements of a ball in the order of the key (squared length, dz, dy, dx).
 *
 * The first displacement that leads to a site leads to the nearest site. \a radius is in metric units of \a grid and
 * reaches at most MedialVoxelLongestOffset voxels along each axis.
 *
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT std::vector<MedialVoxelOffset>
                   MedialVoxelSortedOffsets(const MedialVoxelGrid & grid, double radius);

/** Longest displacement along x that a table search follows. */
constexpr std::int64_t MedialVoxelLongestOffset = 63;

/** \struct MedialVoxelOffsetTable
 * \brief Part of the sorted displacements, and the longest of them along each axis.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelOffsetTable
{
  MedialVoxelOffsetTable() = default;
  explicit MedialVoxelOffsetTable(std::vector<MedialVoxelOffset> sorted);

  std::vector<MedialVoxelOffset> offsets;
  MedialVoxelIndex               reach{};
};

/** \struct MedialVoxelDisplacementRow
 * \brief Where the displacements of 64 voxels of a row are stored: lane i at firstLane + i of each array.
 *
 * Only lanes of the query are touched, so that firstLane may be negative.
 * \ingroup MedialVoxel
 */
struct MedialVoxelDisplacementRow
{
  std::int32_t * dx;
  std::int32_t * dy;
  std::int32_t * dz;
  std::int64_t   firstLane;
};

/** \struct MedialVoxelTableResult
 * \brief Lanes for which a table search found no site, and the largest squared length that it stored.
 * \ingroup MedialVoxel
 */
struct MedialVoxelTableResult
{
  MedialVoxelBits::WordType remaining;
  double                    largestSquaredLength;
};

/** \brief Nearest sites of up to 64 voxels of a row, by the sorted displacements of a ball.
 *
 * \param table  sorted displacements
 * \param sites  site bits; voxels outside its box are no sites
 * \param x,y,z  voxel of lane 0
 * \param query  lanes to search for
 * \param row    receives the displacements
 *
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT MedialVoxelTableResult
MedialVoxelSearchOffsets(const MedialVoxelOffsetTable &     table,
                         const MedialVoxelBits &            sites,
                         std::int64_t                       x,
                         std::int64_t                       y,
                         std::int64_t                       z,
                         MedialVoxelBits::WordType          query,
                         const MedialVoxelDisplacementRow & row);

/** \brief Displacement along x to the nearest site of the own row, for \a count voxels from \a x on.
 *
 * Sites further than \a reach voxels may be missed. Of two sites at the same distance the one with the smaller x is
 * taken. Voxels without a site get MedialVoxelNoDisplacement. (y, z) is a row of \a sites.
 *
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT void
MedialVoxelNearestInRow(const MedialVoxelBits & sites,
                        std::int64_t            x,
                        std::int64_t            count,
                        std::int64_t            y,
                        std::int64_t            z,
                        std::int64_t            reach,
                        std::int32_t *          displacement);

/** Cost of a line without a site. */
constexpr double MedialVoxelNoCost = std::numeric_limits<double>::infinity();

/** \brief One separable pass: the best of \a numberOfLines candidate lines for each lane of one line.
 *
 * Candidate line j has the costs lines[j * pitch + lane]; seen from line \a center it costs squares[|j - center|] more.
 * The cheapest candidate wins, among equals the one with the smallest j. Costs are searched outwards from the center,
 * as far as \a squares reaches.
 *
 * \param lines,pitch,numberOfLines,lanes  candidate costs
 * \param center         own position among the candidates
 * \param squares        squared distance of 0, 1, 2, ... lines
 * \param cost,position  best cost (MedialVoxelNoCost when there is none) and its candidate, for each lane
 *
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT void
MedialVoxelSearchOutward(const double *              lines,
                         std::int64_t                pitch,
                         std::int64_t                numberOfLines,
                         std::int64_t                lanes,
                         std::int64_t                center,
                         const std::vector<double> & squares,
                         double *                    cost,
                         std::int64_t *              position);

/** \brief Squared metric distance from a voxel to its nearest site; infinite when \a sites holds none.
 *
 * Only sites not further than the metric distance \a limit are looked for.
 *
 * \ingroup MedialVoxel
 */
MedialVoxel_EXPORT double
MedialVoxelSquaredDistanceToSites(const MedialVoxelGrid &  grid,
                                  const MedialVoxelBits &  sites,
                                  const MedialVoxelIndex & voxel,
                                  double                   limit);

} // end namespace itk

#endif
