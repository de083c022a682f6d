// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelWallJson_h
#define medialvoxelWallJson_h

#include "Json.h"

#include "itkMedialVoxelSheetWalls.h"

#include <cstddef>
#include <string>

namespace medialvoxel
{

/** Numbers of walls and seams, and the first ones of both; those of a report by default. */
Json
MakeWallsJson(const itk::MedialVoxelSheetWalls & walls, std::size_t mostRows = 100);

/** All walls as comma-separated values. */
std::string
MakeWallsCsv(const itk::MedialVoxelSheetWalls & walls);

/** All seams. */
std::string
MakeSeamsCsv(const itk::MedialVoxelSheetWalls & walls);

} // end namespace medialvoxel

#endif
