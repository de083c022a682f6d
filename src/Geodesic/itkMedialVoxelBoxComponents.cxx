// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelBoxComponents.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>

namespace itk
{

using WordType = MedialVoxelBits::WordType;

void
MedialVoxelBoxComponents::Label(const MedialVoxelBits & boundary, const MedialVoxelBox & box)
{
  m_Box = box;
  m_FirstRun.clear();
  m_Runs.clear();
  MedialVoxelAbortChecker checker;
  const WordType          columns = MedialVoxelBits::RangeMask(0, 0, box.Extent(0));
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    checker.Count(static_cast<std::uint32_t>(box.Extent(1)));
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const std::size_t row = m_FirstRun.size();
      m_FirstRun.push_back(static_cast<std::uint32_t>(m_Runs.size()));
      WordType rest = boundary.Extract(box.lower[0], y, z) & columns;
      while (rest != 0)
      {
        // Adding the lowest bit carries through the lowest run.
        const WordType run = rest & ~(rest + (rest & (~rest + 1)));
        m_Runs.push_back({ run, static_cast<std::uint32_t>(m_Runs.size()) });
        rest &= ~run;
      }
      if (m_Runs.size() == m_FirstRun.back())
      {
        continue;
      }
      const auto rowsPerSlice = static_cast<std::size_t>(box.Extent(1));
      const bool hasPrevious = y > box.lower[1];
      if (hasPrevious)
      {
        this->Join(row, row - 1);
      }
      if (z > box.lower[2])
      {
        const std::size_t below = row - rowsPerSlice;
        this->Join(row, below);
        if (hasPrevious)
        {
          this->Join(row, below - 1);
        }
        if (y + 1 < box.upper[1])
        {
          this->Join(row, below + 1);
        }
      }
    }
  }
  m_FirstRun.push_back(static_cast<std::uint32_t>(m_Runs.size()));
  // Parents come before their runs.
  for (Run & run : m_Runs)
  {
    run.parent = m_Runs[run.parent].parent;
  }
}

/** Join the runs of the last row with touching runs of an earlier one. */
void
MedialVoxelBoxComponents::Join(const std::size_t row, const std::size_t otherRow)
{
  const std::uint32_t end = m_FirstRun[otherRow + 1];
  for (std::uint32_t run = m_FirstRun[row]; run < m_Runs.size(); ++run)
  {
    const WordType bits = m_Runs[run].bits;
    const WordType touched = bits | (bits << 1) | (bits >> 1);
    for (std::uint32_t other = m_FirstRun[otherRow]; other < end; ++other)
    {
      if ((m_Runs[other].bits & touched) != 0 && m_Runs[run].parent != m_Runs[other].parent)
      {
        const std::uint32_t root = this->RootOf(run);
        const std::uint32_t otherRoot = this->RootOf(other);
        const std::uint32_t first = std::min(root, otherRoot);
        m_Runs[root].parent = m_Runs[otherRoot].parent = first;
        // Short paths to the root.
        m_Runs[run].parent = m_Runs[other].parent = first;
      }
    }
  }
}

std::uint32_t
MedialVoxelBoxComponents::RootOf(std::uint32_t run) const
{
  while (m_Runs[run].parent != run)
  {
    run = m_Runs[run].parent;
  }
  return run;
}

} // end namespace itk
