// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrPyramid.h"

#include "ZarrChunks.h"

#include "itkByteSwapper.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <string>

namespace medialvoxel
{
namespace
{

using Label = unsigned char;

constexpr std::uint64_t LongestSide = 256;

bool
IsOfLabels(const VoxelLayout & layout)
{
  return layout.components == 1 && layout.pixelType == PixelType::UInt8;
}

/** Each voxel stands for two along each axis that is longer than one. */
VolumeGeometry
GetHalf(const VolumeGeometry & geometry)
{
  VolumeGeometry half = GetCellGeometry(geometry);
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    half.size[axis] = (geometry.size[axis] + 1) / 2;
    half.spacing[axis] *= geometry.size[axis] > 1 ? 2.0 : 1.0;
  }
  return half;
}

/** Raises labels of half the number to the labels of a row. */
void
RaiseRow(const Label * labels, std::uint64_t count, Label * half)
{
  for (std::uint64_t pair = 0; pair < count / 2; ++pair)
  {
    half[pair] = std::max(half[pair], std::max(labels[2 * pair], labels[2 * pair + 1]));
  }
  if (count % 2 != 0)
  {
    half[count / 2] = std::max(half[count / 2], labels[count - 1]);
  }
}

/** Raises the labels of a chunk to the labels of one of its 2 x 2 x 2 finer chunks, all of one shape.
 * \param size of the chunk within the volume
 * \param place of the finer chunk among them, 0 or 1 along each axis */
void
RaiseChunk(const ZarrGrid & grid, const ZarrIndex & size, const ZarrIndex & place, const Label * from, Label * to)
{
  ZarrIndex begin{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    begin[axis] = place[axis] * grid.chunk[axis];
  }
  for (std::uint64_t z = 0; z < size[2]; ++z)
  {
    for (std::uint64_t y = 0; y < size[1]; ++y)
    {
      const Label *       row = from + (z * grid.chunk[1] + y) * grid.chunk[0];
      Label * const       half = to + ((begin[2] + z) / 2 * grid.chunk[1] + (begin[1] + y) / 2) * grid.chunk[0];
      const std::uint64_t first = begin[0] % 2; // of an odd row before, the last pair goes on here
      half[begin[0] / 2] = std::max(half[begin[0] / 2], row[0]);
      RaiseRow(row + first, size[0] - first, half + (begin[0] + first) / 2);
    }
  }
}

} // namespace

std::vector<ZarrLevel>
MakeZarrLevels(const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  std::vector<ZarrLevel> levels{ { geometry, ZarrGrid::ForVolume(geometry, layout), "0" } };
  const auto             isLong = [](const VolumeGeometry & level) {
    return *std::max_element(level.size.begin(), level.size.end()) > LongestSide;
  };
  while (IsOfLabels(layout) && isLong(levels.back().geometry))
  {
    ZarrLevel level{ GetHalf(levels.back().geometry), levels.back().grid, std::to_string(levels.size()) };
    for (std::uint64_t & size : level.grid.size)
    {
      size = (size + 1) / 2;
    }
    levels.push_back(level);
  }
  return levels;
}

ZarrArray
MakeZarrArray(const ZarrGrid & grid, ZarrCompression compression)
{
  ZarrArray array;
  array.grid = grid;
  array.bigEndian = itk::ByteSwapper<int>::SystemIsBigEndian();
  array.packing = GetName(compression);
  if (const ZarrCodec * const codec = GetZarrCodec(compression))
  {
    array.codecs = { codec };
  }
  return array;
}

ZarrPyramid::ZarrPyramid(const std::filesystem::path & folder, ZarrCompression compression, ZarrChunkWriter & writer)
  : m_Folder(folder)
  , m_Compression(compression)
  , m_Writer(writer)
{}

std::uint64_t
ZarrPyramid::Write(const ZarrLevel & from, const ZarrLevel & to)
{
  ZarrChunks        chunks(m_Folder / from.folder, MakeZarrArray(from.grid, m_Compression), 0);
  auto              buffers = chunks.MakeBuffers();
  std::vector<char> half(to.grid.GetChunkSize());
  std::uint64_t     numberOfFiles = 0;
  ForEachChunk(to.grid, { { 0, 0, 0 }, to.grid.size }, [&](std::uint64_t component, const ZarrIndex & index) {
    bool isEmpty = true;
    for (std::uint64_t number = 0; number < 8; ++number)
    {
      itk::MedialVoxelCheckAbort();
      const ZarrIndex place{ { number & 1, (number >> 1) & 1, number >> 2 } };
      ZarrIndex       source{};
      bool            isInside = true;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        source[axis] = 2 * index[axis] + place[axis];
        isInside = isInside && source[axis] < from.grid.GetNumberOfChunks(axis);
      }
      const char * const chunk = isInside ? chunks.Read(component, source, buffers) : nullptr;
      if (chunk == nullptr)
      {
        continue;
      }
      if (isEmpty)
      {
        std::fill(half.begin(), half.end(), '\0');
        isEmpty = false;
      }
      RaiseChunk(from.grid,
                 from.grid.GetBox(source).size,
                 place,
                 reinterpret_cast<const Label *>(chunk),
                 reinterpret_cast<Label *>(half.data()));
    }
    if (!isEmpty && std::any_of(half.begin(), half.end(), [](char label) { return label != '\0'; }))
    {
      m_Writer.Write(m_Folder / to.folder / to.grid.GetChunkName(component, index), half.data());
      ++numberOfFiles;
    }
  });
  return numberOfFiles;
}

} // end namespace medialvoxel
