// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFirstSites_h
#define itkMedialVoxelFirstSites_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelProgress.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** Visit for each column of \a area the first slice that has a site in it, from \a first on and before \a end, upwards
 * or downwards; columns without one are not visited.
 *
 * \param open   memory for the bits of the columns that have none yet: most sites lie behind others
 * \param visit  called with x, row and slice; the rows of the area are counted from 0 */
template <typename TVisitor>
void
MedialVoxelVisitFirstSites(const MedialVoxelBits &                  sites,
                           const MedialVoxelBox &                   area,
                           const std::int64_t                       first,
                           const std::int64_t                       end,
                           std::vector<MedialVoxelBits::WordType> & open,
                           TVisitor &&                              visit)
{
  using WordType = MedialVoxelBits::WordType;
  const std::int64_t firstWord = area.lower[0] >> 6;
  const std::int64_t words = ((area.upper[0] - 1) >> 6) - firstWord + 1;
  const std::int64_t rows = area.Extent(1);
  open.resize(static_cast<std::size_t>(rows * words));
  for (std::size_t i = 0; i < open.size(); ++i)
  {
    open[i] =
      MedialVoxelBits::RangeMask(firstWord + static_cast<std::int64_t>(i) % words, area.lower[0], area.upper[0]);
  }
  for (std::int64_t z = first; z != end; z += first < end ? 1 : -1)
  {
    MedialVoxelCheckAbort();
    WordType * openOfRow = open.data();
    for (std::int64_t row = 0; row < rows; ++row, openOfRow += words)
    {
      const WordType * const sitesOfRow = sites.GetRow(area.lower[1] + row, z) - sites.GetFirstWord() + firstWord;
      WordType               any = 0;
      for (std::int64_t word = 0; word < words; ++word)
      {
        any |= sitesOfRow[word] & openOfRow[word];
      }
      for (std::int64_t word = 0; any != 0 && word < words; ++word)
      {
        WordType found = sitesOfRow[word] & openOfRow[word];
        openOfRow[word] ^= found;
        for (; found != 0; found &= found - 1)
        {
          visit((firstWord + word) * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(found), row, z);
        }
      }
    }
  }
}

} // end namespace itk

#endif
