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
  const char * role;                                      ///< in messages, plans, reports and the records of a job
  std::string TOptions::*   option;                       ///< its file name
  std::optional<VolumeKind> volume{};                     ///< of volumes
  std::optional<JobRefusal> refusal{};                    ///< set: no job of several processes makes it
  std::vector<std::string>  extensions{};                 ///< of other files; none: any, or the mesh formats
  const char *              name{ nullptr };              ///< in the message on another extension
  bool                      mayBeStandardOutput{ false }; ///< then there is no file

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
const std::vector<OutputKind<PartOptions>> &
ListOutputKinds(const PartOptions &);

/** The outputs that are wanted. */
template <typename TOptions>
std::vector<OutputRequest>
ListOutputs(const TOptions & options, const VolumeHeader & input)
{
  std::vector<OutputRequest> outputs;
  for (const auto & kind : ListOutputKinds(options))
  {
    if (const std::string fileName = kind.GetFileName(options); !fileName.empty())
    {
      outputs.push_back({ kind.role, fileName, std::nullopt });
      if (kind.volume)
      {
        outputs.back().layout = kind.volume->getLayout(input);
      }
    }
  }
  return outputs;
}

/** The volumes among them. */
template <typename TOptions>
std::vector<VolumeRequest>
ListVolumes(const TOptions & options, const VolumeHeader & input)
{
  std::vector<VolumeRequest> volumes;
  for (const auto & kind : ListOutputKinds(options))
  {
    if (kind.volume && !(options.*kind.option).empty())
    {
      const VolumeGeometry geometry = kind.volume->isOfCells ? GetCellGeometry(input.geometry) : input.geometry;
      volumes.push_back({ kind.role,
                          options.*kind.option,
                          geometry,
                          kind.volume->getLayout(input),
                          kind.volume->write,
                          kind.volume->filler });
    }
  }
  return volumes;
}

/** The volume of all cells, beside the labels of which it is, until the end of the job has made them. */
inline std::string
GetCellsFile(const std::string & labels)
{
  return labels + ".cells.mha";
}

/** Their names, as they were given. */
template <typename TOptions>
std::vector<std::string>
ListVolumeNames(const TOptions & options)
{
  std::vector<std::string> names;
  for (const auto & kind : ListOutputKinds(options))
  {
    if (kind.volume && !(options.*kind.option).empty())
    {
      names.push_back(options.*kind.option);
    }
  }
  return names;
}

/** Whether an output is of numbered walls. */
bool
NumbersWalls(const ExtractOptions & options);

/** Whether an output needs the importance of cells. */
bool
FindsImportance(const ExtractOptions & options);

/** Whether one of the volumes or the list of places shows measures of walls. */
bool
MeasuresWalls(const ExtractOptions & options);

/** \throw JobError Usage when the extension of a file does not fit its content. Formats check volumes and meshes. */
void
CheckExtensions(const ExtractOptions & options);

} // end namespace medialvoxel

#endif
