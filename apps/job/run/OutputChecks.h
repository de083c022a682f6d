// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputChecks_h
#define medialvoxelOutputChecks_h

#include "OutputRequest.h"

#include <filesystem>
#include <set>
#include <vector>

namespace medialvoxel
{

/** Every file that the volume is read from. */
std::set<std::filesystem::path>
ListInputFiles(const VolumeHeader & input);

/** Refuses outputs that cannot be written or would destroy something.
 * \throw JobError Usage for an output that is the input or another output, or has an unknown extension; Refused for
 * one that exists, unless \a overwrite, or whose folder is missing. */
void
CheckOutputs(const std::vector<OutputRequest> & outputs, const VolumeHeader & input, bool overwrite);

/** Refuses outputs that would replace another file that is read; \a input may be empty, for none.
 * \throw JobError Usage */
void
CheckOtherInput(const std::vector<OutputRequest> & outputs, const std::filesystem::path & input);

/** Refuses a folder that would be removed with a Zarr folder that is replaced. \throw JobError Usage */
void
CheckJobFolder(const std::filesystem::path & folder, const std::vector<OutputRequest> & outputs);

} // end namespace medialvoxel

#endif
