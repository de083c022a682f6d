// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelScanSamples_h
#define itkMedialVoxelScanSamples_h

#include "itkMedialVoxelGrayLocal.h"
#include "itkMedialVoxelRandomSample.h"
#include "itkMedialVoxelScanSurvey.h"
#include "itkMedialVoxelValueSides.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelScanSamples
 * \brief Values of a scan that MedialVoxelScanSurvey takes to find its materials.
 * \ingroup MedialVoxel
 */
struct MedialVoxelScanSamples
{
  struct Background
  {
    double value;
    double smallMean; ///< over 3^D voxels; NaN where it would have values of the object
    double largeMean; ///< over 5^D voxels
  };

  struct Material
  {
    double value;
    double depth; ///< distance to the nearest background, from SmallestDepth to LargestDepth
  };

  static constexpr double SmallestDepth = 2.5;
  static constexpr double LargestDepth = 5.5;

  /** Values near a surface, that lead into the object. */
  using Surface = MedialVoxelGrayLocal::Samples;

  /** Ways from a surface at which voxels must be of one kind. */
  static constexpr double NearestFlat = 2.5;
  static constexpr double FarthestFlat = 4.5;

  /** \struct Faces
   * \brief Faces between object and background, and how many of them are sharp: the values are the same from the
   * voxels at the face to the voxels behind them. */
  struct Faces
  {
    std::uint64_t all{ 0 };
    std::uint64_t sharp{ 0 };
  };

  static constexpr std::size_t NumberOfLevels = 16384;
  static constexpr std::size_t NumberOfSurfaces = 512;

  MedialVoxelRandomSample<Background> background{ NumberOfLevels };
  MedialVoxelRandomSample<Material>   material{ NumberOfLevels };
  MedialVoxelRandomSample<Surface>    surfaces{ NumberOfSurfaces };
  Faces                               faces;
  MedialVoxelValueSides               sides;

  /** Whether more of them would hardly change the result. */
  bool
  AreEnough() const
  {
    return background.GetSize() >= NumberOfLevels / 4 && material.GetSize() >= NumberOfLevels / 4 &&
           surfaces.GetSize() >= NumberOfSurfaces;
  }

  /** Items that the other samples do not want are not wanted here either. */
  void
  LimitTo(const MedialVoxelScanSamples & other)
  {
    background.LimitTo(other.background);
    material.LimitTo(other.material);
    surfaces.LimitTo(other.surfaces);
  }

  void
  Add(MedialVoxelScanSamples && other)
  {
    background.Add(std::move(other.background));
    material.Add(std::move(other.material));
    surfaces.Add(std::move(other.surfaces));
    faces.all += other.faces.all;
    faces.sharp += other.faces.sharp;
    sides += other.sides;
  }
};

/** \brief The survey of the samples of a scan; takes them.
 * \ingroup MedialVoxel
 */
MedialVoxelScanSurvey::Result
MedialVoxelSummarizeScan(MedialVoxelScanSamples &                     samples,
                         unsigned int                                 numberOfActiveAxes,
                         double                                       threshold,
                         const std::optional<MedialVoxelScanLevels> & levels);

} // end namespace itk

#endif
