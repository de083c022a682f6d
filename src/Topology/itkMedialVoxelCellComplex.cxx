// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelCellComplex.h"

#include <algorithm>
#include <utility>

namespace itk
{

namespace
{

using WordType = MedialVoxelBits::WordType;

/** The bits of the points at x + 1. */
WordType
Next(const WordType * const row, const std::int64_t word)
{
  return (row[word] >> 1) | (row[word + 1] << (MedialVoxelBits::BitsPerWord - 1));
}

/** The bits of the points at x - 1. */
WordType
Previous(const WordType * const row, const std::int64_t word)
{
  return (row[word] << 1) | (row[word - 1] >> (MedialVoxelBits::BitsPerWord - 1));
}

} // namespace

MedialVoxelCellComplex::MedialVoxelCellComplex(const MedialVoxelGrid & grid)
  : m_Image(grid.GetVoxelBox())
  , m_NumberOfWords((m_Image.upper[0] + MedialVoxelBits::BitsPerWord - 1) / MedialVoxelBits::BitsPerWord)
{
  for (Rows * const rows : { &m_Voxels,
                             &m_Around,
                             &m_Cells,
                             &m_Before,
                             &m_EdgesX,
                             &m_EdgesY,
                             &m_EdgesZ,
                             &m_SquaresX,
                             &m_SquaresY,
                             &m_SquaresZ,
                             &m_SquaresBefore,
                             &m_Cubes })
  {
    rows->Reshape(m_Image.upper[1], m_NumberOfWords);
  }
}

void
MedialVoxelCellComplex::Rows::Reshape(const std::int64_t numberOfRows, const std::int64_t numberOfWords)
{
  m_Pitch = numberOfWords + 2;
  m_Words.assign(static_cast<std::size_t>((numberOfRows + 2) * m_Pitch), 0);
}

void
MedialVoxelCellComplex::AddSlice(const MedialVoxelBits & object,
                                 const MedialVoxelBits & next,
                                 const MedialVoxelBits & cells)
{
  std::swap(m_Cells, m_Before);
  std::swap(m_SquaresZ, m_SquaresBefore);
  const std::int64_t slice = cells.GetBox().lower[2];
  for (std::int64_t y = 0; y < m_Image.upper[1]; ++y)
  {
    std::copy_n(cells.GetRow(y, slice), m_NumberOfWords, m_Cells.At(y));
    std::copy_n(object.GetRow(y, slice), m_NumberOfWords, m_Voxels.At(y));
    for (std::int64_t word = 0; word < m_NumberOfWords; ++word)
    {
      m_Around.At(y)[word] = m_Voxels.At(y)[word] | (next.HasRow(y, slice + 1) ? next.GetRow(y, slice + 1)[word] : 0);
    }
  }
  this->AddLayer();
  this->AddPlane();
  this->JoinCells();
  this->JoinOthers();
}

/** The faces between the cells of the slice and those of the one before, around its voxels. */
void
MedialVoxelCellComplex::AddLayer()
{
  Rows & both = m_EdgesZ; // cells in both slices, until they are edges
  for (std::int64_t y = 0; y < m_Image.upper[1]; ++y)
  {
    for (std::int64_t word = 0; word < m_NumberOfWords; ++word)
    {
      both.At(y)[word] = m_Cells.At(y)[word] & m_Before.At(y)[word];
    }
  }
  for (std::int64_t y = 0; y < m_Image.upper[1]; ++y)
  {
    WordType * const       row = both.At(y);
    const WordType * const rowAfter = both.At(y + 1);
    const WordType * const voxels = m_Voxels.At(y);
    const WordType * const voxelsAfter = m_Voxels.At(y + 1);
    for (std::int64_t word = 0; word < m_NumberOfWords; ++word)
    {
      const WordType after = Next(voxelsAfter, word);
      const WordType columns = row[word] & rowAfter[word];
      const WordType pairs = row[word] & Next(row, word);
      m_SquaresY.At(y)[word] = pairs & (Next(voxels, word) | after);
      m_SquaresX.At(y)[word] = columns & (voxelsAfter[word] | after);
      m_Cubes.At(y)[word] = pairs & rowAfter[word] & Next(rowAfter, word) & after;
      this->Count(m_SquaresY.At(y)[word], 1);
      this->Count(m_SquaresX.At(y)[word], 1);
      this->Count(m_Cubes.At(y)[word], -1);
    }
    for (std::int64_t word = 0; word < m_NumberOfWords; ++word)
    {
      row[word] &= voxels[word] | voxelsAfter[word] | Next(voxels, word) | Next(voxelsAfter, word);
      this->Count(row[word], -1);
    }
  }
}

/** The faces between cells of the slice, between its voxels and those of the one after it. */
void
MedialVoxelCellComplex::AddPlane()
{
  for (std::int64_t y = 0; y < m_Image.upper[1]; ++y)
  {
    const WordType * const row = m_Cells.At(y);
    const WordType * const rowAfter = m_Cells.At(y + 1);
    for (std::int64_t word = 0; word < m_NumberOfWords; ++word)
    {
      const WordType after = Next(m_Around.At(y + 1), word);
      const WordType pairs = row[word] & Next(row, word);
      m_EdgesX.At(y)[word] = pairs & (Next(m_Around.At(y), word) | after);
      m_EdgesY.At(y)[word] = row[word] & rowAfter[word] & (m_Around.At(y + 1)[word] | after);
      m_SquaresZ.At(y)[word] = pairs & rowAfter[word] & Next(rowAfter, word) & after;
      this->Count(row[word], 1);
      this->Count(m_EdgesX.At(y)[word], -1);
      this->Count(m_EdgesY.At(y)[word], -1);
      this->Count(m_SquaresZ.At(y)[word], 1);
    }
  }
}

void
MedialVoxelCellComplex::JoinCells()
{
  m_Parts.BeginSlice();
  for (std::int64_t y = 0; y < m_Image.upper[1]; ++y)
  {
    m_Parts.AddRow({ m_Cells.At(y), m_EdgesX.At(y), m_EdgesY.At(y - 1), m_EdgesZ.At(y) }, m_NumberOfWords);
  }
}

/** The voxels of the slice whose cubes are not in the complex, through squares that are not in it. The lowest cell of a
 * voxel is at its index minus 1. */
void
MedialVoxelCellComplex::JoinOthers()
{
  Words points(static_cast<std::size_t>(m_NumberOfWords + 1));
  Words toNext(points.size());
  Words toRow(points.size());
  Words toSlice(points.size());
  m_Others.BeginSlice();
  for (std::int64_t y = 0; y < m_Image.upper[1]; ++y)
  {
    const auto findPoints = [&](const std::int64_t word) {
      return ~Previous(m_Cubes.At(y - 1), word) & MedialVoxelBits::RangeMask(word, 0, m_Image.upper[0]);
    };
    for (std::int64_t word = 0; word < m_NumberOfWords; ++word)
    {
      points[static_cast<std::size_t>(word)] = findPoints(word);
    }
    for (std::int64_t word = 0; word < m_NumberOfWords; ++word)
    {
      const auto i = static_cast<std::size_t>(word);
      toNext[i] = points[i] & Next(points.data(), word) & ~m_SquaresX.At(y - 1)[word];
      toRow[i] = ~Previous(m_SquaresY.At(y - 1), word);
      toSlice[i] = ~Previous(m_SquaresBefore.At(y - 1), word);
    }
    m_Others.AddRow({ points.data(), toNext.data(), toRow.data(), toSlice.data() }, m_NumberOfWords);
  }
}

MedialVoxelBettiNumbers
MedialVoxelCellComplex::GetBettiNumbers() const
{
  MedialVoxelBettiNumbers numbers;
  numbers.parts = m_Parts.GetNumberOfComponents();
  numbers.cavities = m_Others.GetNumberOfComponents() - 1;
  numbers.tunnels = numbers.parts + numbers.cavities - m_EulerNumber;
  return numbers;
}

} // end namespace itk
