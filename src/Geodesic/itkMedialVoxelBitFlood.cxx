// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBitFlood.h"

#include "itkMedialVoxelFloodPrivate.h"
#include "itkMedialVoxelResolutionBand.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace itk
{

bool
MedialVoxelBitFlood::Covers(const MedialVoxelGrid & grid, const double epsilon)
{
  const bool isSolid = grid.IsActive(0) && grid.IsActive(1) && grid.IsActive(2);
  return isSolid && grid.HasEqualSpacing() && epsilon > grid.GetLongestEdge() &&
         epsilon * (1.0 + MedialVoxelResolutionBand) < static_cast<double>(Reach + 1) * grid.GetShortestEdge();
}

MedialVoxelBitFlood::MedialVoxelBitFlood(const MedialVoxelGrid & grid, const double epsilon)
{
  if (!Covers(grid, epsilon) || !this->FindLengths(grid, epsilon))
  {
    return;
  }
  m_Epsilon = epsilon;
  m_MostEdges = static_cast<std::int64_t>(epsilon / grid.GetShortestEdge());
  m_ShortEdges = static_cast<std::int64_t>(epsilon / grid.GetLongestEdge());
  this->FindWindows(grid, epsilon);
}

/** False when a length is so near to the threshold that its rounding matters. */
bool
MedialVoxelBitFlood::FindLengths(const MedialVoxelGrid & grid, const double epsilon)
{
  const std::array<double, 3> edges{ { grid.GetEdgeLength(1), grid.GetEdgeLength(3), grid.GetEdgeLength(7) } };
  for (int i = 0; i <= Reach; ++i)
  {
    for (int j = 0; j <= Reach; ++j)
    {
      for (int k = 0; k <= Reach; ++k)
      {
        const double length = i * edges[0] + j * edges[1] + k * edges[2];
        if (std::abs(length - epsilon) <= MedialVoxelResolutionBand * epsilon)
        {
          return false;
        }
        if (length < epsilon)
        {
          m_Lengths.push_back({ length, { { i, j, k } }, { { NoLength, NoLength, NoLength } } });
        }
      }
    }
  }
  // A path with an edge less is shorter, so it comes first.
  std::sort(m_Lengths.begin(), m_Lengths.end(), [](const Length & a, const Length & b) { return a.length < b.length; });
  for (Length & length : m_Lengths)
  {
    for (unsigned int edgeClass = 0; edgeClass < 3; ++edgeClass)
    {
      auto counts = length.counts;
      --counts[edgeClass];
      const auto shorter =
        std::find_if(m_Lengths.begin(), m_Lengths.end(), [&](const Length & other) { return other.counts == counts; });
      if (shorter != m_Lengths.end())
      {
        length.shorter[edgeClass] = static_cast<std::uint8_t>(shorter - m_Lengths.begin());
      }
    }
  }
  return m_Lengths.size() <= MostLengths;
}

namespace
{

/** Largest coordinates, up to \a reach, of the points with lengths to 0 and to \a b, not negative, of less than \a
 * limit together. */
template <typename TLength>
std::array<int, 3>
FindUpper(const TLength & lengthAt, const std::array<int, 3> & b, const double limit, const int reach)
{
  const auto isBelow = [&](const int x, const int y, const int z) {
    return lengthAt(x, y, z) + lengthAt(x - b[0], y - b[1], z - b[2]) < limit;
  };
  std::array<int, 3> upper = b;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Along the other axes the lengths are smallest between the points; along this one they grow.
    std::array<int, 3> first{ { 0, 0, 0 } };
    std::array<int, 3> last = b;
    for (bool isFound = true; isFound && upper[axis] < reach;)
    {
      first[axis] = last[axis] = upper[axis] + 1;
      isFound = false;
      for (int z = first[2]; z <= last[2]; ++z)
      {
        for (int y = first[1]; y <= last[1]; ++y)
        {
          for (int x = first[0]; x <= last[0]; ++x)
          {
            isFound = isFound || isBelow(x, y, z);
          }
        }
      }
      upper[axis] += isFound ? 1 : 0;
    }
  }
  return upper;
}

} // namespace

void
MedialVoxelBitFlood::FindWindows(const MedialVoxelGrid & grid, const double epsilon)
{
  const MedialVoxelDualCell cell(grid);
  constexpr int             reach = Reach;
  const auto lengthOf = [&](const int x, const int y, const int z) { return cell.FreeSpaceLength({ { x, y, z } }); };
  std::vector<double> lengths;
  for (int z = 0; z <= reach; ++z)
  {
    for (int y = 0; y <= reach; ++y)
    {
      for (int x = 0; x <= reach; ++x)
      {
        lengths.push_back(lengthOf(x, y, z));
      }
    }
  }
  const auto lengthAt = [&](const int x, const int y, const int z) {
    return lengths[static_cast<std::size_t>((std::abs(z) * (reach + 1) + std::abs(y)) * (reach + 1) + std::abs(x))];
  };

  m_WindowOf.assign(IndexOf({ { reach, reach, reach } }) + 1, BoundedWindow);
  for (int bz = 0; bz <= reach; ++bz)
  {
    for (int by = 0; by <= reach; ++by)
    {
      for (int bx = 0; bx <= reach; ++bx)
      {
        if (lengthAt(bx, by, bz) >= epsilon)
        {
          continue;
        }
        const std::array<int, 3> b{ { bx, by, bz } };
        const std::array<int, 3> upper = FindUpper(lengthAt, b, epsilon * (1.0 + MedialVoxelResolutionBand), reach);
        // The surroundings of one point are mirrored around the other.
        const std::array<int, 3> lower{ { bx - upper[0], by - upper[1], bz - upper[2] } };
        this->AddWindow({ { bx, by, bz } }, lower, upper);
      }
    }
  }
}

/** Windows of b = a + offset and of its mirror images, from the voxels lower .. upper around a = 0. */
void
MedialVoxelBitFlood::AddWindow(const MedialVoxelDisplacement & offset,
                               const std::array<int, 3> &      lower,
                               const std::array<int, 3> &      upper)
{
  for (unsigned int mirrored = 0; mirrored < 8; ++mirrored)
  {
    Window                  window{};
    MedialVoxelDisplacement difference{};
    bool                    isNew = true;
    std::array<int, 3>      positionOfB{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const bool isMirrored = ((mirrored >> axis) & 1u) != 0;
      isNew = isNew && !(isMirrored && offset[axis] == 0);
      window.lower[axis] = static_cast<std::int8_t>(isMirrored ? -upper[axis] : lower[axis]);
      window.size[axis] = static_cast<std::uint8_t>(upper[axis] - lower[axis] + 1);
      difference[axis] = isMirrored ? offset[axis] : -offset[axis];
      positionOfB[axis] = static_cast<int>(-difference[axis]) - window.lower[axis];
    }
    if (!isNew)
    {
      continue;
    }
    const int slice = window.size[0] * window.size[1];
    window.fitsWord = slice < MedialVoxelBits::BitsPerWord && slice * window.size[2] <= MedialVoxelBits::BitsPerWord;
    window.shape = window.fitsWord ? this->ShapeOf(window.size) : std::uint8_t{ 0 };
    const int  strideY = window.fitsWord ? window.size[0] : MedialVoxelPlaneLayout::Edge;
    const int  strideZ = window.fitsWord ? slice : static_cast<int>(MedialVoxelBits::BitsPerWord);
    const auto bitAt = [&](const int x, const int y, const int z) {
      return static_cast<std::uint16_t>(z * strideZ + y * strideY + x);
    };
    window.bitOfA = bitAt(-window.lower[0], -window.lower[1], -window.lower[2]);
    window.bitOfB = bitAt(positionOfB[0], positionOfB[1], positionOfB[2]);
    m_WindowOf[IndexOf(difference)] = static_cast<std::uint16_t>(m_Windows.size());
    m_Windows.push_back(window);
  }
}

std::uint8_t
MedialVoxelBitFlood::ShapeOf(const std::array<std::uint8_t, 3> & size)
{
  const auto known =
    std::find_if(m_Shapes.begin(), m_Shapes.end(), [&](const Shape & shape) { return shape.size == size; });
  if (known != m_Shapes.end())
  {
    return static_cast<std::uint8_t>(known - m_Shapes.begin());
  }
  Shape shape;
  shape.size = size;
  for (unsigned int bit = 0; bit < static_cast<unsigned int>(size[0]) * size[1] * size[2]; ++bit)
  {
    const WordType     one = WordType{ 1 } << bit;
    const unsigned int x = bit % size[0];
    const unsigned int y = bit / size[0] % size[1];
    shape.hasNextX |= (x + 1 < size[0]) ? one : 0;
    shape.hasPreviousX |= (x > 0) ? one : 0;
    shape.hasNextY |= (y + 1 < size[1]) ? one : 0;
    shape.hasPreviousY |= (y > 0) ? one : 0;
  }
  m_Shapes.push_back(shape);
  return static_cast<std::uint8_t>(m_Shapes.size() - 1);
}

/** All voxels of the window in a word. */
struct MedialVoxelBitFlood::WordLayout
{
  using Set = WordType;

  const Shape &      shape;
  const unsigned int strideY;
  const unsigned int strideZ;

  static Set
  Point(const std::uint16_t bit)
  {
    return WordType{ 1 } << bit;
  }
  static bool
  Meet(const Set & a, const Set & b)
  {
    return (a & b) != 0;
  }
  static bool
  Equal(const Set & a, const Set & b)
  {
    return a == b;
  }
  Set
  AlongX(const Set & set) const
  {
    return ((set & shape.hasNextX) << 1) | ((set & shape.hasPreviousX) >> 1);
  }
  Set
  AlongY(const Set & set) const
  {
    return ((set & shape.hasNextY) << strideY) | ((set & shape.hasPreviousY) >> strideY);
  }
  Set
  AlongZ(const Set & set) const
  {
    return (set << strideZ) | (set >> strideZ);
  }
  static Set
  Or(const Set & a, const Set & b)
  {
    return a | b;
  }
  static Set
  And(const Set & a, const Set & b)
  {
    return a & b;
  }
};

/** The window of a pair and its first voxel; nothing when the free-space length alone reaches the threshold, or when
 * the boundary does not hold all of the window, which sets \a isUndecided. */
const MedialVoxelBitFlood::Window *
MedialVoxelBitFlood::FindWindow(const MedialVoxelBits &         boundary,
                                const MedialVoxelIndex &        a,
                                const MedialVoxelDisplacement & difference,
                                MedialVoxelIndex &              lower,
                                bool &                          isUndecided) const
{
  isUndecided = false;
  for (const std::int64_t steps : difference)
  {
    if (std::abs(steps) > Reach)
    {
      return nullptr;
    }
  }
  const std::uint16_t number = m_WindowOf[IndexOf(difference)];
  if (number == BoundedWindow)
  {
    return nullptr;
  }
  const Window &         window = m_Windows[number];
  const MedialVoxelBox & known = boundary.GetBox();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    lower[axis] = a[axis] + window.lower[axis];
    if (lower[axis] < known.lower[axis] || lower[axis] + window.size[axis] > known.upper[axis])
    {
      isUndecided = true;
      return nullptr;
    }
  }
  return &window;
}

/** Call \a visit(layout, domain) with the boundary in a window. */
template <typename TVisitor>
auto
MedialVoxelBitFlood::WithDomain(const MedialVoxelBits &  boundary,
                                const Window &           window,
                                const MedialVoxelIndex & lower,
                                TVisitor &&              visit) const
{
  if (window.fitsWord)
  {
    WordType     domain = 0;
    unsigned int shift = 0;
    MedialVoxelVisitRows(
      boundary, lower, window.size, [&](const WordType bits, const unsigned int, const unsigned int) {
        domain |= bits << shift;
        shift += window.size[0];
      });
    const unsigned int strideY = window.size[0];
    return visit(WordLayout{ m_Shapes[window.shape], strideY, strideY * window.size[1] }, domain);
  }
  return visit(MedialVoxelPlaneLayout{}, MedialVoxelLoadPlanes(boundary, lower, window.size));
}

MedialVoxelBitFlood::Result
MedialVoxelBitFlood::Decide(const MedialVoxelBits &         boundary,
                            const MedialVoxelIndex &        a,
                            const MedialVoxelDisplacement & difference) const
{
  if (!this->IsAvailable())
  {
    return Result::Undecided;
  }
  MedialVoxelIndex     lower;
  bool                 isUndecided = false;
  const Window * const window = this->FindWindow(boundary, a, difference, lower, isUndecided);
  if (window == nullptr)
  {
    return isUndecided ? Result::Undecided : Result::Bounded;
  }
  return this->WithDomain(boundary, *window, lower, [&](const auto & layout, const auto & domain) {
    return this->Flood(layout, *window, domain);
  });
}

std::optional<double>
MedialVoxelBitFlood::FindLength(const MedialVoxelBits &         boundary,
                                const MedialVoxelIndex &        a,
                                const MedialVoxelDisplacement & difference) const
{
  if (!this->IsAvailable())
  {
    return std::nullopt;
  }
  MedialVoxelIndex     lower;
  bool                 isUndecided = false;
  const Window * const window = this->FindWindow(boundary, a, difference, lower, isUndecided);
  if (window == nullptr)
  {
    return isUndecided ? std::nullopt : std::optional<double>(std::numeric_limits<double>::infinity());
  }
  return this->WithDomain(boundary, *window, lower, [&](const auto & layout, const auto & domain) {
    // The number of edges shows at once which thresholds are out of reach.
    return this->CountEdges(layout, *window, domain) == 0 ? std::numeric_limits<double>::infinity()
                                                          : this->FloodByLength(layout, *window, domain);
  });
}

/** Edges of the path with the fewest; 0 when no path is shorter than the threshold. */
template <typename TLayout>
std::int64_t
MedialVoxelBitFlood::CountEdges(const TLayout &               layout,
                                const Window &                window,
                                const typename TLayout::Set & domain) const
{
  return MedialVoxelFlood(layout, domain, TLayout::Point(window.bitOfA), TLayout::Point(window.bitOfB), m_MostEdges);
}

template <typename TLayout>
MedialVoxelBitFlood::Result
MedialVoxelBitFlood::Flood(const TLayout & layout, const Window & window, const typename TLayout::Set & domain) const
{
  const std::int64_t edges = this->CountEdges(layout, window, domain);
  if (edges == 0)
  {
    return Result::Reaches;
  }
  return edges <= m_ShortEdges || this->FloodByLength(layout, window, domain) < m_Epsilon ? Result::FallsShort
                                                                                          : Result::Reaches;
}

/** The length of the shortest path; infinite when it reaches the threshold. */
template <typename TLayout>
double
MedialVoxelBitFlood::FloodByLength(const TLayout &               layout,
                                   const Window &                window,
                                   const typename TLayout::Set & domain) const
{
  using Set = typename TLayout::Set;
  // Left uninitialized: every entry is written before it is read.
  std::array<Set, MostLengths> reached;
  reached[0] = TLayout::Point(window.bitOfA);
  const Set target = TLayout::Point(window.bitOfB);
  for (std::size_t i = 1; i < m_Lengths.size(); ++i)
  {
    const auto & shorter = m_Lengths[i].shorter;
    Set          next{};
    if (shorter[0] != NoLength)
    {
      const Set & from = reached[shorter[0]];
      next = TLayout::Or(layout.AlongX(from), TLayout::Or(layout.AlongY(from), layout.AlongZ(from)));
    }
    if (shorter[1] != NoLength)
    {
      const Set & from = reached[shorter[1]];
      const Set   x = layout.AlongX(from);
      const Set   y = layout.AlongY(from);
      next = TLayout::Or(next, TLayout::Or(layout.AlongY(x), layout.AlongZ(TLayout::Or(x, y))));
    }
    if (shorter[2] != NoLength)
    {
      next = TLayout::Or(next, layout.AlongZ(layout.AlongY(layout.AlongX(reached[shorter[2]]))));
    }
    reached[i] = TLayout::And(next, domain);
    if (TLayout::Meet(reached[i], target))
    {
      return m_Lengths[i].length;
    }
  }
  return std::numeric_limits<double>::infinity();
}

} // end namespace itk
