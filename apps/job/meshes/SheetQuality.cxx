// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetQuality.h"

#include "MeshReader.h"

#include "itkMedialVoxelSheetTree.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace medialvoxel
{
namespace
{

using Index = std::uint32_t;
using Vector = itk::MedialVoxelVector3;

/** Share of the length of a side: a nearer node lies on it. */
constexpr double NearSide = 1e-3;

struct Element
{
  std::array<Index, 4> corners{};
  unsigned int         numberOfCorners{ 0 };
};

struct Mesh
{
  std::vector<Vector>  points;
  std::vector<Element> elements;
};

Mesh
ReadMesh(const MeshSpool & surface)
{
  Mesh       mesh;
  MeshReader reader(surface, {});
  reader.ForEachVertex(
    [&](std::uint64_t, const MeshReader::Vertex & vertex) { mesh.points.push_back(vertex.position); });
  const auto add = [&](std::uint64_t, const MeshFace & face) {
    mesh.elements.push_back({ {}, face.numberOfVertices });
    std::transform(face.vertices.begin(),
                   face.vertices.begin() + face.numberOfVertices,
                   mesh.elements.back().corners.begin(),
                   [](const std::uint64_t vertex) { return static_cast<Index>(vertex); });
  };
  reader.ForEachFace(add, MeshFaceFields::Corners);
  return mesh;
}

/** An element at a side, and whether the element goes from the lower to the higher node. */
struct Side
{
  Index low;
  Index high;
  Index element;
  bool  isUp;
};

bool
AreSame(const Side & a, const Side & b)
{
  return a.low == b.low && a.high == b.high;
}

std::vector<Side>
ListSides(const Mesh & mesh)
{
  std::vector<Side> sides;
  for (Index number = 0; number < mesh.elements.size(); ++number)
  {
    const Element & element = mesh.elements[number];
    for (unsigned int k = 0; k < element.numberOfCorners; ++k)
    {
      const Index a = element.corners[k];
      const Index b = element.corners[(k + 1) % element.numberOfCorners];
      sides.push_back({ std::min(a, b), std::max(a, b), number, a < b });
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side & a, const Side & b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.element < b.element;
  });
  return sides;
}

void
MeasureShapes(const Mesh & mesh, MeshQuality & quality)
{
  itk::MedialVoxelElementShapes shapes;
  for (const Element & element : mesh.elements)
  {
    shapes.Add(mesh.points, element.corners, element.numberOfCorners);
    (element.numberOfCorners == 4 ? quality.quads : quality.triangles) += 1;
  }
  quality.shapes = shapes.Summarize();
}

/** How many of sorted values come again. */
template <typename TValue>
std::uint64_t
CountRepeated(std::vector<TValue> & values)
{
  std::sort(values.begin(), values.end());
  return static_cast<std::uint64_t>(values.end() - std::unique(values.begin(), values.end()));
}

void
CountRepeated(const Mesh & mesh, MeshQuality & quality)
{
  std::vector<bool>                 isUsed(mesh.points.size());
  std::vector<std::array<Index, 4>> elements;
  for (const Element & element : mesh.elements)
  {
    std::array<Index, 4> corners = element.corners;
    for (unsigned int k = 0; k < element.numberOfCorners; ++k)
    {
      isUsed[corners[k]] = true;
    }
    corners[3] = element.numberOfCorners == 4 ? corners[3] : ~Index{ 0 };
    std::sort(corners.begin(), corners.end());
    elements.push_back(corners);
  }
  std::vector<Vector> places;
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    if (isUsed[point])
    {
      places.push_back(mesh.points[point]);
    }
  }
  quality.nodes = places.size();
  quality.sameNodes = CountRepeated(places);
  quality.sameElements = CountRepeated(elements);
}

/** Nodes of rims that lie on the side of another element, by the places along x of rim nodes. */
void
CountHanging(const Mesh & mesh, const std::vector<Side> & rims, MeshQuality & quality)
{
  std::vector<std::pair<double, Index>> nodes;
  for (const Side & side : rims)
  {
    nodes.emplace_back(mesh.points[side.low][0], side.low);
    nodes.emplace_back(mesh.points[side.high][0], side.high);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::set<Index> hanging;
  for (const Side & side : rims)
  {
    const Vector & a = mesh.points[side.low];
    const Vector & b = mesh.points[side.high];
    const double   near = NearSide * itk::MedialVoxelNorm(itk::MedialVoxelSubtract(a, b));
    const auto     end = std::max(a[0], b[0]) + near;
    auto node = std::lower_bound(nodes.begin(), nodes.end(), std::make_pair(std::min(a[0], b[0]) - near, Index{ 0 }));
    for (; node != nodes.end() && node->first <= end; ++node)
    {
      const Vector & point = mesh.points[node->second];
      const auto     distanceTo = [&](const Vector & other) {
        return itk::MedialVoxelNorm(itk::MedialVoxelSubtract(point, other));
      };
      if (node->second != side.low && node->second != side.high && distanceTo(a) > near && distanceTo(b) > near &&
          distanceTo(itk::MedialVoxelNearestOfTriangle(point, { { a, b, b } })) <= near)
      {
        hanging.insert(node->second);
      }
    }
  }
  quality.hangingNodes = hanging.size();
}

/** \class Walls
 * \brief Joins elements over sides that two of them share. Each element counts twice, as it is and turned: a wall
 * that joins an element with its turned self has one side only. */
class Walls
{
public:
  explicit Walls(const std::size_t elements)
    : m_Parents(2 * elements)
  {
    std::iota(m_Parents.begin(), m_Parents.end(), Index{ 0 });
  }

  /** \param areAlike whether both elements go the same way along their side, so that they are turned differently */
  void
  Join(const Index a, const Index b, const bool areAlike)
  {
    for (const Index way : { 0u, 1u })
    {
      const Index rootOfA = this->Find(2 * a + way);
      const Index rootOfB = this->Find(2 * b + (areAlike ? 1 - way : way));
      m_Parents[std::max(rootOfA, rootOfB)] = std::min(rootOfA, rootOfB);
    }
    if (areAlike)
    {
      m_Turned.push_back(a);
    }
  }

  void
  Count(MeshQuality & quality)
  {
    for (Index way = 0; way < m_Parents.size(); way += 2)
    {
      quality.walls += this->FindWall(way / 2) == way ? 1 : 0;
      quality.oneSidedWalls += this->FindWall(way / 2) == way && this->IsOneSided(way / 2) ? 1 : 0;
    }
    std::set<Index> turned;
    for (const Index element : m_Turned)
    {
      if (!this->IsOneSided(element))
      {
        turned.insert(this->FindWall(element));
      }
    }
    quality.turnedWalls = turned.size();
  }

private:
  /** The first way of its wall's first element, as roots are the lowest. */
  Index
  FindWall(const Index element)
  {
    return std::min(this->Find(2 * element), this->Find(2 * element + 1));
  }

  bool
  IsOneSided(const Index element)
  {
    return this->Find(2 * element) == this->Find(2 * element + 1);
  }

  Index
  Find(Index way)
  {
    for (; m_Parents[way] != way; way = m_Parents[way])
    {
      m_Parents[way] = m_Parents[m_Parents[way]];
    }
    return way;
  }

  std::vector<Index> m_Parents;
  std::vector<Index> m_Turned; ///< elements that are turned against a neighbor
};

void
CountSides(const Mesh & mesh, MeshQuality & quality)
{
  const std::vector<Side> sides = ListSides(mesh);
  std::vector<Side>       rims;
  Walls                   walls(mesh.elements.size());
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && AreSame(sides[first], sides[last]))
    {
      ++last;
    }
    if (last - first == 1)
    {
      rims.push_back(sides[first]);
    }
    else if (last - first == 2)
    {
      walls.Join(sides[first].element, sides[first + 1].element, sides[first].isUp == sides[first + 1].isUp);
    }
    else
    {
      ++quality.junctionSides;
    }
  }
  quality.rimSides = rims.size();
  walls.Count(quality);
  CountHanging(mesh, rims, quality);
}

} // namespace

MeshQuality
MeasureQuality(const MeshSpool & surface)
{
  const Mesh  mesh = ReadMesh(surface);
  MeshQuality quality;
  MeasureShapes(mesh, quality);
  CountRepeated(mesh, quality);
  CountSides(mesh, quality);
  return quality;
}

} // end namespace medialvoxel
