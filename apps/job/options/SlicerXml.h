// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSlicerXml_h
#define medialvoxelSlicerXml_h

#include "OptionTable.h"

#include <string>

namespace medialvoxel
{

/** How the module for 3D Slicer reads the value of a parameter. Empty texts of Slicer leave it as it is. */
OptionValue
GetModuleValue(const OptionRow & row);

/** The description of the module for 3D Slicer, made from the parameters of the table. */
std::string
MakeSlicerXml();

} // end namespace medialvoxel

#endif
