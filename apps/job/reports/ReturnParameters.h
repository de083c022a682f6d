// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelReturnParameters_h
#define medialvoxelReturnParameters_h

#include "JobResult.h"

#include <string>

namespace medialvoxel
{

/** Counts, percentages and seconds as lines "name = value", the form in which 3D Slicer takes back results that are
 * not files. Percentages of no candidates are "nan". */
std::string
MakeReturnParameters(const JobResult & result);

} // end namespace medialvoxel

#endif
