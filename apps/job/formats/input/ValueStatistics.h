// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValueStatistics_h
#define medialvoxelValueStatistics_h

#include "InputVolume.h"
#include "Options.h"
#include "Progress.h"
#include "Text.h"

#include <array>
#include <cstdint>
#include <optional>

namespace medialvoxel
{

/** Most bins of a histogram of values. Whole numbers whose range fits have a bin each. */
constexpr std::uint64_t MostValueBins = std::uint64_t{ 1 } << 16;

/** What the values of a volume are like, without those that are not a number or infinite. */
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

  /** From and to: what the file tells to be no measurement, or one value far away from all others, which scanners put
   * outside of their field of view. */
  std::optional<std::array<double, 2>> padding;
  std::uint64_t                        paddingValues{ 0 };

  /** Of Otsu, without the padding: values from it up are one class, those below the other one, and the variance between
   * them is largest. Of several such thresholds the lowest one. Nothing when all values are the same. */
  std::optional<double> otsu;
};

/** Reads all voxels once, or twice: for types of more than 16 bits the first time is for the range of the values, which
 * MostValueBins equal bins then share. Depends neither on memory nor on threads.
 * \param observer is called before each part that is read
 * \throw JobError as reading; what the observer throws */
ValueStatistics
MeasureValues(const VolumeHeader & header, const ReadObserver & observer);

/** The same for so many values in memory. */
ValueStatistics
MeasureValues(PixelType type, const void * values, std::uint64_t number, const ReadObserver & observer);

/** Sets the lower threshold to that of Otsu.
 * \throw JobError Refused when all values are the same; Usage when the upper threshold is below */
void
SetOtsuThreshold(JobOptions & options, const VolumeHeader & header, const ValueStatistics & statistics);

/** Sets the lower threshold if it is to be measured and is not set.
 * \throw JobError Refused when all values are the same; Usage when the upper threshold is below
 * \throw StoppedBySignal when the sink asks to stop */
void
MeasureThreshold(JobOptions & options, const VolumeHeader & header, const ProgressSink & sink);

/** \throw JobError Usage for a label that the values of the volume cannot have */
void
CheckLabel(const JobOptions & options, const VolumeHeader & header);

/** The statistics as names and values to print. */
TextTable
DescribeValues(const ValueStatistics & statistics);

} // end namespace medialvoxel

#endif
