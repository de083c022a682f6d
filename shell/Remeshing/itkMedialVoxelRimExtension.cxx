// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRimExtension.h"

#include "itkMedialVoxelRimLines.h"
#include "itkMedialVoxelSheetTree.h"
#include "itkMedialVoxelSymmetricEquations.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>

namespace itk
{
namespace
{

using Index = MedialVoxelSheet::Index;
using Vector = MedialVoxelVector3;
using Triangle = std::array<Index, 3>;
using RimSide = MedialVoxelRimSide;

/** Sides of a rim make no corner at a point while they turn by less than 45 degrees. */
constexpr double CosineOfPoint = 0.7;

/** Of what is added across a rim: how far a corner may be away. */
constexpr double MostOfCorner = 2.5;

/** The way of a point is clear while the sheet is not nearer than this share of it. */
constexpr double LeastClearance = 0.7;

/** Of the thickness: what is left free between two strips that go towards each other, and how near other walls are in
 * the way. */
constexpr double GapOfThickness = 0.2;
constexpr double NearOfThickness = 0.1;

/** Of what is added, where it would touch something. */
constexpr double ShareLeft = 0.6;

/** Of the thickness: how long lines are that make corners, how much of a corner may be cut off. */
constexpr double LongOfThickness = 1.0;
constexpr double CornerOfThickness = 1.0;

/** Of the way along a rim: how much more may be added there. */
constexpr double MostOfSlope = 0.6;

constexpr double SamePlace = 1e-6;
constexpr double SmallOfShift = 1e-3;

constexpr unsigned int Steps = 24;
constexpr unsigned int MostRounds = 8;

/** Of the normals of a strip and its wall. */
constexpr double LeastCosine = 0.3;

Vector
Scaled(const Vector & vector, const double factor)
{
  return MedialVoxelAddScaled({}, vector, factor);
}

/** \class RimExtender
 * \brief The rims of a sheet, and where they are carried on to. */
class RimExtender
{
public:
  RimExtender(MedialVoxelSheet &                sheet,
              const MedialVoxelMeasureRimRays & measure,
              const MedialVoxelRimLimits &      limits,
              const MedialVoxelRunTasks &       runTasks)
    : m_Sheet(sheet)
    , m_Limits(limits)
    , m_RunTasks(runTasks)
    , m_Lines(sheet, measure, runTasks)
    , m_Tree(sheet.points, sheet.triangles, std::vector<Index>(sheet.triangles.size()))
    , m_Shifts(sheet.points.size())
    , m_Across(sheet.points.size())
    , m_IsCut(sheet.points.size())
    , m_Twins(sheet.points.size())
    , m_Summary(m_Lines.GetSummary())
  {}

  MedialVoxelRimExtensionSummary
  Run(std::vector<Index> & origins)
  {
    std::iota(m_Twins.begin(), m_Twins.end(), Index{ 0 });
    this->FindShifts();
    this->FindCorners();
    this->KeepWithin();
    this->KeepClear();
    this->KeepNormals();
    this->KeepApart();
    this->KeepEven();
    this->AddStrips(origins);
    return m_Summary;
  }

private:
  /** Of each point, onto the edges of its sides. */
  void
  FindShifts()
  {
    for (Index point = 0; point < m_Lines.GetNumberOfPoints(); ++point)
    {
      std::vector<std::pair<Vector, double>> edges;
      Vector                                 sum{};
      double                                 lengths = 0.0;
      for (const std::size_t number : m_Lines.GetSidesOf(point))
      {
        const RimSide & side = m_Lines.GetSides()[number];
        const double    length = side.edge - MedialVoxelDot(m_Lines.PointOf(point), side.outward);
        edges.emplace_back(side.outward, std::max(0.0, length));
        sum = MedialVoxelAddScaled(sum, side.outward, 1.0);
        lengths += edges.back().second;
      }
      if (edges.empty())
      {
        continue;
      }
      const double across = lengths / static_cast<double>(edges.size());
      const bool   isSmooth = std::all_of(edges.begin(), edges.end(), [&](const auto & one) {
        return std::all_of(edges.begin(), edges.end(), [&](const auto & other) {
          return MedialVoxelDot(one.first, other.first) > CosineOfPoint;
        });
      });
      const double norm2 = MedialVoxelDot(sum, sum);
      const Vector shift = isSmooth ? Scaled(sum, across * static_cast<double>(edges.size()) / norm2)
                                    : MedialVoxelFindShift(edges, SmallOfShift);
      const double norm = MedialVoxelNorm(shift);
      m_Shifts[point] = norm > MostOfCorner * across ? Scaled(shift, MostOfCorner * across / norm) : shift;
      m_Across[point] = across;
      ++m_Summary.points;
    }
  }

  /** Brings short sides between two long lines to the point where their edges meet: corners of the part, which the
   * sheet has cut off. */
  void
  FindCorners()
  {
    for (std::size_t number = 0; number < m_Lines.GetSides().size(); ++number)
    {
      if (m_Lines.GetLineLength(number) < LongOfThickness * m_Lines.GetSides()[number].thickness)
      {
        continue;
      }
      this->FindCorner(number, m_Lines.GetSides()[number].a);
      this->FindCorner(number, m_Lines.GetSides()[number].b);
    }
  }

  /** From the end of a long line on. */
  void
  FindCorner(const std::size_t first, const Index start)
  {
    const double       most = CornerOfThickness * m_Lines.GetSides()[first].thickness;
    std::vector<Index> points(1, start);
    std::size_t        number = first;
    for (double way = 0.0; m_Lines.GetSidesOf(points.back()).size() == 2;)
    {
      number = m_Lines.GetSidesOf(points.back())[m_Lines.GetSidesOf(points.back())[0] == number ? 1 : 0];
      const RimSide & side = m_Lines.GetSides()[number];
      if (m_Lines.GetLineLength(number) >= LongOfThickness * side.thickness)
      {
        break;
      }
      way += MedialVoxelNorm(MedialVoxelSubtract(m_Lines.PointOf(side.b), m_Lines.PointOf(side.a)));
      points.push_back(side.a == points.back() ? side.b : side.a);
      if (way > most || points.back() == start)
      {
        return;
      }
    }
    // Each corner is found from both lines.
    if (points.size() > 1 && points.front() < points.back() && m_Lines.GetSidesOf(points.back()).size() == 2 &&
        number != first)
    {
      this->MeetAtCorner(points, m_Lines.GetSides()[first], m_Lines.GetSides()[number]);
    }
  }

  void
  MeetAtCorner(const std::vector<Index> & points, const RimSide & first, const RimSide & last)
  {
    const Vector between = MedialVoxelSubtract(m_Lines.PointOf(points.back()), m_Lines.PointOf(points.front()));
    const Vector start = m_Lines.PointOf(points.front());
    const double cosine = MedialVoxelDot(first.outward, last.outward);
    const bool   isOuter = MedialVoxelDot(between, first.outward) < 0.0 && MedialVoxelDot(between, last.outward) > 0.0;
    if (!isOuter || cosine > CosineOfPoint || cosine < -CosineOfPoint)
    {
      return;
    }
    const Vector toCorner = MedialVoxelFindShift({ { first.outward, first.edge - MedialVoxelDot(start, first.outward) },
                                                   { last.outward, last.edge - MedialVoxelDot(start, last.outward) } },
                                                 SmallOfShift);
    const Vector corner = MedialVoxelAddScaled(start, toCorner, 1.0);
    if (!m_Lines.IsInside(MedialVoxelMiddle(start, m_Lines.PointOf(points.back())), corner))
    {
      return;
    }
    for (const Index point : points)
    {
      m_Shifts[point] = MedialVoxelSubtract(corner, m_Lines.PointOf(point));
      m_Twins[point] = *std::min_element(points.begin(), points.end());
    }
  }

  /** Shortens what is added where it would leave the volume. */
  void
  KeepWithin()
  {
    for (Index point = 0; point < m_Lines.GetNumberOfPoints(); ++point)
    {
      double share = 1.0;
      for (const MedialVoxelRimLimit & face : m_Limits)
      {
        const double left = face.limit - MedialVoxelDot(face.normal, m_Lines.PointOf(point));
        const double way = MedialVoxelDot(face.normal, m_Shifts[point]);
        share = way > left ? std::min(share, std::max(0.0, left) / way) : share;
      }
      if (share < 1.0)
      {
        this->Shorten(point, share);
      }
    }
  }

  /** Shortens what is added where the way on comes near to the sheet again, so that strips stop before they meet. */
  void
  KeepClear()
  {
    this->ForEachPoint([&](const Index point) {
      double share = 1.0;
      for (const Vector & shift : this->ListWays(point))
      {
        const double across = std::min(m_Across[point], MedialVoxelNorm(shift));
        const double gap = GapOfThickness * m_Lines.FindThickness(point);
        const double clear = this->FindClearWay(point, shift, across, 2.0 * across + gap);
        share = across > 0.0 ? std::min({ share, clear / across, (clear - gap) / (2.0 * across) }) : share;
      }
      if (share < 1.0 - SamePlace)
      {
        this->Shorten(point, std::max(0.0, share));
      }
    });
  }

  /** Calls function(point), which may change what belongs to it alone. */
  template <typename TFunction>
  void
  ForEachPoint(const TFunction & function) const
  {
    MedialVoxelForEach(m_RunTasks, m_Lines.GetNumberOfPoints(), function);
  }

  /** The way of a point, and at an outer corner those across each of its rims, where strips go on, too. */
  std::vector<Vector>
  ListWays(const Index point) const
  {
    std::vector<Vector> ways(1, m_Shifts[point]);
    for (const std::size_t number : m_Lines.GetSidesOf(point))
    {
      const Vector & outward = m_Lines.GetSides()[number].outward;
      if (std::any_of(m_Lines.GetSidesOf(point).begin(), m_Lines.GetSidesOf(point).end(), [&](const std::size_t other) {
            const Index end =
              m_Lines.GetSides()[other].a == point ? m_Lines.GetSides()[other].b : m_Lines.GetSides()[other].a;
            return MedialVoxelCosine(MedialVoxelSubtract(m_Lines.PointOf(end), m_Lines.PointOf(point)), outward) <
                   -CosineOfPoint;
          }))
      {
        ways.push_back(Scaled(outward, MedialVoxelDot(m_Shifts[point], outward)));
      }
    }
    return ways;
  }

  /** How far a way goes, across the rim, before it comes near to the sheet again. */
  double
  FindClearWay(const Index point, const Vector & shift, const double across, const double most) const
  {
    const double near = NearOfThickness * m_Lines.FindThickness(point);
    for (unsigned int step = 1; across > 0.0 && step <= Steps; ++step)
    {
      const double way = most * step / Steps;
      const Vector place = MedialVoxelAddScaled(m_Lines.PointOf(point), shift, way / across);
      const double least = LeastClearance * way;
      if (m_Tree.HasWithin(place, 0, way > across ? std::min(least, near) : least))
      {
        return most * (step - 1) / Steps;
      }
    }
    return most;
  }

  void
  Shorten(const Index point, const double share)
  {
    m_Shifts[point] = Scaled(m_Shifts[point], share);
    m_Across[point] *= share;
    m_IsCut[point] = 1;
  }

  /** Shortens what is added where a strip would turn over. */
  void
  KeepNormals()
  {
    bool found = true;
    for (unsigned int round = 0; round < MostRounds && found; ++round)
    {
      found = false;
      for (const RimSide & side : m_Lines.GetSides())
      {
        if (!this->IsFlat(side))
        {
          found = true;
          this->Shorten(side.a, round + 1 < MostRounds ? 0.5 : 0.0);
          this->Shorten(side.b, round + 1 < MostRounds ? 0.5 : 0.0);
        }
      }
    }
  }

  bool
  IsFlat(const RimSide & side) const
  {
    const Vector & a = m_Lines.PointOf(side.a);
    const Vector & b = m_Lines.PointOf(side.b);
    const Vector   farA = MedialVoxelAddScaled(a, m_Shifts[side.a], 1.0);
    const Vector   farB = MedialVoxelAddScaled(b, m_Shifts[side.b], 1.0);
    const Vector   facing = MedialVoxelCross(MedialVoxelSubtract(b, a), side.outward);
    const auto     agrees = [&](const Vector & p, const Vector & q, const Vector & r) {
      const Vector normal = MedialVoxelTriangleNormal({ { p, q, r } });
      const double size = MedialVoxelNorm(normal) * MedialVoxelNorm(facing);
      return size <= SamePlace * MedialVoxelDot(facing, facing) || MedialVoxelDot(normal, facing) >= LeastCosine * size;
    };
    return agrees(a, b, farB) && agrees(a, farB, farA) && agrees(a, b, farA) && agrees(b, farB, farA);
  }

  /** Shortens what is added where the new rim would lie at other strips, or at another wall. */
  void
  KeepApart()
  {
    std::atomic<bool> found{ true };
    for (unsigned int round = 0; round < MostRounds && found; ++round)
    {
      const MedialVoxelSheet     strips = this->MakeStrips();
      const MedialVoxelSheetTree tree(strips.points, strips.triangles, std::vector<Index>(strips.triangles.size()));
      found = false;
      this->ForEachPoint([&](const Index point) {
        if (m_Across[point] > 0.0)
        {
          const double gap = GapOfThickness * m_Lines.FindThickness(point);
          const Vector ahead =
            MedialVoxelAddScaled(m_Lines.PointOf(point), m_Shifts[point], 1.0 + gap / m_Across[point]);
          const double near = LeastClearance * gap;
          if (m_Tree.HasWithin(ahead, 0, near) || tree.HasWithin(ahead, 0, near))
          {
            found = true;
            this->Shorten(point, round + 1 < MostRounds ? ShareLeft : 0.0);
          }
        }
      });
    }
  }

  /** Shortens what is added where it is less to both sides along the rim, so that rims have no spikes. */
  void
  KeepEven()
  {
    const std::vector<double> across = m_Across;
    for (Index point = 0; point < m_Lines.GetNumberOfPoints(); ++point)
    {
      const double most = m_Lines.FindMost(point, across, MostOfSlope);
      if (most < across[point])
      {
        this->Shorten(point, most / across[point]);
      }
    }
  }

  /** The strips as they are now; all points come twice. */
  MedialVoxelSheet
  MakeStrips() const
  {
    MedialVoxelSheet strips;
    const auto       number = static_cast<Index>(m_Sheet.points.size());
    strips.points = m_Sheet.points;
    for (Index point = 0; point < number; ++point)
    {
      strips.points.push_back(MedialVoxelAddScaled(m_Lines.PointOf(point), m_Shifts[point], 1.0));
    }
    for (const RimSide & side : m_Lines.GetSides())
    {
      strips.triangles.push_back({ { side.a, side.b, side.b + number } });
      strips.triangles.push_back({ { side.a, side.b + number, side.a + number } });
    }
    return strips;
  }

  void
  AddStrips(std::vector<Index> & origins)
  {
    const auto         before = static_cast<Index>(m_Sheet.points.size());
    std::vector<Index> far(before);
    origins.resize(before);
    for (Index point = 0; point < before; ++point)
    {
      far[point] = origins[point] = point;
      if (m_Lines.GetSidesOf(point).empty())
      {
        continue;
      }
      m_Sheet.thickness[point] = m_Lines.FindThickness(point);
      m_Summary.cutBack += m_IsCut[point] != 0 ? 1 : 0;
      m_Summary.length += m_Across[point] / static_cast<double>(m_Summary.points);
      m_Summary.longest = std::max(m_Summary.longest, m_Across[point]);
      const Vector place = MedialVoxelAddScaled(m_Lines.PointOf(point), m_Shifts[point], 1.0);
      const Index  twin = far[m_Twins[point]];
      if (m_Twins[point] < point &&
          MedialVoxelNorm(MedialVoxelSubtract(m_Lines.PointOf(twin), place)) < SamePlace * m_Across[point])
      {
        far[point] = twin;
      }
      else if (MedialVoxelNorm(m_Shifts[point]) > 0.0)
      {
        far[point] = static_cast<Index>(m_Sheet.points.size());
        m_Sheet.points.push_back(place);
        m_Sheet.thickness.push_back(m_Sheet.thickness[point]);
        origins.push_back(point);
      }
    }
    for (const RimSide & side : m_Lines.GetSides())
    {
      this->AddStrip(side, far[side.a], far[side.b]);
    }
  }

  void
  AddStrip(const RimSide & side, const Index farA, const Index farB)
  {
    const std::size_t first = m_Sheet.triangles.size();
    if (farA != side.a && farB != side.b && farA != farB)
    {
      m_Sheet.AddQuad({ { side.a, side.b, farB, farA } });
    }
    else if (farA != side.a || farB != side.b)
    {
      m_Sheet.triangles.push_back({ { side.a, side.b, farA != side.a ? farA : farB } });
    }
    for (std::size_t number = first; number < m_Sheet.triangles.size(); ++number)
    {
      m_Summary.area += MedialVoxelNorm(MedialVoxelTriangleNormal(m_Lines.CornersOf(m_Sheet.triangles[number]))) / 2.0;
    }
  }

  MedialVoxelSheet &             m_Sheet;
  const MedialVoxelRimLimits &   m_Limits;
  const MedialVoxelRunTasks &    m_RunTasks;
  MedialVoxelRimLines            m_Lines;
  const MedialVoxelSheetTree     m_Tree;   ///< of the sheet without strips
  std::vector<Vector>            m_Shifts; ///< of the points of rims
  std::vector<double>            m_Across; ///< the same across the rims
  std::vector<char>              m_IsCut;  ///< bytes, as tasks write them
  std::vector<Index>             m_Twins;  ///< of points that go to one corner: one of them; else themselves
  MedialVoxelRimExtensionSummary m_Summary;
};

} // namespace

MedialVoxelVector3
MedialVoxelMoveWithin(const MedialVoxelVector3 & point, const MedialVoxelRimLimits & limits)
{
  MedialVoxelVector3 moved = point;
  for (const MedialVoxelRimLimit & face : limits)
  {
    const double beyond = MedialVoxelDot(face.normal, moved) - face.limit;
    if (beyond > 0.0)
    {
      moved = MedialVoxelAddScaled(moved, face.normal, -beyond / MedialVoxelDot(face.normal, face.normal));
    }
  }
  return moved;
}

MedialVoxelRimExtensionSummary
MedialVoxelExtendRims(MedialVoxelSheet &                sheet,
                      const MedialVoxelMeasureRimRays & measure,
                      const MedialVoxelRimLimits &      limits,
                      std::vector<std::uint32_t> &      origins,
                      const MedialVoxelRunTasks &       runTasks)
{
  assert(sheet.thickness.size() == sheet.points.size());
  return RimExtender(sheet, measure, limits, runTasks).Run(origins);
}

} // end namespace itk
