// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLengthHistogram_h
#define medialvoxelLengthHistogram_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class LengthHistogram
 * \brief Counts lengths, rounded to multiples of a bin width, and derives their statistics.
 *
 * It keeps whole numbers in fixed bins. Their sums do not depend on the order, so every division of the work gives
 * the same bits; sums of lengths would not. The price is the rounding: percentiles are multiples of the width,
 * and the mean is off by less than half of it, mostly far less. Bins are centered on the multiples, so whole voxels
 * come out exactly. */
class LengthHistogram
{
public:
  /** \param binWidth positive and finite, in the units of the lengths */
  explicit LengthHistogram(double binWidth);

  double
  GetBinWidth() const
  {
    return m_BinWidth;
  }

  /** Number of the bin of a length, which is finite and not negative. */
  std::size_t
  GetBin(double length) const
  {
    return static_cast<std::size_t>(length / m_BinWidth + 0.5);
  }

  void
  Add(std::size_t bin, std::uint64_t number = 1);

  /** Adds the numbers of a histogram of the same width. */
  void
  Add(const LengthHistogram & other);

  void
  Clear();

  std::uint64_t
  GetTotal() const
  {
    return m_Total;
  }

  /** Numbers by bin; bin k stands for k times the width; the last one is not zero. */
  const std::vector<std::uint64_t> &
  GetNumbers() const
  {
    return m_Numbers;
  }

  /** Without lengths, all of these are 0. */
  double
  GetMean() const;
  double
  GetStandardDeviation() const;

  /** The smallest length that at least \a percent of all lengths do not exceed; \a percent from 0 to 100. */
  double
  GetPercentile(double percent) const;

private:
  double                     m_BinWidth;
  std::uint64_t              m_Total{ 0 };
  std::vector<std::uint64_t> m_Numbers;
};

} // end namespace medialvoxel

#endif
