// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrValues.h"

#include "ZarrChunks.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace medialvoxel
{
namespace
{

/** Bytes of a chunk that is not packed that are read at once; a row of it at least. */
constexpr std::uint64_t BlockSize = std::uint64_t{ 1 } << 20;

std::uint64_t
GetRowSize(const ZarrGrid & grid)
{
  return grid.chunk[0] * GetTraits(grid.layout.pixelType).bytes;
}

/** The axis of a box for an axis of the grid, which has the slices of an image of two dimensions as its last axis. */
unsigned int
GetBoxAxis(const ZarrGrid & grid, unsigned int axis)
{
  return grid.dimension == 3 || axis == 0 ? axis : 3 - axis;
}

/** \class ZarrValues
 * \brief The reader of MakeZarrValues(); the readers of several threads share the chunks. */
class ZarrValues : public ValueReader
{
public:
  explicit ZarrValues(std::shared_ptr<ZarrChunks> chunks)
    : m_Chunks(std::move(chunks))
    , m_Array(m_Chunks->GetArray())
    , m_Buffers(m_Chunks->MakeBuffers())
    , m_FillRow(GetRowSize(m_Array.grid))
  {
    FillChunk(m_Array, m_FillRow);
  }

  void
  Read(const itk::MedialVoxelBox & box, void * values) override
  {
    const std::uint64_t valueSize = GetTraits(m_Array.grid.layout.pixelType).bytes;
    this->ForEachSpan(box, [&](const itk::MedialVoxelBox & part) {
      const ValueView view = this->Look(part);
      itk::MedialVoxelForEachRow(part, view.strides, [&](const std::int64_t offset, const itk::MedialVoxelBox & row) {
        const auto first = static_cast<std::uint64_t>(box.OffsetOf(row.lower));
        std::memcpy(static_cast<char *>(values) + first * valueSize,
                    static_cast<const char *>(view.values) + static_cast<std::uint64_t>(offset) * valueSize,
                    static_cast<std::uint64_t>(row.Extent(0)) * valueSize);
      });
    });
  }

  void
  ForEachSpan(const itk::MedialVoxelBox & box, const SpanFunction & function) const override
  {
    const ZarrGrid & grid = m_Array.grid;
    ForEachChunk(grid, this->ToGrid(box), [&](std::uint64_t, const ZarrIndex & index) {
      const itk::MedialVoxelBox part = this->FromGrid(grid.GetBox(index)).Intersection(box);
      if (m_Array.IsPlain())
      {
        this->CutPlainSpan(part, function);
      }
      else
      {
        function(part);
      }
    });
  }

  std::int64_t
  GetRowsReadTogether() const override
  {
    return m_Array.grid.dimension == 3 ? static_cast<std::int64_t>(m_Array.grid.chunk[1]) : 1;
  }

  ValueView
  Look(const itk::MedialVoxelBox & part) override
  {
    const ZarrGrid & grid = m_Array.grid;
    const ZarrBox    wanted = this->ToGrid(part);
    ZarrIndex        index{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = wanted.begin[axis] / grid.chunk[axis];
    }
    const ZarrBox       chunk = grid.GetBox(index);
    const std::uint64_t row = wanted.begin[1] - chunk.begin[1];
    const std::uint64_t slice = wanted.begin[2] - chunk.begin[2];
    const std::uint64_t firstRow = (slice * grid.chunk[1] + row) * grid.chunk[0];
    const std::uint64_t column = wanted.begin[0] - chunk.begin[0];
    const std::uint64_t valueSize = GetTraits(grid.layout.pixelType).bytes;
    if (m_Array.IsPlain())
    {
      // From the first row to the last one, and no further: chunks end there.
      const std::uint64_t rows = (wanted.size[2] - 1) * grid.chunk[1] + wanted.size[1];
      m_Rows.resize(rows * GetRowSize(grid));
      return m_Chunks->ReadSpan(index, firstRow * valueSize, m_Rows, m_Buffers)
               ? this->MakeView(m_Rows.data() + column * valueSize)
               : this->MakeFill();
    }
    // The other rows belong to neighbors, to which some of these will be a halo.
    const bool isNeededAgain =
      wanted.begin[2] + wanted.size[2] < chunk.begin[2] + chunk.size[2] || wanted.size[1] < chunk.size[1];
    const char * const planes = m_Chunks->Read(0, index, { slice, wanted.size[2], isNeededAgain }, m_Buffers);
    return planes != nullptr ? this->MakeView(planes + (row * grid.chunk[0] + column) * valueSize) : this->MakeFill();
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Buffers.bytesRead;
  }

  std::unique_ptr<ValueReader>
  MakeAnother() const override
  {
    return std::make_unique<ZarrValues>(m_Chunks);
  }

private:
  ZarrBox
  ToGrid(const itk::MedialVoxelBox & box) const
  {
    ZarrBox inGrid;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const unsigned int from = GetBoxAxis(m_Array.grid, axis);
      inGrid.begin[axis] = static_cast<std::uint64_t>(box.lower[from]);
      inGrid.size[axis] = static_cast<std::uint64_t>(box.Extent(from));
    }
    return inGrid;
  }

  itk::MedialVoxelBox
  FromGrid(const ZarrBox & inGrid) const
  {
    itk::MedialVoxelBox box;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const unsigned int to = GetBoxAxis(m_Array.grid, axis);
      box.lower[to] = static_cast<std::int64_t>(inGrid.begin[axis]);
      box.upper[to] = static_cast<std::int64_t>(inGrid.begin[axis] + inGrid.size[axis]);
    }
    return box;
  }

  /** As many whole slices of the chunk as may be read at once, or rows of one. */
  void
  CutPlainSpan(const itk::MedialVoxelBox & part, const SpanFunction & function) const
  {
    const unsigned int y = GetBoxAxis(m_Array.grid, 1);
    const unsigned int z = GetBoxAxis(m_Array.grid, 2);
    const auto         most = [](std::uint64_t bytes) {
      return static_cast<std::int64_t>(std::max<std::uint64_t>(1, BlockSize / bytes));
    };
    const bool          isWhole = m_Array.grid.GetPlaneSize() <= BlockSize;
    const std::int64_t  slices = isWhole ? most(m_Array.grid.GetPlaneSize()) : 1;
    const std::int64_t  rows = isWhole ? part.Extent(y) : most(GetRowSize(m_Array.grid));
    itk::MedialVoxelBox some = part;
    for (some.lower[z] = part.lower[z]; some.lower[z] < part.upper[z]; some.lower[z] = some.upper[z])
    {
      some.upper[z] = std::min(some.lower[z] + slices, part.upper[z]);
      for (some.lower[y] = part.lower[y]; some.lower[y] < part.upper[y]; some.lower[y] = some.upper[y])
      {
        some.upper[y] = std::min(some.lower[y] + rows, part.upper[y]);
        function(some);
      }
    }
  }

  ValueView
  MakeView(const char * values) const
  {
    const auto rowStep = static_cast<std::int64_t>(m_Array.grid.chunk[0]);
    const auto planeStep = static_cast<std::int64_t>(m_Array.grid.chunk[0] * m_Array.grid.chunk[1]);
    return { values, { 1, m_Array.grid.dimension == 3 ? rowStep : planeStep, planeStep }, false };
  }

  ValueView
  MakeFill() const
  {
    return { m_FillRow.data(), { 1, 0, 0 }, true };
  }

  std::shared_ptr<ZarrChunks> m_Chunks;
  const ZarrArray &           m_Array;
  ZarrChunks::Buffers         m_Buffers;
  std::vector<char>           m_Rows;
  std::vector<char>           m_FillRow;
};

} // namespace

std::unique_ptr<ValueReader>
MakeZarrValues(const VolumeHeader & header, std::uint64_t bytesToKeep)
{
  return std::make_unique<ZarrValues>(std::make_shared<ZarrChunks>(
    header.dataFile.parent_path(), ReadZarrArray(header.dataFile, header.geometry.GetDimension()), bytesToKeep));
}

std::uint64_t
GetZarrThreadMemory(const ZarrArray & array)
{
  const std::uint64_t rowSize = GetRowSize(array.grid);
  const std::uint64_t shardIndexSize = array.shards ? array.shards->GetIndexSize() : 0;
  return rowSize +
         (array.IsPlain() ? std::max(BlockSize, rowSize) + shardIndexSize : ZarrChunks::GetBufferMemory(array));
}

} // end namespace medialvoxel
