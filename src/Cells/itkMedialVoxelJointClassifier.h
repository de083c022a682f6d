// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelJointClassifier_h
#define itkMedialVoxelJointClassifier_h

#include "itkMedialVoxelBitFlood.h"
#include "itkMedialVoxelBlockSeparation.h"
#include "itkMedialVoxelLocalThreshold.h"
#include "itkMedialVoxelPairSeparation.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelTileLabels.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace itk
{

/** \struct MedialVoxelTileInput
 * \brief The input for the labels of a tile.
 * \ingroup MedialVoxel
 */
struct MedialVoxelTileInput
{
  const MedialVoxelWindow &   window;   ///< object bits, and the background border as sites
  const MedialVoxelBox &      cells;    ///< cells that get a threshold: the tile, or some around it as well
  const MedialVoxelBits &     corners;  ///< object voxels whose cells are looked at
  const MedialVoxelFeatures & features; ///< displacements of MedialVoxelClassifier::GetFeatureBox()
  const MedialVoxelProgress & progress; ///< asked for an abort, after which labels and counts are incomplete
};

/** \class MedialVoxelJointClassifier
 * \brief Labels the dual cells of one tile together, each with a MedialVoxelLocalThreshold, or all with the threshold
 * of the parameters.
 *
 * All pairs of the tile are found first, with an automatic thickness also the inscribed balls in and around it. Pairs
 * that fall short of the smallest threshold are decided at once. Of the pairs that no bound decides, one is not medial
 * when the path along the pair of a neighboring cell is short, and medial when its points are in different components
 * of the boundary around them. Only the rest is searched.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelJointClassifier
{
private:
  static constexpr double Unlimited = std::numeric_limits<double>::infinity();

  /** A cell of the tile that is not trivial. */
  struct alignas(64) Cell
  {
    // Its neighbors read these, in one line of the cache.
    MedialVoxelIndex        a;
    MedialVoxelIndex        b;
    MedialVoxelLengthBounds bounds; // of the geodesic distance

    MedialVoxelIndex center;
    std::size_t      label{ 0 };         // position in the labels of the tile
    double           radius{ 0.0 };      // of its own ball, or 0
    double           limit{ Unlimited }; // its threshold is not above it, once known
    double           epsilon{ 0.0 };     // up to which paths matter while blocks may separate its points
    bool             isAtFloor{ false }; // known to reach the smallest threshold
    bool             isWaiting{ true };  // for its own threshold

    MedialVoxelDisplacement
    GetDifference() const
    {
      return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
    }
  };

public:
  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  public:
    /** For more searches on the boundary around the tile. */
    MedialVoxelPairSeparation::Workspace &
    GetSeparation()
    {
      return m_Separation;
    }

    /** The balls in and around the tile and their survey, for thresholds of more cells. */
    MedialVoxelLocalThreshold::Workspace &
    GetSurvey()
    {
      return m_Threshold;
    }

  private:
    friend class MedialVoxelJointClassifier;

    MedialVoxelLocalThreshold::Workspace    m_Threshold;
    MedialVoxelRankedBits                   m_Ranks; // of the cells
    std::vector<Cell>                       m_Cells;
    std::vector<MedialVoxelPair>            m_Pairs; // of the cells that wait for their threshold
    std::vector<MedialVoxelSeparationQuery> m_Queries;
    MedialVoxelBlockSeparation::Workspace   m_Blocks;
    MedialVoxelPairSeparation::Workspace    m_Separation;
  };

  /** Memory of a workspace for each voxel of a tile and the margin around it when an eighth of them are waiting. */
  static constexpr std::uint64_t BytesPerVoxel =
    (sizeof(Cell) + sizeof(MedialVoxelPair) + sizeof(MedialVoxelSeparationQuery) +
     2 * sizeof(MedialVoxelInscribedBall) + 128) /
    8;

  MedialVoxelJointClassifier(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  const MedialVoxelLocalThreshold &
  GetThreshold() const
  {
    return m_Threshold;
  }

  /** Decide all cells of the tile of \a labels.
   *
   * \return an empty box, or as MedialVoxelClassifier::Classify() the box of sites that must be known */
  MedialVoxelBox
  Classify(const MedialVoxelTileInput & input, Workspace & workspace, MedialVoxelTileLabels & labels) const;

  /** The boundary points at the ends of an edge of voxels, and their bounds from the cells around it. */
  struct CrossedPair
  {
    const MedialVoxelIndex & a;
    const MedialVoxelIndex & b;
    double                   leastEpsilon{ 0.0 }; ///< the thresholds of the cells are not below it
    double                   mostEpsilon{ 0.0 };  ///< nor above it
    MedialVoxelLengthBounds  bounds{};            ///< of the geodesic distance
  };

  /** The cells around an edge of voxels. */
  struct CellsOfEdge
  {
    std::array<MedialVoxelIndex, 4> cells;
    unsigned int                    number{ 0 };
  };

  /** Add the bounds from the cells around an edge of the last input: of their thresholds, which stay as they are unless
   * the thickness is automatic, and of the geodesic distance, as far as needed. */
  void
  LookAt(const Workspace &           workspace,
         const MedialVoxelFeatures & features,
         const CellsOfEdge &         around,
         CrossedPair &               pair) const;

  /** The boundary points that decided \a cell of the last tile; false where they are trivial. */
  static bool
  GetPair(const Workspace & workspace, const MedialVoxelIndex & cell, MedialVoxelIndex & a, MedialVoxelIndex & b);

private:
  using Query = MedialVoxelSeparationQuery;
  using QueryIterator = std::vector<Query>::iterator;

  bool
  Collect(const MedialVoxelTileInput & input, Workspace & workspace, MedialVoxelTileLabels & labels) const;

  void
  AddCell(const MedialVoxelIndex &      center,
          const MedialVoxelPair &       pair,
          double                        radius,
          const MedialVoxelTileLabels & labels,
          Workspace &                   workspace) const;

  bool
  LabelShortPair(const MedialVoxelBits & sites, Cell & cell, MedialVoxelTileLabels & labels) const;

  double
  GetLargestEpsilon(const MedialVoxelIndex & cell, double radius, const Workspace & workspace) const;

  double
  GetBoundMargin(const MedialVoxelTileInput & input, const MedialVoxelTileLabels & labels) const;

  void
  SeparateByBlocks(const MedialVoxelTileInput & input, Workspace & workspace, MedialVoxelTileLabels & labels) const;

  void
  BoundCells(const MedialVoxelTileInput & input, Workspace & workspace, MedialVoxelTileLabels & labels) const;

  void
  BoundByFloods(const MedialVoxelBits & sites, const MedialVoxelPair & pair, double epsilon, Cell & cell) const;

  void
  FloodLength(const MedialVoxelBits & sites, const MedialVoxelPair & pair, Cell & cell) const;

  double
  LengthOfFewEdges(const MedialVoxelBits & sites, const Cell & cell, double epsilon) const;

  void
  LabelAtOnce(const MedialVoxelBits & sites, Workspace & workspace, MedialVoxelTileLabels & labels) const;

  std::optional<std::uint8_t>
  LabelByBound(const MedialVoxelPair & pair, double epsilon, const Cell & cell) const;

  std::optional<std::uint8_t>
  LabelByLength(const MedialVoxelBits & sites, const MedialVoxelPair & pair, double epsilon, Cell & cell) const;

  /** How far along the boundary the points of a cell may be from the points of the neighbor that decides it. */
  enum class NeighborReach : std::uint8_t
  {
    OneEdge,  ///< up to one edge from each point
    TwoEdges, ///< up to two, which takes longer
  };

  bool
  DecideByNeighbors(const MedialVoxelBits & sites,
                    NeighborReach           reach,
                    const Query &           query,
                    Workspace &             workspace,
                    MedialVoxelTileLabels & labels) const;

  static void
  SortInwards(const Workspace & workspace, QueryIterator first, QueryIterator last);

  void
  LabelBranches(const MedialVoxelBits & sites, Workspace & workspace, MedialVoxelTileLabels & labels) const;

  void
  Search(const MedialVoxelTileInput & input, Workspace & workspace, MedialVoxelTileLabels & labels) const;

  using KnownCells = std::array<const Cell *, 4>; // null: trivial, or outside the tile

  void
  LimitThresholds(const Workspace &           workspace,
                  const MedialVoxelFeatures & features,
                  const CellsOfEdge &         around,
                  const KnownCells &          known,
                  CrossedPair &               pair) const;

  static const Cell *
  FindCell(const Workspace & workspace, const MedialVoxelIndex & cell);

  double
  PathLengthTo(const MedialVoxelIndex & a, const MedialVoxelIndex & b, const Cell & cell) const;

  double
  LongerPathLengthTo(const MedialVoxelBits & sites, const Cell & from, const Cell & to, double most) const;

  void
  FollowNeighbors(const Workspace &       workspace,
                  const MedialVoxelBits & sites,
                  NeighborReach           reach,
                  double                  epsilon,
                  Cell &                  cell) const;

  double
  EdgeBetween(const MedialVoxelIndex & a, const MedialVoxelIndex & b) const;

  double
  TwoEdgesBetween(const MedialVoxelBits & sites, const MedialVoxelIndex & a, const MedialVoxelIndex & b) const;

  MedialVoxelGrid            m_Grid;
  MedialVoxelParameters      m_Parameters;
  MedialVoxelCellPairs       m_Pairs;
  MedialVoxelLocalThreshold  m_Threshold;
  MedialVoxelBitFlood        m_Flood;       // for the smallest threshold
  MedialVoxelBitFlood        m_LengthFlood; // for the longest paths it can find
  MedialVoxelBlockSeparation m_Blocks;
  MedialVoxelPairSeparation  m_Separation;
};

} // end namespace itk

#endif
