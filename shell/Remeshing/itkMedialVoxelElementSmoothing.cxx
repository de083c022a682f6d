// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelElementSmoothing.h"

#include "itkMedialVoxelSheetVectors.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Complex = MedialVoxelTriangleComplex;
using Element = MedialVoxelShellElement;
using Index = Complex::Index;
using Vector = MedialVoxelVector3;

constexpr unsigned int Rounds = 4;

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
           const std::vector<Element> & wanted)
    : m_Complex(complex)
    , m_Fine(fine)
    , m_Elements(elements)
    , m_ElementsOf(complex.GetNumberOfVertices())
  {
    m_Elements.insert(m_Elements.end(), wanted.begin(), wanted.end());
    for (Index number = 0; number < m_Elements.size(); ++number)
    {
      for (unsigned int k = 0; k < m_Elements[number].numberOfCorners; ++k)
      {
        m_ElementsOf[m_Elements[number].corners[k]].push_back(number);
      }
      m_Qualities.push_back(MedialVoxelShellQuality(complex, m_Elements[number]));
      m_Limits.push_back(this->GetLimit(m_Elements[number]));
    }
  }

  void
  Move(const Index vertex)
  {
    const double worst = this->GetWorst(vertex);
    if (worst >= GoodQuality || m_ElementsOf[vertex].empty() || m_Complex.GetPlace(vertex) != Complex::Place::Wall)
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
        return;
      }
    }
    m_Complex.GetVertex(vertex).point = old;
  }

private:
  /** Of the distance of its middle. */
  double
  GetLimit(const Element & element) const
  {
    const Vector middle = MedialVoxelElementMiddle(m_Complex, element);
    return std::max(Tolerance * MedialVoxelLargestSize(m_Complex, element),
                    m_Fine.FindOnWall(middle, element.wall).distance);
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
};

} // namespace

void
MedialVoxelSmoothElements(Complex &                    complex,
                          const MedialVoxelFineSheet & fine,
                          const std::vector<Element> & elements,
                          const std::vector<Element> & wanted)
{
  Smoother smoother(complex, fine, elements, wanted);
  for (unsigned int round = 0; round < Rounds; ++round)
  {
    for (Index vertex = 0; vertex < complex.GetNumberOfVertices(); ++vertex)
    {
      smoother.Move(vertex);
    }
  }
}

} // end namespace itk
