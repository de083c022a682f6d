// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelPairSeparation_h
#define itkMedialVoxelPairSeparation_h

#include "itkMedialVoxelBoundedGeodesic.h"
#include "itkMedialVoxelBoxComponents.h"
#include "itkMedialVoxelLengthBounds.h"
#include "itkMedialVoxelPathSearch.h"
#include "itkMedialVoxelProgress.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace itk
{

/** \struct MedialVoxelSeparationQuery
 * \brief Two boundary points, their own threshold, and bounds of their distance.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSeparationQuery
{
  MedialVoxelIndex a;
  MedialVoxelIndex b;
  double           epsilon;              ///< in physical units, positive and finite
  std::size_t      cell;                 ///< for the user
  bool             isSeparated{ false }; ///< no path that is shorter than \a epsilon joins the points

  MedialVoxelLengthBounds bounds{}; ///< bounds of the geodesic distance
};

/** \class MedialVoxelPairSeparation
 * \brief Decides for many pairs of boundary points, each with a threshold of its own, whether their geodesic distance
 * reaches it.
 *
 * Pairs that are near each other are judged together: paths below the thresholds stay in one box, and points in
 * different components of the boundary in that box are apart. Joined pairs are tried again in smaller groups. This
 * decides most pairs on either side of a wall; the rest is searched one by one. The answers equal the answers of
 * MedialVoxelBoundedGeodesic.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelPairSeparation
{
public:
  /** \class Workspace
   * \brief Memory of one thread.
   * \ingroup MedialVoxel
   */
  class Workspace
  {
  public:
    /** Before the first search on another boundary: pairs that were searched are not searched again. */
    void
    Forget()
    {
      m_Lengths.clear();
    }

  private:
    friend class MedialVoxelPairSeparation;

    using Pair = std::array<MedialVoxelIndex, 2>;

    struct PairHash
    {
      std::size_t
      operator()(const Pair & pair) const;
    };


    struct Entry
    {
      std::size_t    query;
      std::uint64_t  group;
      MedialVoxelBox box;
    };

    std::unordered_map<Pair, MedialVoxelLengthBounds, PairHash> m_Lengths;

    std::vector<Entry>                    m_Entries;
    MedialVoxelBoxComponents              m_Components;
    MedialVoxelPathSearch::Workspace      m_Search;
    MedialVoxelBoundedGeodesic::Workspace m_Geodesic;
  };

  explicit MedialVoxelPairSeparation(const MedialVoxelGrid & grid);

  /** Find the \a queries whose points components separate.
   *
   * \param queries   of points whose free-space length is below the threshold: others need no search
   * \param progress  asked for an abort before each group, after which the answers are incomplete
   * \return an empty box, or the box of boundary bits that must be known to judge and search all */
  MedialVoxelBox
  FindSeparated(const MedialVoxelBits &                   boundary,
                const MedialVoxelProgress &               progress,
                Workspace &                               workspace,
                std::vector<MedialVoxelSeparationQuery> & queries) const;

  /** True when the geodesic distance of the points reaches epsilon; tightens the bounds of the query. Neighboring cells
   * often have the same pair, which reuses the result.
   *
   * The box of \a boundary holds MedialVoxelBoundedGeodesic::SearchBoxOf() the query. */
  bool
  Reaches(const MedialVoxelBits & boundary, MedialVoxelSeparationQuery & query, Workspace & workspace) const;

private:
  bool
  Search(const MedialVoxelBits &            boundary,
         const MedialVoxelSeparationQuery & query,
         Workspace &                        workspace,
         MedialVoxelLengthBounds &          bounds) const;

  /** The precondition of queries. */
  bool
  IsNear(const MedialVoxelSeparationQuery & query) const;

  using Entries = std::vector<Workspace::Entry>::iterator;

  void
  JudgeGroup(const MedialVoxelBits &                   boundary,
             Entries                                   first,
             Entries                                   last,
             unsigned int                              level,
             Workspace &                               workspace,
             std::vector<MedialVoxelSeparationQuery> & queries) const;

  MedialVoxelGrid       m_Grid;
  MedialVoxelPathSearch m_Search;
};

} // end namespace itk

#endif
