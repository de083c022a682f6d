// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValueHistogram_h
#define medialvoxelValueHistogram_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace medialvoxel
{

/** \class ExactSum
 * \brief Of whole or finite real numbers: the same for any order of them. */
template <typename TValue>
class ExactSum
{
public:
  /** \param times that the value is there */
  void
  Add(TValue value, std::uint64_t times)
  {
    const bool    isNegative = value < TValue{ 0 };
    std::uint64_t magnitude = 0;
    std::size_t   exponent = 0;
    if constexpr (IsWhole)
    {
      magnitude = isNegative ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    }
    else
    {
      Bits bits;
      std::memcpy(&bits, &value, sizeof(bits));
      exponent = static_cast<std::size_t>(bits >> MantissaBits) & (Exponents - 1);
      magnitude = (bits & ((Bits{ 1 } << MantissaBits) - 1)) | (Bits{ exponent > 0 } << MantissaBits);
    }
    const auto factor = isNegative ? -static_cast<std::int64_t>(times) : static_cast<std::int64_t>(times);
    for (std::size_t part = 0; part < Parts; ++part)
    {
      const std::uint64_t ofPart = (magnitude >> (part * PartBits)) & ((std::uint64_t{ 1 } << PartBits) - 1);
      m_Sums[part][exponent] += factor * static_cast<std::int64_t>(ofPart);
    }
  }

  /** The sum over a number of values. */
  double
  GetMean(std::uint64_t count) const
  {
    // Relative to the largest numbers: the sum may be beyond the range of numbers where the mean is not.
    std::size_t top = Exponents - 1;
    while (top > 0 && std::all_of(m_Sums.begin(), m_Sums.end(), [top](const auto & sums) { return sums[top] == 0; }))
    {
      --top;
    }
    double     sum = 0.0;
    double     rest = 0.0; // that the sum lost by rounding (Neumaier)
    const auto add = [&](std::int64_t term, int power) {
      const double number = std::ldexp(static_cast<double>(term), power);
      const double next = sum + number;
      rest += std::abs(sum) >= std::abs(number) ? (sum - next) + number : (number - next) + sum;
      sum = next;
    };
    for (std::size_t exponent = 0; exponent <= top; ++exponent)
    {
      for (std::size_t part = 0; part < Parts; ++part)
      {
        constexpr std::int64_t half = std::int64_t{ 1 } << 32; // halves of 64 bits are numbers without rounding
        const int              power = GetPower(exponent) - GetPower(top) + static_cast<int>(part * PartBits);
        add(m_Sums[part][exponent] / half, power + 32);
        add(m_Sums[part][exponent] % half, power);
      }
    }
    const auto   number = static_cast<double>(count);
    const double quotient = sum / number;
    return std::ldexp(quotient + (std::fma(-quotient, number, sum) + rest) / number, GetPower(top));
  }

private:
  static constexpr bool IsWhole = std::is_integral<TValue>::value;
  using Bits = std::conditional_t<sizeof(TValue) == 4, std::uint32_t, std::uint64_t>;
  static constexpr unsigned int MantissaBits =
    IsWhole ? 8 * sizeof(TValue) - 1 : std::numeric_limits<TValue>::digits - 1;
  static constexpr std::size_t Exponents = std::size_t{ 1 } << (8 * sizeof(TValue) - 1 - MantissaBits);

  /** Of the last bit of a number. Exponent 0 has no leading bit, and is as small as exponent 1. */
  static int
  GetPower(std::size_t exponent)
  {
    constexpr int least = std::numeric_limits<TValue>::min_exponent - std::numeric_limits<TValue>::digits;
    return IsWhole ? 0 : least + std::max(static_cast<int>(exponent), 1) - 1;
  }

  /** Sums of so few bits hold 2 to the power of 36 values and more. */
  static constexpr unsigned int PartBits = 27;
  static constexpr std::size_t  Parts = MantissaBits / PartBits + 1;

  std::array<std::array<std::int64_t, Exponents>, Parts> m_Sums{};
};

/** \class ValueRange
 * \brief Least, largest and mean of the finite ones of many values, in any order. */
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
      if constexpr (!IsWhole)
      {
        if (!std::isfinite(value))
        {
          m_Excluded += times;
          continue;
        }
      }
      m_Sum.Add(value, times);
      m_Count += times;
      m_Minimum = std::min(m_Minimum, value);
      m_Maximum = std::max(m_Maximum, value);
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
    return m_Sum.GetMean(m_Count);
  }

private:
  static constexpr bool IsWhole = std::is_integral<TValue>::value;

  std::uint64_t m_Count{ 0 };
  std::uint64_t m_Excluded{ 0 };
  TValue        m_Minimum{ std::numeric_limits<TValue>::max() };
  TValue        m_Maximum{ std::numeric_limits<TValue>::lowest() };

  ExactSum<TValue> m_Sum;
};

/** \class ValueBins
 * \brief Equal bins from the least to the largest value. The width of bins of whole numbers is a whole number. */
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
      m_Bins = range / m_Width + 1;
    }
    else
    {
      m_Bins = maximum > minimum ? mostBins : 1;
    }
    // Behind them real numbers that are not finite have one.
    m_Counts.resize(IsWhole ? m_Bins : m_Bins + 1);
    m_Others.resize((Lanes - 1) * m_Counts.size());
  }

  /** \param times that each of them is there */
  void
  Add(const std::vector<TValue> & values, std::uint64_t times = 1)
  {
    if constexpr (IsWhole)
    {
      this->Count(values.data(), values.size(), times, [this](TValue value) { return this->GetBin(value); });
    }
    else
    {
      // Bins are found for many values at once, several in one instruction.
      std::array<std::int32_t, 512> bins;
      for (std::size_t begin = 0; begin < values.size(); begin += bins.size())
      {
        const std::size_t number = std::min(bins.size(), values.size() - begin);
        this->FindBins(values.data() + begin, number, bins.data());
        this->Count(bins.data(), number, times, [](std::int32_t bin) { return static_cast<std::size_t>(bin); });
      }
    }
  }

  /** Call when all values are added. */
  void
  Finish()
  {
    const std::size_t bins = m_Counts.size();
    for (std::size_t i = 0; i < m_Others.size(); ++i)
    {
      m_Counts[i % bins] += m_Others[i];
    }
    m_Others.clear();
    m_Counts.resize(m_Bins);
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
    return isNegative ? (m_Maximum < TValue{ 0 } ? m_Bins : this->GetBin(TValue{ 0 })) : 0;
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
      const double share = static_cast<double>(bin) / static_cast<double>(m_Bins);
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

  /** \param getBin of one of the items */
  template <typename TItem, typename TGetBin>
  void
  Count(const TItem * items, std::size_t number, std::uint64_t times, TGetBin && getBin)
  {
    // Equal values follow each other: one counter would wait for its last sum, so that several take turns.
    const std::size_t bins = m_Counts.size();
    std::size_t       i = 0;
    for (; i + Lanes <= number; i += Lanes)
    {
      m_Counts[getBin(items[i])] += times;
      for (std::size_t lane = 1; lane < Lanes; ++lane)
      {
        m_Others[(lane - 1) * bins + getBin(items[i + lane])] += times;
      }
    }
    for (; i < number; ++i)
    {
      m_Counts[getBin(items[i])] += times;
    }
  }

  /** The last bin, of real numbers that are not finite. */
  void
  FindBins(const TValue * values, std::size_t number, std::int32_t * bins) const
  {
    // Halves, as the range of all numbers is not one.
    const auto   count = static_cast<double>(m_Bins);
    const double half = 0.5 * static_cast<double>(m_Minimum);
    const double difference = 0.5 * static_cast<double>(m_Maximum) - half;
    const double range = difference > 0.0 ? difference : 1.0;
    for (std::size_t i = 0; i < number; ++i)
    {
      const double place = (0.5 * static_cast<double>(values[i]) - half) / range * count;
      const double bin = place < count - 1.0 ? place : count - 1.0;
      const bool   isFinite = std::abs(values[i]) <= std::numeric_limits<TValue>::max();
      bins[i] = static_cast<std::int32_t>(isFinite ? bin : count);
    }
  }

  /** Distance of a whole number from the least one, which its own type need not hold. */
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
      std::int32_t bin = 0;
      this->FindBins(&value, 1, &bin);
      return static_cast<std::size_t>(bin);
    }
  }

  TValue                     m_Minimum;
  TValue                     m_Maximum;
  std::uint64_t              m_Width{ 1 };
  std::size_t                m_Bins{ 0 };
  std::vector<std::uint64_t> m_Counts;
  std::vector<std::uint64_t> m_Others; ///< counts of the other lanes
};

} // end namespace medialvoxel

#endif
