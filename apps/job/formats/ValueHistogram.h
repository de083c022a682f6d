// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValueHistogram_h
#define medialvoxelValueHistogram_h

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace medialvoxel
{

/** \class ValueRange
 * \brief Least, largest and mean of the finite ones of many values, which come in their order. */
template <typename TValue>
class ValueRange
{
public:
  /** \param times that each of them is there */
  void
  Add(const std::vector<TValue> & values, std::uint64_t times = 1)
  {
    for (const TValue value : values)
    {
      if constexpr (!std::is_integral<TValue>::value)
      {
        if (!std::isfinite(value))
        {
          m_Excluded += times;
          continue;
        }
      }
      m_Count += times;
      m_Minimum = std::min(m_Minimum, value);
      m_Maximum = std::max(m_Maximum, value);
      m_Sum += static_cast<long double>(value) * static_cast<long double>(times);
    }
  }

  std::uint64_t
  GetCount() const
  {
    return m_Count;
  }
  std::uint64_t
  GetExcluded() const
  {
    return m_Excluded;
  }
  TValue
  GetMinimum() const
  {
    return m_Minimum;
  }
  TValue
  GetMaximum() const
  {
    return m_Maximum;
  }
  double
  GetMean() const
  {
    return static_cast<double>(m_Sum / static_cast<long double>(m_Count));
  }

private:
  std::uint64_t m_Count{ 0 };
  std::uint64_t m_Excluded{ 0 };
  TValue        m_Minimum{ std::numeric_limits<TValue>::max() };
  TValue        m_Maximum{ std::numeric_limits<TValue>::lowest() };
  long double   m_Sum{ 0.0L };
};

/** \class ValueBins
 * \brief Equal bins from the least to the largest value. Those of whole numbers have a whole number as their width. */
template <typename TValue>
class ValueBins
{
public:
  static constexpr bool IsWhole = std::is_integral<TValue>::value;

  ValueBins(TValue minimum, TValue maximum, std::uint64_t mostBins)
    : m_Minimum(minimum)
    , m_Maximum(maximum)
  {
    if constexpr (IsWhole)
    {
      const std::uint64_t range = this->GetOffset(maximum);
      m_Width = range / mostBins + 1;
      m_Counts.resize(range / m_Width + 1);
    }
    else
    {
      m_Counts.resize(maximum > minimum ? mostBins : 1);
    }
    m_Others.resize((Lanes - 1) * m_Counts.size());
  }

  /** \param times that each of them is there */
  void
  Add(const std::vector<TValue> & values, std::uint64_t times = 1)
  {
    // Equal values follow each other: one counter would wait for its last sum, so that several take turns.
    const std::size_t bins = m_Counts.size();
    std::size_t       i = 0;
    for (; i + Lanes <= values.size(); i += Lanes)
    {
      this->Count(m_Counts.data(), values[i], times);
      for (std::size_t lane = 1; lane < Lanes; ++lane)
      {
        this->Count(m_Others.data() + (lane - 1) * bins, values[i + lane], times);
      }
    }
    for (; i < values.size(); ++i)
    {
      this->Count(m_Counts.data(), values[i], times);
    }
  }

  /** To be called when all values are added. */
  void
  Finish()
  {
    const std::size_t bins = m_Counts.size();
    for (std::size_t i = 0; i < m_Others.size(); ++i)
    {
      m_Counts[i % bins] += m_Others[i];
    }
    m_Others.clear();
  }

  const std::vector<std::uint64_t> &
  GetCounts() const
  {
    return m_Counts;
  }

  /** The first bin of values that are not negative. */
  std::size_t
  GetBinOfZero() const
  {
    const bool isNegative = m_Minimum < TValue{ 0 };
    return isNegative ? (m_Maximum < TValue{ 0 } ? m_Counts.size() : this->GetBin(TValue{ 0 })) : 0;
  }

  /** Where a bin begins. */
  double
  GetBegin(std::size_t bin) const
  {
    if constexpr (IsWhole)
    {
      const std::uint64_t offset = bin * m_Width;
      // The sum is taken as a whole number where the type has it.
      return offset <= this->GetOffset(m_Maximum)
               ? static_cast<double>(static_cast<TValue>(static_cast<std::uint64_t>(m_Minimum) + offset))
               : static_cast<double>(m_Maximum) + 1.0;
    }
    else
    {
      const double share = static_cast<double>(bin) / static_cast<double>(m_Counts.size());
      return static_cast<double>(m_Minimum) * (1.0 - share) + static_cast<double>(m_Maximum) * share;
    }
  }

  /** 0 for bins of one value. */
  double
  GetWidth() const
  {
    if constexpr (IsWhole)
    {
      return m_Width == 1 ? 0.0 : static_cast<double>(m_Width);
    }
    else
    {
      return this->GetBegin(1) - this->GetBegin(0);
    }
  }

private:
  static constexpr std::size_t Lanes = sizeof(TValue) == 1 ? 4 : 2;

  void
  Count(std::uint64_t * counts, TValue value, std::uint64_t times) const
  {
    if constexpr (!IsWhole)
    {
      if (!std::isfinite(value))
      {
        return;
      }
    }
    counts[this->GetBin(value)] += times;
  }

  /** Of a whole number from the least one, which its own type need not hold. */
  std::uint64_t
  GetOffset(TValue value) const
  {
    return static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(m_Minimum);
  }

  std::size_t
  GetBin(TValue value) const
  {
    if constexpr (IsWhole)
    {
      const std::uint64_t offset = this->GetOffset(value);
      if (sizeof(TValue) <= 2 || m_Width == 1)
      {
        return static_cast<std::size_t>(offset);
      }
      // Processors divide numbers of 32 bits much faster.
      constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
      return offset <= most && m_Width <= most
               ? static_cast<std::uint32_t>(offset) / static_cast<std::uint32_t>(m_Width)
               : static_cast<std::size_t>(offset / m_Width);
    }
    else
    {
      // Halves, as the range of all numbers is not one.
      const double half = 0.5 * static_cast<double>(m_Minimum);
      const double range = 0.5 * static_cast<double>(m_Maximum) - half;
      const double share = range > 0.0 ? (0.5 * static_cast<double>(value) - half) / range : 0.0;
      const auto   bin = static_cast<std::size_t>(share * static_cast<double>(m_Counts.size()));
      return std::min(bin, m_Counts.size() - 1);
    }
  }

  TValue                     m_Minimum;
  TValue                     m_Maximum;
  std::uint64_t              m_Width{ 1 };
  std::vector<std::uint64_t> m_Counts;
  std::vector<std::uint64_t> m_Others; ///< counts of the other lanes
};

} // end namespace medialvoxel

#endif
