// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSharedJob_h
#define medialvoxelSharedJob_h

#include "JobFolder.h"

#include <memory>
#include <string>
#include <vector>

namespace medialvoxel
{

/** A job folder that a process works in. */
struct SharedJob
{
  JobFolder folder;
  Manifest  manifest;
};

/** Reads the manifest, makes the folder of the plan the current one when names are relative to it, and checks that
 * the input of an unfinished job is unchanged. \throw JobError Failure */
SharedJob
OpenSharedJob(const std::string & jobFolder);

/** Removes the volume of all cells, if there is one. */
void
RemoveSharedCells(const Manifest & manifest);

/** Clusters without a valid marker. */
std::vector<std::uint64_t>
ListMissing(const SharedJob & job);

/** "medialvoxel work JOBDIR --clusters I-J". */
std::string
MakeWorkCommand(const JobFolder & folder, const std::vector<std::uint64_t> & clusters, std::uint64_t numberOfClusters);

/** A name as a shell takes it. */
std::string
Quote(const std::string & text);

} // end namespace medialvoxel

#endif
