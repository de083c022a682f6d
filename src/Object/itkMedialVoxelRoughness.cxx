// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelRoughness.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace itk
{
namespace
{

using WordType = MedialVoxelBits::WordType;

/** One word of a row with its neighbors along x. */
struct Triple
{
  WordType left; ///< each bit is that of the voxel before
  WordType own;
  WordType right; ///< that of the voxel after
};

Triple
GetTriple(const WordType * const word)
{
  constexpr unsigned int last = MedialVoxelBits::BitsPerWord - 1;
  return { (word[0] << 1) | (word[-1] >> last), word[0], (word[0] >> 1) | (word[1] << last) };
}

/** Where at least \a number - 1 of the first \a number words have a bit. */
WordType
FindAllButOne(const WordType (&words)[6], const std::size_t number)
{
  WordType all = ~WordType{ 0 };
  WordType allButOne = ~WordType{ 0 };
  for (std::size_t i = 0; i < number; ++i)
  {
    allButOne = all | (allButOne & words[i]);
    all &= words[i];
  }
  return allButOne;
}

/** 1 along axes with more than one voxel. */
MedialVoxelIndex
GetMargin(const MedialVoxelBox & image)
{
  MedialVoxelIndex margin{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    margin[axis] = image.Extent(axis) > 1 ? 1 : 0;
  }
  return margin;
}

/** \class WordSurvey
 * \brief Looks at 64 voxels of a row at a time. */
class WordSurvey
{
public:
  WordSurvey(const MedialVoxelBits & object, const MedialVoxelIndex & margin)
    : m_Object(object)
    , m_Margin(margin)
  {}

  /** Voxels with one of the other kind among all neighbors. */
  WordType
  FindBorder(const std::int64_t word, const std::int64_t y, const std::int64_t z) const
  {
    WordType any = 0;
    WordType all = ~WordType{ 0 };
    for (std::int64_t dz = -m_Margin[2]; dz <= m_Margin[2]; ++dz)
    {
      for (std::int64_t dy = -m_Margin[1]; dy <= m_Margin[1]; ++dy)
      {
        const Triple row = GetTriple(this->GetWord(word, y + dy, z + dz));
        any |= m_Margin[0] == 0 ? row.own : row.left | row.own | row.right;
        all &= m_Margin[0] == 0 ? row.own : row.left & row.own & row.right;
      }
    }
    return any & ~all;
  }

  /** Voxels most of whose neighbors along the axes are of the other kind. */
  WordType
  FindRough(const std::int64_t word, const std::int64_t y, const std::int64_t z) const
  {
    const Triple row = GetTriple(this->GetWord(word, y, z));
    WordType     others[6];
    std::size_t  number = 0;
    const auto   add = [&](const WordType before, const WordType after) {
      others[number++] = before ^ row.own;
      others[number++] = after ^ row.own;
    };
    if (m_Margin[0] != 0)
    {
      add(row.left, row.right);
    }
    if (m_Margin[1] != 0)
    {
      add(*this->GetWord(word, y - 1, z), *this->GetWord(word, y + 1, z));
    }
    if (m_Margin[2] != 0)
    {
      add(*this->GetWord(word, y, z - 1), *this->GetWord(word, y, z + 1));
    }
    return FindAllButOne(others, number);
  }

private:
  const WordType *
  GetWord(const std::int64_t word, const std::int64_t y, const std::int64_t z) const
  {
    return m_Object.GetRow(y, z) - m_Object.GetFirstWord() + word;
  }

  const MedialVoxelBits & m_Object;
  MedialVoxelIndex        m_Margin;
};

std::uint64_t
CountBits(const WordType word)
{
  return static_cast<std::uint64_t>(MedialVoxelPopulationCount(word));
}

} // namespace

MedialVoxelRoughness
MedialVoxelMeasureRoughness(const MedialVoxelBits & object, const MedialVoxelBox & box, const MedialVoxelBox & image)
{
  const MedialVoxelIndex margin = GetMargin(image);
  assert(object.GetBox().Contains(box.Expanded(margin).Intersection(image)));
  MedialVoxelBox inner = box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    inner.lower[axis] = std::max(box.lower[axis], image.lower[axis] + margin[axis]);
    inner.upper[axis] = std::min(box.upper[axis], image.upper[axis] - margin[axis]);
  }
  MedialVoxelRoughness roughness;
  const WordSurvey     survey(object, margin);
  for (std::int64_t z = inner.lower[2]; z < inner.upper[2]; ++z)
  {
    for (std::int64_t y = inner.lower[1]; y < inner.upper[1]; ++y)
    {
      for (std::int64_t word = inner.lower[0] >> 6; word <= (inner.upper[0] - 1) >> 6; ++word)
      {
        const WordType border =
          survey.FindBorder(word, y, z) & MedialVoxelBits::RangeMask(word, inner.lower[0], inner.upper[0]);
        if (border != 0)
        {
          roughness.borderVoxels += CountBits(border);
          roughness.roughVoxels += CountBits(border & survey.FindRough(word, y, z));
        }
      }
    }
  }
  return roughness;
}

} // end namespace itk
