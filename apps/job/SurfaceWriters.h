// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurfaceWriters_h
#define medialvoxelSurfaceWriters_h

#include "BufferedOutput.h"
#include "SurfaceFormat.h"
#include "SurfaceReader.h"

namespace medialvoxel
{

/** Each writes the whole content of a file of its format; WriteSurface() has checked that the surface fits. */
using SurfaceWriter = void(SurfaceReader & reader, const SurfaceWriteOptions & options, BufferedOutput & output);

SurfaceWriter WriteSurfaceVtp;
SurfaceWriter WriteSurfaceVtu;
SurfaceWriter WriteSurfaceVtk;
SurfaceWriter WriteSurfacePly;
SurfaceWriter WriteSurfaceStl;
SurfaceWriter WriteSurfaceObj;
SurfaceWriter WriteSurfaceAbaqus;
SurfaceWriter WriteSurfaceNastran;

} // end namespace medialvoxel

#endif
