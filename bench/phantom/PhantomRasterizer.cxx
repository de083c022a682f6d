// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "PhantomRasterizer.h"

#include <atomic>
#include <cstring>
#include <thread>

namespace phantom
{
namespace
{
struct Box
{
  Size begin, end;
};

/** A value in [-1, 1) from the index alone (finalizer of SplitMix64). */
double
UniformOf(std::uint64_t seed, const Size & index)
{
  std::uint64_t h = seed;
  for (const std::int64_t i : index)
  {
    h += static_cast<std::uint64_t>(i) + 0x9e3779b97f4a7c15U;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

/** Fills boxes of one slab; skips boxes that the Lipschitz bound proves empty or full. */
class SlabFiller
{
public:
  SlabFiller(const Shape & shape, const Noise & noise, const Size & size, std::int64_t firstSlice, unsigned char * mask)
    : m_Shape(shape)
    , m_Noise(noise)
    , m_Lipschitz(shape.GetLipschitzConstant())
    , m_Size(size)
    , m_FirstSlice(firstSlice)
    , m_Mask(mask)
  {}

  std::int64_t
  Fill(const Box & box) const
  {
    Size         extent;
    double       squaredDiagonal = 0.0;
    std::int64_t longest = 0;
    for (unsigned int d = 0; d < 3; ++d)
    {
      extent[d] = box.end[d] - box.begin[d];
      longest = std::max(longest, extent[d]);
      squaredDiagonal += static_cast<double>((extent[d] - 1) * (extent[d] - 1));
    }
    if (longest == 1)
    {
      return SetVoxel(box.begin);
    }
    const Vector center{ 0.5 * static_cast<double>(box.begin[0] + box.end[0] - 1),
                         0.5 * static_cast<double>(box.begin[1] + box.end[1] - 1),
                         0.5 * static_cast<double>(box.begin[2] + box.end[2] - 1) };
    const double value = m_Shape.Evaluate(center);
    const double reach = 0.5 * m_Lipschitz * std::sqrt(squaredDiagonal) + m_Noise.amplitude;
    if (value > reach)
    {
      return 0;
    }
    if (value < -reach)
    {
      return SetRows(box, extent);
    }
    return FillParts(box, extent);
  }

private:
  std::int64_t
  FillParts(const Box & box, const Size & extent) const
  {
    Size middle;
    for (unsigned int d = 0; d < 3; ++d)
    {
      middle[d] = box.begin[d] + (extent[d] + 1) / 2;
    }
    std::int64_t count = 0;
    for (unsigned int part = 0; part < 8; ++part)
    {
      Box  child = box;
      bool empty = false;
      for (unsigned int d = 0; d < 3; ++d)
      {
        (part >> d & 1 ? child.begin : child.end)[d] = middle[d];
        empty = empty || child.begin[d] >= child.end[d];
      }
      count += empty ? 0 : Fill(child);
    }
    return count;
  }

  std::int64_t
  SetVoxel(const Size & index) const
  {
    double value =
      m_Shape.Evaluate({ static_cast<double>(index[0]), static_cast<double>(index[1]), static_cast<double>(index[2]) });
    if (m_Noise.amplitude > 0.0)
    {
      value += m_Noise.amplitude * UniformOf(m_Noise.seed, index);
    }
    *At(index) = value < 0.0;
    return value < 0.0;
  }

  std::int64_t
  SetRows(const Box & box, const Size & extent) const
  {
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z)
    {
      for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y)
      {
        std::memset(At({ box.begin[0], y, z }), 1, static_cast<std::size_t>(extent[0]));
      }
    }
    return extent[0] * extent[1] * extent[2];
  }

  unsigned char *
  At(const Size & index) const
  {
    return m_Mask + ((index[2] - m_FirstSlice) * m_Size[1] + index[1]) * m_Size[0] + index[0];
  }

  const Shape &   m_Shape;
  const Noise &   m_Noise;
  double          m_Lipschitz;
  const Size &    m_Size;
  std::int64_t    m_FirstSlice;
  unsigned char * m_Mask;
};
} // namespace

std::int64_t
RasterizeSlab(const Shape &                shape,
              const Noise &                noise,
              const Size &                 size,
              std::int64_t                 firstSlice,
              std::int64_t                 numberOfSlices,
              unsigned int                 numberOfThreads,
              std::vector<unsigned char> & mask)
{
  constexpr std::int64_t edge = 32;
  mask.assign(static_cast<std::size_t>(size[0] * size[1] * numberOfSlices), 0);
  const SlabFiller          filler(shape, noise, size, firstSlice, mask.data());
  const std::int64_t        columns = (size[0] + edge - 1) / edge;
  const std::int64_t        rows = (size[1] + edge - 1) / edge;
  std::atomic<std::int64_t> nextColumn{ 0 };
  std::atomic<std::int64_t> count{ 0 };

  const auto work = [&] {
    std::int64_t own = 0;
    for (std::int64_t c = nextColumn++; c < columns * rows; c = nextColumn++)
    {
      const std::int64_t x = c % columns * edge;
      const std::int64_t y = c / columns * edge;
      own += filler.Fill({ { x, y, firstSlice },
                           { std::min(x + edge, size[0]), std::min(y + edge, size[1]), firstSlice + numberOfSlices } });
    }
    count += own;
  };

  std::vector<std::thread> threads;
  for (unsigned int t = 1; t < numberOfThreads; ++t)
  {
    threads.emplace_back(work);
  }
  work();
  for (std::thread & thread : threads)
  {
    thread.join();
  }
  return count;
}
} // namespace phantom
