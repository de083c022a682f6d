// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelPairDecision.h"

#include <algorithm>

namespace itk
{

namespace
{

/** The threshold itself, or the one in voxels for which floods are cheap: paths below it are below larger ones too. */
double
FloodEpsilon(const MedialVoxelGrid & grid, const double epsilon)
{
  constexpr double cheapFlood = 4.75;
  return MedialVoxelBitFlood::Covers(grid, epsilon) ? epsilon : std::min(epsilon, cheapFlood * grid.GetMetricUnit());
}

} // namespace

double
MedialVoxelBoundOf(const MedialVoxelPair &              pair,
                   const MedialVoxelDualCell &          cell,
                   const MedialVoxelPseudoGeodesicBound kind)
{
  switch (kind)
  {
    case MedialVoxelPseudoGeodesicBound::FreeSpace:
      return cell.FreeSpaceLength(pair.difference);
    case MedialVoxelPseudoGeodesicBound::Paper:
      return cell.PseudoGeodesicDistance(pair.displacement, pair.oppositeDisplacement);
    case MedialVoxelPseudoGeodesicBound::Off:
      break;
  }
  return 0.0;
}

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

  if (MedialVoxelBoundOf(pair, m_Cell, m_Parameters.bound) >= m_Parameters.epsilon)
  {
    return MedialVoxelLabel::MedialByBound;
  }

  const MedialVoxelIndex b = pair.GetB();
  const MedialVoxelBox   searchBox = m_Geodesic.GetSearchBox(pair.a, b);
  if (!boundary.GetBox().Contains(searchBox))
  {
    missing = missing.Union(searchBox);
    return MedialVoxelLabel::NonMedial;
  }
  return m_Geodesic.ReachesThreshold(pair.a, b, workspace) ? MedialVoxelLabel::MedialByGeodesic
                                                           : MedialVoxelLabel::NonMedial;
}

} // end namespace itk
