// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LengthHistogram.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace medialvoxel
{

LengthHistogram::LengthHistogram(const double binWidth)
  : m_BinWidth(binWidth)
{
  if (!(binWidth > 0.0) || !std::isfinite(binWidth))
  {
    throw std::invalid_argument("The width of the bins must be positive and finite.");
  }
}

void
LengthHistogram::Add(const std::size_t bin, const std::uint64_t number)
{
  if (number == 0)
  {
    return;
  }
  if (bin >= m_Numbers.size())
  {
    m_Numbers.resize(bin + 1, 0);
  }
  m_Numbers[bin] += number;
  m_Total += number;
}

void
LengthHistogram::Add(const LengthHistogram & other)
{
  for (std::size_t bin = 0; bin < other.m_Numbers.size(); ++bin)
  {
    this->Add(bin, other.m_Numbers[bin]);
  }
}

void
LengthHistogram::Clear()
{
  m_Numbers.clear();
  m_Total = 0;
}

double
LengthHistogram::GetMean() const
{
  double sum = 0.0;
  for (std::size_t bin = 0; bin < m_Numbers.size(); ++bin)
  {
    sum += static_cast<double>(m_Numbers[bin]) * static_cast<double>(bin);
  }
  return m_Total == 0 ? 0.0 : sum / static_cast<double>(m_Total) * m_BinWidth;
}

double
LengthHistogram::GetStandardDeviation() const
{
  const double mean = this->GetMean() / m_BinWidth;
  double       sum = 0.0;
  for (std::size_t bin = 0; bin < m_Numbers.size(); ++bin)
  {
    const double deviation = static_cast<double>(bin) - mean;
    sum += static_cast<double>(m_Numbers[bin]) * (deviation * deviation);
  }
  return m_Total == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(m_Total)) * m_BinWidth;
}

double
LengthHistogram::GetPercentile(const double percent) const
{
  if (!(percent >= 0.0) || percent > 100.0)
  {
    throw std::invalid_argument("A percentile needs a number from 0 to 100.");
  }
  const double  wanted = std::max(1.0, std::ceil(percent * static_cast<double>(m_Total) / 100.0));
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin < m_Numbers.size(); ++bin)
  {
    below += m_Numbers[bin];
    if (static_cast<double>(below) >= wanted)
    {
      return static_cast<double>(bin) * m_BinWidth;
    }
  }
  return 0.0;
}

} // end namespace medialvoxel
