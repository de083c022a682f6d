// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLoneTriangles.h"

#include "itkMedialVoxelSheetTree.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>

namespace itk
{
namespace
{

using Complex = MedialVoxelTriangleComplex;
using Element = MedialVoxelShellElement;
using Index = Element::Index;

constexpr Index None = ~Index{ 0 };

/** Quadrilaterals that a triangle may look at. */
constexpr std::size_t MostQuads = 128;

/** Of the size, where vertices become one: how long sides may be, and how far the middles of elements and rims may be
 * away. */
constexpr double MostOfLength = 1.8;
constexpr double MostOfDistance = 0.08;

Element
MakeElement(const std::initializer_list<Index> corners, const Index wall)
{
  Element element;
  std::copy(corners.begin(), corners.end(), element.corners.begin());
  element.numberOfCorners = static_cast<std::uint8_t>(corners.size());
  element.wall = wall;
  return element;
}

/** \class Walk
 * \brief The elements round each vertex, and the ways of triangles. */
class Walk
{
public:
  Walk(Complex & complex, const MedialVoxelFineSheet & fine, const double leastQuality, std::vector<Element> & elements)
    : m_Complex(complex)
    , m_Fine(fine)
    , m_LeastQuality(leastQuality)
    , m_Elements(elements)
    , m_ElementsOf(complex.GetNumberOfVertices())
    , m_IsSeen(elements.size())
  {
    for (Index number = 0; number < elements.size(); ++number)
    {
      this->Attach(number);
    }
  }

  void
  Join(const Index triangle)
  {
    if (m_Elements[triangle].numberOfCorners != 3)
    {
      return;
    }
    m_Ways.assign(1, { None, None, m_Elements[triangle], {} });
    m_Seen.assign(1, triangle);
    m_IsSeen[triangle] = true;
    for (std::size_t way = 0; way < m_Ways.size() && m_Seen.size() < MostQuads; ++way)
    {
      if (this->GoOn(triangle, static_cast<Index>(way)))
      {
        break;
      }
    }
    for (const Index element : m_Seen)
    {
      m_IsSeen[element] = false;
    }
  }

private:
  /** A place that the triangle can be at, after the ways before. */
  struct Way
  {
    Index   before;   ///< the way that it came by
    Index   quad;     ///< that it went through; none at the start
    Element triangle; ///< where it is now
    Element rest;     ///< what becomes of the quadrilateral
  };

  void
  Attach(const Index number)
  {
    for (unsigned int k = 0; k < m_Elements[number].numberOfCorners; ++k)
    {
      m_ElementsOf[m_Elements[number].corners[k]].push_back(number);
    }
  }

  void
  Detach(const Index number)
  {
    for (unsigned int k = 0; k < m_Elements[number].numberOfCorners; ++k)
    {
      std::vector<Index> & list = m_ElementsOf[m_Elements[number].corners[k]];
      list.erase(std::find(list.begin(), list.end(), number));
    }
  }

  /** The place of a corner whose side goes from a to b; none: there is no such side. */
  static unsigned int
  FindSide(const Element & element, const Index a, const Index b)
  {
    const unsigned int number = element.numberOfCorners;
    for (unsigned int k = 0; k < number; ++k)
    {
      if (element.corners[k] == a && element.corners[(k + 1) % number] == b)
      {
        return k;
      }
    }
    return number;
  }

  unsigned int
  CountElements(const Index a, const Index b) const
  {
    return static_cast<unsigned int>(
      std::count_if(m_ElementsOf[a].begin(), m_ElementsOf[a].end(), [&](const Index number) {
        const Element & element = m_Elements[number];
        return FindSide(element, a, b) < element.numberOfCorners || FindSide(element, b, a) < element.numberOfCorners;
      }));
  }

  /** The element at the other side of one of two, which goes from b to a. */
  Index
  FindBeyond(const Index a, const Index b) const
  {
    Index beyond = None;
    if (this->CountElements(a, b) == 2)
    {
      for (const Index number : m_ElementsOf[a])
      {
        if (FindSide(m_Elements[number], b, a) < m_Elements[number].numberOfCorners)
        {
          beyond = number;
        }
      }
    }
    return beyond;
  }

  bool
  IsGood(const Element & element) const
  {
    return MedialVoxelShellQuality(m_Complex, element) >= m_LeastQuality;
  }

  /** Looks beyond the sides of the triangle of a way. \return whether it is gone */
  bool
  GoOn(const Index start, const Index way)
  {
    const Element triangle = m_Ways[way].triangle;
    for (unsigned int k = 0; k < 3; ++k)
    {
      const Index p = triangle.corners[k];
      const Index q = triangle.corners[(k + 1) % 3];
      const Index r = triangle.corners[(k + 2) % 3];
      const Index beyond = this->FindBeyond(p, q);
      if (this->CountElements(p, q) == 1 && this->TryMerge(start, way, p, q))
      {
        return true;
      }
      if (beyond == None || m_IsSeen[beyond])
      {
        continue;
      }
      const Element &    other = m_Elements[beyond];
      const unsigned int side = FindSide(other, q, p);
      const auto         at = [&](const unsigned int n) { return other.corners[(side + n) % other.numberOfCorners]; };
      if (other.numberOfCorners == 3)
      {
        const Element joined = MakeElement({ q, r, p, at(2) }, triangle.wall);
        if (this->IsGood(joined))
        {
          this->Follow(start, way);
          this->Replace(start, joined);
          this->Remove(beyond);
          return true;
        }
        if (this->TryMerge(start, way, p, q))
        {
          return true;
        }
        continue;
      }
      m_Seen.push_back(beyond);
      m_IsSeen[beyond] = true;
      this->AddWays(way, beyond, { { q, r, p, at(2), at(3) } });
    }
    return false;
  }

  /** The four other divisions of five corners, of which the second is the triangle's own. */
  void
  AddWays(const Index before, const Index quad, const std::array<Index, 5> & ring)
  {
    for (const unsigned int ear : { 0u, 2u, 3u, 4u })
    {
      const auto    at = [&](const unsigned int n) { return ring[(ear + n) % 5]; };
      const Index   wall = m_Elements[quad].wall;
      const Element triangle = MakeElement({ at(4), at(0), at(1) }, wall);
      const Element rest = MakeElement({ at(1), at(2), at(3), at(4) }, wall);
      if (this->CountElements(at(4), at(1)) == 0 && !this->HasSide(before, at(4), at(1)) && this->IsGood(triangle) &&
          this->IsGood(rest))
      {
        m_Ways.push_back({ before, quad, triangle, rest });
      }
    }
  }

  /** Whether a way, or one before it, makes a side between two vertices. */
  bool
  HasSide(Index way, const Index a, const Index b) const
  {
    for (; m_Ways[way].quad != None; way = m_Ways[way].before)
    {
      const auto & corners = m_Ways[way].triangle.corners;
      if (std::minmax(corners[0], corners[2]) == std::minmax(a, b))
      {
        return true;
      }
    }
    return false;
  }

  /** Exchanges what there is with what the ways leave, or back again. */
  void
  Follow(const Index start, const Index last)
  {
    for (Index way = last; m_Ways[way].quad != None; way = m_Ways[way].before)
    {
      const Element before = m_Elements[m_Ways[way].quad];
      this->Replace(m_Ways[way].quad, m_Ways[way].rest);
      m_Ways[way].rest = before;
    }
    const Element before = m_Elements[start];
    this->Replace(start, m_Ways[last].triangle);
    m_Ways[last].triangle = before;
  }

  /** Makes two vertices one, at a side of the triangle where the ways lead to. */
  bool
  TryMerge(const Index start, const Index last, const Index a, const Index b)
  {
    this->Follow(start, last);
    const bool isMerged = this->TryPut(a, b) || this->TryPut(b, a);
    if (!isMerged)
    {
      this->Follow(start, last);
    }
    return isMerged;
  }

  /** Puts a vertex on another one, where all elements stay good. Those of rims go along these. */
  bool
  TryPut(const Index from, const Index to)
  {
    const Complex::Place place = this->CountElements(from, to) == 1 ? Complex::Place::Rim : Complex::Place::Wall;
    if (m_Complex.GetPlace(from) != place || !m_Complex.CanCollapse(from, to) || !this->KeepsRim(from, to))
    {
      return false;
    }
    const std::vector<Index> numbers = m_ElementsOf[from];
    std::vector<Element>     changed;
    for (const Index number : numbers)
    {
      changed.push_back(Put(m_Elements[number], from, to));
    }
    if (!std::all_of(changed.begin(), changed.end(), [&](const Element & e) { return this->IsGoodAndNear(e); }) ||
        !this->KeepsSides(from, to))
    {
      return false;
    }
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      if (changed[k].numberOfCorners == 2)
      {
        this->Remove(numbers[k]);
      }
      else
      {
        this->Replace(numbers[k], changed[k]);
      }
    }
    m_Complex.Collapse(from, to);
    return true;
  }

  /** With two corners where a triangle has both vertices. */
  static Element
  Put(Element element, const Index from, const Index to)
  {
    const auto begin = element.corners.begin();
    const auto end = begin + element.numberOfCorners;
    if (std::find(begin, end, to) == end)
    {
      std::replace(begin, end, from, to);
    }
    else
    {
      element.numberOfCorners = static_cast<std::uint8_t>(std::remove(begin, end, from) - begin);
    }
    return element;
  }

  bool
  IsGoodAndNear(const Element & element) const
  {
    return element.numberOfCorners == 2 ||
           (this->IsGood(element) && m_Fine.HasWallWithin(MedialVoxelElementMiddle(m_Complex, element),
                                                          element.wall,
                                                          MostOfDistance * MedialVoxelLargestSize(m_Complex, element)));
  }

  /** Whether the place of a vertex stays near the rim, when it leaves that. */
  bool
  KeepsRim(const Index from, const Index to) const
  {
    const Complex::Neighbors neighbors = m_Complex.FindNeighbors(from);
    return std::all_of(neighbors.begin(), neighbors.end(), [&](const Complex::Neighbor & neighbor) {
      const auto & end = m_Complex.GetPoint(neighbor.vertex);
      return neighbor.triangles == 2 || neighbor.vertex == to ||
             MedialVoxelNorm(MedialVoxelSubtract(
               MedialVoxelNearestOfTriangle(m_Complex.GetPoint(from), { { m_Complex.GetPoint(to), end, end } }),
               m_Complex.GetPoint(from))) <= MostOfDistance * m_Complex.GetSize(from);
    });
  }

  /** Whether the sides of a vertex can be those of another: they are not too long, and none is there already, but that
   * of a triangle that goes. */
  bool
  KeepsSides(const Index from, const Index to) const
  {
    std::vector<Index> beside;
    std::vector<Index> opposite; // in triangles of both
    for (const Index number : m_ElementsOf[from])
    {
      const Element &    element = m_Elements[number];
      const unsigned int corners = element.numberOfCorners;
      for (unsigned int k = 0; k < corners; ++k)
      {
        const Index other = element.corners[k];
        const Index next = element.corners[(k + 1) % corners];
        const Index last = element.corners[(k + corners - 1) % corners];
        if (other != to && (next == from || last == from))
        {
          (corners == 3 && (next == to || last == to) ? opposite : beside).push_back(other);
        }
      }
    }
    return std::all_of(beside.begin(), beside.end(), [&](const Index other) {
      const double size = (m_Complex.GetSize(to) + m_Complex.GetSize(other)) / 2.0;
      return (this->CountElements(to, other) == 0 ||
              std::find(opposite.begin(), opposite.end(), other) != opposite.end()) &&
             MedialVoxelNorm(MedialVoxelSubtract(m_Complex.GetPoint(to), m_Complex.GetPoint(other))) <=
               MostOfLength * size;
    });
  }

  void
  Remove(const Index number)
  {
    this->Detach(number);
    m_Elements[number].numberOfCorners = 0;
  }

  void
  Replace(const Index number, const Element & element)
  {
    this->Detach(number);
    m_Elements[number] = element;
    this->Attach(number);
  }

  Complex &                       m_Complex;
  const MedialVoxelFineSheet &    m_Fine;
  double                          m_LeastQuality;
  std::vector<Element> &          m_Elements;
  std::vector<std::vector<Index>> m_ElementsOf;
  std::vector<Way>                m_Ways;
  std::vector<bool>               m_IsSeen; ///< of elements
  std::vector<Index>              m_Seen;
};

} // namespace

void
MedialVoxelJoinLoneTriangles(Complex &                    complex,
                             const MedialVoxelFineSheet & fine,
                             const double                 leastQuality,
                             std::vector<Element> &       elements)
{
  Walk walk(complex, fine, leastQuality, elements);
  for (Index number = 0; number < elements.size(); ++number)
  {
    walk.Join(number);
  }
  elements.erase(std::remove_if(elements.begin(),
                                elements.end(),
                                [](const Element & element) { return element.numberOfCorners == 0; }),
                 elements.end());
}

} // end namespace itk
