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

bool
HasRim(const MedialVoxelTriangleComplex::Neighbors & neighbors)
{
  return std::any_of(neighbors.begin(), neighbors.end(), [](const auto & neighbor) { return neighbor.triangles == 1; });
}

} // namespace

Index
MedialVoxelTriangleComplex::AddVertex(const Point & point)
{
  m_Vertices.push_back({ point, 0.0F, false });
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
  constexpr std::size_t mostlyEnough = 8;
  for (const Index vertex : triangle)
  {
    m_TrianglesOf[vertex].reserve(mostlyEnough);
    m_TrianglesOf[vertex].push_back(number);
  }
  return number;
}

std::vector<bool>
MedialVoxelTriangleComplex::FindWallsKept(const Index numberOfWalls) const
{
  std::vector<bool> isKept(numberOfWalls);
  for (Index triangle = 0; triangle < m_Triangles.size(); ++triangle)
  {
    if (this->IsTriangle(triangle))
    {
      isKept[m_Walls[triangle]] = true;
    }
  }
  return isKept;
}

std::array<MedialVoxelTriangleComplex::Point, 3>
MedialVoxelTriangleComplex::GetCorners(const Index triangle) const
{
  const Triangle & corners = m_Triangles[triangle];
  return { { this->GetPoint(corners[0]), this->GetPoint(corners[1]), this->GetPoint(corners[2]) } };
}

MedialVoxelTriangleComplex::Indices
MedialVoxelTriangleComplex::FindTriangles(const Index a, const Index b) const
{
  Indices found;
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

MedialVoxelTriangleComplex::Neighbors
MedialVoxelTriangleComplex::FindNeighbors(const Index vertex, const Index least) const
{
  // Both ends of the side opposite to the vertex, in each triangle; each vertex mostly comes twice.
  MedialVoxelShortList<Index, 24> others;
  for (const Index triangle : m_TrianglesOf[vertex])
  {
    for (const Index corner : m_Triangles[triangle])
    {
      if (corner != vertex && corner >= least)
      {
        others.push_back(corner);
      }
    }
  }
  std::sort(others.begin(), others.end());
  Neighbors neighbors;
  for (Index * place = others.begin(); place != others.end();)
  {
    Index * const next = std::find_if(place, others.end(), [place](const Index other) { return other != *place; });
    neighbors.push_back({ *place, static_cast<unsigned int>(next - place) });
    place = next;
  }
  return neighbors;
}

MedialVoxelTriangleComplex::Place
MedialVoxelTriangleComplex::GetPlace(const Index vertex) const
{
  if (this->IsShared(vertex))
  {
    return Place::Corner;
  }
  unsigned int rims = 0;
  unsigned int junctions = 0;
  for (const Neighbor & neighbor : this->FindNeighbors(vertex))
  {
    rims += neighbor.triangles == 1 ? 1 : 0;
    junctions += neighbor.triangles > 2 ? 1 : 0;
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
  return HasRim(this->FindNeighbors(vertex));
}

bool
MedialVoxelTriangleComplex::CanCollapse(const Index a, const Neighbors & ofA, const Index b, const bool pinching) const
{
  if (this->IsShared(a))
  {
    return false;
  }
  const Neighbors  ofB = this->FindNeighbors(b);
  unsigned int     triangles = 0;
  unsigned int     common = 0;
  const Neighbor * other = ofB.begin();
  for (const Neighbor & neighbor : ofA)
  {
    other = std::find_if(other, ofB.end(), [&](const Neighbor & next) { return next.vertex >= neighbor.vertex; });
    const bool isCommon = other != ofB.end() && other->vertex == neighbor.vertex;
    triangles = neighbor.vertex == b ? neighbor.triangles : triangles;
    common += isCommon ? 1 : 0;
    if (!isCommon && neighbor.vertex != b && this->IsShared(b) && this->IsShared(neighbor.vertex))
    {
      return false;
    }
  }
  if (triangles == 0 || common != triangles)
  {
    return false;
  }
  if (!pinching && triangles > 1 && HasRim(ofA) && HasRim(ofB))
  {
    return false;
  }
  // Something is to remain, and no triangle twice.
  if (m_TrianglesOf[a].size() == triangles && m_TrianglesOf[b].size() == triangles)
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
  this->Merge(from, to);
}

void
MedialVoxelTriangleComplex::Merge(const Index from, const Index to)
{
  assert(this->CountTriangles(from, to) == 0);
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
