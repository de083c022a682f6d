// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PlaceSections.h"

#include "PageText.h"
#include "PreviewCanvas.h"
#include "Text.h"
#include "VolumeSource.h"

#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelInput.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace medialvoxel
{
namespace
{

using Vector = itk::MedialVoxelVector3;

constexpr unsigned int LeastPixels = 32;
constexpr unsigned int MostPixels = 96;
constexpr double       MostVoxels = 128.0; ///< from the middle of a section to its edge

/** A plane in lengths along the axes of the volume, and the pixels on it. */
struct Plane
{
  Vector       middle{};    ///< between the sides
  Vector       across{};    ///< from one side to the other, to the right in the picture
  Vector       down{};      ///< along the wall
  double       thickness{}; ///< between the sides
  double       step{};      ///< between pixels
  unsigned int pixels{};    ///< of an edge

  Vector
  GetPoint(unsigned int column, unsigned int row) const
  {
    const double half = 0.5 * (pixels - 1);
    return itk::MedialVoxelAddScaled(
      itk::MedialVoxelAddScaled(middle, across, (column - half) * step), down, (row - half) * step);
  }
};

/** The volume with lengths along its axes, three of them. */
class Axes
{
public:
  explicit Axes(const VolumeGeometry & geometry)
    : m_Geometry(geometry)
    , m_Smallest(*std::min_element(geometry.spacing.begin(), geometry.spacing.end()))
  {
    std::copy(geometry.spacing.begin(), geometry.spacing.end(), m_Spacing.begin());
  }

  Plane
  MakePlane(const WallPlace & place) const
  {
    const Vector a = this->ToLengths(place.sideA);
    const Vector between = itk::MedialVoxelSubtract(this->ToLengths(place.sideB), a);
    Plane        plane;
    plane.thickness = itk::MedialVoxelNorm(between);
    plane.middle = itk::MedialVoxelAddScaled(a, between, 0.5);
    plane.across = plane.thickness > 0.0 ? itk::MedialVoxelNormalized(between) : Vector{ { 1.0, 0.0, 0.0 } };
    // The axis that is most along the wall, of a plane image the one across it, is across the section.
    unsigned int axis = 2;
    for (const unsigned int other : { 1, 0 })
    {
      const bool isBetter = std::fabs(plane.across[other]) < std::fabs(plane.across[axis]) - 1e-9;
      axis = m_Geometry.GetDimension() == 3 && isBetter ? other : axis;
    }
    Vector normal{};
    normal[axis] = 1.0;
    normal = itk::MedialVoxelNormalized(itk::MedialVoxelAddScaled(normal, plane.across, -plane.across[axis]));
    plane.down = itk::MedialVoxelCross(normal, plane.across);
    const double reach = std::min(1.25 * plane.thickness + 6.0 * m_Smallest, MostVoxels * m_Smallest);
    plane.pixels = static_cast<unsigned int>(
      std::clamp(std::ceil(4.0 * reach / m_Smallest), double{ LeastPixels }, double{ MostPixels }));
    plane.step = 2.0 * reach / plane.pixels;
    return plane;
  }

  /** Lengths as an index with fractions. */
  Vector
  ToIndex(const Vector & lengths) const
  {
    return { lengths[0] / m_Spacing[0], lengths[1] / m_Spacing[1], lengths[2] / m_Spacing[2] };
  }

private:
  /** A point in space as lengths from the first voxel. */
  Vector
  ToLengths(const WallPlace::Point & point) const
  {
    Vector lengths{};
    for (unsigned int axis = 0; axis < m_Geometry.GetDimension(); ++axis)
    {
      for (unsigned int row = 0; row < m_Geometry.GetDimension(); ++row)
      {
        lengths[axis] += m_Geometry.direction[axis][row] * (point[row] - m_Geometry.origin[row]);
      }
    }
    return lengths;
  }

  const VolumeGeometry & m_Geometry;
  Vector                 m_Spacing{ { 1.0, 1.0, 1.0 } };
  double                 m_Smallest;
};

/** A pixel inside the volume, between two voxels along each axis. */
struct Sample
{
  std::size_t           at; ///< of the pixel, row by row
  itk::MedialVoxelIndex lower{};
  itk::MedialVoxelIndex upper{};
  Vector                share{}; ///< of the upper voxel

  double
  Interpolate(const itk::MedialVoxelGray & slice, std::int64_t z) const
  {
    const auto between = [](double low, double high, double part) { return low + part * (high - low); };
    const auto inRow = [&](std::int64_t y) {
      return between(
        double{ slice.Get({ { lower[0], y, z } }) }, double{ slice.Get({ { upper[0], y, z } }) }, share[0]);
    };
    return between(inRow(lower[1]), inRow(upper[1]), share[1]);
  }
};

std::vector<Sample>
MakeSamples(const Plane & plane, const Axes & axes, const itk::MedialVoxelBox & volume)
{
  std::vector<Sample> samples;
  for (std::size_t at = 0; at < std::size_t{ plane.pixels } * plane.pixels; ++at)
  {
    const Vector index = axes.ToIndex(
      plane.GetPoint(static_cast<unsigned int>(at % plane.pixels), static_cast<unsigned int>(at / plane.pixels)));
    Sample sample{ at };
    bool   isInside = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto   last = volume.upper[axis] - 1;
      const double place = std::clamp(index[axis], 0.0, static_cast<double>(last));
      isInside = isInside && std::fabs(index[axis] - place) <= 0.5 + 1e-9;
      sample.lower[axis] = static_cast<std::int64_t>(place);
      sample.upper[axis] = std::min(sample.lower[axis] + 1, last);
      sample.share[axis] = place - static_cast<double>(sample.lower[axis]);
    }
    if (isInside)
    {
      samples.push_back(sample);
    }
  }
  return samples;
}

/** Reads values slice by slice, so that a section through thick walls takes no more memory than its shadow. */
class Sampler
{
public:
  explicit Sampler(const VolumeHeader & header)
    : m_Volume(header.geometry.GetVoxelBox())
    , m_Source(header, Interpolation::Linear, 0)
    , m_Input(m_Source, m_Volume, {}, itk::MedialVoxelEnums::Smoothing::Off)
  {}

  /** Not a number outside the volume. */
  std::vector<double>
  Read(const Plane & plane, const Axes & axes)
  {
    constexpr double          outside = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Sample> samples = MakeSamples(plane, axes, m_Volume);
    std::vector<double>       values(std::size_t{ plane.pixels } * plane.pixels, outside);
    itk::MedialVoxelBox       box = m_Volume;
    box.lower = m_Volume.upper;
    box.upper = m_Volume.lower;
    for (const Sample & sample : samples)
    {
      values[sample.at] = 0.0;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        box.lower[axis] = std::min(box.lower[axis], sample.lower[axis]);
        box.upper[axis] = std::max(box.upper[axis], sample.upper[axis] + 1);
      }
    }
    for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
    {
      this->AddSlice(samples, z, values);
    }
    return values;
  }

  const itk::MedialVoxelBox &
  GetVolume() const
  {
    return m_Volume;
  }

private:
  /** Adds the share that a slice has in the values. */
  void
  AddSlice(const std::vector<Sample> & samples, std::int64_t z, std::vector<double> & values)
  {
    itk::MedialVoxelBox box{ { m_Volume.upper[0], m_Volume.upper[1], z }, { 0, 0, z + 1 } };
    const auto          getShare = [z](const Sample & sample) {
      return (sample.lower[2] == z ? 1.0 - sample.share[2] : 0.0) + (sample.upper[2] == z ? sample.share[2] : 0.0);
    };
    for (const Sample & sample : samples)
    {
      for (unsigned int axis = 0; axis < 2 && getShare(sample) > 0.0; ++axis)
      {
        box.lower[axis] = std::min(box.lower[axis], sample.lower[axis]);
        box.upper[axis] = std::max(box.upper[axis], sample.upper[axis] + 1);
      }
    }
    if (box.IsEmpty())
    {
      return;
    }
    m_Slice.Frame(box, box);
    m_Input.Fill(box, { nullptr, nullptr, &m_Slice });
    for (const Sample & sample : samples)
    {
      if (const double share = getShare(sample); share > 0.0)
      {
        values[sample.at] += share * sample.Interpolate(m_Slice, z);
      }
    }
  }

  itk::MedialVoxelBox         m_Volume;
  VolumeSource                m_Source;
  itk::MedialVoxelObjectInput m_Input;
  itk::MedialVoxelGray        m_Slice;
};

/** Black to white from the least to the greatest value; blue where there is none. */
std::string
EncodePicture(const std::vector<double> & values, unsigned int pixels)
{
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const double value : values)
  {
    least = std::isfinite(value) ? std::min(least, value) : least;
    greatest = std::isfinite(value) ? std::max(greatest, value) : greatest;
  }
  constexpr Color  outside{ 205, 216, 232 };
  constexpr double white = 255.0;
  Canvas           canvas(pixels, pixels);
  for (std::size_t at = 0; at < values.size(); ++at)
  {
    const double share = greatest > least ? (values[at] - least) / (greatest - least) : 0.5;
    const auto   shade = static_cast<std::uint8_t>(std::isfinite(share) ? std::lround(white * share) : 0);
    canvas.SetPixel(static_cast<unsigned int>(at % pixels),
                    static_cast<unsigned int>(at / pixels),
                    std::isfinite(share) ? Color{ shade, shade, shade } : outside);
  }
  return EncodeBase64(canvas.EncodePng());
}

std::string
DrawSection(const Plane & plane, const std::vector<double> & values)
{
  const std::string edge = std::to_string(plane.pixels);
  const double      middle = 0.5 * plane.pixels;
  const double      half = 0.5 * plane.thickness / plane.step;
  const auto        coordinate = [](double pixel) { return FormatNumber(std::round(100.0 * pixel) / 100.0); };
  const std::string left = coordinate(middle - half);
  const std::string right = coordinate(middle + half);
  const std::string y = coordinate(middle);
  const std::string radius = coordinate(0.03 * plane.pixels);
  const auto        circle = [&](const std::string & x) {
    return "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"" + radius + "\"/>";
  };
  return "<svg class=\"section\" viewBox=\"0 0 " + edge + ' ' + edge +
         "\" role=\"img\" aria-label=\"Section through the values, with both sides of the wall\"><image width=\"" +
         edge + "\" height=\"" + edge + "\" href=\"data:image/png;base64," + EncodePicture(values, plane.pixels) +
         "\"/><line x1=\"" + left + "\" x2=\"" + right + "\" y1=\"" + y + "\" y2=\"" + y + "\"/>" + circle(left) +
         circle(right) + "</svg><br/><span class=\"muted\">" + FormatShort(plane.step * plane.pixels, 3) +
         " wide</span>";
}

} // namespace

std::vector<std::string>
DrawPlaceSections(const std::vector<PlaceSummary> & places, const VolumeHeader & header)
{
  const Axes               axes(header.geometry);
  Sampler                  sampler(header);
  std::vector<std::string> sections;
  for (const PlaceSummary & kind : places)
  {
    for (std::size_t i = 0; i < std::min(kind.places.size(), MostPlacesOfPage); ++i)
    {
      const Plane plane = axes.MakePlane(kind.places[i]);
      sections.push_back(DrawSection(plane, sampler.Read(plane, axes)));
    }
  }
  return sections;
}

std::uint64_t
GetSectionMemory()
{
  // A slice of the longest diagonal, and the samples; pictures of both kinds as text, also in the page while it grows.
  constexpr auto          edge = static_cast<std::uint64_t>(2.0 * 1.5 * MostVoxels);
  constexpr std::uint64_t pixels = std::uint64_t{ MostPixels } * MostPixels;
  constexpr std::uint64_t bytesPerPixel = 3 * 4;
  return edge * edge * sizeof(float) + pixels * (sizeof(Sample) + sizeof(double)) +
         2 * MostPlacesOfPage * bytesPerPixel * pixels;
}

} // end namespace medialvoxel
