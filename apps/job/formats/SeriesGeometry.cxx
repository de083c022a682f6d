// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SeriesGeometry.h"

#include "HeaderParsing.h"
#include "Text.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace medialvoxel
{
namespace
{

using Vector = std::array<double, 3>;
using Slices = std::vector<SliceHeader>;

double
Dot(const Vector & a, const Vector & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector
Cross(const Vector & a, const Vector & b)
{
  return { { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] } };
}

Vector
Subtract(const Vector & a, const Vector & b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}

std::string
Describe(const Vector & vector)
{
  return "(" + FormatNumbers({ vector.begin(), vector.end() }, ",") + ")";
}

Vector
GetNormal(const SlicePlace & place)
{
  return Cross(place.rowAxis, place.columnAxis);
}

void
CheckDirections(const std::filesystem::path & input, const Slices & slices)
{
  constexpr double   tolerance = 1e-3;
  const SlicePlace & first = *slices.front().place;
  const auto         differs = [](const Vector & a, const Vector & b) {
    const Vector difference = Subtract(a, b);
    return !(std::sqrt(Dot(difference, difference)) <= tolerance);
  };
  if (!(std::abs(Dot(first.rowAxis, first.columnAxis)) <= tolerance))
  {
    RefuseHeader(slices.front().fileName,
                 "its rows and columns are not at right angles: " + Describe(first.rowAxis) + " and " +
                   Describe(first.columnAxis));
  }
  for (const SliceHeader & slice : slices)
  {
    if (differs(slice.place->rowAxis, first.rowAxis) || differs(slice.place->columnAxis, first.columnAxis))
    {
      RefuseHeader(input,
                   "slices have different directions: " + slices.front().fileName.string() + " has " +
                     Describe(first.rowAxis) + " and " + Describe(first.columnAxis) + ", " + slice.fileName.string() +
                     " has " + Describe(slice.place->rowAxis) + " and " + Describe(slice.place->columnAxis));
    }
  }
}

/** Distances from each slice to the next one. */
std::vector<double>
GetSteps(const Slices & slices, const Vector & normal)
{
  std::vector<double> steps;
  for (std::size_t slice = 1; slice < slices.size(); ++slice)
  {
    steps.push_back(Dot(Subtract(slices[slice].place->origin, slices[slice - 1].place->origin), normal));
  }
  return steps;
}

double
GetMedian(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** The first slice that is not where the others let it be expected. */
void
CheckSteps(const std::filesystem::path & input, const Slices & slices, const Vector & normal)
{
  const std::vector<double> steps = GetSteps(slices, normal);
  const double              usual = GetMedian(steps);
  const double              tolerance = SlicePositionTolerance * usual;
  for (std::size_t slice = 0; slice < steps.size(); ++slice)
  {
    const std::string pair = slices[slice].fileName.string() + " and " + slices[slice + 1].fileName.string();
    const double      step = steps[slice];
    if (!(step > tolerance))
    {
      RefuseHeader(input,
                   pair + " have the same place " + Describe(slices[slice].place->origin) + "; a slice is doubled");
    }
    if (!(std::abs(step - usual) <= tolerance))
    {
      const double more = std::round(step / usual) - 1;
      const bool   isGap = more >= 1 && std::abs(step - (more + 1) * usual) <= tolerance * (more + 1);
      RefuseHeader(input,
                   (isGap ? FormatNumber(more) + (more > 1 ? " slices are" : " slice is") + " missing between " + pair
                          : "the slices are not equally spaced: " + pair + " do not fit") +
                     "; their distance is " + FormatShort(step) + ", that of others " + FormatShort(usual));
    }
  }
}

/** Slices that are shifted against each other, as those of a tilted gantry, are no box. */
void
CheckLine(const std::filesystem::path & input, const Slices & slices, const Vector & normal)
{
  const Vector & first = slices.front().place->origin;
  const double   spacing =
    Dot(Subtract(slices.back().place->origin, first), normal) / static_cast<double>(slices.size() - 1);
  for (std::size_t slice = 1; slice < slices.size(); ++slice)
  {
    const Vector way = Subtract(slices[slice].place->origin, first);
    const double along = Dot(way, normal);
    const double beside = std::sqrt(std::max(0.0, Dot(way, way) - along * along));
    if (!(beside <= SlicePositionTolerance * spacing * static_cast<double>(slice)))
    {
      RefuseHeader(input,
                   slices[slice].fileName.string() + " is shifted by " + FormatShort(beside) +
                     " mm along its plane against " + slices.front().fileName.string() +
                     ", as with a tilted gantry; resample the series to a straight one first",
                   HeaderError::Kind::Unsupported);
    }
  }
}

} // namespace

void
SortAlongNormal(const std::filesystem::path & input, Slices & slices)
{
  CheckDirections(input, slices);
  const Vector normal = GetNormal(*slices.front().place);
  std::stable_sort(slices.begin(), slices.end(), [&normal](const SliceHeader & a, const SliceHeader & b) {
    return Dot(a.place->origin, normal) < Dot(b.place->origin, normal);
  });
  if (slices.size() > 1)
  {
    CheckSteps(input, slices, normal);
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
                   "slices have different spacings: " + first.fileName.string() + " has " +
                     FormatNumbers({ first.spacing.begin(), first.spacing.end() }, " x ") + ", " +
                     slice.fileName.string() + " has " +
                     FormatNumbers({ slice.spacing.begin(), slice.spacing.end() }, " x "));
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
  if (slices.size() > 1 && first.place)
  {
    const Vector normal = GetNormal(*first.place);
    const Vector way = Subtract(slices.back().place->origin, first.place->origin);
    geometry.spacing[2] = Dot(way, normal) / static_cast<double>(slices.size() - 1);
    geometry.origin.assign(first.place->origin.begin(), first.place->origin.end());
    geometry.direction[0].assign(first.place->rowAxis.begin(), first.place->rowAxis.end());
    geometry.direction[1].assign(first.place->columnAxis.begin(), first.place->columnAxis.end());
    geometry.direction[2].assign(normal.begin(), normal.end());
  }
  return geometry;
}

} // end namespace medialvoxel
