// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshCheck.h"

#include "itkMedialVoxelSheetTree.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace medialvoxel
{
namespace
{

using Index = std::uint32_t;
using Vector = itk::MedialVoxelVector3;

/** Of the length of a side: a node that is nearer to it lies on it. */
constexpr double NearSide = 1e-3;

/** Of a side, with the place of its element and whether the element goes from the lower to the higher node. */
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
ListSides(const MeshFile & mesh)
{
  std::vector<Side> sides;
  for (Index number = 0; number < mesh.elements.size(); ++number)
  {
    const MeshFile::Element & element = mesh.elements[number];
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
CheckShapes(const MeshFile & mesh, MeshCheck & check)
{
  itk::MedialVoxelElementShapes shapes;
  for (const MeshFile::Element & element : mesh.elements)
  {
    shapes.Add(mesh.points, element.corners, element.numberOfCorners);
    (element.numberOfCorners == 4 ? check.quads : check.triangles) += 1;
  }
  check.shapes = shapes.Summarize();
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
CheckRepeated(const MeshFile & mesh, MeshCheck & check)
{
  std::vector<bool>                 isUsed(mesh.points.size());
  std::vector<std::array<Index, 4>> elements;
  for (const MeshFile::Element & element : mesh.elements)
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
  check.nodes = places.size();
  check.sameNodes = CountRepeated(places);
  check.sameElements = CountRepeated(elements);
}

/** Nodes of rims that lie on the side of another element, by the places along x of rim nodes. */
void
CheckHanging(const MeshFile & mesh, const std::vector<Side> & rims, MeshCheck & check)
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
  check.hangingNodes = hanging.size();
}

/** \class WallTurns
 * \brief Walls that join over sides of two elements, and for each element whether it is turned against the first one.
 */
class WallTurns
{
public:
  explicit WallTurns(const std::size_t elements)
    : m_Parents(elements)
    , m_IsTurned(elements)
    , m_IsOneSided(elements)
    , m_IsMixed(elements)
  {
    for (std::size_t element = 0; element < elements; ++element)
    {
      m_Parents[element] = static_cast<Index>(element);
    }
  }

  /** \param areAlike whether both elements go the same way along their side, so that they are turned differently */
  void
  Join(const Index a, const Index b, const bool areAlike)
  {
    const auto [rootOfA, turnOfA] = this->Find(a);
    const auto [rootOfB, turnOfB] = this->Find(b);
    const bool differs = (turnOfA != turnOfB) != areAlike;
    if (rootOfA == rootOfB)
    {
      m_IsOneSided[rootOfA] = m_IsOneSided[rootOfA] || differs;
      m_IsMixed[rootOfA] = m_IsMixed[rootOfA] || areAlike;
      return;
    }
    const Index root = std::min(rootOfA, rootOfB);
    const Index other = std::max(rootOfA, rootOfB);
    m_Parents[other] = root;
    m_IsTurned[other] = differs;
    m_IsOneSided[root] = m_IsOneSided[root] || m_IsOneSided[other];
    m_IsMixed[root] = m_IsMixed[root] || m_IsMixed[other] || areAlike;
  }

  void
  Count(MeshCheck & check) const
  {
    for (std::size_t element = 0; element < m_Parents.size(); ++element)
    {
      if (m_Parents[element] == element)
      {
        ++check.walls;
        check.oneSidedWalls += m_IsOneSided[element] ? 1 : 0;
        check.turnedWalls += m_IsMixed[element] && !m_IsOneSided[element] ? 1 : 0;
      }
    }
  }

private:
  std::pair<Index, bool>
  Find(const Index element)
  {
    std::vector<Index> path;
    Index              root = element;
    for (; m_Parents[root] != root; root = m_Parents[root])
    {
      path.push_back(root);
    }
    bool turn = false;
    for (auto step = path.rbegin(); step != path.rend(); ++step)
    {
      turn = turn != m_IsTurned[*step];
      m_IsTurned[*step] = turn;
      m_Parents[*step] = root;
    }
    return { root, turn };
  }

  std::vector<Index> m_Parents;
  std::vector<bool>  m_IsTurned; ///< against its parent
  std::vector<bool>  m_IsOneSided;
  std::vector<bool>  m_IsMixed;
};

void
CheckSides(const MeshFile & mesh, MeshCheck & check)
{
  const std::vector<Side> sides = ListSides(mesh);
  std::vector<Side>       rims;
  WallTurns               walls(mesh.elements.size());
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
      ++check.junctionSides;
    }
  }
  check.rimSides = rims.size();
  walls.Count(check);
  CheckHanging(mesh, rims, check);
}

std::string
FormatLimit(const MeshLimit & limit)
{
  return FormatShort(limit.value) +
         (limit.Holds()   ? ""
          : limit.isLeast ? ", less than "
                          : ", more than ") +
         (limit.Holds() ? "" : FormatShort(limit.limit));
}

} // namespace

MeshCheck
CheckMesh(const MeshFile & mesh)
{
  MeshCheck check;
  CheckShapes(mesh, check);
  CheckRepeated(mesh, check);
  CheckSides(mesh, check);
  return check;
}

std::vector<MeshLimit>
ListMeshLimits(const MeshCheck & check)
{
  const auto number = [](const std::uint64_t count) { return static_cast<double>(count); };
  return { { "elements without a positive Jacobian", number(check.shapes.notPositive), 0, false },
           { "scaled Jacobian of 99 %", check.shapes.lowJacobian, 0.3, true },
           { "aspect ratio of 99 %", check.shapes.highAspect, 5, false },
           { "nodes at one place", number(check.sameNodes), 0, false },
           { "elements with the same nodes", number(check.sameElements), 0, false },
           { "hanging nodes", number(check.hangingNodes), 0, false },
           { "walls turned both ways", number(check.turnedWalls), 0, false } };
}

TextTable
DescribeMeshCheck(const MeshCheck & check)
{
  TextTable                    table{ { "nodes", std::to_string(check.nodes) },
                                      { "triangles", std::to_string(check.triangles) },
                                      { "quadrilaterals", std::to_string(check.quads) },
                                      { "sides of one element", std::to_string(check.rimSides) },
                                      { "sides of more than two", std::to_string(check.junctionSides) },
                                      { "walls", std::to_string(check.walls) },
                                      { "walls with one side only", std::to_string(check.oneSidedWalls) },
                                      { "least scaled Jacobian", FormatShort(check.shapes.leastJacobian) },
                                      { "largest aspect ratio", FormatShort(check.shapes.largestAspect) } };
  const std::vector<MeshLimit> limits = ListMeshLimits(check);
  for (const MeshLimit & limit : limits)
  {
    table.emplace_back(limit.name, FormatLimit(limit));
  }
  const bool holds = std::all_of(limits.begin(), limits.end(), [](const MeshLimit & limit) { return limit.Holds(); });
  table.emplace_back("all limits hold", holds ? "yes" : "no");
  return table;
}

std::string
MakeMeshCheckJson(const std::string & fileName, const MeshCheck & check)
{
  nlohmann::ordered_json json{ { "mesh", fileName },
                               { "nodes", check.nodes },
                               { "triangles", check.triangles },
                               { "quadrilaterals", check.quads },
                               { "rim_sides", check.rimSides },
                               { "junction_sides", check.junctionSides },
                               { "walls", check.walls },
                               { "one_sided_walls", check.oneSidedWalls },
                               { "least_scaled_jacobian", check.shapes.leastJacobian },
                               { "largest_aspect_ratio", check.shapes.largestAspect },
                               { "limits", nlohmann::ordered_json::array() } };
  for (const MeshLimit & limit : ListMeshLimits(check))
  {
    json["limits"].push_back({ { "name", limit.name },
                               { "value", limit.value },
                               { limit.isLeast ? "least" : "most", limit.limit },
                               { "holds", limit.Holds() } });
  }
  return json.dump(2) + "\n";
}

} // end namespace medialvoxel
