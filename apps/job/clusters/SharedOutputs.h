// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSharedOutputs_h
#define medialvoxelSharedOutputs_h

#include "Job.h"
#include "SharedVolume.h"

#include <map>
#include <string>

namespace medialvoxel
{

/** \class SharedOutputs
 * \brief The outputs of a job whose volumes several processes write. */
class SharedOutputs : public OutputSet
{
public:
  /** The volumes alone, to write clusters of them. \param job planned; must outlive it */
  SharedOutputs(const Job & job, const std::string & suffix)
    : OutputSet(job.options, job.result.plan.writesBehind, suffix)
    , m_Options(job.options)
    , m_Suffix(suffix)
    , m_WritesBehind(job.result.plan.writesBehind)
  {}

  /** All outputs, when the volumes are complete. \param names of the voxels, by role */
  SharedOutputs(const Job & job, const std::string & suffix, std::map<std::string, Publication> names)
    : SharedOutputs(job, suffix)
  {
    m_Names = std::move(names);
  }

  VoxelOutput &
  AddVolume(const VolumeRequest & request) override;

  VoxelOutput *
  AddVolumeOfEnd(const VolumeRequest & request) override
  {
    return m_Names ? OutputSet::AddVolumeOfEnd(request) : nullptr;
  }

  OutputFile *
  AddFile(const std::string & fileName) override
  {
    return m_Names ? OutputSet::AddFile(fileName) : nullptr;
  }

  /** By role. */
  const std::map<std::string, SharedVolume *> &
  GetVolumes() const
  {
    return m_Volumes;
  }

private:
  const JobOptions &                                m_Options;
  std::string                                       m_Suffix;
  bool                                              m_WritesBehind;
  std::optional<std::map<std::string, Publication>> m_Names; ///< unset: clusters are written
  std::map<std::string, SharedVolume *>             m_Volumes;
};

} // end namespace medialvoxel

#endif
