// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemesher.h"

#include "itkMedialVoxelComplexDivision.h"

#include <algorithm>

namespace itk
{
namespace
{

using Index = MedialVoxelTriangleComplex::Index;

} // namespace

void
MedialVoxelRemesher::Run(const MedialVoxelRunTasks & runTasks, std::function<void(double)> progress)
{
  // Parts are as small as their overhead allows, for many threads. Shares differ, so that cuts do.
  // most triangles, share, steps, merges at once, repairs, raises sizes, cleans
  constexpr std::array<Round, 4> rounds{ { { 2048, 0.5, 4, false, 0, true, false },
                                           { 1024, 0.4, 2, true, 4, false, true },
                                           { 1024, 0.3, 0, false, 1, false, true },
                                           { 1024, 0.45, 0, false, 1, false, true } } };
  m_RunTasks = runTasks;
  m_Progress = std::move(progress);
  for (const Round & round : rounds)
  {
    this->RunParts(round);
    if (round.raisesSizes)
    {
      this->RaiseSizesAtBends();
    }
    if (round.cleans)
    {
      this->RepairTriangles();
      this->CleanUp();
    }
    m_Share += 1.0 / rounds.size();
  }
}

void
MedialVoxelRemesher::RunParts(const Round & round)
{
  const MedialVoxelComplexDivision division = MedialVoxelDivideComplex(m_Complex, round.most, round.share);
  Parts                            parts(division.parts.size());
  m_RunTasks(parts.size(), [&](const std::size_t number, const std::function<void()> & check) {
    parts[number].reset(new MedialVoxelRemesher(*this, division.parts[number], division.isShared));
    parts[number]->m_Progress = [&check](double) { check(); };
    parts[number]->RunPart(round);
  });
  this->Join(parts);
}

MedialVoxelRemesher::MedialVoxelRemesher(MedialVoxelFineSheet & fine, const double noise)
  : m_Fine(fine)
  , m_Given(fine.GetSheet().points)
  , m_Witnesses(m_Given)
  , m_Noise(noise)
{
  const MedialVoxelSheet & sheet = fine.GetSheet();
  for (Index point = 0; point < m_Given.size(); ++point)
  {
    m_Complex.GetVertex(m_Complex.AddVertex(m_Given[point])).size = fine.GetSize(point);
  }
  std::vector<bool> isKept(m_Given.size());
  for (Index triangle = 0; triangle < sheet.triangles.size(); ++triangle)
  {
    const Index number = m_Complex.AddTriangle(sheet.triangles[triangle], fine.GetWall(triangle));
    for (const Index corner : sheet.triangles[triangle])
    {
      if (!isKept[corner])
      {
        isKept[corner] = true;
        m_Witnesses.Add(corner, number);
      }
    }
  }
}

MedialVoxelRemesher::MedialVoxelRemesher(const MedialVoxelRemesher & whole,
                                         const std::vector<Index> &  triangles,
                                         const std::vector<bool> &   isShared)
  : m_Fine(whole.m_Fine)
  , m_Witnesses(m_Given)
  , m_Noise(whole.m_Noise)
{
  for (const Index triangle : triangles)
  {
    const Triangle & corners = whole.m_Complex.GetTriangle(triangle);
    m_Numbers.insert(m_Numbers.end(), corners.begin(), corners.end());
    whole.m_Witnesses.AppendPoints(triangle, m_NumbersGiven);
  }
  std::sort(m_Numbers.begin(), m_Numbers.end());
  m_Numbers.erase(std::unique(m_Numbers.begin(), m_Numbers.end()), m_Numbers.end());
  for (const Index number : m_Numbers)
  {
    Complex::Vertex & vertex = m_Complex.GetVertex(m_Complex.AddVertex({}));
    vertex = { whole.m_Complex.GetPoint(number), whole.m_Complex.GetSize(number), isShared[number] };
    m_HasShared = m_HasShared || isShared[number];
  }
  for (const Index number : m_NumbersGiven)
  {
    m_Given.push_back(whole.m_Given[number]);
  }
  m_Witnesses = MedialVoxelSheetWitnesses(m_Given);
  std::vector<Index> points;
  Index              given = 0;
  for (const Index triangle : triangles)
  {
    Triangle corners = whole.m_Complex.GetTriangle(triangle);
    std::transform(corners.begin(), corners.end(), corners.begin(), [this](const Index corner) {
      return static_cast<Index>(std::lower_bound(m_Numbers.begin(), m_Numbers.end(), corner) - m_Numbers.begin());
    });
    const Index number = m_Complex.AddTriangle(corners, whole.m_Complex.GetWall(triangle));
    points.clear();
    whole.m_Witnesses.AppendPoints(triangle, points);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      m_Witnesses.Add(given++, number);
    }
  }
}

void
MedialVoxelRemesher::Join(const Parts & parts)
{
  std::vector<Index> numbers(m_Complex.GetNumberOfVertices(), Complex::None);
  std::vector<Index> ofPart;
  std::vector<Index> points;
  m_Complex = Complex();
  m_Witnesses = MedialVoxelSheetWitnesses(m_Given);
  for (const auto & part : parts)
  {
    const Complex & complex = part->m_Complex;
    ofPart.assign(complex.GetNumberOfVertices(), Complex::None);
    for (Index vertex = 0; vertex < complex.GetNumberOfVertices(); ++vertex)
    {
      if (complex.GetTrianglesOf(vertex).empty())
      {
        continue;
      }
      Index & number = vertex < part->m_Numbers.size() ? numbers[part->m_Numbers[vertex]] : ofPart[vertex];
      number = number == Complex::None ? m_Complex.AddVertex({}) : number;
      ofPart[vertex] = number;
      m_Complex.GetVertex(number) = { complex.GetPoint(vertex), complex.GetSize(vertex), false };
    }
    for (Index triangle = 0; triangle < complex.GetNumberOfTriangles(); ++triangle)
    {
      if (!complex.IsTriangle(triangle))
      {
        continue;
      }
      Triangle corners = complex.GetTriangle(triangle);
      std::transform(
        corners.begin(), corners.end(), corners.begin(), [&](const Index corner) { return ofPart[corner]; });
      if (m_Complex.HasTriangle(corners))
      {
        continue; // another part has made it, too
      }
      const Index number = m_Complex.AddTriangle(corners, complex.GetWall(triangle));
      points.clear();
      part->m_Witnesses.AppendPoints(triangle, points);
      for (const Index point : points)
      {
        m_Witnesses.Add(part->m_NumbersGiven[point], number);
      }
    }
  }
}

} // end namespace itk
