// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetDecimation_h
#define itkMedialVoxelSheetDecimation_h

#include "itkMedialVoxelTriangleComplex.h"

#include <functional>
#include <queue>

namespace itk
{

/** \class MedialVoxelSheetDecimation
 * \brief Takes points out of a sheet until its sides have their sizes: cheapest first, by quadric errors.
 *
 * Each collapse puts a vertex on a neighbor, so that all that stay are points of the fine sheet. Vertices of rims and
 * junctions go along their lines only, which stay within a tolerance. The root mean square distance of a vertex that
 * stays to the planes of what went is at most the same.
 * \ingroup MedialVoxel
 */
class MedialVoxelSheetDecimation
{
public:
  using Complex = MedialVoxelTriangleComplex;
  using Index = Complex::Index;

  /** Memory for each triangle, beside that of the complex: half a vertex. */
  static constexpr std::uint64_t BytesPerTriangle = 120;

  /** \param complex with the sizes that sides are to have
   * \param noise   the least tolerance; it is a share of the size where that is more
   * \param progress called often with the share that is done; may throw to stop */
  MedialVoxelSheetDecimation(Complex & complex, double noise, std::function<void(double)> progress);

  void
  Run();

private:
  using Point = Complex::Point;

  /** The sum of weighted squared distances to planes, which is a polynomial of the place. */
  class Quadric
  {
  public:
    /** \pre the normal has the length 1 */
    void
    AddPlane(const Point & point, const Point & normal, double weight);

    void
    Add(const Quadric & other);

    double
    GetSum(const Point & place) const;

    double
    GetWeight() const
    {
      return m_Weight;
    }

  private:
    void
    AddForm(const std::array<double, 6> & form, const Point & point, double weight);

    std::array<double, 6> m_Form{}; ///< xx, xy, xz, yy, yz, zz
    Point                 m_Linear{};
    double                m_Constant{ 0 };
    double                m_Weight{ 0 };
  };

  /** A vertex with the cost of its cheapest collapse when it was found. */
  struct Entry
  {
    double cost;
    Index  vertex;

    bool
    operator<(const Entry & other) const
    {
      return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
  };

  struct Candidate
  {
    double cost;
    Index  vertex;
  };
  using Candidates = MedialVoxelShortList<Candidate, 16>;

  void
  AddQuadrics();
  Candidates
  ListCandidates(Index vertex, const Complex::Neighbors & neighbors) const;
  double
  GetLineError(Index vertex, Index to, Index other) const;
  double
  GetCost(Index from, Index to, double lineError) const;
  bool
  TryCollapse(Index from, Index to, const Complex::Neighbors & neighbors);
  bool
  KeepsShapes(Index from, Index to) const;
  double
  GetSize(Index a, Index b) const;
  double
  GetLength(Index a, Index b) const;
  void
  Queue(Index vertex);

  Complex &                   m_Complex;
  double                      m_Noise;
  std::function<void(double)> m_Progress;
  std::vector<Quadric>        m_Planes; ///< of each vertex
  std::vector<double>         m_LineErrors;
  std::priority_queue<Entry>  m_Queue;
  std::vector<bool>           m_IsQueued;
};

} // end namespace itk

#endif
