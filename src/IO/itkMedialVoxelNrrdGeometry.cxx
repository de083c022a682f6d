// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelNrrdHeaderPrivate.h"

#include "itkMedialVoxelHeaderText.h"
#include "itkMedialVoxelText.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace itk
{

using namespace MedialVoxelText;

namespace
{

using Vectors = std::vector<std::vector<double>>;

std::optional<std::string>
Find(const MedialVoxelNrrdHeader & header, const std::string & field)
{
  const auto found = header.fields.find(field);
  return found == header.fields.end() ? std::nullopt : std::optional<std::string>(found->second);
}

/** A field with a value for each axis of the file; returns the values of the axes of space. */
std::optional<std::string>
FindPerAxis(const MedialVoxelNrrdHeader & header, const std::string & field)
{
  const std::optional<std::string> text = Find(header, field);
  if (!text || header.componentKind.empty())
  {
    return text;
  }
  std::vector<std::string> parts = SplitAtBlanks(*text);
  parts.erase(parts.begin(), parts.begin() + (parts.empty() ? 0 : 1));
  return Join(parts, " ", [](const std::string & part) { return part; });
}

/** "(1,0,0) (0,1,0)": as many vectors as the volume has dimensions, each with as many numbers. */
Vectors
ParseVectors(const MedialVoxelNrrdHeader & header, const std::string & field, const std::string & text, size_t count)
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
    vectors.push_back(ParseNumbers(header.fileName, field, numbers, header.size.size()));
    position = end + 1;
  }
  if (vectors.size() != count)
  {
    RefuseHeader(header.fileName,
                 field + " has " + std::to_string(vectors.size()) + " vectors, not " + std::to_string(count));
  }
  return vectors;
}

/** Signs that bring the coordinates of a space into the one of ITK: left, posterior, superior. Spaces without
 * anatomical directions stay as they are. */
std::vector<double>
ReadSpace(MedialVoxelNrrdHeader & header)
{
  header.space = ToLower(Find(header, "space").value_or(""));
  std::vector<double> signs(header.size.size(), 1.0);
  const bool          isRightAnterior = header.space == "right-anterior-superior" || header.space == "ras";
  const bool          isLeftAnterior = header.space == "left-anterior-superior" || header.space == "las";
  if (isRightAnterior || isLeftAnterior)
  {
    signs[0] = isRightAnterior ? -1.0 : 1.0;
    signs[1] = -1.0;
  }
  if (isRightAnterior || isLeftAnterior || header.space == "lps")
  {
    header.space = "left-posterior-superior";
  }
  return signs;
}

/** The vectors of the axes of space; an axis of components has "none". */
std::string
WithoutNone(const MedialVoxelNrrdHeader & header, const std::string & text)
{
  const std::string none = "none";
  if (header.componentKind.empty())
  {
    return text;
  }
  if (ToLower(text).rfind(none, 0) != 0)
  {
    RefuseHeader(header.fileName,
                 "space directions is '" + text + "'; the first axis, that of the components, must have 'none'");
  }
  return text.substr(none.size());
}

void
ReadSpaceDirections(MedialVoxelNrrdHeader & header, const std::string & text, const std::vector<double> & signs)
{
  const size_t dimension = header.size.size();
  header.direction = ParseVectors(header, "space directions", WithoutNone(header, text), dimension);
  for (size_t i = 0; i < dimension; ++i)
  {
    std::vector<double> & axis = header.direction[i];
    double                squaredLength = 0.0;
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
    header.spacing[i] = length;
    for (size_t row = 0; row < dimension; ++row)
    {
      axis[row] = signs[row] * (axis[row] / length);
    }
  }
}

/** Without a space, an axis begins at its minimum, half a voxel before the first voxel unless its centers are nodes. */
void
ReadAxisMinima(MedialVoxelNrrdHeader & header)
{
  const std::optional<std::string> minima = FindPerAxis(header, "axismins");
  const std::optional<std::string> maxima = FindPerAxis(header, "axismaxs");
  const size_t                     dimension = header.size.size();
  if (!minima || (!maxima && header.fields.count("spacings") == 0))
  {
    return;
  }
  const std::vector<double>      lower = ParseNumbers(header.fileName, "axis mins", *minima, dimension);
  const std::vector<std::string> centers = SplitAtBlanks(ToLower(FindPerAxis(header, "centers").value_or("")));
  for (size_t axis = 0; axis < dimension; ++axis)
  {
    const bool isNode = axis < centers.size() && centers[axis] == "node";
    double     spacing = header.spacing[axis];
    if (maxima)
    {
      const double upper = ParseNumbers(header.fileName, "axis maxs", *maxima, dimension)[axis];
      const auto   steps = static_cast<double>(header.size[axis]) - (isNode ? 1.0 : 0.0);
      spacing = (upper - lower[axis]) / steps;
    }
    header.origin[axis] = lower[axis] + (isNode ? 0.0 : spacing / 2);
  }
}

void
ReadMeasurementFrame(MedialVoxelNrrdHeader & header, const std::vector<double> & signs)
{
  const std::optional<std::string> frame = Find(header, "measurementframe");
  if (!frame)
  {
    return;
  }
  header.measurementFrame = ParseVectors(header, "measurement frame", *frame, header.size.size());
  for (std::vector<double> & vector : header.measurementFrame)
  {
    std::transform(vector.begin(), vector.end(), signs.begin(), vector.begin(), std::multiplies<>());
  }
}

} // namespace

void
ReadMedialVoxelNrrdGeometry(MedialVoxelNrrdHeader & header)
{
  const size_t                     dimension = header.size.size();
  const std::vector<double>        signs = ReadSpace(header);
  const std::optional<std::string> spacings = FindPerAxis(header, "spacings");
  const std::optional<std::string> directions = Find(header, "spacedirections");
  const std::optional<std::string> origin = Find(header, "spaceorigin");
  header.origin.assign(dimension, 0.0);
  header.spacing.assign(dimension, 1.0);
  header.direction.resize(dimension);
  for (size_t axis = 0; axis < dimension; ++axis)
  {
    header.direction[axis].resize(dimension, 0.0);
    header.direction[axis][axis] = 1.0;
  }

  if (directions && spacings)
  {
    RefuseHeader(header.fileName, "it has both space directions and spacings");
  }
  if (directions)
  {
    ReadSpaceDirections(header, *directions, signs);
  }
  else if (spacings)
  {
    header.spacing = ParseSpacings(header.fileName, "spacings", *spacings, dimension);
  }
  if (origin)
  {
    const std::vector<double> point = ParseVectors(header, "space origin", *origin, 1).front();
    std::transform(point.begin(), point.end(), signs.begin(), header.origin.begin(), std::multiplies<>());
  }
  else if (!directions)
  {
    ReadAxisMinima(header);
  }
  ReadMeasurementFrame(header, signs);
}

} // end namespace itk
