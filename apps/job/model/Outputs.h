// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputs_h
#define medialvoxelOutputs_h

#include "Options.h"
#include "OutputRequest.h"
#include "VoxelLayout.h"

#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** How a volume is made. */
struct VolumeKind
{
  TileWriter   write;
  VolumeFiller filler;
  bool         isOfCells; ///< has the geometry of the cells, not of the voxels
  VoxelLayout (*getLayout)(const VolumeHeader & input);
  bool measuresWalls{ false }; ///< shows measures of walls, which are taken for it
};

/** Why a job of several processes does not make an output. */
struct JobRefusal
{
  const char * what;
  const char * remedy;
};

/** An output that options can ask for: a row of the tables in Outputs.cxx, which all that lists outputs reads. */
template <typename TOptions>
struct OutputKind
{
  const char * role;                              ///< in messages, plans, reports and the records of a job
  std::string TOptions::*   option;               ///< its file name
  const char *              parameter{ nullptr }; ///< name of the option in the manifest of a job; null: not there
  std::optional<VolumeKind> volume{};             ///< of volumes

  std::vector<std::string>  extensions{};                 ///< of others; none: any, or those of the mesh formats
  const char *              name{ nullptr };              ///< in the message on another extension
  bool                      mayBeStandardOutput{ false }; ///< then there is no file
  std::optional<JobRefusal> refusal{};

  /** Empty when it is not wanted. */
  std::string
  GetFileName(const TOptions & options) const
  {
    const std::string & fileName = options.*option;
    return mayBeStandardOutput && fileName == StandardOutput ? "" : fileName;
  }
};

/** All kinds, in the order of reports; the volume that stands for the job first. */
const std::vector<OutputKind<ExtractOptions>> &
ListOutputKinds(const ExtractOptions &);
const std::vector<OutputKind<DistanceOptions>> &
ListOutputKinds(const DistanceOptions &);
const std::vector<OutputKind<SurfaceOptions>> &
ListOutputKinds(const SurfaceOptions &);

/** The outputs that are wanted. */
std::vector<OutputRequest>
ListOutputs(const ExtractOptions & options, const VolumeHeader & input);
std::vector<OutputRequest>
ListOutputs(const DistanceOptions & options, const VolumeHeader & input);
std::vector<OutputRequest>
ListOutputs(const SurfaceOptions & options, const VolumeHeader & input);

/** The volumes among them. */
std::vector<VolumeRequest>
ListVolumes(const ExtractOptions & options, const VolumeHeader & input);
std::vector<VolumeRequest>
ListVolumes(const DistanceOptions & options, const VolumeHeader & input);
std::vector<VolumeRequest>
ListVolumes(const SurfaceOptions & options, const VolumeHeader & input);

/** Whether one of the volumes or the list of places shows measures of walls. */
bool
MeasuresWalls(const ExtractOptions & options);

/** Names of the volumes that the options ask for, as they were given. */
std::vector<std::string>
ListVolumeNames(const ExtractOptions & options);
std::vector<std::string>
ListVolumeNames(const DistanceOptions & options);

/** \throw JobError Usage when a file has a name that does not say what will be in it; of volumes and meshes, their
 * formats do. */
void
CheckExtensions(const ExtractOptions & options);

} // end namespace medialvoxel

#endif
