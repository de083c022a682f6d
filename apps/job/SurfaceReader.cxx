// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceReader.h"

namespace medialvoxel
{
namespace
{

double
GetSquaredDistance(const std::array<float, 3> & a, const std::array<float, 3> & b)
{
  double sum = 0;
  for (size_t axis = 0; axis < a.size(); ++axis)
  {
    const double difference = static_cast<double>(a[axis]) - static_cast<double>(b[axis]);
    sum += difference * difference;
  }
  return sum;
}

} // namespace

SurfaceReader::SurfaceReader(const SurfaceSpool & surface, const std::function<void(double)> & progress)
  : m_Surface(surface)
  , m_Progress(progress)
  , m_Slots(NumberOfSlots)
{}

void
SurfaceReader::SetNumberOfPasses(std::uint64_t vertexPasses, std::uint64_t facePasses)
{
  m_Expected = vertexPasses * m_Surface.GetNumberOfVertices() + facePasses * m_Surface.GetNumberOfFaces();
}

void
SurfaceReader::AddDone(std::uint64_t count)
{
  m_Done += count;
  if (m_Progress)
  {
    // A writer that finds out late how often it walks must not make the progress fall.
    m_Fraction = std::max(m_Fraction, std::min(1.0, static_cast<double>(m_Done) / static_cast<double>(m_Expected)));
    m_Progress(m_Fraction);
  }
}

const SurfaceReader::Vertex &
SurfaceReader::GetVertex(std::uint64_t number)
{
  const std::uint64_t block = number / BlockSize;
  Slot &              slot = m_Slots[block % NumberOfSlots];
  if (slot.block != block)
  {
    const std::uint64_t first = block * BlockSize;
    m_Surface.ReadVertices(first, std::min(BlockSize, m_Surface.GetNumberOfVertices() - first), slot.vertices);
    slot.block = block;
  }
  return slot.vertices[number % BlockSize];
}

const SurfaceTriangles &
GetTriangles(SurfaceReader & reader, const SurfaceFace & face)
{
  static const SurfaceTriangles triangle{ { 0, 1, 2 } };
  static const SurfaceTriangles alongFirst{ { 0, 1, 2 }, { 0, 2, 3 } };
  static const SurfaceTriangles alongSecond{ { 0, 1, 3 }, { 1, 2, 3 } };
  if (face.numberOfVertices == 3)
  {
    return triangle;
  }
  std::array<std::array<float, 3>, 4> corners;
  for (size_t corner = 0; corner < corners.size(); ++corner)
  {
    corners[corner] = reader.GetVertex(face.vertices[corner]).position;
  }
  const bool isSecondShorter = GetSquaredDistance(corners[1], corners[3]) < GetSquaredDistance(corners[0], corners[2]);
  return isSecondShorter ? alongSecond : alongFirst;
}

} // end namespace medialvoxel
