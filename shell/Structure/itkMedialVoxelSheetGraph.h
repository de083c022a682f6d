// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetGraph_h
#define itkMedialVoxelSheetGraph_h

#include "itkMedialVoxelSheet.h"

namespace itk
{

/** \class MedialVoxelSheetGraph
 * \brief A sheet as nodes that are joined along it: pieces that are small against the thickness of the wall.
 *
 * Each node has a radius: the thickness of the wall, and at least FewestSides sides of triangles. A node is a point of
 * the sheet or, where the radius has many sides, the points in a cube that the sheet joins there.
 * \ingroup MedialVoxel
 */
class MedialVoxelSheetGraph
{
public:
  using Index = MedialVoxelSheet::Index;
  using Point = MedialVoxelVector3;

  static constexpr Index  None = ~Index{ 0 };
  static constexpr double FewestSides = 4.5;

  explicit MedialVoxelSheetGraph(const MedialVoxelSheet & sheet);

  Index
  GetNumberOfNodes() const
  {
    return static_cast<Index>(m_Places.size());
  }

  /** Of a point; None: no triangle has it. */
  Index
  GetNode(const Index point) const
  {
    return m_NodeOf[point];
  }

  /** The middle of a node by area. */
  const Point &
  GetPlace(const Index node) const
  {
    return m_Places[node];
  }
  double
  GetArea(const Index node) const
  {
    return m_Areas[node];
  }
  double
  GetRadius(const Index node) const
  {
    return m_Radii[node];
  }

  /** Calls function(node) for all that are joined to a node, by number. */
  template <typename TFunction>
  void
  ForEachNeighbor(const Index node, TFunction && function) const
  {
    for (Index k = m_First[node]; k < m_First[node + 1]; ++k)
    {
      function(m_Neighbors[k]);
    }
  }

  /** Of each point: its share of the area, and of the rims. */
  const std::vector<double> &
  GetAreasOfPoints() const
  {
    return m_AreasOfPoints;
  }
  const std::vector<double> &
  GetRimsOfPoints() const
  {
    return m_RimsOfPoints;
  }

private:
  using Joints = std::vector<std::array<Index, 2>>;

  Joints
  ListSides(const MedialVoxelSheet & sheet);

  std::vector<float>
  FindRadii(const MedialVoxelSheet & sheet, const Joints & sides) const;

  void
  MakeNodes(const MedialVoxelSheet & sheet, const Joints & sides, const std::vector<float> & radii);

  void
  Join(Joints joints);

  double              m_MeanSide{ 0 };
  std::vector<double> m_AreasOfPoints;
  std::vector<double> m_RimsOfPoints;
  std::vector<Index>  m_NodeOf;
  std::vector<Point>  m_Places;
  std::vector<double> m_Areas;
  std::vector<float>  m_Radii;
  std::vector<Index>  m_First;
  std::vector<Index>  m_Neighbors;
};

/** \class MedialVoxelSheetDisk
 * \brief The piece of a sheet around a node: what is joined to it within a distance.
 * \ingroup MedialVoxel
 */
class MedialVoxelSheetDisk
{
public:
  using Index = MedialVoxelSheetGraph::Index;

  explicit MedialVoxelSheetDisk(const MedialVoxelSheetGraph & graph)
    : m_Graph(graph)
    , m_Marks(graph.GetNumberOfNodes())
  {}

  /** The node first. Valid until the next call. */
  const std::vector<Index> &
  Find(Index node, double radius);

private:
  const MedialVoxelSheetGraph & m_Graph;
  std::vector<Index>            m_Marks;
  std::vector<Index>            m_Nodes;
  Index                         m_Mark{ 0 };
};

} // end namespace itk

#endif
