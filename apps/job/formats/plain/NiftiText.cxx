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

using namespace NiftiFields;

/** The first version is written, which all programs read. */
constexpr std::size_t     WrittenVersion = 0;
constexpr const Version & Written = Versions[WrittenVersion];

/** Sets one of the numbers of a field. */
template <typename TValue>
void
Set(std::string & header, const Field & field, TValue value, std::size_t index = 0)
{
  const Place & place = field[WrittenVersion];
  DispatchNumber(place.type, [&](auto zero) {
    const auto number = static_cast<decltype(zero)>(value);
    std::memcpy(&header[place.offset + index * sizeof(number)], &number, sizeof(number));
  });
}

void
SetSize(std::string & header, const VolumeGeometry & geometry)
{
  constexpr std::size_t axes = 7;
  Set(header, Dim, geometry.GetDimension());
  Set(header, PixDim, 1.0); // of a quaternion, which is not used
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    const bool isPresent = axis < geometry.size.size();
    Set(header, Dim, isPresent ? geometry.size[axis] : 1, axis + 1);
    Set(header, PixDim, isPresent ? geometry.spacing[axis] : 1.0, axis + 1);
  }
}

/** The rows of the matrix from indices to space, whose x and y axes point right and anterior in this format. */
void
SetPlacement(std::string & header, const VolumeGeometry & geometry)
{
  constexpr int scannerCode = 1;
  Set(header, SFormCode, scannerCode);
  for (std::size_t row = 0; row < 3; ++row)
  {
    const double sign = row < 2 ? -1.0 : 1.0;
    const bool   isPresent = row < geometry.size.size();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool   has = isPresent && axis < geometry.size.size();
      const double step =
        has ? sign * geometry.direction[axis][row] * geometry.spacing[axis] : (axis == row ? 1.0 : 0.0);
      Set(header, SRows, step, 4 * row + axis);
    }
    Set(header, SRows, isPresent ? sign * geometry.origin[row] : 0.0, 4 * row + 3);
  }
}

} // namespace

std::string
MakeNiftiHeader(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  constexpr int millimeters = 2;
  std::string   header(static_cast<std::size_t>(Written.minimumDataOffset), '\0');
  Set(header, SizeOfHeader, Written.headerSize);
  SetSize(header, geometry);
  const auto type = std::find_if(
    DataTypes.begin(), DataTypes.end(), [&layout](const auto & known) { return known.second == layout.pixelType; });
  Set(header, DataType, type->first);
  Set(header, BitsPerVoxel, 8 * GetTraits(layout.pixelType).bytes);
  Set(header, VoxelOffset, Written.minimumDataOffset);
  Set(header, Units, millimeters);
  SetPlacement(header, geometry);
  header.replace(Written.magic, Written.magicOfFile.size(), Written.magicOfFile);
  return header;
}

} // end namespace medialvoxel
