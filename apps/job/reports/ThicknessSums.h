// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelThicknessSums_h
#define medialvoxelThicknessSums_h

#include "LengthHistogram.h"

#include "itkMedialVoxelThickness.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace medialvoxel
{

/** \class ThicknessSums
 * \brief Counts of measured walls: cells and areas of the sheet by thickness. Sums of whole numbers do not depend on
 * their order. */
class ThicknessSums
{
public:
  /** Parts of the largest face of a voxel that areas are multiples of. */
  static constexpr std::uint64_t AreaUnitsPerFace = std::uint64_t{ 1 } << 20;

  explicit ThicknessSums(double binWidth)
    : m_Cells(binWidth)
    , m_Areas(binWidth)
    , m_Uncertainty(binWidth)
  {}

  /** \param areaUnit a unit of areas, in the squared units of the wall */
  void
  AddWall(const itk::MedialVoxelWall & wall, double areaUnit);

  /** \param area of a cell, in units */
  void
  AddCell(float thickness, std::uint64_t area);

  void
  Add(const ThicknessSums & other);

  void
  Clear();

  const LengthHistogram &
  GetCells() const
  {
    return m_Cells;
  }

  const LengthHistogram &
  GetAreas() const
  {
    return m_Areas;
  }

  /** The thinnest and the thickest wall of a cell, not rounded; infinite and 0 without cells. */
  float
  GetMinimum() const
  {
    return m_Minimum;
  }

  float
  GetMaximum() const
  {
    return m_Maximum;
  }

  std::uint64_t
  GetUnpairedCells() const
  {
    return m_UnpairedCells;
  }

  /** Cells that the blur does not resolve, which no histogram has. */
  std::uint64_t
  GetUnresolvedCells() const
  {
    return m_UnresolvedCells;
  }

  /** Half of the 95 % intervals of the cells of which they are known. */
  const LengthHistogram &
  GetUncertainty() const
  {
    return m_Uncertainty;
  }

  /** That of the mean weighted by area, of a sample of one of \a step cells. */
  double
  GetStandardErrorOfMean(unsigned int step) const;

  /** The members that other processes get. */
  template <typename TSums, typename TNumbers>
  static void
  Exchange(TSums & sums, TNumbers & numbers)
  {
    numbers.Exchange(sums.m_Cells);
    numbers.Exchange(sums.m_Areas);
    numbers.Exchange(sums.m_SquaredAreas);
    numbers.Exchange(sums.m_Minimum);
    numbers.Exchange(sums.m_Maximum);
    numbers.Exchange(sums.m_UnpairedCells);
    numbers.Exchange(sums.m_Uncertainty);
    numbers.Exchange(sums.m_UnresolvedCells);
  }

private:
  LengthHistogram m_Cells;
  LengthHistogram m_Areas;             ///< in units
  std::uint64_t   m_SquaredAreas{ 0 }; ///< in units of 1024 by 1024, so that 2^40 cells fit
  float           m_Minimum{ std::numeric_limits<float>::infinity() };
  float           m_Maximum{ 0.0F };
  std::uint64_t   m_UnpairedCells{ 0 };
  LengthHistogram m_Uncertainty;
  std::uint64_t   m_UnresolvedCells{ 0 };
};

} // end namespace medialvoxel

#endif
