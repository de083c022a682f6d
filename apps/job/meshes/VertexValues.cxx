// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VertexValues.h"

#include <algorithm>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t BlockSize = std::uint64_t{ 1 } << 14;

} // namespace

VertexValues::VertexValues(const std::filesystem::path & folder, std::string name)
  : m_File(folder)
  , m_Name(std::move(name))
{}

void
VertexValues::Put(const std::uint64_t first, const std::vector<float> & numbers)
{
  m_File.WriteAt(first * VertexSize, numbers.data(), numbers.size() * VertexSize);
  m_Size += numbers.size();
}

void
VertexValues::Read(std::uint64_t first, std::uint64_t count, std::vector<float> & numbers) const
{
  numbers.resize(count);
  m_File.ReadAt(first * VertexSize, numbers.data(), count * VertexSize);
}

float
VertexValues::Get(const std::uint64_t vertex) const
{
  if (vertex < m_First || vertex >= m_First + m_Block.size())
  {
    m_First = vertex / BlockSize * BlockSize;
    this->Read(m_First, std::min(BlockSize, m_Size.load() - m_First), m_Block);
  }
  return m_Block[vertex - m_First];
}

} // end namespace medialvoxel
