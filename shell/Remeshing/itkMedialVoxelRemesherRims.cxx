// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemesher.h"

#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;
using Index = MedialVoxelTriangleComplex::Index;

/** Of the size: rims that are nearer to each other are one place. */
constexpr double MostOfGap = 0.1;

/** A side of one triangle. */
struct Rim
{
  Index a;
  Index b;
};

/** \class RimLattice
 * \brief Finds the rims around a place: they are in the cubes of their middles, which are as long as the longest one.
 */
class RimLattice
{
public:
  RimLattice(const MedialVoxelTriangleComplex & complex, const std::vector<Rim> & rims)
  {
    for (const Rim & rim : rims)
    {
      m_Edge = std::max(m_Edge, MedialVoxelNorm(MedialVoxelSubtract(complex.GetPoint(rim.a), complex.GetPoint(rim.b))));
    }
    for (const Rim & rim : rims)
    {
      m_Cubes[this->GetCube(MedialVoxelMiddle(complex.GetPoint(rim.a), complex.GetPoint(rim.b)))].push_back(rim);
    }
  }

  std::vector<Rim>
  FindAround(const Vector & point) const
  {
    std::vector<Rim> found;
    const Cube       middle = this->GetCube(point);
    for (int k = 0; k < 27; ++k)
    {
      const auto cube = m_Cubes.find({ { middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1 } });
      if (cube != m_Cubes.end())
      {
        found.insert(found.end(), cube->second.begin(), cube->second.end());
      }
    }
    return found;
  }

private:
  using Cube = std::array<long, 3>;

  Cube
  GetCube(const Vector & point) const
  {
    return { { std::lround(point[0] / m_Edge), std::lround(point[1] / m_Edge), std::lround(point[2] / m_Edge) } };
  }

  double                           m_Edge{ 1e-30 };
  std::map<Cube, std::vector<Rim>> m_Cubes;
};

} // namespace

std::vector<Index>
MedialVoxelRemesher::ListRimVertices() const
{
  std::vector<char> isOnRim(m_Complex.GetNumberOfVertices()); // bytes, as tasks write them
  MedialVoxelForEach(
    m_RunTasks, isOnRim.size(), [&](const Index vertex) { isOnRim[vertex] = m_Complex.IsOnRim(vertex) ? 1 : 0; });
  std::vector<Index> vertices;
  for (Index vertex = 0; vertex < isOnRim.size(); ++vertex)
  {
    if (isOnRim[vertex] != 0)
    {
      vertices.push_back(vertex);
    }
  }
  return vertices;
}

/** Joins rims that lie on each other, as those of a slit that is narrower than elements can be. */
void
MedialVoxelRemesher::ZipRims(const std::vector<Index> & candidates)
{
  std::vector<Rim>   rims;
  std::vector<Index> vertices;
  for (const Index vertex : candidates)
  {
    const Complex::Indices line = this->FindLineNeighbors(vertex, Complex::Place::Rim);
    for (const Index other : line)
    {
      if (vertex < other)
      {
        rims.push_back({ vertex, other });
      }
    }
    if (line.size() > 0)
    {
      vertices.push_back(vertex);
    }
  }
  const RimLattice lattice(m_Complex, rims);
  for (const Index vertex : vertices)
  {
    this->Proceed();
    for (const Rim & rim : lattice.FindAround(m_Complex.GetPoint(vertex)))
    {
      if (this->TryZip(vertex, rim.a, rim.b))
      {
        break;
      }
    }
  }
}

/** Makes a vertex of a rim one of the rim from a to b, when it lies on it. */
bool
MedialVoxelRemesher::TryZip(const Index vertex, const Index a, const Index b)
{
  const double gap = MostOfGap * this->GetSize(vertex, vertex);
  const Vector point = m_Complex.GetPoint(vertex);
  const Vector side = MedialVoxelSubtract(m_Complex.GetPoint(b), m_Complex.GetPoint(a));
  const Vector toPoint = MedialVoxelSubtract(point, m_Complex.GetPoint(a));
  const double length2 = MedialVoxelDot(side, side);
  const double share = length2 > 0.0 ? std::clamp(MedialVoxelDot(side, toPoint) / length2, 0.0, 1.0) : 0.0;
  if (vertex == a || vertex == b || MedialVoxelNorm(MedialVoxelAddScaled(toPoint, side, -share)) >= gap ||
      m_Complex.CountTriangles(a, b) != 1 || m_Complex.GetTrianglesOf(vertex).empty())
  {
    return false;
  }
  for (const Index end : { a, b })
  {
    if (this->GetLength(vertex, end) < gap)
    {
      return this->TryMerge(vertex, end);
    }
  }
  const Index triangle = m_Complex.FindTriangles(a, b)[0];
  const Index corner = m_Complex.GetOpposite(triangle, a, b);
  if (vertex == corner || m_Complex.CountTriangles(vertex, corner) > 0 || m_Complex.CountTriangles(vertex, a) > 1 ||
      m_Complex.CountTriangles(vertex, b) > 1)
  {
    return false;
  }
  std::vector<Index> halves;
  const Index        middle = m_Complex.Split(a, b, point, halves);
  m_Witnesses.Share(triangle, halves[0], m_Complex.GetCorners(triangle), m_Complex.GetCorners(halves[0]));
  m_Complex.Merge(middle, vertex);
  return true;
}

/** Makes two vertices of rims one, unless they have a side, or sides of more than two triangles would come of it. */
bool
MedialVoxelRemesher::TryMerge(const Index from, const Index to)
{
  if (m_Complex.CountTriangles(from, to) > 0 || this->FindLineNeighbors(to, Complex::Place::Rim).size() == 0)
  {
    return false;
  }
  for (const Complex::Neighbor & neighbor : m_Complex.FindNeighbors(from))
  {
    const unsigned int others = m_Complex.CountTriangles(neighbor.vertex, to);
    if (others > 0 && neighbor.triangles + others > 2)
    {
      return false;
    }
  }
  for (const Index triangle : m_Complex.GetTrianglesOf(from))
  {
    Triangle corners = m_Complex.GetTriangle(triangle);
    std::replace(corners.begin(), corners.end(), from, to);
    if (m_Complex.HasTriangle(corners))
    {
      return false;
    }
  }
  m_Complex.Merge(from, to);
  return true;
}

} // end namespace itk
