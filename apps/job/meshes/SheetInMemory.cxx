// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SheetInMemory.h"

#include "Errors.h"
#include "Text.h"

#include <limits>

namespace medialvoxel
{
namespace
{

/** Of a point, its triangles and what finding the walls takes for a while. */
constexpr std::uint64_t BytesPerPoint = 300;

} // namespace

SheetInMemory::SheetInMemory(const std::uint64_t memory)
  : m_Most(std::min<std::uint64_t>(memory / BytesPerPoint, std::numeric_limits<std::uint32_t>::max() / 8))
{}

void
SheetInMemory::AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices)
{
  if (sheet.points.size() + vertices.size() > m_Most)
  {
    FailForMemory("the sheet has so many cells that the walls need more than the ",
                  FormatBytes(m_Most * BytesPerPoint),
                  " of memory that are left for them; allow more with --memory, or leave out walls and their tables");
  }
  for (const itk::MedialVoxelSurfaceVertex & vertex : vertices)
  {
    sheet.points.push_back(vertex.point);
    sheet.thickness.push_back(static_cast<float>(vertex.thickness));
    cells.push_back(vertex.cell);
  }
}

void
SheetInMemory::AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads)
{
  for (const itk::MedialVoxelSurfaceQuad & quad : quads)
  {
    std::array<std::uint32_t, 4> corners{};
    std::transform(quad.vertices.begin(), quad.vertices.end(), corners.begin(), [](const std::uint64_t vertex) {
      return static_cast<std::uint32_t>(vertex);
    });
    sheet.AddQuad(corners);
  }
}

} // end namespace medialvoxel
