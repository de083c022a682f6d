// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemesher.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;
using Index = MedialVoxelTriangleComplex::Index;

} // namespace

std::array<Vector, 3>
MedialVoxelRemesher::GetCorners(const Step & step, const std::size_t number) const
{
  std::array<Vector, 3> corners;
  for (unsigned int k = 0; k < 3; ++k)
  {
    const Index vertex = step.after[number][k];
    corners[k] = vertex == step.moved ? step.place : m_Complex.GetPoint(vertex);
  }
  return corners;
}

MedialVoxelRemesher::Worst
MedialVoxelRemesher::Judge(const Step & step, const double leastCosine) const
{
  Worst worst{ 1.0, true };
  for (std::size_t k = 0; k < step.after.size(); ++k)
  {
    const auto corners = this->GetCorners(step, k);
    worst.quality = std::min(worst.quality, MedialVoxelScaledJacobian(corners));
    const auto old = m_Complex.GetCorners(step.numbers[k]);
    worst.keepsNormals = worst.keepsNormals && MedialVoxelCosine(MedialVoxelTriangleNormal(old),
                                                                 MedialVoxelTriangleNormal(corners)) >= leastCosine;
  }
  return worst;
}

bool
MedialVoxelRemesher::Allows(const Step & step, const Rules & rules)
{
  double before = 1.0;
  for (const Index triangle : step.before)
  {
    before = std::min(before, this->GetQuality(triangle));
  }
  const Worst worst = this->Judge(step, rules.leastCosine);
  if (!worst.keepsNormals || worst.quality < std::min(before, rules.leastQuality) ||
      worst.quality < before + (rules.improvement > 0 ? rules.improvement : -1.0))
  {
    return false;
  }
  return this->IsNear(step, rules.tolerance);
}

/** Whether the points of the fine sheet and the middles of the triangles stay within a distance of each other. */
bool
MedialVoxelRemesher::IsNear(const Step & step, const double tolerance)
{
  std::vector<std::array<Vector, 3>> after;
  for (std::size_t k = 0; k < step.after.size(); ++k)
  {
    after.push_back(this->GetCorners(step, k));
  }
  if (!m_Witnesses.Fit(step.before, after, tolerance))
  {
    return false;
  }
  for (std::size_t k = 0; k < step.after.size(); ++k)
  {
    Vector center{};
    for (const Vector & corner : after[k])
    {
      center = MedialVoxelAddScaled(center, corner, 1.0 / 3.0);
    }
    if (!m_Fine.HasWallWithin(center, m_Complex.GetWall(step.numbers[k]), tolerance))
    {
      return false;
    }
  }
  return true;
}

MedialVoxelRemesher::Step
MedialVoxelRemesher::MakeCollapse(const Index from, const Index to) const
{
  Step step;
  for (const Index triangle : m_Complex.GetTrianglesOf(from))
  {
    step.before.push_back(triangle);
    Triangle corners = m_Complex.GetTriangle(triangle);
    if (std::find(corners.begin(), corners.end(), to) == corners.end())
    {
      std::replace(corners.begin(), corners.end(), from, to);
      step.numbers.push_back(triangle);
      step.after.push_back(corners);
    }
  }
  for (const Index triangle : m_Complex.GetTrianglesOf(to))
  {
    const Triangle & corners = m_Complex.GetTriangle(triangle);
    if (std::find(corners.begin(), corners.end(), from) == corners.end())
    {
      step.before.push_back(triangle);
      step.numbers.push_back(triangle);
      step.after.push_back(corners);
    }
  }
  return step;
}

MedialVoxelRemesher::Step
MedialVoxelRemesher::MakeMove(const Index vertex, const Point & place) const
{
  Step step;
  step.before = m_Complex.GetTrianglesOf(vertex);
  step.numbers = step.before;
  for (const Index triangle : step.before)
  {
    step.after.push_back(m_Complex.GetTriangle(triangle));
  }
  step.moved = vertex;
  step.place = place;
  return step;
}

/** Changes the complex, without the points of the fine sheet.
 * \return the numbers of the triangles that are there now, in the order of step.after */
std::vector<Index>
MedialVoxelRemesher::Apply(const Step & step)
{
  std::vector<Index> walls;
  for (const Index triangle : step.numbers)
  {
    walls.push_back(m_Complex.GetWall(triangle));
  }
  for (const Index triangle : step.before)
  {
    m_Complex.RemoveTriangle(triangle);
  }
  std::vector<Index> numbers;
  for (std::size_t k = 0; k < step.after.size(); ++k)
  {
    numbers.push_back(m_Complex.AddTriangle(step.after[k], walls[k]));
  }
  return numbers;
}

} // end namespace itk
