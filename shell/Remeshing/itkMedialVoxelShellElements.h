// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelShellElements_h
#define itkMedialVoxelShellElements_h

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelFineSheet.h"
#include "itkMedialVoxelTasks.h"
#include "itkMedialVoxelTriangleComplex.h"

namespace itk
{

/** A triangle or a quadrilateral of a shell model. */
struct MedialVoxelShellElement
{
  using Index = std::uint32_t;

  std::array<Index, 4> corners{}; ///< round it; a triangle ignores the last one
  std::uint8_t         numberOfCorners{ 3 };
  std::uint8_t         rimSides{ 0 };      ///< bit k: the side from corner k to the next is of no other element
  std::uint8_t         junctionSides{ 0 }; ///< bit k: of more than two
  Index                wall{ 0 };          ///< of the fine sheet
};

/** Turns the triangles of each wall the same way round, from its first triangle on; walls are those that sides of two
 * triangles join.
 * \param complex stays as it is
 * \param corners of each triangle with its number; removed ones are empty
 * \return the number of sides whose triangles could not agree, as on a wall with one side only */
std::uint64_t
MedialVoxelOrientWalls(const MedialVoxelTriangleComplex &                  complex,
                       std::vector<MedialVoxelTriangleComplex::Triangle> & corners);

/** The mean place of its corners. */
MedialVoxelVector3
MedialVoxelElementMiddle(const MedialVoxelTriangleComplex & complex, const MedialVoxelShellElement & element);

/** The largest size at its corners. */
double
MedialVoxelLargestSize(const MedialVoxelTriangleComplex & complex, const MedialVoxelShellElement & element);

/** Of an element, by the places of its corners. */
double
MedialVoxelShellQuality(const MedialVoxelTriangleComplex & complex, const MedialVoxelShellElement & element);

/** Rotates corners, so that the lowest one comes first, and the marks of the sides with them. */
void
MedialVoxelStartWithLowest(MedialVoxelShellElement & element);

/** Joins triangles that share a side to quadrilaterals of a quality of 0.4 at least: as many as possible, the best
 * first. Vertices inside walls move to where elements are better, and let more of them be joined.
 * \param fine    the sheet that vertices stay on
 * \param corners as MedialVoxelOrientWalls() has left them
 * \param joins   false: all stay as they are
 * \param runTasks does parts of the work, which are the same for any order */
std::vector<MedialVoxelShellElement>
MedialVoxelMakeElements(MedialVoxelTriangleComplex &                              complex,
                        const MedialVoxelFineSheet &                              fine,
                        const std::vector<MedialVoxelTriangleComplex::Triangle> & corners,
                        bool                                                      joins,
                        const MedialVoxelRunTasks &                               runTasks);

} // end namespace itk

#endif
