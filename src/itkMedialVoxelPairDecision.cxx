// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPairDecision.h"

#include <algorithm>

namespace itk
{

namespace
{

/** The threshold itself, or that in voxels for which floods are cheap: paths below it are below larger ones too. */
double
FloodEpsilon(const MedialVoxelGrid & grid, const double epsilon)
{
  constexpr double cheapFlood = 4.75;
  return MedialVoxelBitFlood::Covers(grid, epsilon) ? epsilon : std::min(epsilon, cheapFlood * grid.GetMetricUnit());
}

} // namespace

MedialVoxelPairDecision::MedialVoxelPairDecision(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
  : m_Parameters(parameters)
  , m_Cell(grid)
  , m_Geodesic(grid, parameters.epsilon)
  , m_Flood(grid, FloodEpsilon(grid, parameters.epsilon))
  , m_FloodIsForEpsilon(FloodEpsilon(grid, parameters.epsilon) == parameters.epsilon)
{}

void
MedialVoxelPairDecision::Begin(const MedialVoxelBits & boundary,
                               const MedialVoxelBox &  tile,
                               Workspace &             workspace) const
{
  m_Geodesic.Begin(boundary, tile, workspace);
}

std::uint8_t
MedialVoxelPairDecision::Decide(const MedialVoxelBits & boundary,
                                const MedialVoxelPair & pair,
                                Workspace &             workspace,
                                MedialVoxelBox &        missing) const
{
  if (m_Parameters.bound != MedialVoxelPseudoGeodesicBound::Paper)
  {
    auto result = m_Flood.Decide(boundary, pair.a, pair.difference);
    if (!m_FloodIsForEpsilon && result != MedialVoxelBitFlood::Result::FallsShort)
    {
      result = MedialVoxelBitFlood::Result::Undecided;
    }
    switch (result)
    {
      case MedialVoxelBitFlood::Result::Bounded:
        return m_Parameters.bound == MedialVoxelPseudoGeodesicBound::FreeSpace ? MedialVoxelLabel::MedialByBound
                                                                               : MedialVoxelLabel::MedialByGeodesic;
      case MedialVoxelBitFlood::Result::Reaches:
        return MedialVoxelLabel::MedialByGeodesic;
      case MedialVoxelBitFlood::Result::FallsShort:
        return MedialVoxelLabel::NonMedial;
      case MedialVoxelBitFlood::Result::Undecided:
        break;
    }
  }

  double bound = 0.0;
  switch (m_Parameters.bound)
  {
    case MedialVoxelPseudoGeodesicBound::FreeSpace:
      bound = m_Cell.FreeSpaceLength(pair.difference);
      break;
    case MedialVoxelPseudoGeodesicBound::Paper:
      bound = m_Cell.PseudoGeodesicDistance(pair.displacement, pair.oppositeDisplacement);
      break;
    case MedialVoxelPseudoGeodesicBound::Off:
      break;
  }
  if (bound >= m_Parameters.epsilon)
  {
    return MedialVoxelLabel::MedialByBound;
  }

  const MedialVoxelIndex b{
    { pair.a[0] - pair.difference[0], pair.a[1] - pair.difference[1], pair.a[2] - pair.difference[2] }
  };
  const MedialVoxelBox searchBox = m_Geodesic.GetSearchBox(pair.a, b);
  if (!boundary.GetBox().Contains(searchBox))
  {
    missing = missing.Union(searchBox);
    return MedialVoxelLabel::NonMedial;
  }
  return m_Geodesic.ReachesThreshold(pair.a, b, workspace) ? MedialVoxelLabel::MedialByGeodesic
                                                           : MedialVoxelLabel::NonMedial;
}

} // end namespace itk
