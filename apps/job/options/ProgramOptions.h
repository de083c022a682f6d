// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProgramOptions_h
#define medialvoxelProgramOptions_h

#include "Options.h"
#include "Progress.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Options of the program beside the job. */
struct ProgramOptions
{
  std::string   jobFolder;
  bool          resumes{ false };     ///< the extraction
  bool          showsValues{ false }; ///< of the volume
  bool          showsLabels{ false }; ///< lists the objects of a label map
  bool          printsJson{ false };
  ProgressStyle progress{ ProgressStyle::Auto };
  bool          quiet{ false };
  bool          showsPhases{ false }; ///< prints the long table

  /** Lengths that were given in voxels, each of which sets its option when it is told how long a voxel is. */
  std::vector<std::function<void(double voxel)>> lengthsInVoxels;
};

/** Which voxels are the object. The module for 3D Slicer is given all limits at all times, so that one of them has to
 * be chosen. */
enum class ObjectSelection
{
  NonZero,
  AboveLower, ///< lower threshold and more
  BelowUpper, ///< upper threshold and less
  Between,    ///< lower to upper threshold
  Label,      ///< the label value alone
  Labels      ///< each of several labels, as an object of its own
};

/** Parameters of the module of 3D Slicer in place of options of the job, which CompleteJob() sets. */
struct ModuleOptions
{
  ExtractOptions  job;
  ProgramOptions  program;
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

} // end namespace medialvoxel

#endif
