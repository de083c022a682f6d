// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Resampling.h"

#include "Errors.h"
#include "Text.h"

#include "itkMedialVoxelGridLimits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medialvoxel
{
namespace
{

/** Share of a step below which a position counts as that of a voxel. */
constexpr double Rounding = 1e-9;

double
GetSmallestSpacing(const VolumeGeometry & geometry)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    smallest = geometry.size[axis] > 1 ? std::min(smallest, geometry.spacing[axis]) : smallest;
  }
  return smallest;
}

} // namespace

VolumeHeader
ResampleHeader(const VolumeHeader & header, double spacing)
{
  const double   target = spacing > 0.0 ? spacing : GetSmallestSpacing(header.geometry);
  VolumeGeometry geometry = header.geometry;
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    const std::uint64_t size = geometry.size[axis];
    if (size > 1 && geometry.spacing[axis] != target)
    {
      const double steps = std::floor(static_cast<double>(size - 1) * (geometry.spacing[axis] / target) + Rounding);
      // Beyond any limit it is all the same.
      geometry.size[axis] = static_cast<std::uint64_t>(std::min(steps, 1e18)) + 1;
      geometry.spacing[axis] = target;
    }
  }
  if (geometry.spacing == header.geometry.spacing)
  {
    return header;
  }
  const std::string problem = itk::MedialVoxelGridLimits::FindProblem(geometry.size, geometry.spacing, geometry.origin);
  if (!problem.empty())
  {
    Fail(ExitStatus::Usage,
         header.fileName.string(),
         ": with the resampled spacing ",
         FormatNumber(target),
         ", ",
         problem);
  }
  VolumeHeader resampled = header;
  resampled.geometry = geometry;
  resampled.pixelType = PixelType::Float64;
  resampled.stored = std::make_shared<const VolumeHeader>(header);
  return resampled;
}

Resampling::Resampling(const VolumeHeader & header, Interpolation interpolation)
  : m_Interpolation(interpolation)
{
  const VolumeGeometry & stored = header.GetStored().geometry;
  for (unsigned int axis = 0; axis < stored.GetDimension(); ++axis)
  {
    m_Strides[axis] = header.geometry.spacing[axis] / stored.spacing[axis];
    m_Last[axis] = static_cast<double>(stored.size[axis] - 1);
  }
}

Resampling::Step
Resampling::GetStep(unsigned int axis, std::uint64_t index) const
{
  const double position = std::min(m_Last[axis], static_cast<double>(index) * m_Strides[axis]);
  Step         step;
  step.lower = static_cast<std::uint64_t>(position);
  step.weight = position - static_cast<double>(step.lower);
  const double most = m_Interpolation == Interpolation::Nearest ? 0.5 : 1.0 - Rounding;
  const double least = m_Interpolation == Interpolation::Nearest ? 0.5 : Rounding;
  if (step.weight > most)
  {
    return { step.lower + 1, 0.0 };
  }
  return { step.lower, step.weight > least ? step.weight : 0.0 };
}

std::array<std::uint64_t, 2>
Resampling::GetStored(unsigned int axis, std::uint64_t first, std::uint64_t last) const
{
  return { { this->GetStep(axis, first).lower, this->GetStep(axis, last).GetUpper() } };
}

} // end namespace medialvoxel
