// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelParameters_h
#define medialvoxelParameters_h

#include "ProgramOptions.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <ostream>

namespace medialvoxel
{

/** Defines the parameters under the names of the XML; parsing fills \a options, which must outlive the result. */
std::unique_ptr<CLI::App>
DefineParameters(ModuleOptions & options);

/** Sets the thresholds that the selection names, the thickness when it is fixed, as the mode says or as a thickness
 * implies without one, the same for the element size, and the resampled spacing. \param app that has parsed */
void
CompleteJob(const CLI::App & app, ModuleOptions & options);

/** Names and values of all parameters, a line each. */
void
PrintValues(std::ostream & out, const CLI::App & app);

} // end namespace medialvoxel

#endif
