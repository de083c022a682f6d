// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// How faces of cells are split of which all edges are crossed.

#include "itkMedialVoxelSurfaceCrossings.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>

namespace itk
{

using WordType = MedialVoxelBits::WordType;
using Topology = MedialVoxelSurfaceTopology;

namespace
{

MedialVoxelDisplacement
DisplacementAt(const MedialVoxelFeatures & features, const std::size_t at)
{
  return { { features.dx[at], features.dy[at], features.dz[at] } };
}

} // namespace

/** A face of a cell, whose first voxel is the lowest one. */
struct MedialVoxelSurfaceCrossings::Face
{
  Face(const MedialVoxelIndex & ofCell, const unsigned int direction)
    : cell(ofCell)
    , behind(ofCell)
    , first(ofCell)
    , normal(direction / 2)
  {
    behind[normal] += direction % 2 == 0 ? -1 : 1;
    first[normal] += direction % 2;
  }

  MedialVoxelIndex cell;
  MedialVoxelIndex behind; // the cell behind it
  MedialVoxelIndex first;
  unsigned int     normal;
};

/** The boundary points of voxels across from each other: the first one and its partner, or both uneven ones. */
MedialVoxelPair
MedialVoxelSurfaceCrossings::PairAcross(const MedialVoxelFeatures & features,
                                        const Face &                face,
                                        const unsigned int          uneven)
{
  MedialVoxelIndex from = face.first;
  from[(face.normal + 1) % 3] += uneven;
  MedialVoxelIndex to = face.first;
  to[(face.normal + 1) % 3] += 1 - uneven;
  to[(face.normal + 2) % 3] += 1;
  MedialVoxelPair pair;
  pair.displacement = DisplacementAt(features, features.OffsetOf(from[0], from[1], from[2]));
  pair.oppositeDisplacement = DisplacementAt(features, features.OffsetOf(to[0], to[1], to[2]));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    pair.a[axis] = from[axis] + pair.displacement[axis];
    pair.difference[axis] = static_cast<std::int32_t>(pair.a[axis] - to[axis]) - pair.oppositeDisplacement[axis];
  }
  return pair;
}

/** Find the thresholds on both sides of the faces whose edges are all crossed, for FindSplit(), where they matter. */
void
MedialVoxelSurfaceCrossings::FindThresholdsOfSplits(const MedialVoxelClassifiedTile & tile, Workspace & workspace) const
{
  auto & cells = workspace.m_ThresholdCells;
  cells.clear();
  MedialVoxelAbortChecker checker;
  // Every crossed edge has an object voxel, which is a corner of the cells around it.
  for (const MedialVoxelCellRow & row : tile.rows)
  {
    checker.Count(static_cast<std::uint32_t>(MedialVoxelBits::BitsPerWord));
    for (WordType rest = row.candidates; rest != 0; rest &= rest - 1)
    {
      const MedialVoxelIndex   cell{ { row.first[0] + MedialVoxelLowestBit(rest), row.first[1], row.first[2] } };
      const Topology::EdgeMask crossed = workspace.GetCrossedEdges(cell);
      if (crossed == 0)
      {
        continue;
      }
      for (unsigned int directions = Topology::AmbiguousDirections(crossed); directions != 0;
           directions &= directions - 1)
      {
        const Face face(cell, static_cast<unsigned int>(MedialVoxelLowestBit(directions)));
        if (this->DecideByLimits(tile, face, 0) == Answer::Unknown ||
            this->DecideByLimits(tile, face, 1) == Answer::Unknown)
        {
          for (const MedialVoxelIndex & side : { face.cell, face.behind })
          {
            if (m_CellBox.Contains(side))
            {
              cells.push_back(side);
            }
          }
        }
      }
    }
  }
  if (!cells.empty())
  {
    this->FindRadii(tile, workspace);
    m_Threshold.RaiseRadii(tile.classification.joint.GetSurvey(), workspace.m_Threshold);
  }
}

MedialVoxelSurfaceTopology::Split
MedialVoxelSurfaceCrossings::FindSplit(const MedialVoxelClassifiedTile & tile,
                                       const MedialVoxelIndex &          cell,
                                       const unsigned int                direction,
                                       Workspace &                       workspace,
                                       MedialVoxelBox &                  missing) const
{
  const Face face(cell, direction);
  bool       isApart[2];
  double     squared[2];
  for (unsigned int uneven = 0; uneven < 2; ++uneven)
  {
    const MedialVoxelPair pair = PairAcross(tile.features, face, uneven);
    const Answer          answer = this->DecideByLimits(tile, face, uneven);
    isApart[uneven] =
      answer == Answer::Unknown ? this->AreApart(tile, face, pair, workspace, missing) : answer == Answer::Apart;
    squared[uneven] = m_Grid.SquaredMetricLength(pair.difference[0], pair.difference[1], pair.difference[2]);
  }
  if (isApart[0] && isApart[1])
  {
    return Topology::Unsplit;
  }
  const bool evenAreOfOneSide = isApart[1] || (!isApart[0] && squared[0] <= squared[1]);
  return evenAreOfOneSide ? Topology::AroundUneven : Topology::AroundEven;
}

/** Whether a pair across a face is apart, by the bounds of the cells on both sides of it. */
auto
MedialVoxelSurfaceCrossings::DecideByLimits(const MedialVoxelClassifiedTile & tile,
                                            const Face &                      face,
                                            const unsigned int                uneven) const -> Answer
{
  if (!m_DecidesTogether)
  {
    return Answer::Unknown;
  }
  MedialVoxelJointClassifier::CellsOfEdge sides;
  for (const MedialVoxelIndex & cell : { face.cell, face.behind })
  {
    if (m_CellBox.Contains(cell))
    {
      sides.cells[sides.number++] = cell;
    }
  }
  const MedialVoxelPair                   pair = PairAcross(tile.features, face, uneven);
  const MedialVoxelIndex                  b = pair.GetB();
  MedialVoxelJointClassifier::CrossedPair crossed{ pair.a, b, m_Parameters.epsilon, m_Parameters.epsilon };
  tile.classifier.GetJoint().LookAt(tile.classification.joint, tile.features, sides, crossed);
  if (m_Cell.IsTrivial(pair.difference, crossed.leastEpsilon) || crossed.bounds.FallShortOf(crossed.leastEpsilon))
  {
    return Answer::Near;
  }
  return crossed.bounds.Reach(crossed.mostEpsilon) || m_Cell.FreeSpaceLength(pair.difference) >= crossed.mostEpsilon
           ? Answer::Apart
           : Answer::Unknown;
}

/** Whether the points of a pair across a face are at least as far apart along the boundary as the larger threshold of
 * both sides. */
bool
MedialVoxelSurfaceCrossings::AreApart(const MedialVoxelClassifiedTile & tile,
                                      const Face &                      face,
                                      const MedialVoxelPair &           pair,
                                      Workspace &                       workspace,
                                      MedialVoxelBox &                  missing) const
{
  const double epsilon = std::max(this->EpsilonOf(face.cell, workspace), this->EpsilonOf(face.behind, workspace));
  if (m_Cell.IsTrivial(pair.difference, epsilon))
  {
    return false;
  }
  const MedialVoxelBits & sites = *tile.window.sites;
  if (!m_DecidesTogether)
  {
    return m_Decision.Decide(sites, pair, tile.classification.geodesic, missing) != MedialVoxelLabel::NonMedial;
  }
  if (m_Cell.FreeSpaceLength(pair.difference) >= epsilon)
  {
    return true;
  }
  auto & queries = workspace.m_QueryOfSplit;
  queries.assign(1, { pair.a, pair.GetB(), epsilon, 0 });
  const MedialVoxelBox unknown =
    m_Separation.FindSeparated(sites, tile.progress, tile.classification.joint.GetSeparation(), queries);
  if (!unknown.IsEmpty())
  {
    missing = missing.Union(unknown);
    return false;
  }
  return queries[0].isSeparated || m_Separation.Reaches(sites, queries[0], tile.classification.joint.GetSeparation());
}

} // end namespace itk
