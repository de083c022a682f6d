// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallFitting.h"

#include "itkMedialVoxelComplexDivision.h"
#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelVector3.h"
#include "itkMedialVoxelSymmetricEquations.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace itk
{
namespace
{

using Element = MedialVoxelShellElement;
using Index = std::uint32_t;
using Vector = MedialVoxelVector3;

constexpr Index None = ~Index{ 0 };

/** In sizes of elements round a node. */
constexpr std::array<double, 7> Radii{ { 1.5, 2.5, 4.0, 6.0, 9.0, 13.0, 20.0 } };

/** In noises: root of the mean square of what a fit leaves at most, and how far points may be from their element. */
constexpr double MostRest = 0.7;
constexpr double MostAway = 3.0;

/** Between the normals of elements and the normal of a node. */
constexpr double LeastCosine = 0.7;

/** In noises, that nodes move at most. */
constexpr double MostMove = 2.0;

/** Of the squared angle of walls that count as one. */
constexpr double SmallOfShift = 0.02;

/** A quadric of a larger round leaves so much more than that of a smaller one at most, unless both are small, in
 * noises: walls are not round far around. */
constexpr double GrowthOfRest = 1.2;
constexpr double LeastRest = 0.05;

/** A plane is taken unless a quadric leaves less of the rest than this share. */
constexpr double ShareOfPlane = 0.8;

/** Elements for each number that is fitted. */
constexpr std::size_t ElementsPerNumber = 2;

constexpr std::size_t NodesOfPart = 256;

/** No element becomes worse than that, but those that are worse already may lose a part of it. */
constexpr double LeastQuality = 0.4;
constexpr double ShareOfQuality = 0.9;

std::vector<Vector>
GetCorners(const std::vector<Vector> & points, const Element & element)
{
  std::vector<Vector> corners;
  for (unsigned int k = 0; k < element.numberOfCorners; ++k)
  {
    corners.push_back(points[element.corners[k]]);
  }
  return corners;
}

/** Two directions across to a normal and to each other. */
std::array<Vector, 2>
GetAxes(const Vector & normal)
{
  const Vector some = std::abs(normal[0]) < 0.6 ? Vector{ { 1, 0, 0 } } : Vector{ { 0, 1, 0 } };
  const Vector u = MedialVoxelNormalized(MedialVoxelCross(normal, some));
  return { { u, MedialVoxelCross(normal, u) } };
}

double
GetQuality(const std::vector<Vector> & points, const Element & element)
{
  const auto at = [&](const unsigned int k) { return points[element.corners[k]]; };
  return element.numberOfCorners == 3
           ? MedialVoxelShellQuality(std::array<Vector, 3>{ { at(0), at(1), at(2) } })
           : MedialVoxelShellQuality(std::array<Vector, 4>{ { at(0), at(1), at(2), at(3) } });
}

} // namespace

void
MedialVoxelWallFitting::Equations::Add(const std::array<double, 6> & means, const double height, const double weight)
{
  for (std::size_t i = 0; i < means.size(); ++i)
  {
    values[i] += weight * means[i] * height;
    for (std::size_t k = 0; k <= i; ++k)
    {
      matrix[i][k] += weight * means[i] * means[k];
    }
  }
  square += weight * height * height;
  weights += weight;
  ++number;
}

/** Of the plane (3 numbers) or the quadric (6) that fits best. */
MedialVoxelWallFitting::Height
MedialVoxelWallFitting::Equations::Solve(const std::size_t numbers) const
{
  auto left = matrix;
  auto solution = values;
  if (number < ElementsPerNumber * numbers || !MedialVoxelSolveInPlace(left, solution, numbers))
  {
    return {};
  }
  double rest = square;
  for (std::size_t i = 0; i < numbers; ++i)
  {
    rest -= solution[i] * values[i];
  }
  const auto rows = static_cast<double>(number);
  return { true, solution[0], std::sqrt(std::max(rest, 0.0) / weights * rows / (rows - static_cast<double>(numbers))) };
}

MedialVoxelWallFitting::MedialVoxelWallFitting(const MedialVoxelRemeshedSheet & sheet, const double noise)
  : m_Sheet(sheet)
  , m_Noise(noise)
  , m_ElementsOf(sheet.points.size())
{
  std::vector<MedialVoxelSheetTree::Triangle> triangles;
  for (Index number = 0; number < sheet.elements.size(); ++number)
  {
    const Element &           element = sheet.elements[number];
    const std::vector<Vector> corners = GetCorners(sheet.points, element);
    Vector                    middle{};
    Vector                    normal{};
    for (unsigned int k = 0; k < element.numberOfCorners; ++k)
    {
      middle = MedialVoxelAddScaled(middle, corners[k], 1.0 / element.numberOfCorners);
      m_ElementsOf[element.corners[k]].push_back(number);
    }
    for (unsigned int k = 2; k < element.numberOfCorners; ++k)
    {
      normal =
        MedialVoxelAddScaled(normal, MedialVoxelTriangleNormal({ { corners[0], corners[k - 1], corners[k] } }), 1.0);
      triangles.push_back({ { element.corners[0], element.corners[k - 1], element.corners[k] } });
      m_ElementOf.push_back(number);
    }
    m_Middles.push_back(middle);
    m_Normals.push_back(MedialVoxelNormalized(normal));
    m_Sums.push_back({ number, 0.0, {}, {} });
  }
  m_Triangles =
    std::make_unique<MedialVoxelSheetTree>(sheet.points, triangles, std::vector<Index>(triangles.size(), 0));
  this->FindNeighbors();
}

void
MedialVoxelWallFitting::FindNeighbors()
{
  struct Side
  {
    Index low, high, element, place;
  };
  std::vector<Side> sides;
  m_Neighbors.assign(m_Sheet.elements.size(), { { None, None, None, None } });
  for (Index number = 0; number < m_Sheet.elements.size(); ++number)
  {
    const Element & element = m_Sheet.elements[number];
    for (unsigned int k = 0; k < element.numberOfCorners; ++k)
    {
      const auto [low, high] = std::minmax(element.corners[k], element.corners[(k + 1) % element.numberOfCorners]);
      sides.push_back({ low, high, number, k });
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side & a, const Side & b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.element < b.element;
  });
  const auto areSame = [](const Side & a, const Side & b) { return a.low == b.low && a.high == b.high; };
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last)
  {
    while (last < sides.size() && areSame(sides[first], sides[last]))
    {
      ++last;
    }
    if (last - first == 2)
    {
      m_Neighbors[sides[first].element][sides[first].place] = sides[first + 1].element;
      m_Neighbors[sides[first + 1].element][sides[first + 1].place] = sides[first].element;
    }
  }
}

std::vector<MedialVoxelWallFitting::Sums>
MedialVoxelWallFitting::Measure(const MedialVoxelSheet & part) const
{
  std::vector<Sums>                result;
  std::unordered_map<Index, Index> places; // of elements in the result
  for (const Point & point : part.points)
  {
    const auto nearest = m_Triangles->Find(point, 0, MostAway * m_Noise);
    if (!(nearest.distance < MostAway * m_Noise))
    {
      continue;
    }
    const Index element = m_ElementOf[nearest.triangle];
    const auto [found, isNew] = places.emplace(element, static_cast<Index>(result.size()));
    if (isNew)
    {
      result.push_back({ element, 0.0, {}, {} });
    }
    Sums &      sums = result[found->second];
    const Point from = MedialVoxelSubtract(point, m_Middles[element]);
    sums.number += 1.0;
    sums.places = MedialVoxelAddScaled(sums.places, from, 1.0);
    for (unsigned int i = 0, place = 0; i < 3; ++i)
    {
      for (unsigned int k = i; k < 3; ++k)
      {
        sums.products[place++] += from[i] * from[k];
      }
    }
  }
  return result;
}

void
MedialVoxelWallFitting::Add(const std::vector<Sums> & sums)
{
  for (const Sums & some : sums)
  {
    Sums & all = m_Sums[some.element];
    all.number += some.number;
    all.places = MedialVoxelAddScaled(all.places, some.places, 1.0);
    for (std::size_t k = 0; k < all.products.size(); ++k)
    {
      all.products[k] += some.products[k];
    }
  }
}

/** Mean side of the elements of a node. */
double
MedialVoxelWallFitting::GetSize(const Index node) const
{
  double       sum = 0.0;
  unsigned int number = 0;
  for (const Index element : m_ElementsOf[node])
  {
    const std::vector<Vector> corners = GetCorners(m_Sheet.points, m_Sheet.elements[element]);
    for (std::size_t k = 0; k < corners.size(); ++k, ++number)
    {
      sum += MedialVoxelNorm(MedialVoxelSubtract(corners[(k + 1) % corners.size()], corners[k]));
    }
  }
  return sum / number;
}

/** Adds elements whose middles are within a radius, over sides of two. \return whether all have nearly one normal */
bool
MedialVoxelWallFitting::GrowAround(const Frame & frame, const double radius, Region & region) const
{
  for (std::size_t next = 0; next < region.elements.size(); ++next)
  {
    if (!(std::abs(MedialVoxelDot(m_Normals[region.elements[next]], frame.normal)) > LeastCosine))
    {
      return false;
    }
    for (const Index neighbor : m_Neighbors[region.elements[next]])
    {
      if (neighbor != None && !region.isIn[neighbor] &&
          MedialVoxelNorm(MedialVoxelSubtract(m_Middles[neighbor], frame.place)) < radius)
      {
        region.isIn[neighbor] = true;
        region.elements.push_back(neighbor);
      }
    }
  }
  return true;
}

/** The means over the points of an element, in a frame at a node. */
void
MedialVoxelWallFitting::AddElement(const Index element, const Frame & frame, Equations & equations) const
{
  const Sums & sums = m_Sums[element];
  if (!(sums.number > 0.0))
  {
    return;
  }
  const Point mean = MedialVoxelAddScaled({}, sums.places, 1.0 / sums.number);
  const Point from = MedialVoxelAddScaled(MedialVoxelSubtract(m_Middles[element], frame.place), mean, 1.0);
  const auto  getProduct = [&](const Vector & a, const Vector & b) {
    double sum = 0.0;
    for (unsigned int i = 0, k = 0; i < 3; ++i)
    {
      for (unsigned int j = i; j < 3; ++j, ++k)
      {
        sum += sums.products[k] * (i == j ? a[i] * b[i] : a[i] * b[j] + a[j] * b[i]);
      }
    }
    // Sums are about the middle of the element.
    return sum / sums.number + MedialVoxelDot(from, a) * MedialVoxelDot(from, b) -
           MedialVoxelDot(mean, a) * MedialVoxelDot(mean, b);
  };
  const auto & [u, v] = frame.axes;
  const double scale = 1.0 / frame.size;
  equations.Add({ { 1.0,
                    MedialVoxelDot(from, u) * scale,
                    MedialVoxelDot(from, v) * scale,
                    getProduct(u, u) * scale * scale,
                    getProduct(u, v) * scale * scale,
                    getProduct(v, v) * scale * scale } },
                MedialVoxelDot(from, frame.normal),
                sums.number);
}

/** Of the wall of some elements over a place. Rounds grow as long as a fit leaves no more than noise.
 * \param isInside the place is not at the end of the wall, over which a quadric must not be carried on */
bool
MedialVoxelWallFitting::FindHeight(const Frame &              frame,
                                   const std::vector<Index> & start,
                                   const bool                 isInside,
                                   Region &                   region,
                                   double &                   height) const
{
  bool        isFound = false;
  Equations   equations;
  std::size_t next = 0;
  double      mostOfQuadric = MostRest * m_Noise;
  region.elements = start;
  for (const Index element : start)
  {
    region.isIn[element] = true;
  }
  for (const double radius : Radii)
  {
    const bool isFlat = this->GrowAround(frame, radius * frame.size, region);
    for (; next < region.elements.size(); ++next)
    {
      this->AddElement(region.elements[next], frame, equations);
    }
    const Height plane = equations.Solve(3);
    const Height quadric = equations.Solve(6);
    const bool   isPlane = quadric.rest > ShareOfPlane * plane.rest;
    const Height best = isPlane ? plane : quadric;
    if (!isFlat || (quadric.isSolved && best.rest > MostRest * m_Noise))
    {
      break;
    }
    if (quadric.isSolved && (isPlane || (isInside && best.rest <= mostOfQuadric)))
    {
      isFound = true;
      mostOfQuadric = isPlane ? mostOfQuadric : std::max(GrowthOfRest * best.rest, LeastRest * m_Noise);
      height = best.height;
    }
  }
  for (const Index element : region.elements)
  {
    region.isIn[element] = false;
  }
  return isFound;
}

/** Where the walls of a node have no height over it; as they agree nearly, along their normals alone. */
MedialVoxelWallFitting::Point
MedialVoxelWallFitting::FindPlace(const Index node, Region & region) const
{
  const Point &                         place = m_Sheet.points[node];
  const double                          size = this->GetSize(node);
  std::vector<Index>                    left = m_ElementsOf[node];
  std::vector<std::pair<Point, double>> heights;
  while (!left.empty())
  {
    // Those of the node's elements that sides of two join.
    std::vector<Index> fan(1, left.front());
    left.erase(left.begin());
    for (std::size_t next = 0; next < fan.size(); ++next)
    {
      for (const Index neighbor : m_Neighbors[fan[next]])
      {
        const auto found = std::find(left.begin(), left.end(), neighbor);
        if (neighbor != None && found != left.end())
        {
          fan.push_back(neighbor);
          left.erase(found);
        }
      }
    }
    Point normal = m_Normals[fan.front()];
    for (std::size_t k = 1; k < fan.size(); ++k)
    {
      const Point & other = m_Normals[fan[k]];
      normal = MedialVoxelAddScaled(normal, other, MedialVoxelDot(other, m_Normals[fan.front()]) < 0.0 ? -1.0 : 1.0);
    }
    normal = MedialVoxelNormalized(normal);
    const bool isInside = std::all_of(fan.begin(), fan.end(), [&](const Index element) {
      return m_Sheet.elements[element].rimSides == 0 && m_Sheet.elements[element].junctionSides == 0;
    });
    double     height = 0.0;
    if (this->FindHeight({ place, normal, GetAxes(normal), size }, fan, isInside, region, height))
    {
      heights.emplace_back(normal, height);
    }
  }
  const Vector shift = MedialVoxelFindShift(heights, SmallOfShift);
  return MedialVoxelNorm(shift) <= MostMove * m_Noise ? MedialVoxelAddScaled(place, shift, 1.0) : place;
}

std::vector<MedialVoxelWallFitting::Point>
MedialVoxelWallFitting::FindPlaces(const MedialVoxelRunTasks & runTasks) const
{
  std::vector<Point> places = m_Sheet.points;
  std::vector<Index> nodes(places.size());
  std::iota(nodes.begin(), nodes.end(), Index{ 0 });
  // Elements around a node are in the cache, as the node before has them, too.
  const auto parts = MedialVoxelDividePlaces(m_Sheet.points, std::move(nodes), NodesOfPart, 0.5);
  runTasks(parts.size(), [&](const std::size_t part, const std::function<void()> & check) {
    check();
    Region region{ {}, std::vector<bool>(m_Sheet.elements.size()) };
    for (const Index node : parts[part])
    {
      places[node] = m_ElementsOf[node].empty() ? places[node] : this->FindPlace(node, region);
    }
  });
  this->TakeBack(places);
  return places;
}

/** Leaves the nodes of elements where they were that would become bad, until there are none. */
void
MedialVoxelWallFitting::TakeBack(std::vector<Point> & places) const
{
  for (bool isDone = false; !isDone;)
  {
    isDone = true;
    for (const Element & element : m_Sheet.elements)
    {
      const double quality = GetQuality(places, element);
      if (quality < LeastQuality && quality < ShareOfQuality * GetQuality(m_Sheet.points, element))
      {
        for (unsigned int k = 0; k < element.numberOfCorners; ++k)
        {
          places[element.corners[k]] = m_Sheet.points[element.corners[k]];
        }
        isDone = false;
      }
    }
  }
}

} // end namespace itk
