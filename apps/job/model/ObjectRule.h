// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectRule_h
#define medialvoxelObjectRule_h

#include "Options.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelInput.h"

namespace medialvoxel
{

/** \throw JobError Usage for a label that the values of the volume cannot have */
void
CheckLabel(const JobOptions & options, const VolumeHeader & header);

/** The values that the options make object: a label, the range between the thresholds, or all but 0. CheckLabel() has
 * checked that the type has the label. */
itk::MedialVoxelObjectRule
GetObjectRule(const JobOptions & options);

} // end namespace medialvoxel

#endif
