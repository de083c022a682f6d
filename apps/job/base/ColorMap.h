// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelColorMap_h
#define medialvoxelColorMap_h

#include <array>
#include <cstdint>

namespace medialvoxel
{

/** Red, green, blue of sRGB. */
using Color = std::array<std::uint8_t, 3>;

/** Color of a share from 0 to 1: violet, blue, green, yellow, the lighter the larger. Equal steps of the share are
 * equal steps of lightness in CIELAB, so the order is seen without colors too. Shares outside are clamped. */
Color
GetMapColor(double share);

} // end namespace medialvoxel

#endif
