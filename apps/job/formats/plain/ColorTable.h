// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelColorTable_h
#define medialvoxelColorTable_h

#include "Segments.h"

#include <filesystem>

namespace medialvoxel
{

/** A color table of 3D Slicer with blanks: lines of label, name, red, green, blue from 0 to 255, and opacity, which may
 * be missing. Underscores of names are blanks, as in Slicer. The row of the label 0 is left out.
 * \throw HeaderError Corrupt with the line and the value */
SegmentTable
ReadBlankTable(const std::filesystem::path & fileName);

/** The same with commas, or tabs, and a first line with the names of the columns: LabelValue, Name, Color_R, Color_G
 * and Color_B. All but the first may be missing, and others are left out. */
SegmentTable
ReadCommaTable(const std::filesystem::path & fileName);
SegmentTable
ReadTabTable(const std::filesystem::path & fileName);

} // end namespace medialvoxel

#endif
