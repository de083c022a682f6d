// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemesher.h"

#include <algorithm>
#include <numeric>

namespace itk
{

MedialVoxelRemesher::MedialVoxelRemesher(MedialVoxelFineSheet &     fine,
                                         const double               noise,
                                         const std::vector<Index> & triangles,
                                         const std::vector<bool> &  isShared)
  : m_Fine(fine)
  , m_Witnesses(m_Given)
  , m_Noise(noise)
{
  const MedialVoxelSheet & sheet = fine.GetSheet();
  for (const Index triangle : triangles)
  {
    m_Numbers.insert(m_Numbers.end(), sheet.triangles[triangle].begin(), sheet.triangles[triangle].end());
  }
  std::sort(m_Numbers.begin(), m_Numbers.end());
  m_Numbers.erase(std::unique(m_Numbers.begin(), m_Numbers.end()), m_Numbers.end());
  for (const Index number : m_Numbers)
  {
    m_Given.push_back(sheet.points[number]);
    Complex::Vertex & vertex = m_Complex.GetVertex(m_Complex.AddVertex(sheet.points[number]));
    vertex.size = fine.GetSize(number);
    vertex.isShared = isShared[number];
    m_HasShared = m_HasShared || isShared[number];
  }
  m_Witnesses = MedialVoxelSheetWitnesses(m_Given);
  std::vector<bool> isKept(m_Given.size());
  for (const Index triangle : triangles)
  {
    Triangle corners = sheet.triangles[triangle];
    for (Index & corner : corners)
    {
      corner = static_cast<Index>(std::lower_bound(m_Numbers.begin(), m_Numbers.end(), corner) - m_Numbers.begin());
    }
    const Index number = m_Complex.AddTriangle(corners, fine.GetWall(triangle));
    for (const Index corner : corners)
    {
      if (!isKept[corner])
      {
        isKept[corner] = true;
        m_Witnesses.Add(corner, number);
      }
    }
  }
}

MedialVoxelRemesher::MedialVoxelRemesher(MedialVoxelFineSheet & fine, const double noise, const Parts & parts)
  : m_Fine(fine)
  , m_Given(fine.GetSheet().points)
  , m_Numbers(m_Given.size())
  , m_Witnesses(m_Given)
  , m_Noise(noise)
{
  std::iota(m_Numbers.begin(), m_Numbers.end(), Index{ 0 });
  for (Index point = 0; point < m_Given.size(); ++point)
  {
    m_Complex.GetVertex(m_Complex.AddVertex(m_Given[point])).size = fine.GetSize(point);
  }
  std::vector<bool>  isKept(m_Given.size());
  std::vector<Index> points;
  for (const auto & part : parts)
  {
    std::vector<Index> numbers = part->m_Numbers;
    for (Index vertex = 0; vertex < part->m_Complex.GetNumberOfVertices(); ++vertex)
    {
      if (vertex >= numbers.size())
      {
        numbers.push_back(m_Complex.AddVertex({}));
      }
      m_Complex.GetVertex(numbers[vertex]) = part->m_Complex.GetVertex(vertex);
      m_Complex.GetVertex(numbers[vertex]).isShared = false;
    }
    for (Index triangle = 0; triangle < part->m_Complex.GetNumberOfTriangles(); ++triangle)
    {
      if (!part->m_Complex.IsTriangle(triangle))
      {
        continue;
      }
      Triangle corners = part->m_Complex.GetTriangle(triangle);
      std::transform(
        corners.begin(), corners.end(), corners.begin(), [&](const Index corner) { return numbers[corner]; });
      if (m_Complex.HasTriangle(corners))
      {
        continue; // another part has made it, too
      }
      const Index number = m_Complex.AddTriangle(corners, part->m_Complex.GetWall(triangle));
      points.clear();
      part->m_Witnesses.AppendPoints(triangle, points);
      for (const Index point : points)
      {
        if (!isKept[numbers[point]])
        {
          isKept[numbers[point]] = true;
          m_Witnesses.Add(numbers[point], number);
        }
      }
    }
  }
}

} // end namespace itk
