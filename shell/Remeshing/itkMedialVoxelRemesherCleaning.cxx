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

using Vector = MedialVoxelVector3;
using Index = MedialVoxelTriangleComplex::Index;

constexpr double LeastQuality = 0.32;

/** Two triangles of a side are a fold when they open by less than 60 degrees. */
constexpr double CosineOfFold = 0.5;

/** Two triangles of a wall are a bend when they are turned by more than 25 degrees. */
constexpr double CosineOfBend = -0.9;
constexpr double BadnessOfBend = 0.5;

/** Of the size: how far the sheet may move to get rid of a bad triangle. */
constexpr double ToleranceOfCleaning = 0.5;

/** Of the size: the shortest side of a hole that is closed. */
constexpr double MostOfSlit = 0.3;

/** Of the size: sides of a square as large as a triangle that is no better than a point or a line. */
constexpr double MostOfTiny = 0.1;

constexpr double       LeastGain = 0.02;
constexpr unsigned int MostRounds = 6;

/** Perpendicular to a side, towards the third corner of a triangle. */
Vector
GetHeight(const Vector & a, const Vector & b, const Vector & corner)
{
  const Vector side = MedialVoxelSubtract(b, a);
  const Vector toCorner = MedialVoxelSubtract(corner, a);
  const double length2 = MedialVoxelDot(side, side);
  return length2 > 0.0 ? MedialVoxelAddScaled(toCorner, side, -MedialVoxelDot(toCorner, side) / length2) : toCorner;
}

} // namespace

/** Takes away triangles of bad shape and folds, worst first, also where lines and corners have to move; then what still
 * is bad at the end of a strip. */
void
MedialVoxelRemesher::CleanUp()
{
  bool found = true;
  for (unsigned int round = 0; found && round < MostRounds; ++round)
  {
    const std::vector<Index> onRims = this->ListRimVertices();
    this->CloseSlits(onRims);
    this->ZipRims(onRims);
    found = false;
    for (const Index triangle : this->ListBad())
    {
      if (m_Complex.IsTriangle(triangle) && this->GetBadness(triangle) > 0.0)
      {
        found = this->TryCloseSlit(triangle) || this->TryClean(triangle) || this->TryLeaveOut(triangle) || found;
      }
    }
  }
  for (const Index triangle : this->ListBad())
  {
    if (m_Complex.IsTriangle(triangle))
    {
      this->TryLeaveOut(triangle);
    }
  }
}

/** Worst first. */
std::vector<Index>
MedialVoxelRemesher::ListBad() const
{
  return this->ListBelow(0.0, [this](const Index triangle) { return -this->GetBadness(triangle); });
}

/** Whether a triangle is no more than a point or a line beside others. */
bool
MedialVoxelRemesher::IsTiny(const Index triangle) const
{
  const Index  corner = m_Complex.GetTriangle(triangle)[0];
  const double side = MostOfTiny * this->GetSize(corner, corner);
  return MedialVoxelNorm(MedialVoxelTriangleNormal(m_Complex.GetCorners(triangle))) < 2.0 * side * side;
}

/** Of a triangle: its shape and its folds. */
double
MedialVoxelRemesher::GetBadness(const Index triangle) const
{
  const Triangle & corners = m_Complex.GetTriangle(triangle);
  const double     quality = this->IsTiny(triangle) ? 0.0 : this->GetQuality(triangle);
  double           badness = quality < LeastQuality ? 2.0 - quality / LeastQuality : 0.0;
  for (unsigned int k = 0; k < 3; ++k)
  {
    badness += this->GetFolds(corners[k], corners[(k + 1) % 3]);
  }
  return badness;
}

/** Of all triangles of some vertices. */
double
MedialVoxelRemesher::GetBadness(const std::vector<Index> & vertices) const
{
  std::vector<Index> triangles;
  for (const Index vertex : vertices)
  {
    const std::vector<Index> & ofVertex = m_Complex.GetTrianglesOf(vertex);
    triangles.insert(triangles.end(), ofVertex.begin(), ofVertex.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  double sum = 0.0;
  for (const Index triangle : triangles)
  {
    sum += this->GetBadness(triangle);
  }
  return sum;
}

double
MedialVoxelRemesher::GetFolds(const Index a, const Index b) const
{
  MedialVoxelShortList<Vector, 4> heights;
  for (const Index triangle : m_Complex.FindTriangles(a, b))
  {
    heights.push_back(GetHeight(
      m_Complex.GetPoint(a), m_Complex.GetPoint(b), m_Complex.GetPoint(m_Complex.GetOpposite(triangle, a, b))));
  }
  double folds = 0.0;
  for (std::size_t first = 0; first < heights.size(); ++first)
  {
    for (std::size_t second = first + 1; second < heights.size(); ++second)
    {
      const double cosine = MedialVoxelCosine(heights[first], heights[second]);
      folds += cosine > CosineOfFold ? 1.0 + cosine : 0.0;
      // Half the thickness on both sides of a bend overlaps this far on its inside.
      const double overlap = this->GetSize(a, b) / 2.0 * std::sqrt((1.0 + cosine) / std::max(1.0 - cosine, 1e-9));
      const double height = std::min(MedialVoxelNorm(heights[first]), MedialVoxelNorm(heights[second]));
      folds += heights.size() == 2 && cosine > CosineOfBend && overlap > height ? BadnessOfBend : 0.0;
    }
  }
  return folds;
}

/** How much less bad the triangles around would be. Takes the step, and takes it back. */
double
MedialVoxelRemesher::GetGain(const Step & step)
{
  std::vector<Triangle> corners;
  std::vector<Index>    walls;
  std::vector<Index>    vertices;
  for (const Index triangle : step.before)
  {
    corners.push_back(m_Complex.GetTriangle(triangle));
    walls.push_back(m_Complex.GetWall(triangle));
    vertices.insert(vertices.end(), corners.back().begin(), corners.back().end());
  }
  const double             before = this->GetBadness(vertices);
  const std::vector<Index> numbers = this->Apply(step);
  const double             after = this->GetBadness(vertices);
  // Numbers are given again in the reverse of the order in which they became free.
  for (std::size_t k = numbers.size(); k-- > 0;)
  {
    m_Complex.RemoveTriangle(numbers[k]);
  }
  for (std::size_t k = corners.size(); k-- > 0;)
  {
    m_Complex.AddTriangle(corners[k], walls[k]);
  }
  return before - after;
}

/** All steps that take a triangle away and keep the topology. */
std::vector<MedialVoxelRemesher::Step>
MedialVoxelRemesher::ListCleanSteps(const Index triangle) const
{
  std::vector<Step> steps;
  const auto        add = [&](Step step) {
    if (!step.after.empty())
    {
      steps.push_back(std::move(step));
    }
  };
  const Triangle corners = m_Complex.GetTriangle(triangle);
  for (unsigned int k = 0; k < 3; ++k)
  {
    const Index            a = corners[k];
    const Index            b = corners[(k + 1) % 3];
    const Index            c = corners[(k + 2) % 3];
    const Complex::Indices triangles = m_Complex.FindTriangles(a, b);
    // A short junction that ends at rims on both sides may become a point.
    if (m_Complex.CanCollapse(a, b, triangles.size() > 2))
    {
      add(this->MakeCollapse(a, b));
    }
    if (m_Complex.CanCollapse(b, a, triangles.size() > 2))
    {
      add(this->MakeCollapse(b, a));
    }
    if (triangles.size() == 2 || m_Complex.GetPlace(c) == Complex::Place::Wall)
    {
      add(triangles.size() == 1 ? this->MakeShorterRim(triangle) : this->MakePassOver(triangles, a, b, c));
    }
    if (m_Complex.GetTrianglesOf(a).size() == 1 && m_Complex.CountTriangles(b, c) > 1)
    {
      add(this->MakeShorterRim(triangle)); // a is the tip of a strip
    }
    add(this->MakeLid(a));
  }
  return steps;
}

/** Without the three triangles of a vertex that stand on a triangle, whose pocket is closed. */
MedialVoxelRemesher::Step
MedialVoxelRemesher::MakeLid(const Index vertex) const
{
  Step                     step;
  const Complex::Neighbors neighbors = m_Complex.FindNeighbors(vertex);
  if (neighbors.size() != 3 || m_Complex.GetTrianglesOf(vertex).size() != 3)
  {
    return step;
  }
  for (const Index triangle : m_Complex.FindTriangles(neighbors[0].vertex, neighbors[1].vertex))
  {
    if (m_Complex.GetOpposite(triangle, neighbors[0].vertex, neighbors[1].vertex) == neighbors[2].vertex)
    {
      step.before = m_Complex.GetTrianglesOf(vertex);
      step.before.push_back(triangle);
      step.numbers.push_back(triangle);
      step.after.push_back(m_Complex.GetTriangle(triangle));
    }
  }
  return step;
}

bool
MedialVoxelRemesher::TryClean(const Index triangle)
{
  const Index             corner = m_Complex.GetTriangle(triangle)[0];
  const double            tolerance = ToleranceOfCleaning * this->GetSize(corner, corner);
  const std::vector<Step> steps = this->ListCleanSteps(triangle);
  const Step *            best = nullptr;
  double                  mostGain = LeastGain;
  for (const Step & step : steps)
  {
    const double gain = this->GetGain(step);
    if (gain > mostGain && this->IsNear(step, tolerance))
    {
      best = &step;
      mostGain = gain;
    }
  }
  if (best)
  {
    this->IsNear(*best, tolerance); // once more, for the places of the fine points
    m_Witnesses.Assign(best->before, this->Apply(*best));
  }
  return best != nullptr;
}

/** A hole of three sides with a short one becomes a triangle, which can be taken away then. */
bool
MedialVoxelRemesher::TryCloseSlit(const Index triangle)
{
  const Triangle corners = m_Complex.GetTriangle(triangle);
  for (unsigned int k = 0; k < 3; ++k)
  {
    const Index a = corners[k];
    const Index b = corners[(k + 1) % 3];
    if (this->GetLength(a, b) > MostOfSlit * this->GetSize(a, b))
    {
      continue;
    }
    for (const Complex::Neighbor & neighbor : m_Complex.FindNeighbors(a))
    {
      const Index c = neighbor.vertex;
      if (c != b && m_Complex.CountTriangles(a, c) == 1 && m_Complex.CountTriangles(b, c) == 1 &&
          !m_Complex.HasTriangle({ { a, b, c } }))
      {
        m_Complex.AddTriangle({ { a, b, c } }, m_Complex.GetWall(triangle));
        ++m_HolesClosed;
        return true;
      }
    }
  }
  return false;
}

/** Two triangles over holes of four sides whose opposite vertices are next to one place. */
void
MedialVoxelRemesher::CloseSlits(const std::vector<Index> & onRims)
{
  for (const Index a : onRims)
  {
    const Complex::Indices ofA = this->FindLineNeighbors(a, Complex::Place::Rim);
    for (std::size_t k = 1; k < ofA.size(); ++k)
    {
      const Index p = ofA[k - 1];
      const Index q = ofA[k];
      for (const Index d : this->FindLineNeighbors(p, Complex::Place::Rim))
      {
        if (d > a && m_Complex.CountTriangles(d, q) == 1 && m_Complex.CountTriangles(a, d) == 0 &&
            m_Complex.CountTriangles(p, q) == 0 && this->GetLength(a, d) < MostOfSlit * this->GetSize(a, d))
        {
          const Index wall = m_Complex.GetWall(m_Complex.FindTriangles(a, p)[0]);
          m_Complex.AddTriangle({ { a, p, d } }, wall);
          m_Complex.AddTriangle({ { a, d, q } }, wall);
          ++m_HolesClosed;
          break;
        }
      }
    }
  }
}

/** Of a strip or a fin that is too narrow for elements, from a triangle of it on while they are bad. */
bool
MedialVoxelRemesher::TryLeaveOut(const Index triangle)
{
  bool  found = false;
  Index end = triangle;
  while (end != Complex::None && this->GetBadness(end) > 0.0 && (this->IsEnd(end) || (!found && this->IsInStrip(end))))
  {
    const Triangle corners = m_Complex.GetTriangle(end);
    m_Complex.RemoveTriangle(end);
    m_Witnesses.LeaveOut(end);
    ++m_LeftOut;
    found = true;
    end = Complex::None;
    for (unsigned int k = 0; k < 3; ++k)
    {
      const Complex::Indices next = m_Complex.FindTriangles(corners[k], corners[(k + 1) % 3]);
      end = next.size() == 1 ? next[0] : end;
    }
  }
  return found;
}

/** Whether a triangle is all that is between two rims. */
bool
MedialVoxelRemesher::IsInStrip(const Index triangle) const
{
  const Triangle & corners = m_Complex.GetTriangle(triangle);
  return std::all_of(corners.begin(), corners.end(), [this](const Index corner) {
    return m_Complex.GetPlace(corner) == Complex::Place::Rim;
  });
}

/** Whether a strip gets shorter without a triangle, or it hangs on others by corners at most. */
bool
MedialVoxelRemesher::IsEnd(const Index triangle) const
{
  const Triangle & corners = m_Complex.GetTriangle(triangle);
  unsigned int     rims = 0;
  for (unsigned int k = 0; k < 3; ++k)
  {
    rims += m_Complex.CountTriangles(corners[k], corners[(k + 1) % 3]) == 1 ? 1 : 0;
  }
  return rims >= 2;
}

} // end namespace itk
