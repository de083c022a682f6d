// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelParameters_h
#define medialvoxelParameters_h

#include "Options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Which voxels are the object. The module is given all limits at all times, so that one of them has to be chosen. */
enum class ObjectSelection
{
  NonZero,
  AboveLower, ///< lower threshold and more
  BelowUpper, ///< upper threshold and less
  Between,    ///< lower to upper threshold
  Label       ///< the label value alone
};

/** Name of the enumerator on the command line. */
std::string
GetName(ObjectSelection selection);

std::string
GetName(itk::MedialVoxelThicknessMode mode);

/** What the command line of the module says. The thresholds of the job stay unset until ApplyObjectSelection(), its
 * thickness until ApplyThickness(). */
struct ModuleOptions
{
  ExtractOptions  job;
  ObjectSelection objectSelection{ ObjectSelection::NonZero };
  double          lowerThreshold{ 1 };
  double          upperThreshold{ 65535 };
  std::int64_t    labelValue{ 1 };
  double          thickness{ 3 };

  itk::MedialVoxelThicknessMode thicknessMode{ itk::MedialVoxelThicknessMode::Automatic };

  bool resample{ false };
  bool echo{ false };
};

/** Kinds of values, as the elements of the module's XML name them. Empty texts are allowed for String and Path. */
enum class ParameterKind
{
  Path, ///< image, file or directory
  String,
  Boolean,
  Integer,
  Double,
  Enumeration
};

/** One row of the table that drives parser, help and echo. Its name is that of the XML, and its flag. */
struct Parameter
{
  std::string                              name;
  ParameterKind                            kind;
  std::string                              help;
  std::string                              defaultValue;
  std::function<void(const std::string &)> assign;                ///< takes a checked text
  std::vector<std::string>                 elements{};            ///< of an enumeration
  std::int64_t                             minimum{ 0 };          ///< of an integer
  std::int64_t                             maximum{ 0 };          ///< of an integer
  bool                                     isPositional{ false }; ///< required, and without a flag
  std::optional<std::string>               value{};               ///< what SetValue() was told
};
using ParameterTable = std::vector<Parameter>;

/** The table of all parameters; \a options must outlive it. */
ParameterTable
DefineParameters(ModuleOptions & options);

/** Checks the text and hands it to the options. \throw JobError Usage. */
void
SetValue(Parameter & parameter, const std::string & text);

/** Sets the thresholds of the job. \throw JobError Usage when a limit is given and no selection, which would not use
 * it. */
void
ApplyObjectSelection(const ParameterTable & table, ModuleOptions & options);

/** Sets the thickness of the job, when it is fixed: as the mode says, or as a thickness implies without one. Sets the
 * resampled spacing too. */
void
ApplyThickness(const ParameterTable & table, ModuleOptions & options);

} // end namespace medialvoxel

#endif
