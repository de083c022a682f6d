// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestElements_h
#define MedialVoxelTestElements_h

// Remeshed surfaces of test volumes, and what they must keep, found without the remesher's own tools.

#include "itkMedialVoxelRemeshedSheet.h"

#include "MedialVoxelTestSurface.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

namespace MedialVoxelTest
{
using FaceList = std::vector<std::vector<std::uint32_t>>;

/** Triangles and quadrilaterals with their points. */
struct Faces
{
  std::vector<Vector3> points;
  FaceList             faces;

  /** How many faces each side has. */
  std::map<std::pair<std::uint32_t, std::uint32_t>, int>
  CountSides() const
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto & face : faces)
    {
      for (std::size_t k = 0; k < face.size(); ++k)
      {
        ++sides[std::minmax(face[k], face[(k + 1) % face.size()])];
      }
    }
    return sides;
  }

  /** Points that are in use, less sides, plus faces. */
  long
  GetEulerNumber() const
  {
    std::set<std::uint32_t> used;
    for (const auto & face : faces)
    {
      used.insert(face.begin(), face.end());
    }
    return static_cast<long>(used.size()) - static_cast<long>(this->CountSides().size()) +
           static_cast<long>(faces.size());
  }

  double
  GetArea() const
  {
    double sum = 0.0;
    for (const auto & face : faces)
    {
      for (std::size_t k = 2; k < face.size(); ++k)
      {
        const Vector3 normal = Cross(points[face[0]], points[face[k - 1]], points[face[k]]);
        sum += std::sqrt(Dot(normal, normal)) / 2;
      }
    }
    return sum;
  }

  /** The middles of the sides of one face, or of more than two. */
  std::vector<Vector3>
  ListMiddles(bool atJunctions) const
  {
    std::vector<Vector3> middles;
    for (const auto & [side, number] : this->CountSides())
    {
      if (atJunctions ? number > 2 : number == 1)
      {
        const Vector3 & a = points[side.first];
        const Vector3 & b = points[side.second];
        middles.push_back({ { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2 } });
      }
    }
    return middles;
  }

  /** Points all over the faces, not farther apart than `step`. */
  std::vector<Vector3>
  Sample(double step) const
  {
    std::vector<Vector3> samples;
    for (const auto & face : faces)
    {
      for (std::size_t k = 2; k < face.size(); ++k)
      {
        const Vector3 & a = points[face[0]];
        const Vector3 & b = points[face[k - 1]];
        const Vector3 & c = points[face[k]];
        const double    longest = std::max(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]),
                                        std::hypot(c[0] - a[0], c[1] - a[1], c[2] - a[2]));
        const int       parts = static_cast<int>(longest / step) + 1;
        for (int i = 0; i <= parts; ++i)
        {
          for (int j = 0; i + j <= parts; ++j)
          {
            Vector3 sample;
            for (int axis = 0; axis < 3; ++axis)
            {
              sample[axis] = a[axis] + (b[axis] - a[axis]) * i / parts + (c[axis] - a[axis]) * j / parts;
            }
            samples.push_back(sample);
          }
        }
      }
    }
    return samples;
  }
};

/** The largest distance of a point to the nearest of others. */
inline double
LargestGap(const std::vector<Vector3> & points, const std::vector<Vector3> & others)
{
  double largest = 0.0;
  for (const Vector3 & p : points)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector3 & q : others)
    {
      nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

/** The sheet of a volume, as triangles. */
inline itk::MedialVoxelSheet
SheetOf(const Surface & surface)
{
  itk::MedialVoxelSheet sheet;
  for (const auto & vertex : surface.vertices)
  {
    sheet.points.push_back(vertex.point);
    sheet.thickness.push_back(static_cast<float>(vertex.thickness));
  }
  for (const auto & quad : surface.quads)
  {
    std::array<std::uint32_t, 4> corners;
    std::copy(quad.vertices.begin(), quad.vertices.end(), corners.begin());
    sheet.AddQuad(corners);
  }
  sheet.RemoveDuplicates();
  return sheet;
}

inline Faces
FacesOf(const itk::MedialVoxelSheet & sheet)
{
  Faces result{ sheet.points, {} };
  for (const auto & corners : sheet.triangles)
  {
    result.faces.emplace_back(corners.begin(), corners.end());
  }
  return result;
}

inline Faces
FacesOf(const itk::MedialVoxelRemeshedSheet & sheet)
{
  Faces result{ sheet.points, {} };
  for (const auto & element : sheet.elements)
  {
    result.faces.emplace_back(element.corners.begin(), element.corners.begin() + element.numberOfCorners);
  }
  return result;
}

/** Of the corners of a triangle or quadrilateral: the least sine of an angle that turns the way the face does. */
inline double
LeastSine(const std::vector<Vector3> & corners)
{
  const std::size_t n = corners.size();
  Vector3           normal{};
  for (std::size_t k = 2; k < n; ++k)
  {
    const Vector3 part = Cross(corners[0], corners[k - 1], corners[k]);
    for (int axis = 0; axis < 3; ++axis)
    {
      normal[axis] += part[axis];
    }
  }
  double least = 1.0;
  for (std::size_t k = 0; k < n; ++k)
  {
    const Vector3 & a = corners[k];
    const Vector3 & b = corners[(k + 1) % n];
    const Vector3 & c = corners[(k + n - 1) % n];
    const double    lengths = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) *
                           std::hypot(c[0] - a[0], c[1] - a[1], c[2] - a[2]) * std::sqrt(Dot(normal, normal));
    least = std::min(least, lengths > 0 ? Dot(Cross(a, b, c), normal) / lengths : 0.0);
  }
  return least;
}

inline std::vector<double>
SinesOf(const Faces & faces)
{
  std::vector<double> sines;
  for (const auto & face : faces.faces)
  {
    std::vector<Vector3> corners;
    for (const auto point : face)
    {
      corners.push_back(faces.points[point]);
    }
    sines.push_back(LeastSine(corners));
  }
  std::sort(sines.begin(), sines.end());
  return sines;
}
/** A square of squares of the length 1; those whose corner is given as outside are left out. */
inline itk::MedialVoxelSheet
FlatSquare(
  const int                                 n,
  const float                               thickness,
  const std::function<bool(int x, int y)> & isInside = [](int, int) { return true; })
{
  itk::MedialVoxelSheet sheet;
  for (int y = 0; y <= n; ++y)
  {
    for (int x = 0; x <= n; ++x)
    {
      sheet.points.push_back({ { double(x), double(y), 0.0 } });
      sheet.thickness.push_back(thickness);
    }
  }
  for (int y = 0; y < n; ++y)
  {
    for (int x = 0; x < n; ++x)
    {
      const auto corner = static_cast<std::uint32_t>(y * (n + 1) + x);
      if (isInside(x, y))
      {
        sheet.AddQuad({ { corner, corner + 1, corner + n + 2, corner + n + 1 } });
      }
    }
  }
  return sheet;
}

} // namespace MedialVoxelTest

#endif // MedialVoxelTestElements_h
