// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLoneTriangles.h"

#include <algorithm>

namespace itk
{
namespace
{

using Element = MedialVoxelShellElement;
using Index = Element::Index;

constexpr Index None = ~Index{ 0 };

/** Of all elements that change. */
constexpr double LeastQuality = 0.4;

/** Quadrilaterals that a triangle may look at. */
constexpr std::size_t MostQuads = 128;

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
  Walk(const MedialVoxelTriangleComplex & complex, std::vector<Element> & elements)
    : m_Complex(complex)
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
  TryJoin(const Index triangle)
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
    return MedialVoxelShellQuality(m_Complex, element) >= LeastQuality;
  }

  /** Looks beyond the sides of the triangle of a way. \return whether it was joined */
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
          this->Join(start, way, beyond, joined);
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

  /** Puts what the ways leave, and the triangle at their end together with another. */
  void
  Join(const Index start, const Index last, const Index other, const Element & joined)
  {
    for (Index way = last; m_Ways[way].quad != None; way = m_Ways[way].before)
    {
      this->Replace(m_Ways[way].quad, m_Ways[way].rest);
    }
    this->Replace(start, joined);
    this->Detach(other);
    m_Elements[other].numberOfCorners = 0;
  }

  void
  Replace(const Index number, const Element & element)
  {
    this->Detach(number);
    m_Elements[number] = element;
    this->Attach(number);
  }

  const MedialVoxelTriangleComplex & m_Complex;
  std::vector<Element> &             m_Elements;
  std::vector<std::vector<Index>>    m_ElementsOf;
  std::vector<Way>                   m_Ways;
  std::vector<bool>                  m_IsSeen; ///< of elements
  std::vector<Index>                 m_Seen;
};

} // namespace

void
MedialVoxelJoinLoneTriangles(const MedialVoxelTriangleComplex & complex, std::vector<Element> & elements)
{
  Walk walk(complex, elements);
  for (Index number = 0; number < elements.size(); ++number)
  {
    walk.TryJoin(number);
  }
  elements.erase(std::remove_if(elements.begin(),
                                elements.end(),
                                [](const Element & element) { return element.numberOfCorners == 0; }),
                 elements.end());
}

} // end namespace itk
