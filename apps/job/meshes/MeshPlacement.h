// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshPlacement_h
#define medialvoxelMeshPlacement_h

#include "Options.h"
#include "MeshSink.h"

#include "itkMedialVoxelSurfaceConsumer.h"

#include <filesystem>
#include <string>

namespace medialvoxel
{

itk::MedialVoxelIndex
GetSize(const VolumeGeometry & geometry);

/** Where the voxels of a volume are. */
itk::MedialVoxelSurfacePlacement
GetPlacement(const VolumeGeometry & geometry);

/** Precision of the coordinates of a mesh, known before the mesh. */
MeshPrecision
GetPrecision(const VolumeGeometry & geometry);

/** Folder of the scratch files of a surface: that of the options, without one that of the file it is written to. */
std::filesystem::path
GetScratchFolder(const JobOptions & options, const std::string & surfaceFile);

/** \throw JobError Usage when the volume has 2 dimensions
 * \param kind what needs 3 */
void
CheckDimension(const VolumeHeader & header, const char * kind);

/** \throw JobError Usage for a volume that is not 3-D, which has no surface, or for a format without the precision that
 * its coordinates need. \param kind "medial surface" */
void
CheckMeshInput(const VolumeHeader & header, const std::string & surfaceFile, const char * kind);

} // end namespace medialvoxel

#endif
