// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelThicknessSummary_h
#define medialvoxelThicknessSummary_h

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** What a histogram tells in short. */
struct ThicknessStatistics
{
  static constexpr std::array<unsigned int, 7> Percents{ 1, 5, 25, 50, 75, 95, 99 };

  double                              mean{ 0.0 };
  double                              standardDeviation{ 0.0 };
  std::array<double, Percents.size()> percentiles{};

  double
  GetMedian() const
  {
    return percentiles[3];
  }
};

/** Area for each thickness. Bin k has the lengths that are nearest to k times the width. There are at most 64 bins;
 * they leave out less than one of two hundred parts of the area, which is above. */
struct AreaBins
{
  double              width{ 0.0 };
  std::vector<double> areas;
  double              above{ 0.0 };
};

/** Thickness of the walls at the medial cells that are at no rim, in the units of the job's lengths. Cells count as
 * much as the area of the sheet in them. Without cells all is 0. */
struct ThicknessSummary : ThicknessStatistics
{
  std::uint64_t cells{ 0 };           ///< measured ones
  std::uint64_t rimCells{ 0 };        ///< measured ones that are at rims, which nothing else here counts
  std::uint64_t unresolvedCells{ 0 }; ///< of walls that the blur has joined, which nothing else counts either
  unsigned int  step{ 1 };            ///< one of how many medial cells counts; chosen by their place
  double        resolution{ 0.0 };    ///< of the lengths below, but for mean and deviation

  std::optional<double> minimum;       ///< where all cells count
  std::optional<double> maximum;       ///< the same
  std::optional<double> standardError; ///< of the mean of a sample

  /** Of the mid-surface, as far as its cells count, in squared units; in two dimensions a length. */
  double   area{ 0.0 };
  AreaBins bins;

  std::uint64_t       uncertainCells{ 0 }; ///< whose uncertainty is known
  ThicknessStatistics uncertainty;         ///< of those: half the interval of the thickness that holds 95 %
};

} // end namespace medialvoxel

#endif
