// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetWalls_h
#define itkMedialVoxelSheetWalls_h

#include "itkMedialVoxelSheet.h"
#include "itkMedialVoxelTasks.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** A wall of a part. Lengths are in the units of the points, thickness is that of cells where it is known. */
struct MedialVoxelWallRow
{
  std::uint64_t              cells{ 0 };
  double                     area{ 0 };
  std::uint64_t              measured{ 0 }; ///< cells whose thickness is known; the next four are of these
  double                     meanThickness{ 0 };
  double                     leastThickness{ std::numeric_limits<double>::infinity() };
  double                     mostThickness{ 0 };
  double                     spreadOfThickness{ 0 }; ///< standard deviation
  MedialVoxelVector3         centroid{};             ///< by area
  MedialVoxelVector3         normal{};               ///< of the plane through it; its first component not 0 is positive
  double                     flatness{ 0 };          ///< root mean square distance from that plane
  double                     rimLength{ 0 };
  std::vector<std::uint32_t> neighbors; ///< numbers of the walls it has a seam with
};

/** Where walls meet. */
struct MedialVoxelSeamRow
{
  std::vector<std::uint32_t> walls; ///< their numbers
  double                     length{ 0 };
  std::vector<double>        angles; ///< degrees between each two, 1-2, 1-3, ..., 2-3, ...; straight: 180; NaN: apart
};

/** The walls of a sheet and the seams where they meet. */
struct MedialVoxelSheetWalls
{
  std::vector<std::uint32_t>      wallOf; ///< of each point, from 1; 0: no triangle has it
  std::vector<MedialVoxelWallRow> walls;  ///< the largest first, of equal ones that with the first point
  std::vector<MedialVoxelSeamRow> seams;  ///< by walls
};

/** Cuts a sheet where it bends sharply or where more than two walls meet.
 *
 * The rule: a point is of a seam where the sheet within a thickness of the wall leaves its plane by more than 0.12 of
 * that length; what is left is in pieces, each of which is a wall with the points of seams that are nearest to it,
 * unless it is smaller than a square of a thickness; two walls that meet without a third and turn by less than 45
 * degrees are one.
 *
 * So spurs that reach less than about a thickness make no wall and cut none. The memory is about 170 bytes for each
 * point of the sheet. */
MedialVoxelSheetWalls
MedialVoxelFindWalls(const MedialVoxelSheet & sheet, const MedialVoxelRunTasks & runTasks = MedialVoxelRunInOrder);

} // end namespace itk

#endif
