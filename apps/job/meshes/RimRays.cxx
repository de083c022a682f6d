// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "RimRays.h"

#include "MeshPlacement.h"

#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medialvoxel
{
namespace
{

using Vector = std::array<double, 3>;

/** Steps in smallest spacings. */
constexpr double StepOfSpacing = 0.25;

/** The vectors whose products with a displacement are its numbers of voxels along the axes. */
std::array<Vector, 3>
InvertSteps(const std::array<Vector, 3> & steps)
{
  const double          volume = itk::MedialVoxelDot(steps[0], itk::MedialVoxelCross(steps[1], steps[2]));
  std::array<Vector, 3> toIndex;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    toIndex[axis] =
      itk::MedialVoxelAddScaled({}, itk::MedialVoxelCross(steps[(axis + 1) % 3], steps[(axis + 2) % 3]), 1.0 / volume);
  }
  return toIndex;
}

} // namespace

itk::MedialVoxelRimLimits
GetRimLimits(const VolumeGeometry & geometry)
{
  constexpr double          halfVoxel = 0.5;
  const auto                placement = GetPlacement(geometry);
  const auto                toIndex = InvertSteps(placement.steps);
  const auto                size = GetSize(geometry);
  itk::MedialVoxelRimLimits limits;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double start = itk::MedialVoxelDot(toIndex[axis], placement.origin);
    limits.push_back({ toIndex[axis], static_cast<double>(size[axis]) - halfVoxel + start });
    limits.push_back({ itk::MedialVoxelAddScaled({}, toIndex[axis], -1.0), halfVoxel - start });
  }
  return limits;
}

RimRays::RimRays(itk::MedialVoxelObjectSource &   input,
                 const VolumeGeometry &           geometry,
                 const std::optional<GrayRange> & range)
  : m_Input(input)
  , m_Size(GetSize(geometry))
  , m_Origin(GetPlacement(geometry).origin)
  , m_ToIndex(InvertSteps(GetPlacement(geometry).steps))
  , m_Step(StepOfSpacing * *std::min_element(geometry.spacing.begin(), geometry.spacing.end()))
  , m_Range(range)
{}

std::vector<double>
RimRays::Measure(const itk::MedialVoxelRimRays & rays) const
{
  const Window        window = this->Read(this->FindBox(rays));
  const Vector        step = this->ToIndexStep(itk::MedialVoxelAddScaled({}, rays.direction, m_Step));
  std::vector<double> lengths;
  for (const Vector & start : rays.starts)
  {
    lengths.push_back(m_Step * this->MeasureRay(window, this->ToIndex(start), step, rays.most / m_Step));
  }
  return lengths;
}

Vector
RimRays::ToIndexStep(const Vector & vector) const
{
  return { { itk::MedialVoxelDot(m_ToIndex[0], vector),
             itk::MedialVoxelDot(m_ToIndex[1], vector),
             itk::MedialVoxelDot(m_ToIndex[2], vector) } };
}

Vector
RimRays::ToIndex(const Vector & point) const
{
  return this->ToIndexStep(itk::MedialVoxelAddScaled(point, m_Origin, -1.0));
}

itk::MedialVoxelBox
RimRays::FindBox(const itk::MedialVoxelRimRays & rays) const
{
  itk::MedialVoxelBox box{ m_Size, { { 0, 0, 0 } } };
  for (const Vector & start : rays.starts)
  {
    for (const double length : { 0.0, rays.most + m_Step }) // the last step may go beyond
    {
      const Vector index = this->ToIndex(itk::MedialVoxelAddScaled(start, rays.direction, length));
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto low = static_cast<std::int64_t>(std::floor(index[axis]));
        box.lower[axis] = std::min(box.lower[axis], std::clamp<std::int64_t>(low, 0, m_Size[axis] - 1));
        box.upper[axis] = std::max(box.upper[axis], std::clamp<std::int64_t>(low + 2, 1, m_Size[axis]));
      }
    }
  }
  return box;
}

RimRays::Window
RimRays::Read(const itk::MedialVoxelBox & box) const
{
  Window                  window;
  itk::MedialVoxelTargets targets;
  window.object.Reshape(box);
  targets.object = &window.object;
  if (m_Range)
  {
    window.gray.Frame(box, box);
    targets.gray = &window.gray;
  }
  std::unique_lock<std::mutex> lock(m_Reading, std::defer_lock);
  if (m_Input.GetSourceThreads() != itk::MedialVoxelSourceThreads::Several)
  {
    lock.lock();
  }
  m_Input.Fill(box, targets);
  return window;
}

double
RimRays::GetMargin(const Window & window, const itk::MedialVoxelIndex & voxel) const
{
  itk::MedialVoxelIndex inside = voxel;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    inside[axis] = std::clamp<std::int64_t>(voxel[axis], 0, m_Size[axis] - 1);
  }
  double margin = window.object.Test(inside) ? 0.5 : -0.5;
  if (m_Range)
  {
    const double value = window.gray.Get(inside);
    margin = std::min(value - m_Range->lower, m_Range->upper - value);
  }
  return inside == voxel ? margin : -std::abs(margin);
}

double
RimRays::Interpolate(const Window & window, const Vector & index) const
{
  itk::MedialVoxelIndex low;
  Vector                share;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    low[axis] = static_cast<std::int64_t>(std::floor(index[axis]));
    share[axis] = index[axis] - static_cast<double>(low[axis]);
  }
  double sum = 0.0;
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::MedialVoxelIndex voxel = low;
    double                weight = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const bool isHigh = (corner >> axis & 1u) != 0;
      voxel[axis] += isHigh ? 1 : 0;
      weight *= isHigh ? share[axis] : 1.0 - share[axis];
    }
    sum += weight > 0.0 ? weight * this->GetMargin(window, voxel) : 0.0;
  }
  return sum;
}

/** \return its length in steps, infinite when it starts outside or is longer */
double
RimRays::MeasureRay(const Window & window, const Vector & start, const Vector & step, const double steps) const
{
  double before = this->Interpolate(window, start);
  for (double way = 0.0; before >= 0.0 && way < steps; way += 1.0)
  {
    const double after = this->Interpolate(window, itk::MedialVoxelAddScaled(start, step, way + 1.0));
    if (after < 0.0)
    {
      return way + before / (before - after);
    }
    before = after;
  }
  return std::numeric_limits<double>::infinity();
}

} // end namespace medialvoxel
