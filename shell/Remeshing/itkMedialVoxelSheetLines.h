// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetLines_h
#define itkMedialVoxelSheetLines_h

#include "itkMedialVoxelSheet.h"

namespace itk
{

/** The walls of a sheet, and the lines that bound them.
 *
 * A wall is what sides of exactly two triangles join. The other sides are lines: rims belong to one triangle, junctions
 * to more than two. */
struct MedialVoxelSheetLines
{
  using Index = MedialVoxelSheet::Index;

  static constexpr Index Junction = ~Index{ 0 };

  struct Line
  {
    std::array<Index, 2> points;
    Index                wall; ///< of a rim; Junction
  };

  std::vector<Index> wallOf; ///< of each triangle; walls are in the order of their first triangles
  Index              numberOfWalls{ 0 };
  std::vector<Line>  lines;
  double             meanSide{ 0 };
};

/** \param isShared of each point, whether triangles that are not in the sheet have it, too; empty: no. A side between
 * two of these is no line. */
MedialVoxelSheetLines
MedialVoxelFindLines(const MedialVoxelSheet & sheet, const std::vector<bool> & isShared = {});

} // end namespace itk

#endif
