// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelParameters_h
#define medialvoxelParameters_h

#include "Options.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

namespace medialvoxel
{

/** Which voxels are the object. The module is given all limits at all times, so that one of them has to be chosen. */
enum class ObjectSelection
{
  NonZero,
  AboveLower, ///< lower threshold and more
  BelowUpper, ///< upper threshold and less
  Between,    ///< lower to upper threshold
  Label,      ///< the label value alone
  Labels      ///< each of several labels, as an object of its own
};

/** What the command line of the module says. The thresholds, the thickness and the resampled spacing of the job stay
 * unset until CompleteJob(). */
struct ModuleOptions
{
  ExtractOptions  job;
  ObjectSelection objectSelection{ ObjectSelection::NonZero };
  double          lowerThreshold{ 1 };
  double          upperThreshold{ 65535 };
  std::int64_t    labelValue{ 1 };
  LabelSelection  labels{ true, {}, {} };
  std::string     colorTable; ///< names of the labels
  double          thickness{ 3 };
  double          elementSize{ 6 };

  ElementSize::Kind elementSizeMode{ ElementSize::Kind::Voxel };

  itk::MedialVoxelThicknessMode thicknessMode{ itk::MedialVoxelThicknessMode::Automatic };

  bool resample{ false };
  bool echo{ false };
};

/** Defines the parameters, whose names are those of the XML; parsing fills \a options, which must outlive the result.
 */
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
