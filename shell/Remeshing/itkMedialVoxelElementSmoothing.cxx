// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelElementSmoothing.h"

#include "itkMedialVoxelComplexDivision.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace itk
{
namespace
{

using Complex = MedialVoxelTriangleComplex;
using Element = MedialVoxelShellElement;
using Index = Complex::Index;
using Vector = MedialVoxelVector3;

constexpr unsigned int Rounds = 4;

/** Vertices of a part. */
constexpr std::size_t MostOfPart = 512;

/** Of the low sides of cuts: most vertices at cuts are inside parts of another division. */
constexpr std::array<double, 2> Shares{ { 0.5, 0.4 } };

/** Vertices whose elements all reach it are left alone. */
constexpr double GoodQuality = 0.8;

/** No element falls below it. */
constexpr double LeastQuality = 0.45;

constexpr double LeastGain = 0.005;

/** Of the size of a vertex, for the middles of its elements. */
constexpr double Tolerance = 0.08;

constexpr std::array<double, 3> Steps{ { 1.0, 0.5, 0.25 } };

/** \class Smoother
 * \brief The elements of each vertex, and the steps of one. */
class Smoother
{
public:
  Smoother(Complex &                    complex,
           const MedialVoxelFineSheet & fine,
           const std::vector<Element> & elements,
           const std::vector<Element> & wanted,
           const MedialVoxelRunTasks &  runTasks)
    : m_Complex(complex)
    , m_Fine(fine)
    , m_Elements(elements)
    , m_ElementsOf(complex.GetNumberOfVertices())
    , m_Parts(complex.GetNumberOfVertices())
    , m_IsTaken(complex.GetNumberOfVertices())
    , m_IsSettled(complex.GetNumberOfVertices())
  {
    m_Elements.insert(m_Elements.end(), wanted.begin(), wanted.end());
    for (Index number = 0; number < m_Elements.size(); ++number)
    {
      for (unsigned int k = 0; k < m_Elements[number].numberOfCorners; ++k)
      {
        m_ElementsOf[m_Elements[number].corners[k]].push_back(number);
      }
    }
    m_Qualities.resize(m_Elements.size());
    m_Limits.resize(m_Elements.size());
    MedialVoxelForEach(runTasks, m_Elements.size(), [this](const Index number) {
      m_Qualities[number] = MedialVoxelShellQuality(m_Complex, m_Elements[number]);
      m_Limits[number] = this->GetLimit(m_Elements[number]);
    });
  }

  /** Divides vertices, and takes from each part the inner ones that no division before has taken. */
  std::vector<std::vector<Index>>
  TakeInner(std::vector<std::vector<Index>> parts, const MedialVoxelRunTasks & runTasks)
  {
    for (Index part = 0; part < parts.size(); ++part)
    {
      for (const Index vertex : parts[part])
      {
        m_Parts[vertex] = part;
      }
    }
    runTasks(parts.size(), [&](const std::size_t part, const std::function<void()> & check) {
      check();
      const auto isLeft = [this](const Index vertex) { return m_IsTaken[vertex] != 0 || !this->IsInside(vertex); };
      parts[part].erase(std::remove_if(parts[part].begin(), parts[part].end(), isLeft), parts[part].end());
      for (const Index vertex : parts[part])
      {
        m_IsTaken[vertex] = 1;
      }
    });
    return parts;
  }

  void
  Move(const Index vertex)
  {
    const double worst = m_IsSettled[vertex] != 0 ? 1.0 : this->GetWorst(vertex);
    if (worst >= GoodQuality || m_Complex.GetPlace(vertex) != Complex::Place::Wall)
    {
      return;
    }
    const Vector old = m_Complex.GetPoint(vertex);
    const Vector way = MedialVoxelSubtract(this->GetAim(vertex), old);
    const Index  wall = m_Elements[m_ElementsOf[vertex].front()].wall;
    for (const double step : Steps)
    {
      m_Complex.GetVertex(vertex).point = m_Fine.FindOnWall(MedialVoxelAddScaled(old, way, step), wall).point;
      if (this->IsBetter(vertex, worst))
      {
        this->ForEachNeighbor(vertex, [this](const Index other) { m_IsSettled[other] = 0; });
        return;
      }
    }
    m_Complex.GetVertex(vertex).point = old;
    m_IsSettled[vertex] = 1;
  }

private:
  /** Also the vertex itself, and some of them more than once. */
  template <typename TFunction>
  void
  ForEachNeighbor(const Index vertex, const TFunction & function) const
  {
    for (const Index number : m_ElementsOf[vertex])
    {
      const Element & element = m_Elements[number];
      std::for_each(element.corners.begin(), element.corners.begin() + element.numberOfCorners, function);
    }
  }

  bool
  IsInside(const Index vertex) const
  {
    bool isInside = true;
    this->ForEachNeighbor(vertex, [&](const Index other) { isInside = isInside && m_Parts[other] == m_Parts[vertex]; });
    return isInside;
  }

  /** Of the distance of its middle. */
  double
  GetLimit(const Element & element) const
  {
    const Vector middle = MedialVoxelElementMiddle(m_Complex, element);
    const double limit = Tolerance * MedialVoxelLargestSize(m_Complex, element);
    return m_Fine.HasWallWithin(middle, element.wall, limit) ? limit : m_Fine.FindOnWall(middle, element.wall).distance;
  }

  double
  GetWorst(const Index vertex) const
  {
    double worst = 1.0;
    for (const Index number : m_ElementsOf[vertex])
    {
      worst = std::min(worst, m_Qualities[number]);
    }
    return worst;
  }

  /** The mean of where each element has its best shape; bad ones count more. */
  Vector
  GetAim(const Index vertex) const
  {
    Vector sum{};
    double weights = 0.0;
    for (const Index number : m_ElementsOf[vertex])
    {
      const Element &    element = m_Elements[number];
      const unsigned int corners = element.numberOfCorners;
      const auto         place = static_cast<unsigned int>(
        std::find(element.corners.begin(), element.corners.begin() + corners, vertex) - element.corners.begin());
      const auto at = [&](const unsigned int k) { return m_Complex.GetPoint(element.corners[(place + k) % corners]); };
      const Vector beside = MedialVoxelMiddle(at(1), at(corners - 1));
      const Vector aim = corners == 4 ? MedialVoxelAddScaled(beside, MedialVoxelSubtract(beside, at(2)), 1.0)
                                      : this->GetApex(at(1), at(2), at(0));
      const double weight = 1.1 - std::clamp(m_Qualities[number], 0.0, 1.0);
      sum = MedialVoxelAddScaled(sum, aim, weight);
      weights += weight;
    }
    return MedialVoxelAddScaled({}, sum, 1.0 / weights);
  }

  /** Where a triangle over a side has equal sides, in the plane of a place. */
  static Vector
  GetApex(const Vector & a, const Vector & b, const Vector & place)
  {
    const Vector side = MedialVoxelSubtract(b, a);
    const Vector middle = MedialVoxelMiddle(a, b);
    const Vector toPlace = MedialVoxelSubtract(place, middle);
    const double length2 = MedialVoxelDot(side, side);
    const Vector height = MedialVoxelAddScaled(toPlace, side, -MedialVoxelDot(toPlace, side) / length2);
    return MedialVoxelAddScaled(middle, height, std::sqrt(0.75 * length2) / MedialVoxelNorm(height));
  }

  /** Takes the new qualities when it is. */
  bool
  IsBetter(const Index vertex, const double worst)
  {
    std::vector<double> qualities;
    double              least = 1.0;
    for (const Index number : m_ElementsOf[vertex])
    {
      const Element & element = m_Elements[number];
      qualities.push_back(MedialVoxelShellQuality(m_Complex, element));
      least = std::min(least, qualities.back());
      if (!(least >= worst + LeastGain) || qualities.back() < std::min(LeastQuality, m_Qualities[number]) ||
          !m_Fine.HasWallWithin(MedialVoxelElementMiddle(m_Complex, element), element.wall, m_Limits[number]))
      {
        return false;
      }
    }
    for (std::size_t k = 0; k < qualities.size(); ++k)
    {
      m_Qualities[m_ElementsOf[vertex][k]] = qualities[k];
    }
    return true;
  }

  Complex &                       m_Complex;
  const MedialVoxelFineSheet &    m_Fine;
  std::vector<Element>            m_Elements;
  std::vector<std::vector<Index>> m_ElementsOf;
  std::vector<double>             m_Qualities;
  std::vector<double>             m_Limits;
  std::vector<Index>              m_Parts;     ///< of the vertices in the last division
  std::vector<char>               m_IsTaken;   ///< from a division; bytes, as tasks write them
  std::vector<char>               m_IsSettled; ///< it cannot move, as long as its neighbors do not
};

} // namespace

void
MedialVoxelSmoothElements(Complex &                    complex,
                          const MedialVoxelFineSheet & fine,
                          const std::vector<Element> & elements,
                          const std::vector<Element> & wanted,
                          const MedialVoxelRunTasks &  runTasks)
{
  Smoother            smoother(complex, fine, elements, wanted, runTasks);
  std::vector<Vector> places;
  std::vector<Index>  vertices(complex.GetNumberOfVertices());
  std::iota(vertices.begin(), vertices.end(), Index{ 0 });
  std::transform(vertices.begin(), vertices.end(), std::back_inserter(places), [&](const Index vertex) {
    return complex.GetPoint(vertex);
  });
  // Lists of one wave have no neighbors in each other. The last one has what is at cuts of all divisions.
  std::vector<std::vector<std::vector<Index>>> waves;
  for (const double share : Shares)
  {
    waves.push_back(smoother.TakeInner(MedialVoxelDividePlaces(places, vertices, MostOfPart, share), runTasks));
  }
  waves.push_back(smoother.TakeInner({ vertices }, runTasks));
  for (unsigned int round = 0; round < Rounds; ++round)
  {
    for (const auto & lists : waves)
    {
      runTasks(lists.size(), [&](const std::size_t number, const std::function<void()> & check) {
        check();
        std::for_each(lists[number].begin(), lists[number].end(), [&](const Index vertex) { smoother.Move(vertex); });
      });
    }
  }
}

} // end namespace itk
