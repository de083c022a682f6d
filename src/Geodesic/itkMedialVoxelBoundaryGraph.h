// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBoundaryGraph_h
#define itkMedialVoxelBoundaryGraph_h

#include "itkMedialVoxelBits.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelBoundaryGraph
 * \brief The boundary points of a box as a graph: points that differ by at most 1 along each axis are neighbors.
 *
 * Points are numbered in the order x, y, z; memory is taken for the points and one bit per voxel of the box.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBoundaryGraph
{
public:
  using NodeType = std::uint32_t;

  /** Neighbors of a point on a smooth oblique wall; on one along an axis there are eight. */
  static constexpr std::uint64_t ExpectedNeighbors = 14;

  /** Bytes of memory for each boundary point. */
  static constexpr std::uint64_t BytesPerNode = 2 * sizeof(std::uint64_t) + (1 + ExpectedNeighbors) * sizeof(NodeType);

  /** More points than this have no numbers. */
  static constexpr std::size_t MostNodes = std::size_t{ 1 } << 29;

  /** Take the points of \a boundary in \a box, which the box of \a boundary holds.
   * \return false, with a graph that has no box, when there are more than \a mostNodes */
  bool
  Build(const MedialVoxelBits & boundary, const MedialVoxelBox & box, std::size_t mostNodes);

  /** Forget the box and the points. */
  void
  Clear();

  /** Empty when nothing was built. */
  const MedialVoxelBox &
  GetBox() const
  {
    return m_Box;
  }

  std::size_t
  GetNumberOfNodes() const
  {
    return m_Positions.size();
  }

  /** Number of a boundary point of the box. */
  NodeType
  NodeOf(const MedialVoxelIndex & index) const
  {
    return this->NodeAt(this->PositionOf(index));
  }

  /** The boundary point with a number. */
  MedialVoxelIndex
  IndexOf(const NodeType node) const
  {
    const auto position = static_cast<std::int64_t>(m_Positions[node]);
    const auto row = position / m_BitsPerRow;
    const auto slice = row / m_RowsPerSlice;
    return { { m_Box.lower[0] - 1 + position - row * m_BitsPerRow,
               m_Box.lower[1] - 1 + row - slice * m_RowsPerSlice,
               m_Box.lower[2] - 1 + slice } };
  }

  /** True when a path inside the box joins the two points. */
  bool
  AreConnected(const NodeType a, const NodeType b) const
  {
    return m_Components[a] == m_Components[b];
  }

  /** Call \a visit(neighbor, mask) for every neighbor; \a mask holds the axes along which it differs (bit 0 is x). */
  template <typename TVisitor>
  void
  VisitNeighbors(const NodeType node, TVisitor && visit) const
  {
    for (std::uint64_t i = m_FirstNeighbor[node]; i < m_FirstNeighbor[node + 1]; ++i)
    {
      visit(m_Neighbors[i] >> BitsOfMask, m_Neighbors[i] & MaskOfMask);
    }
  }

private:
  using WordType = MedialVoxelBits::WordType;

  static constexpr unsigned int BitsOfMask = 3;
  static constexpr NodeType     MaskOfMask = 7;

  /** A row beside that of a point: bits to its beginning, and the axes that change on the way. */
  struct Row
  {
    std::int64_t offset{ 0 };
    unsigned int mask{ 0 };
  };

  /** The rows are padded with zeros on all sides, so that neighbors need no test for the border of the box. */
  std::uint64_t
  PositionOf(const MedialVoxelIndex & index) const
  {
    const std::int64_t row = (index[2] - m_Box.lower[2] + 1) * m_RowsPerSlice + (index[1] - m_Box.lower[1] + 1);
    return static_cast<std::uint64_t>(row * m_BitsPerRow + (index[0] - m_Box.lower[0] + 1));
  }

  /** Number of points before a position. */
  NodeType
  NodeAt(const std::uint64_t position) const
  {
    const auto     word = static_cast<std::size_t>(position >> 6);
    const WordType before = m_Words[word] & ((WordType{ 1 } << (position & 63)) - 1);
    return m_NodesBefore[word] + static_cast<NodeType>(MedialVoxelPopulationCount(before));
  }

  /** The three bits from \a position on. */
  unsigned int
  ThreeBitsAt(const std::uint64_t position) const
  {
    const auto         word = static_cast<std::size_t>(position >> 6);
    const unsigned int shift = static_cast<unsigned int>(position & 63);
    WordType           bits = m_Words[word] >> shift;
    if (shift > 61)
    {
      bits |= m_Words[word + 1] << (64 - shift);
    }
    return static_cast<unsigned int>(bits & 7);
  }

  /** Append the neighbors of a point to the list. */
  void
  ListNeighbors(NodeType node);

  void
  SetBox(const MedialVoxelBox & box);

  void
  CopyBits(const MedialVoxelBits & boundary);

  bool
  NumberNodes(std::size_t mostNodes);

  void
  Connect();

  MedialVoxelBox             m_Box;
  std::int64_t               m_BitsPerRow{ 0 };
  std::int64_t               m_RowsPerSlice{ 0 };
  std::array<Row, 9>         m_Rows;
  std::vector<WordType>      m_Words;
  std::vector<NodeType>      m_NodesBefore;
  std::vector<std::uint64_t> m_Positions;
  std::vector<NodeType>      m_Components;
  std::vector<std::uint64_t> m_FirstNeighbor;
  std::vector<NodeType>      m_Neighbors; // the number of the point, then the mask of the axes
};

} // end namespace itk

#endif
