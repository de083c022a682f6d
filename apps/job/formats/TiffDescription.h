// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTiffDescription_h
#define medialvoxelTiffDescription_h

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace medialvoxel
{

/** What ImageJ, or a program that writes OME-TIFF, says of a stack in the description of its first slice. */
struct TiffDescription
{
  std::string                          images;  ///< that ImageJ announces; empty: none
  std::string                          refusal; ///< why the stack is not one volume; empty when it may be one
  std::optional<double>                unit;    ///< millimeters, of the resolution; ImageJ tells it here alone
  std::array<std::optional<double>, 3> spacing; ///< millimeters, where it is told
};

/** Never fails: what is not understood is left out. */
TiffDescription
ReadTiffDescription(const std::string & text);

} // end namespace medialvoxel

#endif
