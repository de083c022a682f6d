// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelShellElements.h"

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelElementSmoothing.h"
#include "itkMedialVoxelLoneTriangles.h"
#include "itkMedialVoxelPairing.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cassert>

namespace itk
{
namespace
{

using Complex = MedialVoxelTriangleComplex;
using Index = Complex::Index;
using Triangle = Complex::Triangle;

constexpr unsigned int Rounds = 3;

/** Quadrilaterals are made where their quality reaches one of these, the best first. */
constexpr std::array<double, 4> QualitySteps{ { 0.8, 0.6, 0.5, 0.4 } };

/** Whether a triangle goes from a to b. */
bool
GoesAlong(const Triangle & triangle, const Index a, const Index b)
{
  return (triangle[0] == a && triangle[1] == b) || (triangle[1] == a && triangle[2] == b) ||
         (triangle[2] == a && triangle[0] == b);
}

/** The other triangle of a side of two. */
Index
GetOther(const Complex & complex, const Index triangle, const Index a, const Index b)
{
  const Complex::Indices triangles = complex.FindTriangles(a, b);
  return triangles.size() != 2 ? Complex::None : triangles[0] == triangle ? triangles[1] : triangles[0];
}

/** Two triangles, and the element that they would make. */
struct Pair
{
  double                  quality;
  Index                   first;
  Index                   second;
  MedialVoxelShellElement element;
};

/** \class Joiner
 * \brief Joins triangles step by step, between which the vertices may move. */
class Joiner
{
public:
  Joiner(const Complex & complex, const std::vector<Triangle> & corners)
    : m_Complex(complex)
    , m_Corners(corners)
    , m_Partners(corners.size(), Complex::None)
    , m_Pairs(this->ListPairs())
  {}

  /** Triangles that are joined stay so, or get other partners. */
  void
  Join(const MedialVoxelRunTasks & runTasks)
  {
    std::vector<Pair> pairs = m_Pairs;
    MedialVoxelForEach(runTasks, pairs.size(), [&](const Index number) {
      pairs[number].quality = MedialVoxelShellQuality(m_Complex, pairs[number].element);
    });
    std::sort(pairs.begin(), pairs.end(), [](const Pair & x, const Pair & y) {
      return x.quality != y.quality ? x.quality > y.quality
             : x.first != y.first   ? x.first < y.first
                                    : x.second < y.second;
    });
    MedialVoxelPairing pairing(m_Corners.size());
    for (const Pair & pair : pairs)
    {
      if (this->AreJoined(pair))
      {
        pairing.Allow(pair.first, pair.second);
      }
    }
    // In steps: good pairs stay good, when worse ones are allowed.
    auto next = pairs.begin();
    for (const double least : QualitySteps)
    {
      for (; next != pairs.end() && next->quality >= least; ++next)
      {
        if (!this->AreJoined(*next))
        {
          pairing.Allow(next->first, next->second);
        }
      }
      pairing.Extend();
    }
    for (Index triangle = 0; triangle < m_Partners.size(); ++triangle)
    {
      m_Partners[triangle] = pairing.GetPartner(triangle);
    }
  }

  /** What is joined, then the triangles that are left. */
  std::vector<MedialVoxelShellElement>
  ListElements() const
  {
    std::vector<MedialVoxelShellElement> elements;
    for (const Pair & pair : m_Pairs)
    {
      if (this->AreJoined(pair))
      {
        elements.push_back(pair.element);
      }
    }
    for (Index triangle = 0; triangle < m_Corners.size(); ++triangle)
    {
      if (m_Complex.IsTriangle(triangle) && m_Partners[triangle] == Complex::None)
      {
        MedialVoxelShellElement element;
        element.corners = { { m_Corners[triangle][0], m_Corners[triangle][1], m_Corners[triangle][2], 0 } };
        element.wall = m_Complex.GetWall(triangle);
        elements.push_back(element);
      }
    }
    return elements;
  }

  /** What would be joined if it were better. */
  std::vector<MedialVoxelShellElement>
  ListWanted() const
  {
    std::vector<MedialVoxelShellElement> elements;
    for (const Pair & pair : m_Pairs)
    {
      if (m_Partners[pair.first] == Complex::None && m_Partners[pair.second] == Complex::None)
      {
        elements.push_back(pair.element);
      }
    }
    return elements;
  }

private:
  bool
  AreJoined(const Pair & pair) const
  {
    return m_Partners[pair.first] == pair.second;
  }

  /** All that share a side of two, in the order of their numbers. */
  std::vector<Pair>
  ListPairs() const
  {
    std::vector<Pair> pairs;
    for (Index first = 0; first < m_Corners.size(); ++first)
    {
      for (unsigned int k = 0; k < 3 && m_Complex.IsTriangle(first); ++k)
      {
        const Index a = m_Corners[first][k];
        const Index b = m_Corners[first][(k + 1) % 3];
        const Index second = GetOther(m_Complex, first, a, b);
        if (second == Complex::None || second < first || !GoesAlong(m_Corners[second], b, a))
        {
          continue;
        }
        Pair pair{ 0.0, first, second, {} };
        pair.element.corners = { { a, m_Complex.GetOpposite(second, a, b), b, m_Complex.GetOpposite(first, a, b) } };
        pair.element.numberOfCorners = 4;
        pair.element.wall = m_Complex.GetWall(first);
        pairs.push_back(pair);
      }
    }
    return pairs;
  }

  const Complex &               m_Complex;
  const std::vector<Triangle> & m_Corners;
  std::vector<Index>            m_Partners; ///< of triangles; None: it is not joined
  const std::vector<Pair>       m_Pairs;    ///< all that could be joined, without their qualities
};

/** Marks sides of one element, and of more than two. */
void
MarkSides(std::vector<MedialVoxelShellElement> & elements)
{
  const auto forEachSide = [&](auto && function) {
    for (MedialVoxelShellElement & element : elements)
    {
      for (unsigned int k = 0; k < element.numberOfCorners; ++k)
      {
        function(element, k, std::minmax(element.corners[k], element.corners[(k + 1) % element.numberOfCorners]));
      }
    }
  };
  using Side = std::pair<Index, Index>;
  std::vector<Side> sides;
  forEachSide([&](auto &, unsigned int, const Side & side) { sides.push_back(side); });
  std::sort(sides.begin(), sides.end());
  forEachSide([&](MedialVoxelShellElement & element, const unsigned int k, const Side & side) {
    const auto range = std::equal_range(sides.begin(), sides.end(), side);
    const auto number = range.second - range.first;
    element.rimSides = static_cast<std::uint8_t>(element.rimSides | (number == 1 ? 1u << k : 0u));
    element.junctionSides = static_cast<std::uint8_t>(element.junctionSides | (number > 2 ? 1u << k : 0u));
  });
}

} // namespace

std::uint64_t
MedialVoxelOrientWalls(const Complex & complex, std::vector<Triangle> & corners)
{
  corners.assign(complex.GetNumberOfTriangles(), { { Complex::None, Complex::None, Complex::None } });
  std::uint64_t      conflicts = 0;
  std::vector<Index> queue;
  for (Index start = 0; start < complex.GetNumberOfTriangles(); ++start)
  {
    if (!complex.IsTriangle(start) || corners[start][0] != Complex::None)
    {
      continue;
    }
    corners[start] = complex.GetTriangle(start);
    queue.assign(1, start);
    for (std::size_t next = 0; next < queue.size(); ++next)
    {
      const Index triangle = queue[next];
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Index a = corners[triangle][k];
        const Index b = corners[triangle][(k + 1) % 3];
        const Index other = GetOther(complex, triangle, a, b);
        if (other == Complex::None)
        {
          continue;
        }
        if (corners[other][0] == Complex::None)
        {
          corners[other] = complex.GetTriangle(other);
          if (GoesAlong(corners[other], a, b))
          {
            std::swap(corners[other][1], corners[other][2]);
          }
          queue.push_back(other);
        }
        else if (other > triangle && GoesAlong(corners[other], a, b))
        {
          ++conflicts;
        }
      }
    }
  }
  return conflicts;
}

MedialVoxelVector3
MedialVoxelElementMiddle(const Complex & complex, const MedialVoxelShellElement & element)
{
  MedialVoxelVector3 middle{};
  for (unsigned int k = 0; k < element.numberOfCorners; ++k)
  {
    middle = MedialVoxelAddScaled(middle, complex.GetPoint(element.corners[k]), 1.0 / element.numberOfCorners);
  }
  return middle;
}

double
MedialVoxelLargestSize(const Complex & complex, const MedialVoxelShellElement & element)
{
  float size = 0.0F;
  for (unsigned int k = 0; k < element.numberOfCorners; ++k)
  {
    size = std::max(size, complex.GetSize(element.corners[k]));
  }
  return size;
}

double
MedialVoxelShellQuality(const Complex & complex, const MedialVoxelShellElement & element)
{
  const auto at = [&](const unsigned int k) { return complex.GetPoint(element.corners[k]); };
  return element.numberOfCorners == 3
           ? MedialVoxelShellQuality(std::array<MedialVoxelVector3, 3>{ { at(0), at(1), at(2) } })
           : MedialVoxelShellQuality(std::array<MedialVoxelVector3, 4>{ { at(0), at(1), at(2), at(3) } });
}

void
MedialVoxelStartWithLowest(MedialVoxelShellElement & element)
{
  const unsigned int number = element.numberOfCorners;
  const auto         begin = element.corners.begin();
  const auto         lowest = static_cast<unsigned int>(std::min_element(begin, begin + number) - begin);
  std::rotate(begin, begin + lowest, begin + number);
  const auto rotate = [&](const std::uint8_t bits) {
    return static_cast<std::uint8_t>((bits >> lowest | bits << (number - lowest)) & ((1u << number) - 1));
  };
  element.rimSides = rotate(element.rimSides);
  element.junctionSides = rotate(element.junctionSides);
}

std::vector<MedialVoxelShellElement>
MedialVoxelMakeElements(Complex &                     complex,
                        const MedialVoxelFineSheet &  fine,
                        const std::vector<Triangle> & corners,
                        const bool                    joins,
                        const MedialVoxelRunTasks &   runTasks)
{
  assert(corners.size() == complex.GetNumberOfTriangles());
  Joiner joiner(complex, corners);
  for (unsigned int round = 0; joins && round < Rounds; ++round)
  {
    joiner.Join(runTasks);
    MedialVoxelSmoothElements(complex, fine, joiner.ListElements(), joiner.ListWanted(), runTasks);
  }
  std::vector<MedialVoxelShellElement> elements = joiner.ListElements();
  for (std::size_t step = 1; joins && step < QualitySteps.size(); ++step)
  {
    MedialVoxelJoinLoneTriangles(complex, fine, QualitySteps[step], elements);
    MedialVoxelSmoothElements(complex, fine, elements, {}, runTasks);
  }
  MarkSides(elements);
  return elements;
}

} // end namespace itk
