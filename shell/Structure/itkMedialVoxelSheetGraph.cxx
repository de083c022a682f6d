// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetGraph.h"

#include "itkMedialVoxelDisjointSets.h"
#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelSheetSides.h"

#include <algorithm>
#include <map>

namespace itk
{
namespace
{

using Index = MedialVoxelSheetGraph::Index;
using Point = MedialVoxelSheetGraph::Point;

/** Cubes of nodes: they have so many in the radius at least. */
constexpr double CubesInRadius = 4.0;

double
GetDistance(const Point & a, const Point & b)
{
  return MedialVoxelNorm(MedialVoxelSubtract(a, b));
}

/** The thickness of all points: that of the nearest along the sheet that is known, 0 where none is. */
std::vector<float>
FillThickness(const MedialVoxelSheet & sheet, const std::vector<std::array<Index, 2>> & sides)
{
  std::vector<float> thickness = sheet.thickness;
  std::size_t        unknown = 0;
  for (float & value : thickness)
  {
    value = MedialVoxelIsKnown(value) ? value : 0.0F;
    unknown += value > 0.0F ? 0 : 1;
  }
  // Rims and junctions are narrow; each round goes one side further.
  std::vector<std::array<Index, 2>> open = sides;
  while (unknown > 0)
  {
    std::map<Index, std::pair<double, unsigned>> found;
    const auto                                   isClosed = [&](const std::array<Index, 2> & side) {
      return thickness[side[0]] > 0.0F && thickness[side[1]] > 0.0F;
    };
    open.erase(std::remove_if(open.begin(), open.end(), isClosed), open.end());
    for (const auto & side : open)
    {
      for (unsigned int k = 0; k < 2; ++k)
      {
        if (thickness[side[k]] > 0.0F)
        {
          auto & sum = found[side[1 - k]];
          sum.first += static_cast<double>(thickness[side[k]]);
          ++sum.second;
        }
      }
    }
    if (found.empty())
    {
      break;
    }
    for (const auto & entry : found)
    {
      thickness[entry.first] = static_cast<float>(entry.second.first / entry.second.second);
    }
    unknown -= found.size();
  }
  return thickness;
}

} // namespace

MedialVoxelSheetGraph::MedialVoxelSheetGraph(const MedialVoxelSheet & sheet)
  : m_AreasOfPoints(sheet.points.size())
  , m_RimsOfPoints(sheet.points.size())
{
  for (const auto & corners : sheet.triangles)
  {
    const auto   at = [&](const unsigned int k) { return sheet.points[corners[k]]; };
    const double area = MedialVoxelNorm(MedialVoxelTriangleNormal({ { at(0), at(1), at(2) } })) / 2.0;
    for (const Index corner : corners)
    {
      m_AreasOfPoints[corner] += area / 3.0;
    }
  }
  const Joints sides = this->ListSides(sheet);
  this->MakeNodes(sheet, sides, this->FindRadii(sheet, sides));
  Joints joints;
  for (const auto & side : sides)
  {
    const Index a = m_NodeOf[side[0]];
    const Index b = m_NodeOf[side[1]];
    if (a != b)
    {
      joints.push_back({ { std::min(a, b), std::max(a, b) } });
    }
  }
  this->Join(std::move(joints));
}

MedialVoxelSheetGraph::Joints
MedialVoxelSheetGraph::ListSides(const MedialVoxelSheet & sheet)
{
  Joints                                  result;
  const std::vector<MedialVoxelSheetSide> sides = MedialVoxelSortSides(sheet.triangles);
  double                                  sum = 0.0;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && sides[first] == sides[last])
    {
      ++last;
    }
    const Index  low = sides[first].low;
    const Index  high = sides[first].high;
    const double length = GetDistance(sheet.points[low], sheet.points[high]);
    result.push_back({ { low, high } });
    sum += length;
    if (last - first == 1)
    {
      m_RimsOfPoints[low] += length / 2.0;
      m_RimsOfPoints[high] += length / 2.0;
    }
  }
  m_MeanSide = result.empty() ? 0.0 : sum / static_cast<double>(result.size());
  return result;
}

std::vector<float>
MedialVoxelSheetGraph::FindRadii(const MedialVoxelSheet & sheet, const Joints & sides) const
{
  std::vector<float> radii = FillThickness(sheet, sides);
  const auto         least = static_cast<float>(FewestSides * m_MeanSide);
  for (float & radius : radii)
  {
    radius = std::max(radius, least);
  }
  return radii;
}

void
MedialVoxelSheetGraph::MakeNodes(const MedialVoxelSheet & sheet, const Joints & sides, const std::vector<float> & radii)
{
  // The side of the cube of a point is a power of two of sides of triangles; the first one stands for the point alone.
  const auto cubeOf = [&](const Index point) {
    double side = 1.0;
    while (2.0 * side * CubesInRadius * m_MeanSide <= static_cast<double>(radii[point]))
    {
      side *= 2.0;
    }
    std::array<std::int64_t, 4> cube{ { static_cast<std::int64_t>(side), point, 0, 0 } };
    for (unsigned int axis = 0; side > 1.0 && axis < 3; ++axis)
    {
      cube[axis + 1] = MedialVoxelFloor(sheet.points[point][axis] / (side * m_MeanSide));
    }
    return cube;
  };
  MedialVoxelDisjointSets pieces(static_cast<Index>(sheet.points.size()));
  for (const auto & side : sides)
  {
    if (cubeOf(side[0]) == cubeOf(side[1]))
    {
      pieces.Join(side[0], side[1]);
    }
  }
  m_NodeOf.assign(sheet.points.size(), None);
  for (Index point = 0; point < sheet.points.size(); ++point)
  {
    const double area = m_AreasOfPoints[point];
    if (!(area > 0.0))
    {
      continue;
    }
    Index & node = m_NodeOf[pieces.Find(point)];
    if (node == None)
    {
      node = this->GetNumberOfNodes();
      m_Places.emplace_back();
      m_Areas.push_back(0.0);
      m_Radii.push_back(0.0F);
    }
    m_NodeOf[point] = node;
    m_Places[node] = MedialVoxelAddScaled(m_Places[node], sheet.points[point], area);
    m_Radii[node] += static_cast<float>(area) * radii[point];
    m_Areas[node] += area;
  }
  for (Index node = 0; node < this->GetNumberOfNodes(); ++node)
  {
    m_Places[node] = MedialVoxelAddScaled({}, m_Places[node], 1.0 / m_Areas[node]);
    m_Radii[node] /= static_cast<float>(m_Areas[node]);
  }
}

void
MedialVoxelSheetGraph::Join(Joints joints)
{
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  m_First.assign(m_Places.size() + 1, 0);
  for (const auto & joint : joints)
  {
    ++m_First[joint[0] + 1];
    ++m_First[joint[1] + 1];
  }
  for (std::size_t node = 0; node < m_Places.size(); ++node)
  {
    m_First[node + 1] += m_First[node];
  }
  m_Neighbors.resize(2 * joints.size());
  std::vector<Index> next(m_First.begin(), m_First.end() - 1);
  // By number: those below a node come with the first loop, those above with the second.
  for (const auto & joint : joints)
  {
    m_Neighbors[next[joint[1]]++] = joint[0];
  }
  for (const auto & joint : joints)
  {
    m_Neighbors[next[joint[0]]++] = joint[1];
  }
}

const std::vector<Index> &
MedialVoxelSheetDisk::Find(const Index node, const double radius)
{
  ++m_Mark;
  m_Nodes.assign(1, node);
  m_Marks[node] = m_Mark;
  const MedialVoxelVector3 & center = m_Graph.GetPlace(node);
  for (std::size_t done = 0; done < m_Nodes.size(); ++done)
  {
    m_Graph.ForEachNeighbor(m_Nodes[done], [&](const Index other) {
      if (m_Marks[other] != m_Mark)
      {
        m_Marks[other] = m_Mark;
        const MedialVoxelVector3 offset = MedialVoxelSubtract(m_Graph.GetPlace(other), center);
        if (MedialVoxelDot(offset, offset) <= radius * radius)
        {
          m_Nodes.push_back(other);
        }
      }
    });
  }
  return m_Nodes;
}

} // end namespace itk
