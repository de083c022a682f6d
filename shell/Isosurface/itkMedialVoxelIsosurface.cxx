// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelIsosurface.h"

#include "itkMedialVoxelIsosurfaceTable.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itk
{
namespace
{

constexpr std::int64_t RowsOfPart = 16;
constexpr double       LeastShare = 1.0 / 256.0;

/** Planned bytes of the surface in a slice, for each of its pixels: a vertex for each 16, and twice as many faces. */
constexpr std::uint64_t BytesPerPixel =
  (sizeof(MedialVoxelIsosurfaceVertex) + 2 * sizeof(MedialVoxelIsosurfaceTriangle)) / 16;

/** Bit x of the result is bit x + 1 of the row. */
std::uint64_t
NextBits(const std::uint64_t * row, std::int64_t word)
{
  return row[word] >> 1 | row[word + 1] << 63;
}

/** Share of the way from an object voxel to one that is not. */
double
GetShare(double object, double other)
{
  const double share = object / (object - other);
  return std::isfinite(share) && object >= 0.0 && other <= 0.0 ? std::clamp(share, LeastShare, 1.0 - LeastShare) : 0.5;
}

} // namespace

MedialVoxelIsosurfaceConsumer::~MedialVoxelIsosurfaceConsumer() = default;

MedialVoxelIsosurface::MedialVoxelIsosurface(const MedialVoxelMargins &      margins,
                                             const bool                      isClosed,
                                             MedialVoxelIsosurfaceConsumer & consumer,
                                             RunTasks                        run)
  : m_Margins(margins)
  , m_IsClosed(isClosed)
  , m_Consumer(consumer)
  , m_RunTasks(std::move(run))
{
  for (std::int64_t begin = 0; begin <= margins.GetSize()[1]; begin += RowsOfPart)
  {
    m_Parts.push_back({ begin, std::min(begin + RowsOfPart, margins.GetSize()[1] + 1) });
  }
  for (Slice & slice : m_Slices)
  {
    slice.object.Reshape(this->GetBoxOfSlice());
    for (Edges & edges : slice.edges)
    {
      edges.bits.Reshape(this->GetBoxOfSlice());
      edges.bits.Rank();
    }
  }
}

MedialVoxelBox
MedialVoxelIsosurface::GetBoxOfSlice() const
{
  const MedialVoxelIndex & size = m_Margins.GetSize();
  return { { 0, 0, 0 }, { size[0] + 2, size[1] + 2, 1 } };
}

std::uint64_t
MedialVoxelIsosurface::GetBytes(const MedialVoxelIndex & size)
{
  const std::uint64_t bits = MedialVoxelBits::GetBytes({ { 0, 0, 0 }, { size[0] + 2, size[1] + 2, 1 } });
  // Ranks take half as much as the bits that they are of.
  return 2 * bits + 5 * (bits + bits / 2) + static_cast<std::uint64_t>(size[0] * size[1]) * BytesPerPixel;
}

void
MedialVoxelIsosurface::AddSlice(const MedialVoxelBits & object)
{
  this->BeginSlice();
  MedialVoxelBits & bits = m_Slices[1].object;
  for (std::int64_t y = 1; y <= m_Margins.GetSize()[1]; ++y)
  {
    MedialVoxelBits::WordType * const row = bits.GetRow(y, 0);
    for (std::int64_t word = 0; word < bits.GetWordsPerRow(); ++word)
    {
      row[word] = object.Extract(word * MedialVoxelBits::BitsPerWord - 1, y - 1, m_Z);
    }
  }
  this->EndSlice();
}

void
MedialVoxelIsosurface::Finish()
{
  this->BeginSlice();
  this->EndSlice();
}

void
MedialVoxelIsosurface::BeginSlice()
{
  std::swap(m_Slices[0], m_Slices[1]);
  m_Slices[1].object.Reshape(this->GetBoxOfSlice());
}

/** The consumer may look at values of these slices, which go. */
void
MedialVoxelIsosurface::EndSlice()
{
  constexpr unsigned int axes[] = { 0, 1, 2 };
  for (const unsigned int axis : axes)
  {
    this->GetEdges(axis).bits.Reshape(this->GetBoxOfSlice());
  }
  this->ForEachPart([&](Part & part) {
    for (const unsigned int axis : axes)
    {
      this->FindCrossings(axis, part);
    }
  });
  this->NumberVertices();
  this->ForEachPart([&](Part & part) {
    for (const unsigned int axis : axes)
    {
      m_Consumer.AddVertices(part.firstVertex[axis], part.vertices[axis]);
    }
    this->AddCells(part);
  });
  for (Part & part : m_Parts)
  {
    part.firstTriangle = m_NumberOfTriangles;
    m_NumberOfTriangles += part.triangles.size();
  }
  this->ForEachPart([&](Part & part) { m_Consumer.AddTriangles(part.firstTriangle, part.triangles); });
  ++m_Z;
}

template <typename TTask>
void
MedialVoxelIsosurface::ForEachPart(TTask && task)
{
  m_RunTasks(m_Parts.size(), [&](const std::size_t number) { task(m_Parts[number]); });
}

/** Along z first, then along x, then along y. */
void
MedialVoxelIsosurface::NumberVertices()
{
  for (const unsigned int axis : { 2u, 0u, 1u })
  {
    Edges & edges = this->GetEdges(axis);
    edges.first = m_NumberOfVertices;
    edges.bits.Rank();
    for (Part & part : m_Parts)
    {
      part.firstVertex[axis] = m_NumberOfVertices;
      m_NumberOfVertices += part.vertices[axis].size();
    }
  }
}

void
MedialVoxelIsosurface::FindCrossings(const unsigned int axis, Part & part)
{
  MedialVoxelRankedBits & bits = this->GetEdges(axis).bits;
  const MedialVoxelBits & lower = m_Slices[axis == 2 ? 0 : 1].object;
  auto &                  vertices = part.vertices[axis];
  vertices.clear();
  const std::int64_t z = m_Z + (axis == 2 ? 0 : 1);
  const auto         isWanted = [&](const MedialVoxelIndex & voxel) {
    const std::int64_t upper = (axis == 2 ? z : voxel[axis]) + 1;
    return m_IsClosed || (this->IsInside(0, voxel[0]) && this->IsInside(1, voxel[1]) && this->IsInside(2, z) &&
                          this->IsInside(axis, upper));
  };
  for (std::int64_t y = part.begin; y < part.end; ++y)
  {
    const auto * const row = lower.GetRow(y, 0);
    const auto * const upper = axis == 2 ? m_Slices[1].object.GetRow(y, 0) : lower.GetRow(axis == 1 ? y + 1 : y, 0);
    for (std::int64_t word = 0; word < lower.GetWordsPerRow(); ++word)
    {
      auto crossings = row[word] ^ (axis == 0 ? NextBits(row, word) : upper[word]);
      for (; crossings != 0; crossings &= crossings - 1)
      {
        const MedialVoxelIndex voxel{ word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(crossings), y, 0 };
        if (isWanted(voxel))
        {
          bits.Set(voxel);
          vertices.push_back(
            this->MakeVertex(axis, { voxel[0], voxel[1], z }, (row[word] >> (voxel[0] & 63) & 1u) != 0));
        }
      }
    }
  }
}

MedialVoxelIsosurfaceVertex
MedialVoxelIsosurface::MakeVertex(unsigned int axis, const MedialVoxelIndex & voxel, bool isLowerObject) const
{
  MedialVoxelIndex lower{ voxel[0] - 1, voxel[1] - 1, voxel[2] - 1 };
  MedialVoxelIndex upper = lower;
  ++upper[axis];
  const MedialVoxelIndex & object = isLowerObject ? lower : upper;
  const MedialVoxelIndex & other = isLowerObject ? upper : lower;
  double                   share = 0.5;
  if (other[axis] >= 0 && other[axis] < m_Margins.GetSize()[axis])
  {
    share = GetShare(m_Margins.Get(object[0], object[1], object[2]), m_Margins.Get(other[0], other[1], other[2]));
  }
  MedialVoxelIsosurfaceVertex vertex{ {}, object };
  for (unsigned int i = 0; i < 3; ++i)
  {
    vertex.point[i] = static_cast<double>(object[i]);
  }
  vertex.point[axis] += isLowerObject ? share : -share;
  return vertex;
}

void
MedialVoxelIsosurface::AddCells(Part & part) const
{
  part.triangles.clear();
  const MedialVoxelIndex & size = m_Margins.GetSize();
  const bool               isCapOfSlices = m_Z == 0 || m_Z == size[2];
  if (!m_IsClosed && isCapOfSlices)
  {
    return;
  }
  for (std::int64_t y = part.begin; y < part.end; ++y)
  {
    const std::array<const MedialVoxelBits::WordType *, 4> rows{ m_Slices[0].object.GetRow(y, 0),
                                                                 m_Slices[0].object.GetRow(y + 1, 0),
                                                                 m_Slices[1].object.GetRow(y, 0),
                                                                 m_Slices[1].object.GetRow(y + 1, 0) };
    for (std::int64_t word = 0; word < m_Slices[0].object.GetWordsPerRow(); ++word)
    {
      std::array<MedialVoxelBits::WordType, 8> corners{};
      MedialVoxelBits::WordType                any = 0;
      MedialVoxelBits::WordType                all = ~any;
      for (unsigned int corner = 0; corner < 8; ++corner)
      {
        const auto * const row = rows[corner >> 1];
        corners[corner] = (corner & 1u) != 0 ? NextBits(row, word) : row[word];
        any |= corners[corner];
        all &= corners[corner];
      }
      for (auto mixed = any & ~all; mixed != 0; mixed &= mixed - 1)
      {
        const int          bit = MedialVoxelLowestBit(mixed);
        const std::int64_t x = word * MedialVoxelBits::BitsPerWord + bit;
        const bool         isCap = isCapOfSlices || x == 0 || x == size[0] || y == 0 || y == size[1];
        if (!m_IsClosed && isCap)
        {
          continue;
        }
        unsigned int objectCorners = 0;
        for (unsigned int corner = 0; corner < 8; ++corner)
        {
          objectCorners |= static_cast<unsigned int>(corners[corner] >> bit & 1u) << corner;
        }
        this->AddCell({ x, y, 0 }, objectCorners, isCap, part);
      }
    }
  }
}

void
MedialVoxelIsosurface::AddCell(const MedialVoxelIndex & cell, unsigned int objectCorners, bool isCap, Part & part) const
{
  using Table = MedialVoxelIsosurfaceTable;
  const auto numberOf = [&](unsigned int edge) {
    const unsigned int     corner = Table::GetLowerCorner(edge);
    const unsigned int     axis = Table::GetAxis(edge);
    const Edges &          edges = axis == 2 ? m_Between : m_Slices[corner >> 2].edges[axis];
    const MedialVoxelIndex voxel{ cell[0] + (corner & 1u), cell[1] + (corner >> 1 & 1u), 0 };
    return edges.first + edges.bits.RankOf(voxel);
  };
  for (const Table::Triangle & triangle : Table::Get(objectCorners))
  {
    part.triangles.push_back({ { numberOf(triangle[0]), numberOf(triangle[1]), numberOf(triangle[2]) }, isCap });
  }
}

} // end namespace itk
