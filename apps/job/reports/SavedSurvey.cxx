// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
// How a survey goes from one process to another: most of its numbers are zeros, which take a byte.
#include "PackedNumbers.h"
#include "Survey.h"

#include <algorithm>

namespace medialvoxel
{

template <typename TSums, typename TNumbers>
void
Survey::Exchange(TSums & sums, TNumbers & numbers)
{
  ThicknessSums::Exchange(sums.thickness, numbers);
  PlaceCell::Exchange(sums.thinnest, numbers);
  for (auto & slices : sums.slices)
  {
    numbers.ExchangeSize(slices.size());
    for (auto & slice : slices)
    {
      numbers.Exchange(slice.score);
      numbers.Exchange(slice.cells);
    }
  }
  numbers.ExchangeSize(sums.projection.size());
  for (auto & pixel : sums.projection)
  {
    numbers.Exchange(pixel.label);
    numbers.Exchange(pixel.medialCells);
    numbers.Exchange(pixel.thickest);
  }
}

std::string
Survey::Save() const
{
  NumberWriter numbers;
  Exchange(m_Total, numbers);
  // Lengths of runs of blocks; the first run has no labels.
  numbers.Add(m_Blocks.size());
  bool value = false;
  for (auto begin = m_Blocks.begin(); begin != m_Blocks.end(); value = !value)
  {
    const auto end = std::find(begin, m_Blocks.end(), !value);
    numbers.Add(static_cast<std::uint64_t>(end - begin));
    begin = end;
  }
  return numbers.Pack();
}

void
Survey::Merge(const std::string & bytes)
{
  // No more than ten bytes for a number, and as many numbers as a survey of this size can have.
  constexpr std::uint64_t mostBins = std::uint64_t{ 1 } << 22;
  std::uint64_t           mostNumbers = 3 * mostBins + 3 * m_Total.projection.size() + m_Blocks.size() + 32;
  for (const auto & slices : m_Total.slices)
  {
    mostNumbers += 2 * slices.size();
  }
  NumberReader numbers(bytes, 10 * mostNumbers);
  Sums         saved(m_Total.thickness.GetCells().GetBinWidth());
  if (m_Settings.picture)
  {
    this->Resize(saved);
  }
  Exchange(saved, numbers);
  numbers.ExchangeSize(m_Blocks.size());
  std::vector<bool> blocks;
  for (bool value = false; blocks.size() < m_Blocks.size(); value = !value)
  {
    const std::uint64_t length = numbers.Get();
    if (length > m_Blocks.size() - blocks.size() || (length == 0 && !blocks.empty()))
    {
      RefuseSaved();
    }
    blocks.insert(blocks.end(), length, value);
  }
  numbers.CheckEnd();
  this->AddToTotal(saved);
  std::transform(m_Blocks.begin(), m_Blocks.end(), blocks.begin(), m_Blocks.begin(), std::logical_or<>());
}

} // end namespace medialvoxel
