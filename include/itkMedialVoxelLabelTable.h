// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLabelTable_h
#define itkMedialVoxelLabelTable_h

#include "MedialVoxelExport.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace itk
{

/** Number of an object of a label map: 1 for the smallest value, and so on; 0: none.
 * \ingroup MedialVoxel */
using MedialVoxelObjectNumber = std::uint16_t;

/** Objects of a label map at most.
 * \ingroup MedialVoxel */
constexpr std::size_t MedialVoxelMostObjects = std::numeric_limits<MedialVoxelObjectNumber>::max();

/** \brief The value of a voxel as a label; nothing for numbers that are not whole or do not fit.
 * \ingroup MedialVoxel
 */
template <typename TValue>
std::optional<std::int64_t>
MedialVoxelToLabel(const TValue value)
{
  if constexpr (std::is_floating_point<TValue>::value)
  {
    constexpr double end = 9223372036854775808.0; // 2^63
    const auto       number = static_cast<double>(value);
    if (!(number >= -end && number < end) || static_cast<double>(static_cast<std::int64_t>(number)) != number)
    {
      return std::nullopt;
    }
    return static_cast<std::int64_t>(number);
  }
  else if constexpr (std::is_unsigned<TValue>::value && sizeof(TValue) == sizeof(std::uint64_t))
  {
    constexpr TValue largest = std::numeric_limits<std::int64_t>::max();
    return value <= largest ? std::optional<std::int64_t>(static_cast<std::int64_t>(value)) : std::nullopt;
  }
  else
  {
    return static_cast<std::int64_t>(value);
  }
}

/** \class MedialVoxelLabelTable
 * \brief The values of the objects, and their numbers.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelLabelTable
{
public:
  MedialVoxelLabelTable() = default;

  /** \param values ascending, each once, without 0, at most MedialVoxelMostObjects */
  explicit MedialVoxelLabelTable(std::vector<std::int64_t> values);

  std::size_t
  GetNumberOfObjects() const
  {
    return m_Values.size();
  }

  /** \param object from 1 on */
  std::int64_t
  GetValue(MedialVoxelObjectNumber object) const
  {
    return m_Values[object - std::size_t{ 1 }];
  }

  const std::vector<std::int64_t> &
  GetValues() const
  {
    return m_Values;
  }

  MedialVoxelObjectNumber
  GetNumber(std::int64_t value) const
  {
    if (m_Near.empty())
    {
      const auto found = std::lower_bound(m_Values.begin(), m_Values.end(), value);
      const bool isKnown = found != m_Values.end() && *found == value;
      return isKnown ? static_cast<MedialVoxelObjectNumber>(found - m_Values.begin() + 1)
                     : MedialVoxelObjectNumber{ 0 };
    }
    const bool isNear = value >= m_Values.front() && value <= m_Values.back();
    return isNear ? m_Near[static_cast<std::size_t>(value - m_Values.front())] : MedialVoxelObjectNumber{ 0 };
  }

  /** Turns values into numbers; fast where neighbors have the same value. */
  template <typename TValue>
  void
  Translate(const TValue * values, std::size_t count, MedialVoxelObjectNumber * numbers) const
  {
    TValue                  last{};
    MedialVoxelObjectNumber number = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!(values[i] == last))
      {
        last = values[i];
        const std::optional<std::int64_t> label = MedialVoxelToLabel(last);
        number = label ? this->GetNumber(*label) : MedialVoxelObjectNumber{ 0 };
      }
      numbers[i] = number;
    }
  }

private:
  std::vector<std::int64_t>            m_Values;
  std::vector<MedialVoxelObjectNumber> m_Near; ///< by value, less the smallest one, where the values lie close together
};

} // end namespace itk

#endif
