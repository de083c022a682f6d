// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetDistances_h
#define itkMedialVoxelSheetDistances_h

#include "itkMedialVoxelRemeshedSheet.h"
#include "itkMedialVoxelSheetTree.h"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelDistanceHistogram
 * \brief Distances in classes of a thousandth of their value.
 * \ingroup MedialVoxel
 */
class MedialVoxelDistanceHistogram
{
public:
  /** \param distance finite, 0 or more */
  void
  Add(double distance);

  MedialVoxelRemeshingSummary::Distances
  Summarize() const;

private:
  std::vector<std::uint64_t> m_Counts;
  std::uint64_t              m_Number{ 0 };
  double                     m_Sum{ 0 };
  double                     m_Largest{ 0 };
};

/** \class MedialVoxelSheetDistances
 * \brief Distances between a sheet of elements and the fine one, of which any part may be given at a time.
 * \ingroup MedialVoxel
 */
class MedialVoxelSheetDistances
{
public:
  /** A sample by its number, and its distance. */
  using SampleDistance = std::pair<std::size_t, double>;

  /** Samples are the middles of the four parts of each triangle of an element, which stand for equal areas.
   * \param sheet stays as long as this */
  explicit MedialVoxelSheetDistances(const MedialVoxelRemeshedSheet & sheet);

  /** Of the points of a part of the fine sheet to the elements. Several threads may call it. */
  std::vector<double>
  MeasurePoints(const MedialVoxelSheet & part) const;

  /** Have the samples that no part was near enough to wait for parts that are less than \a within away. False when no
   * sample waits. */
  bool
  BeginSamples(double within);

  /** Of the samples that wait to a part of the fine sheet. Several threads may call it. */
  std::vector<SampleDistance>
  MeasureSamples(const MedialVoxelSheet & part) const;

  /** Sums depend on the order of the parts in their last digits. */
  void
  Add(const std::vector<double> & distancesOfPoints);

  void
  Add(const std::vector<SampleDistance> & samples);

  /** Adds the distances to the summary. */
  void
  Summarize(MedialVoxelRemeshingSummary & summary) const;

private:
  struct Sample
  {
    MedialVoxelVector3 point;
    double             area;
    bool               isAtLine; ///< of an element at a rim, a junction or a bend
    double             distance{ std::numeric_limits<double>::infinity() };
  };

  /** The box of points. */
  struct Bounds
  {
    MedialVoxelVector3 low;
    MedialVoxelVector3 high;
  };

  /** Samples that wait and follow each other. */
  struct Group
  {
    std::vector<std::size_t> samples;
    Bounds                   bounds;
  };

  static Bounds
  FindBounds(const std::vector<MedialVoxelVector3> & points);

  static bool
  AreWithin(const Bounds & a, const Bounds & b, double distance);

  std::vector<Sample>                   m_Samples; ///< neighbors mostly follow each other
  std::vector<Group>                    m_Groups;
  double                                m_Within{ 0 }; ///< of the samples that wait
  std::unique_ptr<MedialVoxelSheetTree> m_Elements;
  MedialVoxelDistanceHistogram          m_Points;
};

} // end namespace itk

#endif
