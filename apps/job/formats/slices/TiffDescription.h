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

/** The description of a stack in its first slice, by ImageJ, tifffile, or a program that writes OME-TIFF. */
struct TiffDescription
{
  std::string images;  ///< number of slices that it announces; empty: none
  std::string refusal; ///< why the stack is not one volume; empty when it may be one
  bool        isOfImageJ{ false };
  bool        isCalibrated{ false }; ///< ImageJ shows other values than the stored ones
  std::string unknownUnit;           ///< of a length; empty: all units are known

  /** Millimeters of the unit of each axis; ImageJ gives the unit of the resolution only here. */
  std::array<std::optional<double>, 3> units;

  /** Distances of voxels in these units, where they are told. */
  std::array<std::optional<double>, 3> lengths;
};

/** Never fails: unknown parts are left out. */
TiffDescription
ReadTiffDescription(const std::string & text);

} // end namespace medialvoxel

#endif
