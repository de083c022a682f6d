// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRimLines_h
#define itkMedialVoxelRimLines_h

#include "itkMedialVoxelElementQuality.h"
#include "itkMedialVoxelRimExtension.h"
#include "itkMedialVoxelSheetSides.h"
#include "itkMedialVoxelVector3.h"

namespace itk
{

/** A side of one triangle. */
struct MedialVoxelRimSide
{
  using Index = MedialVoxelSheet::Index;
  using Vector = MedialVoxelVector3;

  Index  a;
  Index  b;
  Index  triangle;
  Vector normal{};       ///< of the wall
  Vector outward{};      ///< in the wall, across the rim
  double thickness{ 0 }; ///< of the wall; 0: unknown
  double length{ 0 };    ///< from its middle to the edge
  double edge{ 0 };      ///< where the edge is along outward
};

/** \class MedialVoxelRimLines
 * \brief The rims of a sheet, the walls they end, and where the edges of the part are.
 * \ingroup MedialVoxel
 */
class MedialVoxelRimLines
{
public:
  using Index = MedialVoxelSheet::Index;
  using Vector = MedialVoxelVector3;
  using Triangle = std::array<Index, 3>;
  using RimSide = MedialVoxelRimSide;

  /** \param sheet   stays as long as this; points and triangles may be added
   * \param measure stays as long as this */
  MedialVoxelRimLines(const MedialVoxelSheet &          sheet,
                      const MedialVoxelMeasureRimRays & measure,
                      const MedialVoxelRunTasks &       runTasks);

  const std::vector<RimSide> &
  GetSides() const
  {
    return m_Rims;
  }

  /** The places of the sides of a point in GetSides(). */
  const std::vector<std::size_t> &
  GetSidesOf(const Index point) const
  {
    return m_SidesOf[point];
  }

  /** Points of the sheet when this was made. */
  Index
  GetNumberOfPoints() const
  {
    return static_cast<Index>(m_SidesOf.size());
  }

  const Vector &
  PointOf(const Index point) const
  {
    return m_Sheet.points[point];
  }

  Vector
  MiddleOf(const RimSide & side) const
  {
    return MedialVoxelMiddle(this->PointOf(side.a), this->PointOf(side.b));
  }

  std::array<Vector, 3>
  CornersOf(const Triangle & triangle) const
  {
    return { { this->PointOf(triangle[0]), this->PointOf(triangle[1]), this->PointOf(triangle[2]) } };
  }

  /** Counts of sides, and their length. */
  const MedialVoxelRimExtensionSummary &
  GetSummary() const
  {
    return m_Summary;
  }

  /** The straight line of a side, as far as it is followed. */
  double
  GetLineLength(std::size_t number) const;

  /** The most that a value at a point of a rim may be, so that it is no peak: less than the value at each point to one
   * side, and a slope of the way there. Ends of rims do not count.
   * \param values of the points, at least 0 */
  double
  FindMost(Index point, const std::vector<double> & values, double slope) const;

  /** Whether the part goes on to nearly a place; true where the surface is not known. */
  bool
  IsInside(const Vector & start, const Vector & place) const;

  /** Of the walls of a point of a rim. */
  float
  FindThickness(Index point) const;

private:
  /** Sides of a rim are of one line while they turn by less than 16 degrees. */
  static constexpr double CosineOfLine = 0.96;

  /** Calls visit(side, turns) for the sides of the line of a side, as far as it is straight, and for a share of the
   * thickness to both sides; turns: it goes the other way. */
  template <typename TVisit>
  void
  FollowLine(const std::size_t start, const double share, const TVisit & visit) const
  {
    const RimSide & own = m_Rims[start];
    const Vector    along = MedialVoxelSubtract(this->PointOf(own.b), this->PointOf(own.a));
    visit(own, false);
    for (const bool backward : { false, true })
    {
      std::size_t number = start;
      Index       point = backward ? own.a : own.b;
      for (double way = 0.0; way < share * own.thickness && m_SidesOf[point].size() == 2;)
      {
        number = m_SidesOf[point][m_SidesOf[point][0] == number ? 1 : 0];
        const RimSide & next = m_Rims[number];
        const bool      turns = (next.b == point) != backward;
        const Vector    step = MedialVoxelSubtract(this->PointOf(next.b), this->PointOf(next.a));
        if (number == start ||
            MedialVoxelCosine(MedialVoxelAddScaled({}, step, turns ? -1.0 : 1.0), along) < CosineOfLine)
        {
          break;
        }
        visit(next, turns);
        way += MedialVoxelNorm(step);
        point = next.a == point ? next.b : next.a;
      }
    }
  }

  void
  FindRims();

  /** The other triangle of each side of a triangle, where there is just one. */
  void
  AppendNeighbors(Index triangle, std::vector<Index> & found) const;

  /** Triangles of the wall of a side that begin within a distance of it. */
  std::vector<Index>
  FindNear(const RimSide & side, double distance) const;

  /** The normal and the thickness, from about as far inside as the wall is thick. */
  void
  FindWall(RimSide & side) const;

  /** Outward, as a mean along its straight line. */
  void
  FindLine(std::size_t number);

  /** To the surface from a bundle of rays, whose median the steps of voxels hardly change; 0: none is found. */
  double
  MeasureLength(const RimSide & side) const;

  /** Where the edge of the part is, as a mean along the straight line. */
  void
  FindEdge(std::size_t number);

  const MedialVoxelSheet &              m_Sheet;
  const MedialVoxelMeasureRimRays &     m_Measure;
  std::vector<MedialVoxelSheetSide>     m_Sides;
  std::vector<RimSide>                  m_Rims;
  std::vector<std::vector<std::size_t>> m_SidesOf; ///< of rims, by point
  MedialVoxelRimExtensionSummary        m_Summary;
};

} // end namespace itk

#endif
