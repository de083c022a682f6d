// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSmoother_hxx
#define itkMedialVoxelSmoother_hxx

#include <algorithm>

namespace itk
{

template <typename TPixel, typename TRule>
void
MedialVoxelSmoother<TPixel, TRule>::Run(const TPixel * const       first,
                                        const MedialVoxelStrides & strides,
                                        const MedialVoxelBox &     box,
                                        MedialVoxelBits &          object)
{
  assert(m_Image.Contains(box));
  const View view{ first, strides, Numbers::GetInputBox(box, m_Image) };
  for (std::int64_t y = box.lower[1]; y < box.upper[1]; y += LargestY)
  {
    for (std::int64_t x = box.lower[0]; x < box.upper[0]; x += LargestX)
    {
      MedialVoxelBox block = box;
      block.lower[0] = x;
      block.lower[1] = y;
      block.upper[0] = std::min(x + LargestX, box.upper[0]);
      block.upper[1] = std::min(y + LargestY, box.upper[1]);
      this->RunBlock(view, block, object);
    }
  }
}

template <typename TPixel, typename TRule>
void
MedialVoxelSmoother<TPixel, TRule>::RunBlock(const View & view, const MedialVoxelBox & block, MedialVoxelBits & object)
{
  const std::int64_t width = block.Extent(0);
  const std::int64_t height = block.Extent(1);
  const std::int64_t begin = block.lower[2];
  for (std::int64_t z = begin - 4; z < block.upper[2] + 4; ++z)
  {
    this->Load(view, block, Numbers::Mirror(z, m_Image.upper[2]));
    const std::int64_t step = z - (begin - 4);
    SmoothSlice(m_Loaded, width + 4, height + 4, m_FirstRow, m_Once[step % NumberOfTaps]);
    if (z < begin)
    {
      continue;
    }
    // Slice step - 2 has two on each side.
    const auto once = [&](const std::int64_t i) -> const std::vector<FirstType> & {
      return m_Once[(step - 4 + i) % NumberOfTaps].values;
    };
    Slice<FirstType> & twice = m_Twice[step % NumberOfTwice];
    const auto         number = static_cast<std::size_t>((width + 4) * (height + 4));
    twice.values.resize(number);
    twice.areEqual = AreEqual(m_Once);
    if (twice.areEqual)
    {
      twice.SetAll(16 * m_Once[0].values.front());
    }
    else
    {
      const FirstType * const a = once(0).data();
      const FirstType * const b = once(1).data();
      const FirstType * const c = once(2).data();
      const FirstType * const d = once(3).data();
      const FirstType * const e = once(4).data();
      FirstType * const       out = twice.values.data();
      for (std::size_t i = 0; i < number; ++i)
      {
        out[i] = Weigh<FirstType>(a[i], b[i], c[i], d[i], e[i]);
      }
    }
    SmoothSlice(twice, width, height, m_ThirdRow, m_Third[step % NumberOfTaps]);
    if (z >= begin + 4)
    {
      this->SetObject(view, block, step, object);
    }
  }
}

template <typename TPixel, typename TRule>
void
MedialVoxelSmoother<TPixel, TRule>::Load(const View & view, const MedialVoxelBox & block, const std::int64_t z)
{
  const std::int64_t width = block.Extent(0) + 2 * Numbers::Margin;
  const std::int64_t height = block.Extent(1) + 2 * Numbers::Margin;
  const std::int64_t firstX = block.lower[0] - Numbers::Margin;
  const std::int64_t innerBegin = std::max<std::int64_t>(firstX, 0);
  const std::int64_t innerEnd = std::min(block.upper[0] + Numbers::Margin, m_Image.upper[0]);
  m_Loaded.values.resize(static_cast<std::size_t>(width * height));
  bool differ = false;
  for (std::int64_t row = 0; row < height; ++row)
  {
    const std::int64_t   y = Numbers::Mirror(block.lower[1] - Numbers::Margin + row, m_Image.upper[1]);
    const TPixel * const pixels = view.first + (z - view.box.lower[2]) * view.strides[2] +
                                  (y - view.box.lower[1]) * view.strides[1] - view.box.lower[0];
    FirstType * const values = m_Loaded.values.data() + row * width - firstX;
    m_Rule.GetValues(pixels + innerBegin, innerEnd - innerBegin, values + innerBegin);
    const auto mirror = [&](const std::int64_t begin, const std::int64_t end) {
      for (std::int64_t x = begin; x < end; ++x)
      {
        m_Rule.GetValues(pixels + Numbers::Mirror(x, m_Image.upper[0]), 1, values + x);
      }
    };
    mirror(firstX, innerBegin);
    mirror(innerEnd, firstX + width);
    if (!differ)
    {
      const FirstType one = m_Loaded.values.front();
      for (std::int64_t x = firstX; x < firstX + width; ++x)
      {
        differ |= values[x] != one;
      }
    }
  }
  m_Loaded.areEqual = !differ;
}

template <typename TPixel, typename TRule>
template <typename TIn, typename TOut>
void
MedialVoxelSmoother<TPixel, TRule>::SmoothSlice(const Slice<TIn> &  in,
                                                const std::int64_t  width,
                                                const std::int64_t  height,
                                                std::vector<TOut> & row,
                                                Slice<TOut> &       out)
{
  const std::int64_t pitch = width + 4;
  out.values.resize(static_cast<std::size_t>(width * height));
  out.areEqual = in.areEqual;
  if (in.areEqual)
  {
    out.SetAll(256 * static_cast<TOut>(in.values.front()));
    return;
  }
  row.resize(static_cast<std::size_t>(pitch));
  TOut * const sums = row.data();
  for (std::int64_t y = 0; y < height; ++y)
  {
    const TIn * const a = in.values.data() + y * pitch;
    for (std::int64_t x = 0; x < pitch; ++x)
    {
      sums[x] = Weigh<TOut>(a[x], a[x + pitch], a[x + 2 * pitch], a[x + 3 * pitch], a[x + 4 * pitch]);
    }
    TOut * const to = out.values.data() + y * width;
    for (std::int64_t x = 0; x < width; ++x)
    {
      to[x] = Weigh<TOut>(sums[x], sums[x + 1], sums[x + 2], sums[x + 3], sums[x + 4]);
    }
  }
}

template <typename TPixel, typename TRule>
void
MedialVoxelSmoother<TPixel, TRule>::SetObject(const View &           view,
                                              const MedialVoxelBox & block,
                                              const std::int64_t     step,
                                              MedialVoxelBits &      object)
{
  const Slice<FirstType> & twice = m_Twice[(step - 2) % NumberOfTwice];
  if (twice.areEqual && AreEqual(m_Third) && !m_Rule(AddUp(twice.values[0], 16 * m_Third[0].values[0])))
  {
    return;
  }
  const std::int64_t width = block.Extent(0);
  const std::int64_t z = block.lower[2] + step - 2 * Numbers::Margin;
  m_Sums.resize(static_cast<std::size_t>(width));
  SumType * const sums = m_Sums.data();
  for (std::int64_t y = block.lower[1]; y < block.upper[1]; ++y)
  {
    const std::int64_t row = y - block.lower[1];
    const auto         third = [&](const std::int64_t i) -> const ThirdType * {
      return m_Third[(step - 4 + i) % NumberOfTaps].values.data() + row * width;
    };
    const ThirdType * const a = third(0);
    const ThirdType * const b = third(1);
    const ThirdType * const c = third(2);
    const ThirdType * const d = third(3);
    const ThirdType * const e = third(4);
    const FirstType * const two = twice.values.data() + (row + 2) * (width + 4) + 2;
    for (std::int64_t x = 0; x < width; ++x)
    {
      sums[x] = AddUp(two[x], Weigh<SumType>(a[x], b[x], c[x], d[x], e[x]));
    }
    if constexpr (std::is_floating_point<TPixel>::value)
    {
      const TPixel * const pixels = view.first + (z - view.box.lower[2]) * view.strides[2] +
                                    (y - view.box.lower[1]) * view.strides[1] + block.lower[0] - view.box.lower[0];
      for (std::int64_t x = 0; x < width; ++x)
      {
        sums[x] = pixels[x] != pixels[x] ? m_Rule.GetSumOfBackground() : sums[x];
      }
    }
    MedialVoxelPackRow(sums, block.lower[0], width, m_Rule, object.GetRow(y, z) - object.GetFirstWord());
  }
}

} // end namespace itk

#endif
