// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelParameters.h"

#include "itkMedialVoxelGridLimits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace itk
{

double
MedialVoxelParameters::EpsilonFromThickness(const double thickness)
{
  constexpr double pi = 3.14159265358979323846;
  return pi * thickness / 2.0;
}

std::uint64_t
MedialVoxelParameters::GetDefaultMaximumPoreSize(const MedialVoxelThicknessMode mode)
{
  return mode == MedialVoxelThicknessMode::Fixed ? 0 : DefaultMaximumPoreSize;
}

MedialVoxelParameters
MedialVoxelParameters::ForSettings(const MedialVoxelGrid & grid, const Settings & settings)
{
  MedialVoxelParameters parameters;
  if (settings.mode == MedialVoxelThicknessMode::Fixed)
  {
    parameters =
      ForThickness(std::max(settings.thickness, MedialVoxelGridLimits::LeastThickness(grid)), settings.bound);
  }
  else
  {
    const Limits limits = LimitsOfWalls(grid, settings.minimumThickness, settings.maximumThickness);
    parameters = ForWalls(limits.minimum, limits.maximum, settings.bound);
  }
  parameters.maximumPoreSize = settings.maximumPoreSize.value_or(GetDefaultMaximumPoreSize(settings.mode));
  return parameters;
}

MedialVoxelParameters
MedialVoxelParameters::ForThickness(const double thickness, const MedialVoxelPseudoGeodesicBound bound)
{
  MedialVoxelParameters parameters;
  parameters.epsilon = EpsilonFromThickness(thickness);
  parameters.bound = bound;
  return parameters;
}

MedialVoxelParameters::Limits
MedialVoxelParameters::LimitsOfWalls(const MedialVoxelGrid & grid, const double minimum, const double maximum)
{
  // The shortest edge runs along the axis with the smallest spacing; a grid of one voxel has none, and no cell.
  const double voxel = std::isfinite(grid.GetShortestEdge()) ? grid.GetShortestEdge() : 1.0;
  // Steps along a much longer axis are no walls, and a wall across it has a few of them.
  constexpr double mostLongVoxels = 4.0;
  const double     least = MedialVoxelGridLimits::LeastThickness(grid);
  const double     most = std::max(MostVoxelsOfWalls * voxel, mostLongVoxels * least);
  return { std::max(minimum > 0.0 ? minimum : FewestVoxelsOfWalls * voxel, least),
           std::max(maximum > 0.0 ? maximum : most, least) };
}

MedialVoxelParameters
MedialVoxelParameters::ForWalls(const double minimum, const double maximum, const MedialVoxelPseudoGeodesicBound bound)
{
  MedialVoxelParameters parameters = ForThickness(minimum, bound);
  parameters.mode = MedialVoxelThicknessMode::Automatic;
  parameters.largestRadius = maximum / 2.0;
  return parameters;
}

double
MedialVoxelParameters::GetLargestEpsilon() const
{
  return mode == MedialVoxelThicknessMode::Fixed ? epsilon : std::max(epsilon, thicknessFactor * largestRadius);
}

namespace
{

using CountMember = std::pair<const char *, std::uint64_t MedialVoxelCounts::*>;

constexpr std::array<CountMember, sizeof(MedialVoxelCounts) / sizeof(std::uint64_t)> CountMembers{
  { { "objectVoxels", &MedialVoxelCounts::objectVoxels },
    { "boundaryVoxels", &MedialVoxelCounts::boundaryVoxels },
    { "notANumberVoxels", &MedialVoxelCounts::notANumberVoxels },
    { "filledVoxels", &MedialVoxelCounts::filledVoxels },
    { "removedVoxels", &MedialVoxelCounts::removedVoxels },
    { "candidateCells", &MedialVoxelCounts::candidateCells },
    { "trivialCells", &MedialVoxelCounts::trivialCells },
    { "boundCells", &MedialVoxelCounts::boundCells },
    { "geodesicMedialCells", &MedialVoxelCounts::geodesicMedialCells },
    { "geodesicNonMedialCells", &MedialVoxelCounts::geodesicNonMedialCells } }
};

} // namespace

MedialVoxelCounts &
MedialVoxelCounts::operator+=(const MedialVoxelCounts & other)
{
  for (const auto & [name, member] : CountMembers)
  {
    this->*member += other.*member;
  }
  return *this;
}

std::ostream &
operator<<(std::ostream & out, const MedialVoxelCounts & counts)
{
  const char * separator = "";
  for (const auto & [name, member] : CountMembers)
  {
    out << separator << name << ' ' << counts.*member;
    separator = ", ";
  }
  return out;
}

} // end namespace itk
