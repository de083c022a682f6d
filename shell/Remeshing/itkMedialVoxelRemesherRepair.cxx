// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemesher.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Index = MedialVoxelTriangleComplex::Index;
using Place = MedialVoxelTriangleComplex::Place;

constexpr double WantedQuality = 0.45;
constexpr double LeastGain = 0.02;

/** Of a side: how far a vertex is moved along it. */
constexpr double ShiftOfSide = 0.15;

} // namespace

/** Worst first. */
void
MedialVoxelRemesher::RepairTriangles()
{
  m_Touched.resize(m_Complex.GetNumberOfVertices(), m_NumberOfPasses);
  const auto getQuality = [this](const Index triangle) { return this->GetQuality(triangle); };
  for (const Index triangle : this->ListBelow(WantedQuality, getQuality))
  {
    this->Proceed();
    if (m_Complex.IsTriangle(triangle) && this->GetQuality(triangle) < WantedQuality)
    {
      this->TryRepair(triangle);
    }
  }
}

/** Triangles whose value is below a limit, lowest first. */
std::vector<Index>
MedialVoxelRemesher::ListBelow(const double limit, const std::function<double(Index)> & getValue) const
{
  std::vector<double> values(m_Complex.GetNumberOfTriangles());
  MedialVoxelForEach(m_RunTasks, values.size(), [&](const Index triangle) {
    values[triangle] = m_Complex.IsTriangle(triangle) ? getValue(triangle) : limit;
  });
  std::vector<Index> triangles;
  for (Index triangle = 0; triangle < values.size(); ++triangle)
  {
    if (values[triangle] < limit)
    {
      triangles.push_back(triangle);
    }
  }
  std::stable_sort(
    triangles.begin(), triangles.end(), [&](const Index a, const Index b) { return values[a] < values[b]; });
  return triangles;
}

bool
MedialVoxelRemesher::TryRepair(const Index triangle)
{
  const Triangle corners = m_Complex.GetTriangle(triangle);
  for (unsigned int k = 0; k < 3; ++k)
  {
    if (this->TryPassOver(corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3], LeastGain))
    {
      return true;
    }
  }
  for (unsigned int k = 0; k < 6; ++k)
  {
    const Index  from = corners[k % 3];
    const Index  to = corners[(k + 1 + k / 3) % 3];
    const double size = this->GetSize(from, to);
    if (!m_Complex.CanCollapse(from, to) || !this->MayLeave(from, to, this->GetLength(from, to) < size / 2))
    {
      continue;
    }
    const Step step = this->MakeCollapse(from, to);
    if (!step.after.empty() && this->Allows(step, { size / 2, 0.5, WantedQuality, LeastGain }))
    {
      this->Touch(step.before);
      m_Complex.Collapse(from, to);
      m_Witnesses.Assign(step.before, step.numbers);
      return true;
    }
  }
  return std::any_of(corners.begin(), corners.end(), [this](const Index corner) { return this->TryShift(corner); });
}

/** Moves a vertex towards a neighbor or away from it, where triangles get a better shape by it. */
bool
MedialVoxelRemesher::TryShift(const Index vertex)
{
  const Place kind = m_Complex.GetPlace(vertex);
  if (kind == Place::Corner || this->IsSharp(vertex, kind))
  {
    return false;
  }
  const Point point = m_Complex.GetPoint(vertex);
  for (const Index other : this->FindLineNeighbors(vertex, kind))
  {
    for (const double share : { ShiftOfSide, -ShiftOfSide })
    {
      const Point place = MedialVoxelAddScaled(point, MedialVoxelSubtract(m_Complex.GetPoint(other), point), share);
      if (this->TryMoveTo(
            vertex, this->Project(vertex, kind, place), { this->GetTolerance(vertex), 0.5, WantedQuality, LeastGain }))
      {
        return true;
      }
    }
  }
  return false;
}

/** Takes a side of a triangle away, and leads what is beyond it to the corner opposite to it: a flip of a side of two
 * triangles, a shorter rim, or a junction that goes through the corner. */
bool
MedialVoxelRemesher::TryPassOver(const Index a, const Index b, const Index c, const double improvement)
{
  const Complex::Indices triangles = m_Complex.FindTriangles(a, b);
  if ((m_Complex.IsShared(a) && m_Complex.IsShared(b)) ||
      (triangles.size() != 2 && m_Complex.GetPlace(c) != Place::Wall))
  {
    return false;
  }
  const Step step = triangles.size() == 1 ? this->MakeShorterRim(triangles[0]) : this->MakePassOver(triangles, a, b, c);
  const double tolerance = this->GetTolerance(c);
  if (step.after.empty() || !this->Allows(step, { tolerance, 0.5, WantedQuality, improvement }))
  {
    return false;
  }
  this->Touch(step.before);
  const std::vector<Index> numbers = this->Apply(step);
  m_Witnesses.Assign(step.before, numbers);
  return true;
}

/** Without a triangle at a rim, whose points go to those beside it. */
MedialVoxelRemesher::Step
MedialVoxelRemesher::MakeShorterRim(const Index triangle) const
{
  Step             step;
  const Triangle & corners = m_Complex.GetTriangle(triangle);
  step.before.push_back(triangle);
  for (unsigned int k = 0; k < 3; ++k)
  {
    for (const Index other : m_Complex.FindTriangles(corners[k], corners[(k + 1) % 3]))
    {
      if (other != triangle)
      {
        step.before.push_back(other);
        step.numbers.push_back(other);
        step.after.push_back(m_Complex.GetTriangle(other));
      }
    }
  }
  return step;
}

/** Nothing where a triangle would be twice. */
MedialVoxelRemesher::Step
MedialVoxelRemesher::MakePassOver(const Complex::Indices & triangles, const Index a, const Index b, const Index c) const
{
  Step step;
  step.before.assign(triangles.begin(), triangles.end());
  for (const Index triangle : triangles)
  {
    const Triangle & corners = m_Complex.GetTriangle(triangle);
    if (std::find(corners.begin(), corners.end(), c) != corners.end())
    {
      continue;
    }
    const Index beyond = m_Complex.GetOpposite(triangle, a, b);
    if (m_Complex.CountTriangles(c, beyond) > 0 || (m_Complex.IsShared(c) && m_Complex.IsShared(beyond)))
    {
      return Step{};
    }
    for (const auto & [from, to] : { std::make_pair(b, c), std::make_pair(a, c) })
    {
      step.after.push_back(corners);
      step.numbers.push_back(triangle);
      std::replace(step.after.back().begin(), step.after.back().end(), from, to);
    }
  }
  return step;
}

} // end namespace itk
