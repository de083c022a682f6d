// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelTriangleComplex.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Index = MedialVoxelTriangleComplex::Index;
using Triangle = MedialVoxelTriangleComplex::Triangle;

bool
Contains(const Triangle & triangle, const Index vertex)
{
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

void
Replace(Triangle & triangle, const Index from, const Index to)
{
  std::replace(triangle.begin(), triangle.end(), from, to);
}

} // namespace

Index
MedialVoxelTriangleComplex::AddVertex(const Point & point)
{
  m_Vertices.push_back({ point, 0.0F });
  m_TrianglesOf.emplace_back();
  return static_cast<Index>(m_Vertices.size() - 1);
}

Index
MedialVoxelTriangleComplex::AddTriangle(const Triangle & triangle, const Index wall)
{
  assert(triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]);
  assert(!this->HasTriangle(triangle));
  auto number = static_cast<Index>(m_Triangles.size());
  if (m_Free.empty())
  {
    m_Triangles.push_back(triangle);
    m_Walls.push_back(wall);
  }
  else
  {
    number = m_Free.back();
    m_Free.pop_back();
    m_Triangles[number] = triangle;
    m_Walls[number] = wall;
  }
  for (const Index vertex : triangle)
  {
    m_TrianglesOf[vertex].push_back(number);
  }
  return number;
}

std::array<MedialVoxelTriangleComplex::Point, 3>
MedialVoxelTriangleComplex::GetCorners(const Index triangle) const
{
  const Triangle & corners = m_Triangles[triangle];
  return { { this->GetPoint(corners[0]), this->GetPoint(corners[1]), this->GetPoint(corners[2]) } };
}

std::vector<Index>
MedialVoxelTriangleComplex::FindTriangles(const Index a, const Index b) const
{
  std::vector<Index> found;
  for (const Index triangle : m_TrianglesOf[a])
  {
    if (Contains(m_Triangles[triangle], b))
    {
      found.push_back(triangle);
    }
  }
  return found;
}

unsigned int
MedialVoxelTriangleComplex::CountTriangles(const Index a, const Index b) const
{
  const std::vector<Index> & triangles = m_TrianglesOf[a];
  return static_cast<unsigned int>(std::count_if(
    triangles.begin(), triangles.end(), [&](const Index triangle) { return Contains(m_Triangles[triangle], b); }));
}

bool
MedialVoxelTriangleComplex::HasTriangle(const Triangle & triangle) const
{
  const std::vector<Index> & triangles = m_TrianglesOf[triangle[0]];
  return std::any_of(triangles.begin(), triangles.end(), [&](const Index other) {
    return Contains(m_Triangles[other], triangle[1]) && Contains(m_Triangles[other], triangle[2]);
  });
}

Index
MedialVoxelTriangleComplex::GetOpposite(const Index triangle, const Index a, const Index b) const
{
  for (const Index vertex : m_Triangles[triangle])
  {
    if (vertex != a && vertex != b)
    {
      return vertex;
    }
  }
  return None;
}

std::vector<Index>
MedialVoxelTriangleComplex::FindNeighbors(const Index vertex) const
{
  std::vector<Index> neighbors;
  neighbors.reserve(2 * m_TrianglesOf[vertex].size());
  for (const Index triangle : m_TrianglesOf[vertex])
  {
    for (const Index other : m_Triangles[triangle])
    {
      if (other != vertex)
      {
        neighbors.push_back(other);
      }
    }
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  return neighbors;
}

MedialVoxelTriangleComplex::Place
MedialVoxelTriangleComplex::GetPlace(const Index vertex) const
{
  unsigned int             rims = 0;
  unsigned int             junctions = 0;
  const std::vector<Index> neighbors = this->FindNeighbors(vertex);
  for (const Index other : neighbors)
  {
    const unsigned int triangles = this->CountTriangles(vertex, other);
    rims += triangles == 1 ? 1 : 0;
    junctions += triangles > 2 ? 1 : 0;
  }
  if (rims == 2 && junctions == 0)
  {
    return Place::Rim;
  }
  if (rims == 0 && junctions == 2)
  {
    return Place::Junction;
  }
  return rims == 0 && junctions == 0 ? Place::Wall : Place::Corner;
}

bool
MedialVoxelTriangleComplex::IsOnRim(const Index vertex) const
{
  const std::vector<Index> neighbors = this->FindNeighbors(vertex);
  return std::any_of(
    neighbors.begin(), neighbors.end(), [&](const Index other) { return this->CountTriangles(vertex, other) == 1; });
}

bool
MedialVoxelTriangleComplex::CanCollapse(const Index a, const Index b, const bool pinching) const
{
  const std::vector<Index> triangles = this->FindTriangles(a, b);
  const std::vector<Index> ofA = this->FindNeighbors(a);
  const std::vector<Index> ofB = this->FindNeighbors(b);
  std::vector<Index>       common;
  std::set_intersection(ofA.begin(), ofA.end(), ofB.begin(), ofB.end(), std::back_inserter(common));
  if (triangles.empty() || common.size() != triangles.size())
  {
    return false;
  }
  if (!pinching && triangles.size() > 1 && this->IsOnRim(a) && this->IsOnRim(b))
  {
    return false;
  }
  // Something is to remain, and no triangle twice.
  if (m_TrianglesOf[a].size() == triangles.size() && m_TrianglesOf[b].size() == triangles.size())
  {
    return false;
  }
  return std::none_of(m_TrianglesOf[a].begin(), m_TrianglesOf[a].end(), [&](const Index triangle) {
    Triangle moved = m_Triangles[triangle];
    if (Contains(moved, b))
    {
      return false;
    }
    Replace(moved, a, b);
    return this->HasTriangle(moved);
  });
}

void
MedialVoxelTriangleComplex::Collapse(const Index from, const Index to)
{
  assert(this->CanCollapse(from, to));
  for (const Index triangle : this->FindTriangles(from, to))
  {
    this->RemoveTriangle(triangle);
  }
  for (const Index triangle : m_TrianglesOf[from])
  {
    Replace(m_Triangles[triangle], from, to);
    m_TrianglesOf[to].push_back(triangle);
  }
  std::vector<Index>().swap(m_TrianglesOf[from]);
}

Index
MedialVoxelTriangleComplex::Split(const Index a, const Index b, const Point & point, std::vector<Index> & halves)
{
  halves.clear();
  const Index middle = this->AddVertex(point);
  m_Vertices[middle].size = (m_Vertices[a].size + m_Vertices[b].size) / 2;
  for (const Index triangle : this->FindTriangles(a, b))
  {
    Triangle half = m_Triangles[triangle];
    this->Detach(triangle, b);
    Replace(m_Triangles[triangle], b, middle);
    m_TrianglesOf[middle].push_back(triangle);
    Replace(half, a, middle);
    halves.push_back(this->AddTriangle(half, m_Walls[triangle]));
  }
  return middle;
}

void
MedialVoxelTriangleComplex::RemoveTriangle(const Index triangle)
{
  for (const Index vertex : m_Triangles[triangle])
  {
    this->Detach(triangle, vertex);
  }
  m_Triangles[triangle] = { { None, None, None } };
  m_Free.push_back(triangle);
}

void
MedialVoxelTriangleComplex::Detach(const Index triangle, const Index vertex)
{
  std::vector<Index> & triangles = m_TrianglesOf[vertex];
  triangles.erase(std::find(triangles.begin(), triangles.end(), triangle));
}

} // end namespace itk
