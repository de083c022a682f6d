// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelResampling_h
#define medialvoxelResampling_h

#include "VolumeHeader.h"

#include <array>
#include <cstdint>

namespace medialvoxel
{

/** How the value between voxels is found. */
enum class Interpolation
{
  Nearest, ///< of two voxels that are equally near, the lower one
  Linear   ///< not a number where a voxel with a share in it is none
};

/** A volume at equal spacing; as it is when it has that spacing.
 *
 * Its first voxel lies where that of the file lies, its last one not beyond the last of the file, so that no value is
 * made up. Axes of length 1 stay as they are.
 * \param spacing along each axis; 0: the smallest of the file
 * \throw JobError Usage when the result is out of the ranges of itk::MedialVoxelGridLimits */
VolumeHeader
ResampleHeader(const VolumeHeader & header, double spacing);

/** \class Resampling
 * \brief Which voxels of a file make a voxel of the resampled volume, and with which share.
 *
 * All sums are taken in double and in one order, so that values do not depend on the part that is made. */
class Resampling
{
public:
  /** \param header by ResampleHeader(), with stored */
  Resampling(const VolumeHeader & header, Interpolation interpolation);

  /** The first and the last voxel along an axis of the file that voxels from \a first to \a last are made of. */
  std::array<std::uint64_t, 2>
  GetStored(unsigned int axis, std::uint64_t first, std::uint64_t last) const;

  /** Makes the voxels [\a begin, \a end) of the row at \a y and \a z.
   * \param rowOf (y, z): a pointer to the voxel at x = 0 of a row of the file; asked for rows with a share only */
  template <typename TRowOf>
  void
  MakeRow(const TRowOf & rowOf,
          std::uint64_t  y,
          std::uint64_t  z,
          std::uint64_t  begin,
          std::uint64_t  end,
          double *       values) const;

private:
  /** A position in the file: \a weight of the way from \a lower to the voxel after it. */
  struct Step
  {
    std::uint64_t lower{ 0 };
    double        weight{ 0.0 };

    std::uint64_t
    GetUpper() const
    {
      return weight > 0.0 ? lower + 1 : lower;
    }
  };

  Step
  GetStep(unsigned int axis, std::uint64_t index) const;

  static double
  Interpolate(double lower, double upper, double weight)
  {
    return weight > 0.0 ? (1.0 - weight) * lower + weight * upper : lower;
  }

  Interpolation         m_Interpolation;
  std::array<double, 3> m_Strides{ { 1.0, 1.0, 1.0 } }; ///< voxels of the file from one voxel to the next
  std::array<double, 3> m_Last{ { 0.0, 0.0, 0.0 } };    ///< of the file
};

template <typename TRowOf>
void
Resampling::MakeRow(const TRowOf & rowOf,
                    std::uint64_t  y,
                    std::uint64_t  z,
                    std::uint64_t  begin,
                    std::uint64_t  end,
                    double *       values) const
{
  const Step stepY = this->GetStep(1, y);
  const Step stepZ = this->GetStep(2, z);
  const auto planeAt = [&](std::uint64_t atZ) {
    return
      [lower = rowOf(stepY.lower, atZ), upper = rowOf(stepY.GetUpper(), atZ), weight = stepY.weight](std::uint64_t x) {
        return Interpolate(static_cast<double>(lower[x]), static_cast<double>(upper[x]), weight);
      };
  };
  const auto lower = planeAt(stepZ.lower);
  const auto upper = planeAt(stepZ.GetUpper());
  const auto at = [&](std::uint64_t x) { return Interpolate(lower(x), upper(x), stepZ.weight); };
  for (std::uint64_t x = begin; x < end; ++x)
  {
    const Step step = this->GetStep(0, x);
    *values++ = Interpolate(at(step.lower), at(step.GetUpper()), step.weight);
  }
}

} // end namespace medialvoxel

#endif
