// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"

#include "Text.h"

#include <algorithm>
#include <cmath>

namespace medialvoxel
{
namespace
{

using Vectors = std::vector<std::vector<double>>;

/** "(1,0,0) (0,1,0)": as many vectors as the volume has dimensions, each with as many numbers. */
Vectors
ParseVectors(const VolumeHeader & header, const std::string & field, const std::string & text, size_t count)
{
  Vectors vectors;
  size_t  position = 0;
  while ((position = text.find_first_not_of(" \t", position)) != std::string::npos)
  {
    const size_t end = text.find(')', position);
    if (text[position] != '(' || end == std::string::npos)
    {
      RefuseHeader(header.fileName, field + " is '" + text + "'; it must be vectors such as (1,0,0)");
    }
    std::string numbers = text.substr(position + 1, end - position - 1);
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    vectors.push_back(ParseNumbers(header.fileName, field, numbers, header.geometry.size.size()));
    position = end + 1;
  }
  if (vectors.size() != count)
  {
    RefuseHeader(header.fileName,
                 field + " has " + std::to_string(vectors.size()) + " vectors, not " + std::to_string(count));
  }
  return vectors;
}

/** Signs that bring the coordinates of a space into the one of ITK: left, posterior, superior. Spaces that do not say
 * where they point are taken as they are. */
std::vector<double>
GetSigns(const HeaderFields & fields, size_t dimension)
{
  const std::string   space = ToLower(fields.Find("space").value_or(""));
  std::vector<double> signs(dimension, 1.0);
  const bool          isRightAnterior = space == "right-anterior-superior" || space == "ras";
  const bool          isLeftAnterior = space == "left-anterior-superior" || space == "las";
  if (isRightAnterior || isLeftAnterior)
  {
    signs[0] = isRightAnterior ? -1.0 : 1.0;
    signs[1] = -1.0;
  }
  return signs;
}

void
ReadSpaceDirections(VolumeHeader & header, const std::string & text, const std::vector<double> & signs)
{
  const size_t dimension = header.geometry.size.size();
  header.geometry.direction = ParseVectors(header, "space directions", text, dimension);
  for (std::vector<double> & axis : header.geometry.direction)
  {
    double squaredLength = 0.0;
    for (const double component : axis)
    {
      squaredLength += component * component;
    }
    const double length = std::sqrt(squaredLength);
    if (!std::isfinite(length) || length <= 0)
    {
      RefuseHeader(header.fileName,
                   "space directions has the vector (" + FormatNumbers(axis, ",") +
                     "); its length, the spacing, must be finite and greater than 0");
    }
    header.geometry.spacing.push_back(length);
    for (size_t i = 0; i < dimension; ++i)
    {
      axis[i] = signs[i] * (axis[i] / length);
    }
  }
}

/** Without a space, an axis begins at its minimum, half a voxel before the first voxel unless its centers are nodes. */
void
ReadAxisMinima(VolumeHeader & header, const HeaderFields & fields)
{
  const std::optional<std::string> minima = fields.Find("axismins");
  const std::optional<std::string> maxima = fields.Find("axismaxs");
  const size_t                     dimension = header.geometry.size.size();
  if (!minima || (!maxima && !fields.Find("spacings")))
  {
    return;
  }
  const std::vector<double>      lower = ParseNumbers(header.fileName, "axis mins", *minima, dimension);
  const std::vector<std::string> centers = SplitAtBlanks(ToLower(fields.Find("centers").value_or("")));
  for (size_t axis = 0; axis < dimension; ++axis)
  {
    const bool isNode = axis < centers.size() && centers[axis] == "node";
    double     spacing = header.geometry.spacing[axis];
    if (maxima)
    {
      const double upper = ParseNumbers(header.fileName, "axis maxs", *maxima, dimension)[axis];
      const auto   steps = static_cast<double>(header.geometry.size[axis]) - (isNode ? 1.0 : 0.0);
      spacing = (upper - lower[axis]) / steps;
    }
    header.geometry.origin[axis] = lower[axis] + (isNode ? 0.0 : spacing / 2);
  }
}

} // namespace

void
ReadNrrdGeometry(VolumeHeader & header, const HeaderFields & fields)
{
  const size_t                     dimension = header.geometry.size.size();
  const std::vector<double>        signs = GetSigns(fields, dimension);
  const std::optional<std::string> spacings = fields.Find("spacings");
  const std::optional<std::string> directions = fields.Find("spacedirections");
  const std::optional<std::string> origin = fields.Find("spaceorigin");
  header.geometry.origin.assign(dimension, 0.0);
  header.geometry.SetIdentityDirection();

  if (directions && spacings)
  {
    RefuseHeader(header.fileName, "it has both space directions and spacings");
  }
  if (directions)
  {
    ReadSpaceDirections(header, *directions, signs);
  }
  else
  {
    header.geometry.spacing =
      spacings ? ParseSpacings(header.fileName, "spacings", *spacings, dimension) : std::vector<double>(dimension, 1.0);
  }
  if (origin)
  {
    const std::vector<double> point = ParseVectors(header, "space origin", *origin, 1).front();
    std::transform(point.begin(), point.end(), signs.begin(), header.geometry.origin.begin(), std::multiplies<>());
  }
  else if (!directions)
  {
    ReadAxisMinima(header, fields);
  }
}

} // end namespace medialvoxel
