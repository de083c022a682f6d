// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "NiftiText.h"

#include "NiftiFields.h"

#include <algorithm>
#include <cstring>

namespace medialvoxel
{
namespace
{

template <typename TNumber>
void
Set(std::string & header, std::size_t offset, TNumber value)
{
  std::memcpy(&header[offset], &value, sizeof(value));
}

void
SetSize(std::string & header, const VolumeGeometry & geometry)
{
  using namespace NiftiFields;
  constexpr std::size_t axes = 7;
  Set(header, Dim, static_cast<std::int16_t>(geometry.GetDimension()));
  Set(header, PixDim, 1.0F); // of a quaternion, which is not used
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    const bool isPresent = axis < geometry.size.size();
    Set(
      header, Dim + (axis + 1) * sizeof(std::int16_t), static_cast<std::int16_t>(isPresent ? geometry.size[axis] : 1));
    Set(header, PixDim + (axis + 1) * sizeof(float), isPresent ? static_cast<float>(geometry.spacing[axis]) : 1.0F);
  }
}

/** The rows of the matrix from indices to space, whose x and y axes point right and anterior in this format. */
void
SetPlacement(std::string & header, const VolumeGeometry & geometry)
{
  using namespace NiftiFields;
  constexpr std::int16_t scannerCode = 1;
  Set(header, SFormCode, scannerCode);
  for (std::size_t row = 0; row < 3; ++row)
  {
    const double sign = row < 2 ? -1.0 : 1.0;
    const auto   set = [&header, row](std::size_t column, double value) {
      Set(header, SRows + (4 * row + column) * sizeof(float), static_cast<float>(value));
    };
    const bool isPresent = row < geometry.size.size();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool has = isPresent && axis < geometry.size.size();
      set(axis, has ? sign * geometry.direction[axis][row] * geometry.spacing[axis] : (axis == row ? 1.0 : 0.0));
    }
    set(3, isPresent ? sign * geometry.origin[row] : 0.0);
  }
}

} // namespace

std::string
MakeNiftiHeader(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  using namespace NiftiFields;
  constexpr char millimeters = 2;
  std::string    header(static_cast<std::size_t>(MinimumDataOffset), '\0');
  Set(header, SizeOfHeader, HeaderBytes);
  SetSize(header, geometry);
  const auto type = std::find_if(
    DataTypes.begin(), DataTypes.end(), [&layout](const auto & known) { return known.second == layout.pixelType; });
  Set(header, DataType, type->first);
  Set(header, BitsPerVoxel, static_cast<std::int16_t>(8 * GetTraits(layout.pixelType).bytes));
  Set(header, VoxelOffset, static_cast<float>(MinimumDataOffset));
  Set(header, Units, millimeters);
  SetPlacement(header, geometry);
  header.replace(Magic, 3, "n+1");
  return header;
}

} // end namespace medialvoxel
