// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
// How a survey goes from one process to another: most of its numbers are zeros, which take a byte.
#include "PackedNumbers.h"
#include "Survey.h"

#include <algorithm>

namespace medialvoxel
{

std::string
Survey::Save() const
{
  NumberWriter numbers;
  m_Total.thickness.Save(numbers);
  for (const auto & slices : m_Total.slices)
  {
    numbers.Add(slices.size());
    for (const SliceSums & slice : slices)
    {
      numbers.AddSigned(slice.score);
      numbers.Add(slice.cells);
    }
  }
  numbers.Add(m_Total.projection.size());
  for (const ProjectedPixel & pixel : m_Total.projection)
  {
    numbers.Add(pixel.label);
    numbers.Add(pixel.medialCells);
    numbers.Add(pixel.thickest);
  }
  // Blocks as lengths of runs, first of those without labels.
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
  std::uint64_t           mostNumbers = 3 * mostBins + 3 * m_Total.projection.size() + m_Blocks.size() + 10;
  for (const auto & slices : m_Total.slices)
  {
    mostNumbers += 2 * slices.size();
  }
  NumberReader numbers(bytes, 10 * mostNumbers);
  const auto   requireSize = [&numbers](std::size_t size) {
    if (numbers.Get() != size)
    {
      RefusePart();
    }
  };
  Sums part(m_Total.thickness.GetCells().GetBinWidth());
  this->Resize(part);
  part.thickness.Read(numbers);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    requireSize(m_Total.slices[axis].size());
    part.slices[axis].resize(m_Total.slices[axis].size());
    for (SliceSums & slice : part.slices[axis])
    {
      slice.score = numbers.GetSigned();
      slice.cells = numbers.Get();
    }
  }
  requireSize(m_Total.projection.size());
  for (ProjectedPixel & pixel : part.projection)
  {
    pixel.label = static_cast<std::uint8_t>(numbers.Get());
    pixel.medialCells = static_cast<std::uint32_t>(numbers.Get());
    pixel.thickest = static_cast<std::uint32_t>(numbers.Get());
  }
  requireSize(m_Blocks.size());
  std::vector<bool> blocks;
  for (bool value = false; blocks.size() < m_Blocks.size(); value = !value)
  {
    const std::uint64_t length = numbers.Get();
    if (length > m_Blocks.size() - blocks.size() || (length == 0 && !blocks.empty()))
    {
      RefusePart();
    }
    blocks.insert(blocks.end(), length, value);
  }
  numbers.CheckEnd();
  this->AddToTotal(part);
  std::transform(m_Blocks.begin(), m_Blocks.end(), blocks.begin(), m_Blocks.begin(), std::logical_or<>());
}

} // end namespace medialvoxel
