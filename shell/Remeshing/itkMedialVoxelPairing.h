// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelPairing_h
#define itkMedialVoxelPairing_h

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelPairing
 * \brief Joins the nodes of a graph to pairs, each to one neighbor at most.
 *
 * A node that is left alone takes a neighbor from its pair, and so on along a path of pairs, until another lone node is
 * reached: the paths of Berge, found as by Edmonds, through circles of odd length, too. Paths are searched for in so
 * many nodes at most. What is found depends on the order of the calls alone.
 * \ingroup MedialVoxel
 */
class MedialVoxelPairing
{
public:
  using Index = std::uint32_t;

  static constexpr Index None = ~Index{ 0 };

  explicit MedialVoxelPairing(std::size_t numberOfNodes);

  /** Two nodes may be a pair from now on; they become one when both are alone. */
  void
  Allow(Index a, Index b);

  /** Makes pairs of lone nodes along paths, in the order of their numbers. */
  void
  Extend();

  /** None: it is alone. */
  Index
  GetPartner(Index node) const
  {
    return m_Partners[node];
  }

private:
  bool
  TryExtend(Index root);

  Index
  FindEnd(Index root);

  void
  Visit(Index node);

  void
  Contract(Index a, Index b);

  Index
  FindCommonBase(Index a, Index b);

  void
  MarkToBase(Index node, Index base, Index child);

  /** Of a search. */
  struct State
  {
    Index parent{ None }; ///< the node before, for nodes at the far end of a pair
    Index base{ None };   ///< of the circle of odd length that it is in, or itself
    bool  isEven{ false };
    bool  isVisited{ false };
    bool  isMarked{ false };
  };

  std::vector<std::vector<Index>> m_Neighbors;
  std::vector<Index>              m_Partners;
  std::vector<State>              m_States;
  std::vector<Index>              m_Visited;
  std::vector<Index>              m_Queue;
};

} // end namespace itk

#endif
