// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelValueSides_h
#define itkMedialVoxelValueSides_h

#include "itkMedialVoxelSmoothingLevel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{

/** \class MedialVoxelValueSides
 * \brief The smallest and largest finite values of object and background, which tell the level of smoothed values.
 *
 * Sums of parts are the same in any order. Integers of 64 bits count as their nearest double.
 * \ingroup MedialVoxel
 */
class MedialVoxelValueSides
{
public:
  void
  Add(const double value, const bool isObject)
  {
    if (std::isfinite(value))
    {
      m_Sides[isObject ? 1 : 0].Include({ value, value });
    }
  }

  template <typename TPixel, typename TPredicate>
  void
  Add(const TPixel * const pixels, const std::int64_t count, const TPredicate & isObject)
  {
    using Limits = std::numeric_limits<TPixel>;
    TPixel lowest[2] = { Limits::max(), Limits::max() };
    TPixel highest[2] = { Limits::lowest(), Limits::lowest() };
    bool   any[2] = { false, false };
    for (std::int64_t i = 0; i < count; ++i)
    {
      if constexpr (std::is_floating_point<TPixel>::value)
      {
        if (!std::isfinite(pixels[i]))
        {
          continue;
        }
      }
      const int side = isObject(pixels[i]) ? 1 : 0;
      lowest[side] = std::min(lowest[side], pixels[i]);
      highest[side] = std::max(highest[side], pixels[i]);
      any[side] = true;
    }
    for (const int side : { 0, 1 })
    {
      if (any[side])
      {
        m_Sides[side].Include({ static_cast<double>(lowest[side]), static_cast<double>(highest[side]) });
      }
    }
  }

  MedialVoxelValueSides &
  operator+=(const MedialVoxelValueSides & other)
  {
    for (const int side : { 0, 1 })
    {
      m_Sides[side].Include(other.m_Sides[side]);
    }
    return *this;
  }

  /** Whether no further voxel changes the level. \param areWhole there is no value between two whole numbers */
  bool
  AreDecided(const bool areWhole) const
  {
    const Side & background = m_Sides[0];
    const Side & object = m_Sides[1];
    if (background.highest > object.lowest && background.lowest < object.highest)
    {
      return true; // the mask
    }
    const double gap = std::max(object.lowest - background.highest, background.lowest - object.highest);
    return areWhole && gap <= 1.0 && this->HaveSeveral();
  }

  /** Whether background and object have two values or more each. */
  bool
  HaveSeveral() const
  {
    return m_Sides[0].HasSeveral() && m_Sides[1].HasSeveral();
  }

  /** Whether neither has. */
  bool
  AreOfMask() const
  {
    return !m_Sides[0].HasSeveral() && !m_Sides[1].HasSeveral();
  }

  MedialVoxelSmoothingLevel
  GetLevel() const
  {
    const Side & background = m_Sides[0];
    const Side & object = m_Sides[1];
    if (!this->HaveSeveral())
    {
      return {};
    }
    if (background.highest < object.lowest)
    {
      return { 0.5 * background.highest + 0.5 * object.lowest, true };
    }
    if (background.lowest > object.highest)
    {
      return { 0.5 * background.lowest + 0.5 * object.highest, false };
    }
    return {};
  }

private:
  struct Side
  {
    double lowest{ std::numeric_limits<double>::infinity() };
    double highest{ -std::numeric_limits<double>::infinity() };

    bool
    HasSeveral() const
    {
      return lowest < highest;
    }

    void
    Include(const Side & other)
    {
      lowest = std::min(lowest, other.lowest);
      highest = std::max(highest, other.highest);
    }
  };

  Side m_Sides[2]; ///< background and object
};

} // end namespace itk

#endif
