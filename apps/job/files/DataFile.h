// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelDataFile_h
#define medialvoxelDataFile_h

#include <filesystem>
#include <string>

namespace medialvoxel
{

/** Names that the voxels beside a header get; number 0 is the one without a number. */
std::filesystem::path
MakeDataName(const std::filesystem::path & headerName, unsigned int number);

/** Whether MakeDataName() gives this name: other headers may share any other file. */
bool
IsDataName(const std::filesystem::path & dataName, const std::filesystem::path & headerName);

/** The file of voxels that an existing header names; empty when it names none or is no header of this kind. */
std::filesystem::path
FindDataFile(const std::filesystem::path & headerName);

/** The same of a header that has another name for now. */
std::filesystem::path
FindDataFile(const std::filesystem::path & headerName, const std::filesystem::path & nameForNow);

} // end namespace medialvoxel

#endif
