// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValueStatistics_h
#define medialvoxelValueStatistics_h

#include "Options.h"
#include "Text.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelValueSource.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>

namespace medialvoxel
{

/** Most bins of a histogram of values. Whole numbers whose range fits have a bin each. */
constexpr std::uint64_t MostValueBins = std::uint64_t{ 1 } << 16;

/** Statistics of the values of a volume, without NaN and infinite ones. */
struct ValueStatistics
{
  static constexpr std::array<unsigned int, 7> Percents{ 1, 5, 25, 50, 75, 95, 99 };

  std::uint64_t values{ 0 };   ///< finite ones; without any the numbers below mean nothing
  std::uint64_t excluded{ 0 }; ///< not a number, or infinite
  double        minimum{ 0.0 };
  double        maximum{ 0.0 };
  double        mean{ 0.0 };
  double        binWidth{ 0.0 }; ///< to which percentiles and threshold are exact; 0: they are exact

  /** The least value that so many percent of the values, without the padding, do not exceed. */
  std::array<double, Percents.size()> percentiles{};

  /** From and to: values that the file declares to be no measurement, or one value far away from all others, which
   * scanners put outside of their field of view. */
  std::optional<std::array<double, 2>> padding;
  std::uint64_t                        paddingValues{ 0 };

  /** Otsu's threshold, without the padding: it separates two classes, itself in the upper one, with the largest
   * variance between them. The lowest one of several. Nothing when all values are the same. */
  std::optional<double> otsu;

  std::uint64_t different{ 0 };     ///< values, or bins of them, without the padding
  std::uint64_t otherThanZero{ 0 }; ///< values, without the padding
  std::uint64_t faint{ 0 };         ///< of these, values below Otsu's threshold
};

/** Values that are no measurement, from and to. */
using Paddings = std::set<std::array<double, 2>>;

/** Hears how much of a volume was read, from 0 to 1; throws to stop. */
using ReadObserver = std::function<void(double)>;

/** Reads all values once. Types of more than 16 bits are read twice: first for the range of the values, which
 * MostValueBins equal bins then share. Depends neither on memory nor on threads.
 * \param paddings declared by the file
 * \param observer is called before each span that is read */
ValueStatistics
MeasureValues(itk::MedialVoxelValueSource & source,
              const itk::MedialVoxelBox &   image,
              const Paddings &              paddings,
              const ReadObserver &          observer);

/** Sets the lower threshold to that of Otsu.
 * \throw JobError Refused when all values are the same; Usage when the upper threshold is below */
void
SetOtsuThreshold(JobOptions & options, const VolumeHeader & header, const ValueStatistics & statistics);

/** The statistics as names and values to print. */
TextTable
DescribeValues(const ValueStatistics & statistics);

} // end namespace medialvoxel

#endif
