// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelClassifier.h"

#include <array>
#include <limits>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

/** The diagonal of a cell whose boundary points are seen under the widest angle. */
struct MedialVoxelClassifier::Pair
{
  unsigned int            diagonal;
  MedialVoxelDisplacement displacement;
  MedialVoxelDisplacement oppositeDisplacement;
};

MedialVoxelClassifier::MedialVoxelClassifier(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Cell(grid)
  , m_Geodesic(grid, parameters.epsilon)
{}

MedialVoxelBox
MedialVoxelClassifier::GetVoxelBox(const MedialVoxelBox & tile) const
{
  MedialVoxelBox         box = tile;
  const MedialVoxelIndex margin = m_Grid.GetUnitMargin();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    box.upper[axis] += margin[axis];
  }
  return box.Intersection(m_Grid.GetVoxelBox());
}

namespace
{

/** Bits of the cells x of a word that have an object corner, for one row of cells. */
WordType
CandidateBits(const MedialVoxelBits &  object,
              const std::int64_t       word,
              const std::int64_t       y,
              const std::int64_t       z,
              const MedialVoxelIndex & margin)
{
  const std::int64_t x = word * MedialVoxelBits::BitsPerWord;
  WordType           bits = 0;
  for (std::int64_t dz = 0; dz <= margin[2]; ++dz)
  {
    for (std::int64_t dy = 0; dy <= margin[1]; ++dy)
    {
      bits |= object.Extract(x, y + dy, z + dz) | object.Extract(x + margin[0], y + dy, z + dz);
    }
  }
  return bits;
}

} // namespace

MedialVoxelBox
MedialVoxelClassifier::Classify(const MedialVoxelWindow &   window,
                                const MedialVoxelBox &      tile,
                                const MedialVoxelFeatures & features,
                                const MedialVoxelProgress & progress,
                                Workspace &                 workspace,
                                std::vector<std::uint8_t> & labels,
                                MedialVoxelCounts &         counts) const
{
  labels.assign(static_cast<std::size_t>(tile.NumberOfVoxels()), MedialVoxelLabel::NoObject);
  const MedialVoxelBox cells = tile.Intersection(m_Grid.GetCellBox());
  MedialVoxelBox       missing;
  for (std::int64_t z = cells.lower[2]; z < cells.upper[2]; ++z)
  {
    for (std::int64_t y = cells.lower[1]; y < cells.upper[1]; ++y)
    {
      std::uint8_t * const row =
        labels.data() + ((z - tile.lower[2]) * tile.Extent(1) + (y - tile.lower[1])) * tile.Extent(0);
      for (std::int64_t word = cells.lower[0] >> 6; word <= (cells.upper[0] - 1) >> 6; ++word)
      {
        WordType candidates = CandidateBits(*window.object, word, y, z, m_Grid.GetUnitMargin()) &
                              MedialVoxelBits::RangeMask(word, cells.lower[0], cells.upper[0]);
        counts.candidateCells += static_cast<std::uint64_t>(MedialVoxelPopulationCount(candidates));
        for (; candidates != 0; candidates &= candidates - 1)
        {
          const std::int64_t x = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(candidates);
          Pair               pair;
          std::uint8_t       label = MedialVoxelLabel::NonMedial;
          if (!this->ChoosePair(features, features.OffsetOf(x, y, z), pair))
          {
            ++counts.trivialCells;
          }
          else
          {
            // A single search can be long where epsilon is large.
            if (progress.IsAborted())
            {
              return missing;
            }
            label = this->ClassifyPair(*window.sites, { { x, y, z } }, pair, workspace, missing);
            counts.boundCells += (label == MedialVoxelLabel::MedialByBound) ? 1 : 0;
            counts.geodesicMedialCells += (label == MedialVoxelLabel::MedialByGeodesic) ? 1 : 0;
            counts.geodesicNonMedialCells += (label == MedialVoxelLabel::NonMedial) ? 1 : 0;
          }
          row[x - tile.lower[0]] = label;
        }
      }
    }
  }
  return missing;
}

/** The pair of definition 6; false when it is trivial or no diagonal has two boundary points. */
bool
MedialVoxelClassifier::ChoosePair(const MedialVoxelFeatures & features, const std::size_t offset, Pair & pair) const
{
  const auto nx = static_cast<std::size_t>(features.box.Extent(0));
  const auto ny = static_cast<std::size_t>(features.box.Extent(1));
  const auto displacementOf = [&](const unsigned int corner) -> MedialVoxelDisplacement {
    const MedialVoxelDisplacement & c = m_Cell.GetCorner(corner);
    const std::size_t at = offset + (static_cast<std::size_t>(c[2]) * ny + static_cast<std::size_t>(c[1])) * nx +
                           static_cast<std::size_t>(c[0]);
    return { { features.dx[at], features.dy[at], features.dz[at] } };
  };

  // Most cells are trivial along every diagonal, which needs no angle.
  std::array<Pair, 4> pairs;
  unsigned int        numberOfPairs = 0;
  bool                allTrivial = true;
  for (unsigned int diagonal = 0; diagonal < m_Cell.GetNumberOfDiagonals(); ++diagonal)
  {
    const Pair candidate{ diagonal, displacementOf(diagonal), displacementOf(m_Cell.GetOppositeCorner(diagonal)) };
    if (candidate.displacement[0] == MedialVoxelNoDisplacement ||
        candidate.oppositeDisplacement[0] == MedialVoxelNoDisplacement)
    {
      continue;
    }
    pairs[numberOfPairs++] = candidate;
    allTrivial =
      allTrivial &&
      m_Cell.IsTrivial(m_Cell.BoundaryDifference(diagonal, candidate.displacement, candidate.oppositeDisplacement),
                       m_Parameters.epsilon);
  }
  if (allTrivial)
  {
    return false;
  }

  double smallest = std::numeric_limits<double>::infinity();
  for (unsigned int i = 0; i < numberOfPairs; ++i)
  {
    const double key = m_Cell.CosineKey(pairs[i].diagonal, pairs[i].displacement, pairs[i].oppositeDisplacement);
    if (key < smallest)
    {
      smallest = key;
      pair = pairs[i];
    }
  }
  const auto difference = m_Cell.BoundaryDifference(pair.diagonal, pair.displacement, pair.oppositeDisplacement);
  return !m_Cell.IsTrivial(difference, m_Parameters.epsilon);
}

std::uint8_t
MedialVoxelClassifier::ClassifyPair(const MedialVoxelBits &  boundary,
                                    const MedialVoxelIndex & cell,
                                    const Pair &             pair,
                                    Workspace &              workspace,
                                    MedialVoxelBox &         missing) const
{
  const auto difference = m_Cell.BoundaryDifference(pair.diagonal, pair.displacement, pair.oppositeDisplacement);
  double     bound = 0.0;
  switch (m_Parameters.bound)
  {
    case MedialVoxelPseudoGeodesicBound::FreeSpace:
      bound = m_Cell.FreeSpaceLength(difference);
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

  const MedialVoxelDisplacement & corner = m_Cell.GetCorner(pair.diagonal);
  MedialVoxelIndex                a;
  MedialVoxelIndex                b;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    a[axis] = cell[axis] + corner[axis] + pair.displacement[axis];
    b[axis] = a[axis] - difference[axis];
  }
  const MedialVoxelBox searchBox = m_Geodesic.GetSearchBox(a, b);
  if (!boundary.GetBox().Contains(searchBox))
  {
    missing = missing.Union(searchBox);
    return MedialVoxelLabel::NonMedial;
  }
  return m_Geodesic.ReachesThreshold(boundary, a, b, workspace.geodesic) ? MedialVoxelLabel::MedialByGeodesic
                                                                         : MedialVoxelLabel::NonMedial;
}

} // end namespace itk
