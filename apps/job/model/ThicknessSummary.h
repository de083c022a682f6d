// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelThicknessSummary_h
#define medialvoxelThicknessSummary_h

#include <array>
#include <cstdint>
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

/** Thickness of the walls at the medial cells that are at no rim, in the units of the job's lengths. Without cells all
 * is 0. */
struct ThicknessSummary : ThicknessStatistics ///< every cell counts the same
{
  std::uint64_t cells{ 0 };           ///< measured ones
  std::uint64_t rimCells{ 0 };        ///< measured ones that are at rims, which nothing else here counts
  std::uint64_t unresolvedCells{ 0 }; ///< of walls that the blur has joined, which nothing else counts either
  unsigned int  step{ 1 };            ///< one of how many medial cells is measured
  double        resolution{ 0.0 };    ///< of the lengths below, but for mean and deviation
  double        minimum{ 0.0 };
  double        maximum{ 0.0 };

  /** Of the mid-surface, as far as its cells are measured, in squared units; in two dimensions a length. */
  double              area{ 0.0 };
  ThicknessStatistics byArea; ///< cells count as much as the area that they stand for

  std::uint64_t       uncertainCells{ 0 }; ///< whose uncertainty is known
  ThicknessStatistics uncertainty;         ///< of those: half the interval of the thickness that holds 95 %

  /** Bin k has the lengths that are nearest to k times the width. There are at most 64 bins; what is longer than they
   * reach, less than one of two hundred cells, is counted as above. */
  double                     binWidth{ 0.0 };
  std::vector<std::uint64_t> bins;
  std::uint64_t              above{ 0 };
};

} // end namespace medialvoxel

#endif
