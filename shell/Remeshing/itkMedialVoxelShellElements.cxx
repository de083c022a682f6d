// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelShellElements.h"

#include "itkMedialVoxelElementQuality.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Complex = MedialVoxelTriangleComplex;
using Index = Complex::Index;
using Triangle = Complex::Triangle;

constexpr double LeastCosine = 0.9;
constexpr double LeastQuality = 0.4;
constexpr double MostAspect = 4.0;

/** Whether a triangle goes from a to b. */
bool
GoesAlong(const Triangle & triangle, const Index a, const Index b)
{
  return (triangle[0] == a && triangle[1] == b) || (triangle[1] == a && triangle[2] == b) ||
         (triangle[2] == a && triangle[0] == b);
}

/** The other triangle of a side of two. */
Index
GetOther(const Complex & complex, const Index triangle, const Index a, const Index b)
{
  const Complex::Indices triangles = complex.FindTriangles(a, b);
  return triangles.size() != 2 ? Complex::None : triangles[0] == triangle ? triangles[1] : triangles[0];
}

/** Whether the normals at all corners are nearly the same: solvers turn thick elements over that are not. */
bool
IsNearlyFlat(const std::array<MedialVoxelVector3, 4> & points)
{
  std::array<MedialVoxelVector3, 4> normals;
  for (std::size_t corner = 0; corner < 4; ++corner)
  {
    normals[corner] =
      MedialVoxelTriangleNormal({ { points[(corner + 3) % 4], points[corner], points[(corner + 1) % 4] } });
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    for (std::size_t k = i + 1; k < 4; ++k)
    {
      const double lengths = MedialVoxelNorm(normals[i]) * MedialVoxelNorm(normals[k]);
      if (!(MedialVoxelDot(normals[i], normals[k]) > LeastCosine * lengths))
      {
        return false;
      }
    }
  }
  return true;
}

struct Pair
{
  double                  quality;
  Index                   first;
  Index                   second;
  MedialVoxelShellElement element;
};

/** Both triangles, when they make a good element. */
bool
MakePair(const Complex &               complex,
         const std::vector<Triangle> & corners,
         const Index                   first,
         const unsigned int            k,
         Pair &                        pair)
{
  const Index a = corners[first][k];
  const Index b = corners[first][(k + 1) % 3];
  const Index second = GetOther(complex, first, a, b);
  if (second == Complex::None || second < first || !GoesAlong(corners[second], b, a))
  {
    return false;
  }
  pair.element.corners = { { a, complex.GetOpposite(second, a, b), b, complex.GetOpposite(first, a, b) } };
  pair.element.numberOfCorners = 4;
  pair.element.wall = complex.GetWall(first);
  std::array<MedialVoxelVector3, 4> points;
  for (unsigned int corner = 0; corner < 4; ++corner)
  {
    points[corner] = complex.GetPoint(pair.element.corners[corner]);
  }
  pair.quality = MedialVoxelScaledJacobian(points);
  pair.first = first;
  pair.second = second;
  return IsNearlyFlat(points) && pair.quality >= LeastQuality && MedialVoxelAspectRatio(points) <= MostAspect;
}

void
MarkSides(const Complex & complex, MedialVoxelShellElement & element)
{
  for (unsigned int k = 0; k < element.numberOfCorners; ++k)
  {
    const unsigned int triangles =
      complex.CountTriangles(element.corners[k], element.corners[(k + 1) % element.numberOfCorners]);
    element.rimSides = static_cast<std::uint8_t>(element.rimSides | (triangles == 1 ? 1u << k : 0u));
    element.junctionSides = static_cast<std::uint8_t>(element.junctionSides | (triangles > 2 ? 1u << k : 0u));
  }
}

} // namespace

std::uint64_t
MedialVoxelOrientWalls(const Complex & complex, std::vector<Triangle> & corners)
{
  corners.assign(complex.GetNumberOfTriangles(), { { Complex::None, Complex::None, Complex::None } });
  std::uint64_t      conflicts = 0;
  std::vector<Index> queue;
  for (Index start = 0; start < complex.GetNumberOfTriangles(); ++start)
  {
    if (!complex.IsTriangle(start) || corners[start][0] != Complex::None)
    {
      continue;
    }
    corners[start] = complex.GetTriangle(start);
    queue.assign(1, start);
    for (std::size_t next = 0; next < queue.size(); ++next)
    {
      const Index triangle = queue[next];
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Index a = corners[triangle][k];
        const Index b = corners[triangle][(k + 1) % 3];
        const Index other = GetOther(complex, triangle, a, b);
        if (other == Complex::None)
        {
          continue;
        }
        if (corners[other][0] == Complex::None)
        {
          corners[other] = complex.GetTriangle(other);
          if (GoesAlong(corners[other], a, b))
          {
            std::swap(corners[other][1], corners[other][2]);
          }
          queue.push_back(other);
        }
        else if (other > triangle && GoesAlong(corners[other], a, b))
        {
          ++conflicts;
        }
      }
    }
  }
  return conflicts;
}

std::vector<MedialVoxelShellElement>
MedialVoxelPairTriangles(const Complex & complex, const std::vector<Triangle> & corners, const bool joins)
{
  assert(corners.size() == complex.GetNumberOfTriangles());
  std::vector<Pair> pairs;
  for (Index triangle = 0; triangle < corners.size(); ++triangle)
  {
    for (unsigned int k = 0; k < 3 && joins && complex.IsTriangle(triangle); ++k)
    {
      Pair pair{};
      if (MakePair(complex, corners, triangle, k, pair))
      {
        pairs.push_back(pair);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair & x, const Pair & y) {
    return x.quality != y.quality ? x.quality > y.quality
           : x.first != y.first   ? x.first < y.first
                                  : x.second < y.second;
  });
  std::vector<MedialVoxelShellElement> elements;
  std::vector<bool>                    isTaken(corners.size());
  for (const Pair & pair : pairs)
  {
    if (!isTaken[pair.first] && !isTaken[pair.second])
    {
      isTaken[pair.first] = isTaken[pair.second] = true;
      elements.push_back(pair.element);
    }
  }
  for (Index triangle = 0; triangle < corners.size(); ++triangle)
  {
    if (complex.IsTriangle(triangle) && !isTaken[triangle])
    {
      MedialVoxelShellElement element;
      element.corners = { { corners[triangle][0], corners[triangle][1], corners[triangle][2], 0 } };
      element.wall = complex.GetWall(triangle);
      elements.push_back(element);
    }
  }
  for (MedialVoxelShellElement & element : elements)
  {
    MarkSides(complex, element);
  }
  return elements;
}

} // end namespace itk
