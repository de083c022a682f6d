// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSheetDecimation.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelSheetTree.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;

constexpr double Long = 4.0 / 3.0;
constexpr double Short = 4.0 / 5.0;

/** Of the wanted size: the largest error. */
constexpr double ToleranceOfSize = 0.08;

/** The same of lines, of the tolerance. */
constexpr double ToleranceOfLine = 2.0;

/** Of a triangle that a collapse changes: how far its normal may turn, and the shape that it is to keep. */
constexpr double CosineOfTurn = 0.5;
constexpr double LeastQuality = 0.3;

/** A vertex whose cost has grown by more since it was queued waits again. */
constexpr double MostGrowth = 1.1;

/** Above all costs that are. */
constexpr double NotAllowed = 2.0;

} // namespace

void
MedialVoxelSheetDecimation::Quadric::AddForm(const std::array<double, 6> & form, const Point & point, double weight)
{
  const Point linear{ { form[0] * point[0] + form[1] * point[1] + form[2] * point[2],
                        form[1] * point[0] + form[3] * point[1] + form[4] * point[2],
                        form[2] * point[0] + form[4] * point[1] + form[5] * point[2] } };
  for (unsigned int k = 0; k < form.size(); ++k)
  {
    m_Form[k] += weight * form[k];
  }
  m_Linear = MedialVoxelAddScaled(m_Linear, linear, weight);
  m_Constant += weight * MedialVoxelDot(linear, point);
  m_Weight += weight;
}

void
MedialVoxelSheetDecimation::Quadric::AddPlane(const Point & point, const Point & n, const double weight)
{
  this->AddForm({ { n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2] } }, point, weight);
}

void
MedialVoxelSheetDecimation::Quadric::Add(const Quadric & other)
{
  for (unsigned int k = 0; k < m_Form.size(); ++k)
  {
    m_Form[k] += other.m_Form[k];
  }
  m_Linear = MedialVoxelAddScaled(m_Linear, other.m_Linear, 1.0);
  m_Constant += other.m_Constant;
  m_Weight += other.m_Weight;
}

double
MedialVoxelSheetDecimation::Quadric::GetSum(const Point & p) const
{
  const double squares = m_Form[0] * p[0] * p[0] + m_Form[3] * p[1] * p[1] + m_Form[5] * p[2] * p[2];
  const double mixed = m_Form[1] * p[0] * p[1] + m_Form[2] * p[0] * p[2] + m_Form[4] * p[1] * p[2];
  return std::max(0.0, squares + 2.0 * (mixed - MedialVoxelDot(m_Linear, p)) + m_Constant);
}

MedialVoxelSheetDecimation::MedialVoxelSheetDecimation(Complex &                   complex,
                                                       const double                noise,
                                                       std::function<void(double)> progress)
  : m_Complex(complex)
  , m_Noise(noise)
  , m_Progress(std::move(progress))
  , m_Planes(complex.GetNumberOfVertices())
  , m_LineErrors(complex.GetNumberOfVertices())
  , m_IsQueued(complex.GetNumberOfVertices())
{}

void
MedialVoxelSheetDecimation::Run()
{
  this->AddQuadrics();
  for (Index vertex = 0; vertex < m_Complex.GetNumberOfVertices(); ++vertex)
  {
    this->Queue(vertex);
  }
  for (std::size_t steps = 0; !m_Queue.empty(); ++steps)
  {
    if (steps % 4096 == 0 && m_Progress)
    {
      m_Progress(std::min(1.0, static_cast<double>(steps) / (4.0 * m_Complex.GetNumberOfVertices())));
    }
    const Entry entry = m_Queue.top();
    m_Queue.pop();
    m_IsQueued[entry.vertex] = false;
    const Complex::Neighbors neighbors = m_Complex.FindNeighbors(entry.vertex);
    const Candidates         candidates = this->ListCandidates(entry.vertex, neighbors);
    if (candidates.size() > 0 && candidates[0].cost > MostGrowth * entry.cost)
    {
      m_Queue.push({ candidates[0].cost, entry.vertex });
      m_IsQueued[entry.vertex] = true;
      continue;
    }
    const bool isCollapsed = std::any_of(candidates.begin(), candidates.end(), [&](const Candidate & candidate) {
      return this->TryCollapse(entry.vertex, candidate.vertex, neighbors);
    });
    for (std::size_t k = 0; isCollapsed && k < neighbors.size(); ++k)
    {
      this->Queue(neighbors[k].vertex);
    }
  }
}

/** Of each triangle its plane, by its area. */
void
MedialVoxelSheetDecimation::AddQuadrics()
{
  for (Index triangle = 0; triangle < m_Complex.GetNumberOfTriangles(); ++triangle)
  {
    if (!m_Complex.IsTriangle(triangle))
    {
      continue;
    }
    const auto   corners = m_Complex.GetCorners(triangle);
    const Vector normal = MedialVoxelTriangleNormal(corners);
    const double length = MedialVoxelNorm(normal);
    Quadric      plane;
    if (length > 0.0)
    {
      plane.AddPlane(corners[0], MedialVoxelAddScaled({}, normal, 1.0 / length), length);
    }
    for (const Index vertex : m_Complex.GetTriangle(triangle))
    {
      m_Planes[vertex].Add(plane);
    }
  }
}

void
MedialVoxelSheetDecimation::Queue(const Index vertex)
{
  if (m_IsQueued[vertex] || m_Complex.IsShared(vertex) || m_Complex.GetTrianglesOf(vertex).empty())
  {
    return;
  }
  const Candidates candidates = this->ListCandidates(vertex, m_Complex.FindNeighbors(vertex));
  if (candidates.size() > 0)
  {
    m_Queue.push({ candidates[0].cost, vertex });
    m_IsQueued[vertex] = true;
  }
}

/** The neighbors that a vertex may be put on, as far as sizes and errors say, cheapest first. */
MedialVoxelSheetDecimation::Candidates
MedialVoxelSheetDecimation::ListCandidates(const Index vertex, const Complex::Neighbors & neighbors) const
{
  Complex::Indices rims;
  Complex::Indices junctions;
  for (const Complex::Neighbor & neighbor : neighbors)
  {
    if (neighbor.triangles != 2)
    {
      (neighbor.triangles == 1 ? rims : junctions).push_back(neighbor.vertex);
    }
  }
  Candidates   candidates;
  const auto & line = rims.size() > 0 ? rims : junctions;
  const auto   add = [&](const Index other, const double lineError) {
    if (this->GetLength(vertex, other) < Short * this->GetSize(vertex, other))
    {
      const double cost = this->GetCost(vertex, other, lineError);
      if (cost < NotAllowed)
      {
        candidates.push_back({ cost, other });
      }
    }
  };
  if (rims.size() + junctions.size() == 0)
  {
    std::for_each(neighbors.begin(), neighbors.end(), [&](const auto & neighbor) { add(neighbor.vertex, 0.0); });
  }
  else if (line.size() == 2 && (rims.size() == 0 || junctions.size() == 0))
  {
    add(line[0], this->GetLineError(vertex, line[0], line[1]));
    add(line[1], this->GetLineError(vertex, line[1], line[0]));
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate & a, const Candidate & b) {
    return a.cost != b.cost ? a.cost < b.cost : a.vertex < b.vertex;
  });
  return candidates;
}

/** How far the line of a vertex is from points that went, at the least, when it goes from \a to straight to \a other.
 */
double
MedialVoxelSheetDecimation::GetLineError(const Index vertex, const Index to, const Index other) const
{
  const Vector & point = m_Complex.GetPoint(vertex);
  const Vector & end = m_Complex.GetPoint(other);
  const Vector   nearest = MedialVoxelNearestOfTriangle(point, { { m_Complex.GetPoint(to), end, end } });
  return std::max({ m_LineErrors[vertex],
                    m_LineErrors[to],
                    m_LineErrors[other],
                    MedialVoxelNorm(MedialVoxelSubtract(nearest, point)) });
}

/** The squares of the error, of the allowed one, and of the length, of the size. */
double
MedialVoxelSheetDecimation::GetCost(const Index from, const Index to, const double lineError) const
{
  const Vector &  place = m_Complex.GetPoint(to);
  const double    tolerance = std::max(ToleranceOfSize * this->GetSize(to, to), m_Noise);
  const Quadric & a = m_Planes[from];
  const Quadric & b = m_Planes[to];
  const double    weight = a.GetWeight() + b.GetWeight();
  const double    plane = weight > 0.0 ? (a.GetSum(place) + b.GetSum(place)) / weight : 0.0;
  const double    line = lineError / ToleranceOfLine;
  const double    ofTolerance = std::max(plane, line * line) / (tolerance * tolerance);
  const double    ofSize = this->GetLength(from, to) / this->GetSize(from, to);
  return ofTolerance > 1.0 ? NotAllowed : ofTolerance + ofSize * ofSize;
}

bool
MedialVoxelSheetDecimation::TryCollapse(const Index from, const Index to, const Complex::Neighbors & neighbors)
{
  const bool isShort = std::all_of(neighbors.begin(), neighbors.end(), [&](const Complex::Neighbor & neighbor) {
    const Index other = neighbor.vertex;
    return other == to || this->GetLength(other, to) <= Long * this->GetSize(other, to);
  });
  if (!isShort || !this->KeepsShapes(from, to) || !m_Complex.CanCollapse(from, neighbors, to))
  {
    return false;
  }
  for (const Complex::Neighbor & neighbor : neighbors)
  {
    const auto own = std::find_if(neighbors.begin(), neighbors.end(), [&](const auto & n) { return n.vertex == to; });
    if (own->triangles != 2 && neighbor.triangles != 2 && neighbor.vertex != to)
    {
      const double error = this->GetLineError(from, to, neighbor.vertex);
      m_LineErrors[to] = m_LineErrors[neighbor.vertex] = error;
    }
  }
  m_Complex.Collapse(from, to);
  m_Planes[to].Add(m_Planes[from]);
  return true;
}

bool
MedialVoxelSheetDecimation::KeepsShapes(const Index from, const Index to) const
{
  double before = LeastQuality;
  double after = 1.0;
  for (const Index triangle : m_Complex.GetTrianglesOf(from))
  {
    const Complex::Triangle & corners = m_Complex.GetTriangle(triangle);
    auto                      points = m_Complex.GetCorners(triangle);
    const Vector              normal = MedialVoxelTriangleNormal(points);
    before = std::min(before, MedialVoxelScaledJacobian(points));
    if (std::find(corners.begin(), corners.end(), to) == corners.end())
    {
      points[static_cast<std::size_t>(std::find(corners.begin(), corners.end(), from) - corners.begin())] =
        m_Complex.GetPoint(to);
      if (MedialVoxelCosine(normal, MedialVoxelTriangleNormal(points)) < CosineOfTurn)
      {
        return false;
      }
      after = std::min(after, MedialVoxelScaledJacobian(points));
    }
  }
  return after >= before;
}

double
MedialVoxelSheetDecimation::GetSize(const Index a, const Index b) const
{
  return (m_Complex.GetSize(a) + m_Complex.GetSize(b)) / 2.0;
}

double
MedialVoxelSheetDecimation::GetLength(const Index a, const Index b) const
{
  return MedialVoxelNorm(MedialVoxelSubtract(m_Complex.GetPoint(a), m_Complex.GetPoint(b)));
}

} // end namespace itk
