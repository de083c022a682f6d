// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SeriesGeometry.h"

#include "HeaderParsing.h"
#include "Text.h"

#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace medialvoxel
{
namespace
{

/** How far slices may be from their places without a word, and from the line through the first voxels at all: this
 * share of the spacing. */
constexpr double SlicePositionTolerance = 0.01;

using Vector = itk::MedialVoxelVector3;
using Slices = std::vector<SliceHeader>;

std::string
Describe(const Vector & vector)
{
  return "(" + FormatNumbers({ vector.begin(), vector.end() }, ",") + ")";
}

Vector
GetNormal(const SlicePlace & place)
{
  return itk::MedialVoxelCross(place.rowAxis, place.columnAxis);
}

void
CheckDirections(const std::filesystem::path & input, const Slices & slices)
{
  constexpr double   tolerance = 1e-3;
  const SlicePlace & first = *slices.front().place;
  const auto         differs = [](const Vector & a, const Vector & b) {
    return !(itk::MedialVoxelNorm(itk::MedialVoxelSubtract(a, b)) <= tolerance);
  };
  const auto isUnit = [](const Vector & vector) {
    return std::abs(itk::MedialVoxelNorm(vector) - 1.0) <= 10.0 * tolerance;
  };
  if (!isUnit(first.rowAxis) || !isUnit(first.columnAxis))
  {
    RefuseHeader(slices.front().GetName(),
                 "its rows and columns have the directions " + Describe(first.rowAxis) + " and " +
                   Describe(first.columnAxis) + "; they must have the length 1");
  }
  if (!(std::abs(itk::MedialVoxelDot(first.rowAxis, first.columnAxis)) <= tolerance))
  {
    RefuseHeader(slices.front().GetName(),
                 "its rows and columns are not at right angles: " + Describe(first.rowAxis) + " and " +
                   Describe(first.columnAxis));
  }
  for (const SliceHeader & slice : slices)
  {
    if (differs(slice.place->rowAxis, first.rowAxis) || differs(slice.place->columnAxis, first.columnAxis))
    {
      RefuseHeader(input,
                   "slices have different directions: " + slices.front().GetName() + " has " + Describe(first.rowAxis) +
                     " and " + Describe(first.columnAxis) + ", " + slice.GetName() + " has " +
                     Describe(slice.place->rowAxis) + " and " + Describe(slice.place->columnAxis));
    }
  }
}

double
GetMedian(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Scans of the same region that one series holds would be stacked into each other. */
void
CheckAcquisitions(const std::filesystem::path & input, const Slices & sorted)
{
  std::map<std::string, std::pair<std::size_t, std::size_t>> extents;
  for (std::size_t slice = 0; slice < sorted.size(); ++slice)
  {
    const auto [extent, isNew] = extents.try_emplace(sorted[slice].acquisition, slice, slice);
    extent->second.second = slice;
  }
  for (const auto & [name, extent] : extents)
  {
    for (std::size_t slice = extent.first; slice <= extent.second; ++slice)
    {
      const SliceHeader & other = sorted[slice];
      if (other.acquisition != name)
      {
        RefuseHeader(input,
                     "its slices are of acquisitions that overlap: " + sorted[extent.first].GetName() +
                       " is of acquisition '" + name + "', " + other.GetName() + " of '" + other.acquisition +
                       (other.frameNumber > 0 ? "'; split the file into one for each of them"
                                              : "'; put the files of one of them into a folder of their own"));
      }
    }
  }
}

/** How far slices may be from equal distances: exporters round positions to the digits that they write. A slice that
 * is missing puts others off by more than a third of the distance. */
double
GetTolerance(const Slices & slices, double spacing)
{
  constexpr double usual = 0.1;
  constexpr double most = 0.25;
  double           rounding = 0.0;
  for (const SliceHeader & slice : slices)
  {
    rounding = rounding == 0.0 ? slice.place->rounding : std::min(rounding, slice.place->rounding);
  }
  // The first and the last place, which the others are compared with, are rounded too.
  return spacing * std::clamp(2.0 * rounding / spacing, usual, most);
}

/** The first slice that is not where the others let it be expected. */
void
CheckSteps(const std::filesystem::path & input,
           const Slices &                slices,
           const Vector &                normal,
           bool                          hasSpacing,
           std::vector<Warning> &        warnings)
{
  const Vector &      first = slices.front().place->origin;
  std::vector<double> places;
  std::vector<double> steps;
  for (const SliceHeader & slice : slices)
  {
    places.push_back(itk::MedialVoxelDot(itk::MedialVoxelSubtract(slice.place->origin, first), normal));
    if (places.size() > 1)
    {
      steps.push_back(places.back() - places[places.size() - 2]);
    }
  }
  const double spacing = places.back() / static_cast<double>(steps.size());
  const double tolerance = GetTolerance(slices, spacing);
  const double usual = GetMedian(steps);
  double       worst = 0.0;
  for (std::size_t slice = 0; slice < steps.size(); ++slice)
  {
    if (!(steps[slice] > SlicePositionTolerance * usual))
    {
      RefuseHeader(input,
                   slices[slice].GetName() + " and " + slices[slice + 1].GetName() + " have the same place " +
                     Describe(slices[slice].place->origin) + "; a slice is doubled");
    }
    worst = std::max(worst, std::abs(places[slice + 1] - spacing * static_cast<double>(slice + 1)));
  }
  if (hasSpacing)
  {
    return;
  }
  if (!(worst <= tolerance))
  {
    const auto odd = std::max_element(
      steps.begin(), steps.end(), [usual](double a, double b) { return std::abs(a - usual) < std::abs(b - usual); });
    const auto        at = static_cast<std::size_t>(odd - steps.begin());
    const std::string pair = slices[at].GetName() + " and " + slices[at + 1].GetName();
    const double      more = std::round(*odd / usual) - 1;
    const bool        isGap = more >= 1 && std::abs(*odd - (more + 1) * usual) <= 2 * tolerance;
    RefuseHeader(input,
                 (isGap ? FormatNumber(more) + (more > 1 ? " slices are" : " slice is") + " missing between " + pair
                        : "the slices are not equally spaced: " + pair + " do not fit") +
                   "; their distance is " + FormatShort(*odd) + ", that of others " + FormatShort(usual) +
                   "; --spacing takes them as equally spaced");
  }
  if (worst > SlicePositionTolerance * spacing)
  {
    constexpr double percent = 100.0;
    const double     share = percent * worst / spacing;
    warnings.push_back({ HeaderWarnings::UnevenSlices,
                         "positions of slices are up to " + FormatShort(share) +
                           " % of their distance away from equal distances, as rounded numbers are; the slices are "
                           "taken as " +
                           FormatShort(spacing) + " mm apart",
                         { { "percent", share }, { "distance", spacing } } });
  }
}

/** Sums of written numbers are off in their last digits: 0.8 is 0.7999999999999999. */
double
DropRounding(double distance)
{
  constexpr int digits = 12;
  return *ParseDouble(FormatScientific(distance, digits - 1));
}

/** Slices that are shifted against each other, as by a tilted gantry, are no box. */
void
CheckLine(const std::filesystem::path & input, const Slices & slices, const Vector & normal)
{
  const Vector & first = slices.front().place->origin;
  const double   spacing = itk::MedialVoxelDot(itk::MedialVoxelSubtract(slices.back().place->origin, first), normal) /
                         static_cast<double>(slices.size() - 1);
  for (std::size_t slice = 1; slice < slices.size(); ++slice)
  {
    const Vector way = itk::MedialVoxelSubtract(slices[slice].place->origin, first);
    const double along = itk::MedialVoxelDot(way, normal);
    const double beside = std::sqrt(std::max(0.0, itk::MedialVoxelDot(way, way) - along * along));
    const double rounding = std::min(GetTolerance(slices, spacing), 2.0 * slices[slice].place->rounding);
    if (!(beside <= SlicePositionTolerance * spacing * static_cast<double>(slice) + rounding))
    {
      RefuseHeader(input,
                   slices[slice].GetName() + " is shifted by " + FormatShort(beside) + " mm along its plane against " +
                     slices.front().GetName() +
                     ", as with a tilted gantry; resample the series to a straight one first",
                   HeaderError::Kind::Unsupported);
    }
  }
}

} // namespace

void
SortAlongNormal(const std::filesystem::path & input, Slices & slices, bool hasSpacing, std::vector<Warning> & warnings)
{
  CheckDirections(input, slices);
  const Vector normal = GetNormal(*slices.front().place);
  std::stable_sort(slices.begin(), slices.end(), [&normal](const SliceHeader & a, const SliceHeader & b) {
    return itk::MedialVoxelDot(a.place->origin, normal) < itk::MedialVoxelDot(b.place->origin, normal);
  });
  if (slices.size() > 1)
  {
    CheckAcquisitions(input, slices);
    CheckSteps(input, slices, normal, hasSpacing, warnings);
    CheckLine(input, slices, normal);
  }
}

VolumeGeometry
MakeSeriesGeometry(const std::filesystem::path & input, const Slices & slices)
{
  constexpr double    tolerance = 1e-4;
  const SliceHeader & first = slices.front();
  for (const SliceHeader & slice : slices)
  {
    if (!(std::abs(slice.spacing[0] - first.spacing[0]) <= tolerance * first.spacing[0]) ||
        !(std::abs(slice.spacing[1] - first.spacing[1]) <= tolerance * first.spacing[1]))
    {
      RefuseHeader(input,
                   "slices have different spacings: " + first.GetName() + " has " +
                     FormatNumbers({ first.spacing.begin(), first.spacing.end() }, " x ") + ", " + slice.GetName() +
                     " has " + FormatNumbers({ slice.spacing.begin(), slice.spacing.end() }, " x "));
    }
  }
  VolumeGeometry geometry;
  geometry.size = { first.size[0], first.size[1] };
  geometry.spacing = { first.spacing[0], first.spacing[1] };
  geometry.origin = { 0.0, 0.0 };
  if (slices.size() > 1)
  {
    geometry.size.push_back(slices.size());
    geometry.spacing.push_back(1.0);
    geometry.origin.push_back(0.0);
  }
  geometry.SetIdentityDirection();
  geometry.inMillimeters = first.inMillimeters;
  if (slices.size() > 1 && first.place)
  {
    const Vector normal = GetNormal(*first.place);
    const Vector way = itk::MedialVoxelSubtract(slices.back().place->origin, first.place->origin);
    geometry.spacing[2] = DropRounding(itk::MedialVoxelDot(way, normal) / static_cast<double>(slices.size() - 1));
    geometry.origin.assign(first.place->origin.begin(), first.place->origin.end());
    geometry.direction[0].assign(first.place->rowAxis.begin(), first.place->rowAxis.end());
    geometry.direction[1].assign(first.place->columnAxis.begin(), first.place->columnAxis.end());
    geometry.direction[2].assign(normal.begin(), normal.end());
  }
  return geometry;
}

} // end namespace medialvoxel
