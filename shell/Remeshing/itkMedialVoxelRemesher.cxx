// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRemesher.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;
using Place = MedialVoxelTriangleComplex::Place;
using Index = MedialVoxelTriangleComplex::Index;

constexpr double Long = 4.0 / 3.0;
constexpr double Short = 4.0 / 5.0;

/** Of the size: how far the sheet may move, how short a side must be to close a wall over it. */
constexpr double ToleranceOfSize = 0.08;
constexpr double MergingOfSize = 0.3;

/** Of the size: shorter moves are not worth it. */
constexpr double LeastMove = 0.02;

/** Turns of a line, and of a normal. */
constexpr double CosineOfCorner = 0.6;
constexpr double CosineOfStep = 0.5;
constexpr double CosineOfBend = 0.87;

constexpr double GoodQuality = 0.3;

constexpr unsigned int RoundsOfPass = 2;

} // namespace

void
MedialVoxelRemesher::RunPart(const Round & round)
{
  for (unsigned int k = 0; k < round.steps; ++k)
  {
    this->SplitLongSides();
    this->CollapseShortSides(round.mergesAtOnce || k > 0);
    this->FlipSides();
    this->MoveVertices();
    this->FlipSides();
    this->MoveVertices();
  }
  for (unsigned int k = 0; k < round.repairs; ++k)
  {
    this->RepairTriangles();
    this->MoveVertices();
    this->FlipSides();
  }
}

void
MedialVoxelRemesher::Proceed()
{
  if (++m_Steps % 4096 == 0 && m_Progress)
  {
    m_Progress(m_Share);
  }
}

MedialVoxelRemesher::Index
MedialVoxelRemesher::BeginPass(const Pass pass)
{
  m_Touched.resize(m_Complex.GetNumberOfVertices(), m_NumberOfPasses);
  ++m_NumberOfPasses;
  return std::exchange(m_LastPasses[static_cast<std::size_t>(pass)], m_NumberOfPasses);
}

void
MedialVoxelRemesher::Touch(const std::vector<Index> & triangles)
{
  for (const Index triangle : triangles)
  {
    for (const Index vertex : m_Complex.GetTriangle(triangle))
    {
      m_Touched[vertex] = m_NumberOfPasses;
    }
  }
}

double
MedialVoxelRemesher::GetSize(const Index a, const Index b) const
{
  return (static_cast<double>(m_Complex.GetSize(a)) + m_Complex.GetSize(b)) / 2.0;
}

double
MedialVoxelRemesher::GetTolerance(const Index vertex) const
{
  return std::max(ToleranceOfSize * this->GetSize(vertex, vertex), m_Noise);
}

double
MedialVoxelRemesher::GetLength(const Index a, const Index b) const
{
  return MedialVoxelNorm(MedialVoxelSubtract(m_Complex.GetPoint(a), m_Complex.GetPoint(b)));
}

double
MedialVoxelRemesher::GetQuality(const Index triangle) const
{
  return MedialVoxelScaledJacobian(m_Complex.GetCorners(triangle));
}

/** Each once, in the order of the numbers of their vertices. */
std::vector<MedialVoxelRemesher::LengthOfSide>
MedialVoxelRemesher::ListSides() const
{
  std::vector<LengthOfSide> sides;
  for (Index vertex = 0; vertex < m_Complex.GetNumberOfVertices(); ++vertex)
  {
    for (const Complex::Neighbor & neighbor : m_Complex.FindNeighbors(vertex, vertex + 1))
    {
      sides.push_back({ this->GetLength(vertex, neighbor.vertex), vertex, neighbor.vertex });
    }
  }
  return sides;
}

/** Whether a side is not to be cut: one between shared points, and one beside a longer one that is not cut, as its
 * triangle would have a long side however often the others are cut. */
bool
MedialVoxelRemesher::IsStuck(const Index a, const Index b) const
{
  if (!m_HasShared)
  {
    return false;
  }
  if (m_Complex.IsShared(a) && m_Complex.IsShared(b))
  {
    return true;
  }
  const double           length = this->GetLength(a, b);
  const Complex::Indices triangles = m_Complex.FindTriangles(a, b);
  return std::any_of(triangles.begin(), triangles.end(), [&](const Index triangle) {
    const Index corner = m_Complex.GetOpposite(triangle, a, b);
    return (this->GetLength(a, corner) > length && this->IsStuck(a, corner)) ||
           (this->GetLength(b, corner) > length && this->IsStuck(b, corner));
  });
}

/** Longest first, until none is left. */
void
MedialVoxelRemesher::SplitLongSides()
{
  m_Touched.resize(m_Complex.GetNumberOfVertices(), m_NumberOfPasses);
  std::vector<Index> halves;
  for (bool found = true; found;)
  {
    found = false;
    std::vector<LengthOfSide> sides = this->ListSides();
    std::stable_sort(sides.begin(), sides.end(), [](const auto & x, const auto & y) { return x.length > y.length; });
    for (const LengthOfSide & side : sides)
    {
      if (side.length <= Long * this->GetSize(side.a, side.b) || this->IsStuck(side.a, side.b))
      {
        continue;
      }
      const Complex::Indices triangles = m_Complex.FindTriangles(side.a, side.b);
      if (triangles.size() == 0)
      {
        continue;
      }
      const Vector middle = MedialVoxelMiddle(m_Complex.GetPoint(side.a), m_Complex.GetPoint(side.b));
      this->Touch({ triangles.begin(), triangles.end() });
      m_Touched.push_back(m_NumberOfPasses);
      m_Complex.Split(side.a, side.b, middle, halves);
      for (Index k = 0; k < triangles.size(); ++k)
      {
        m_Witnesses.Share(triangles[k], halves[k], m_Complex.GetCorners(triangles[k]), m_Complex.GetCorners(halves[k]));
      }
      found = true;
      this->Proceed();
    }
  }
}

/** Shortest first. */
void
MedialVoxelRemesher::CollapseShortSides(const bool merging)
{
  for (unsigned int round = 0; round < RoundsOfPass; ++round)
  {
    bool                      found = false;
    std::vector<LengthOfSide> sides = this->ListSides();
    const Index               last = this->BeginPass(merging ? Pass::Merge : Pass::Collapse);
    std::stable_sort(sides.begin(), sides.end(), [](const auto & x, const auto & y) { return x.length < y.length; });
    for (const LengthOfSide & side : sides)
    {
      this->Proceed();
      const double size = this->GetSize(side.a, side.b);
      if (side.length < Short * size && std::max(m_Touched[side.a], m_Touched[side.b]) >= last &&
          m_Complex.CountTriangles(side.a, side.b) > 0 && this->GetLength(side.a, side.b) < Short * size)
      {
        const bool isMerging = merging && this->GetLength(side.a, side.b) < MergingOfSize * size;
        found = this->TryCollapse(side.a, side.b, isMerging) || this->TryCollapse(side.b, side.a, isMerging) || found;
      }
    }
    if (!found)
    {
      break;
    }
  }
}

void
MedialVoxelRemesher::FlipSides()
{
  for (unsigned int round = 0; round < RoundsOfPass; ++round)
  {
    bool        found = false;
    const Index last = this->BeginPass(Pass::Flip);
    for (const LengthOfSide & side : this->ListSides())
    {
      this->Proceed();
      found = this->TryFlip(side.a, side.b, last) || found;
    }
    if (!found)
    {
      break;
    }
  }
}

void
MedialVoxelRemesher::MoveVertices()
{
  const Index last = this->BeginPass(Pass::Move);
  for (Index vertex = 0; vertex < m_Complex.GetNumberOfVertices(); ++vertex)
  {
    this->Proceed();
    if (m_Touched[vertex] >= last && !m_Complex.GetTrianglesOf(vertex).empty())
    {
      this->TryMove(vertex, m_Complex.GetPlace(vertex));
    }
  }
}

/** Where triangles of a few fine sides meet at an angle, elements are to be as long as the wall is thick. */
void
MedialVoxelRemesher::RaiseSizesAtBends()
{
  std::vector<Index> points;
  for (const LengthOfSide & side : this->ListSides())
  {
    const Complex::Indices triangles = m_Complex.FindTriangles(side.a, side.b);
    if (triangles.size() == 2 &&
        std::abs(MedialVoxelCosine(MedialVoxelTriangleNormal(m_Complex.GetCorners(triangles[0])),
                                   MedialVoxelTriangleNormal(m_Complex.GetCorners(triangles[1])))) < CosineOfBend)
    {
      m_Witnesses.AppendPoints(triangles[0], points);
      m_Witnesses.AppendPoints(triangles[1], points);
    }
  }
  m_Fine.RaiseSizes(points);
}

/** At the other ends of its sides of a kind; Wall: of all. */
MedialVoxelRemesher::Complex::Indices
MedialVoxelRemesher::FindLineNeighbors(const Index vertex, const Place kind) const
{
  Complex::Indices found;
  for (const Complex::Neighbor & neighbor : m_Complex.FindNeighbors(vertex))
  {
    if (kind == Place::Wall || (kind == Place::Rim ? neighbor.triangles == 1 : neighbor.triangles > 2))
    {
      found.push_back(neighbor.vertex);
    }
  }
  return found;
}

bool
MedialVoxelRemesher::IsSharp(const Index vertex, const Place kind) const
{
  if (kind != Place::Rim && kind != Place::Junction)
  {
    return false;
  }
  const Complex::Indices line = this->FindLineNeighbors(vertex, kind);
  const Vector           first = MedialVoxelSubtract(m_Complex.GetPoint(vertex), m_Complex.GetPoint(line[0]));
  const Vector           second = MedialVoxelSubtract(m_Complex.GetPoint(line[1]), m_Complex.GetPoint(vertex));
  return this->GetSize(vertex, vertex) > 4.0 * m_Noise && MedialVoxelCosine(first, second) < CosineOfCorner;
}

/** Vertices of lines go along their lines only, unless two lines are to become one. */
bool
MedialVoxelRemesher::MayLeave(const Index from, const Index to, const bool merging) const
{
  const Place        place = m_Complex.GetPlace(from);
  const unsigned int triangles = m_Complex.CountTriangles(from, to);
  if (place == Place::Wall || merging)
  {
    return true;
  }
  const bool isAlong = (place == Place::Rim && triangles == 1) || (place == Place::Junction && triangles > 2);
  return isAlong && !this->IsSharp(from, place);
}

/** Whether the line that is left when a vertex of a line leaves it is still near that of the fine sheet. */
bool
MedialVoxelRemesher::KeepsLine(const Index from, const Index to, const double tolerance) const
{
  const Place place = m_Complex.GetPlace(from);
  if (place != Place::Rim && place != Place::Junction)
  {
    return true;
  }
  const Complex::Indices neighbors = this->FindLineNeighbors(from, place);
  return std::all_of(neighbors.begin(), neighbors.end(), [&](const Index other) {
    const Vector middle = MedialVoxelMiddle(m_Complex.GetPoint(other), m_Complex.GetPoint(to));
    return other == to || this->FindOnLine(from, place, middle, tolerance).distance < tolerance;
  });
}

bool
MedialVoxelRemesher::TryCollapse(const Index from, const Index to, const bool merging)
{
  if (!m_Complex.CanCollapse(from, to) || !this->MayLeave(from, to, merging))
  {
    return false;
  }
  const Complex::Neighbors neighbors = m_Complex.FindNeighbors(from);
  if (std::any_of(neighbors.begin(), neighbors.end(), [&](const Complex::Neighbor & neighbor) {
        const Index other = neighbor.vertex;
        return other != to && this->GetLength(other, to) > Long * this->GetSize(other, to);
      }))
  {
    return false;
  }
  const double tolerance =
    merging ? std::max(MergingOfSize * this->GetSize(to, to), this->GetTolerance(to)) : this->GetTolerance(to);
  const Step step = this->MakeCollapse(from, to);
  if (step.after.empty() || !this->KeepsLine(from, to, tolerance) ||
      !this->Allows(step, { tolerance, CosineOfStep, GoodQuality }))
  {
    return false;
  }
  this->Touch(step.before);
  m_Complex.Collapse(from, to);
  m_Witnesses.Assign(step.before, step.numbers);
  return true;
}

bool
MedialVoxelRemesher::TryFlip(const Index a, const Index b, const Index last)
{
  const Complex::Indices triangles = m_Complex.FindTriangles(a, b);
  if (triangles.size() != 2)
  {
    return false;
  }
  const Index c = m_Complex.GetOpposite(triangles[0], a, b);
  const Index d = m_Complex.GetOpposite(triangles[1], a, b);
  return std::max({ m_Touched[a], m_Touched[b], m_Touched[c], m_Touched[d] }) >= last &&
         this->TryPassOver(a, b, c, 0.01);
}

bool
MedialVoxelRemesher::TryMove(const Index vertex, const Place kind)
{
  if (kind == Place::Corner || this->IsSharp(vertex, kind))
  {
    return false;
  }
  const Point &          point = m_Complex.GetPoint(vertex);
  const Complex::Indices neighbors = this->FindLineNeighbors(vertex, kind);
  Point                  mean{};
  for (const Index other : neighbors)
  {
    mean = MedialVoxelAddScaled(mean, m_Complex.GetPoint(other), 1.0 / static_cast<double>(neighbors.size()));
  }
  for (const double share : { 1.0, 0.4 })
  {
    const auto nearest =
      this->Project(vertex, kind, MedialVoxelAddScaled(point, MedialVoxelSubtract(mean, point), share));
    const double length = MedialVoxelNorm(MedialVoxelSubtract(nearest.point, point));
    if (length >= LeastMove * this->GetSize(vertex, vertex) &&
        this->TryMoveTo(vertex, nearest, { this->GetTolerance(vertex), CosineOfStep, GoodQuality }))
    {
      return true;
    }
  }
  return false;
}

/** To a place that it was projected to. */
bool
MedialVoxelRemesher::TryMoveTo(const Index vertex, const MedialVoxelSheetTree::Nearest & nearest, const Rules & rules)
{
  if (!(nearest.distance < this->GetSize(vertex, vertex)))
  {
    return false;
  }
  const Step step = this->MakeMove(vertex, nearest.point);
  if (!this->Allows(step, rules))
  {
    return false;
  }
  if (m_Complex.GetPlace(vertex) == Place::Wall)
  {
    m_Complex.GetVertex(vertex).size = m_Fine.GetSize(m_Fine.GetNearestPoint(nearest.triangle, nearest.point));
  }
  this->Touch(step.before);
  m_Complex.GetVertex(vertex).point = nearest.point;
  m_Witnesses.Assign(step.before, step.numbers);
  return true;
}

/** Of the rims of the wall of a vertex, or of all junctions. */
MedialVoxelSheetTree::Nearest
MedialVoxelRemesher::FindOnLine(const Index vertex, const Place kind, const Point & place, const double within) const
{
  return kind == Place::Rim ? m_Fine.FindOnRim(place, m_Complex.GetWall(m_Complex.GetTrianglesOf(vertex)[0]), within)
                            : m_Fine.FindOnJunction(place, within);
}

MedialVoxelSheetTree::Nearest
MedialVoxelRemesher::Project(const Index vertex, const Place kind, const Point & place) const
{
  const double within = this->GetSize(vertex, vertex);
  if (kind == Place::Rim || kind == Place::Junction)
  {
    return this->FindOnLine(vertex, kind, place, within);
  }
  MedialVoxelSheetTree::Nearest best;
  std::vector<Index>            walls;
  for (const Index triangle : m_Complex.GetTrianglesOf(vertex))
  {
    const Index wall = m_Complex.GetWall(triangle);
    if (std::find(walls.begin(), walls.end(), wall) == walls.end())
    {
      walls.push_back(wall);
      const auto nearest = m_Fine.FindOnWall(place, wall, within);
      best = nearest.distance < best.distance ? nearest : best;
    }
  }
  return best;
}

} // end namespace itk
