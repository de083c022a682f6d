// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelParameters_h
#define itkMedialVoxelParameters_h

#include "itkMedialVoxelEnums.h"
#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <optional>
#include <ostream>

namespace itk
{

/** Labels of dual cells. Medial cells have MedialByBound or MedialByGeodesic. */
namespace MedialVoxelLabel
{
constexpr std::uint8_t NoObject = 0;
constexpr std::uint8_t NonMedial = 1;
constexpr std::uint8_t MedialByBound = 2;
constexpr std::uint8_t MedialByGeodesic = 3;
constexpr std::uint8_t AddedForTopology = 4;
} // namespace MedialVoxelLabel

/** \struct MedialVoxelParameters
 * \brief Parameters of the classification, in the units of the grid's spacing.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelParameters
{
  /** Threshold on the geodesic distance: a cell is medial when its distance is not below it. With an automatic
   * thickness, the smallest threshold. */
  double epsilon{ 0.0 };

  MedialVoxelPseudoGeodesicBound bound{ MedialVoxelPseudoGeodesicBound::FreeSpace };

  MedialVoxelThicknessMode mode{ MedialVoxelThicknessMode::Fixed };

  /** For an automatic thickness: the threshold is this many times the radius of the largest ball that covers the cell,
   * but at most \a largestRadius. */
  double thicknessFactor{ ThicknessFactor };
  double largestRadius{ 0.0 };

  /** Voxels of the largest components that MedialVoxelSmallComponents changes before anything else; 0 for none. */
  std::uint64_t maximumPoreSize{ 0 };

  /** Largest maximumPoreSize: a list holds so many voxels. */
  static constexpr std::uint64_t LargestMaximumPoreSize = 1000000;

  /** Between pi (Eq. 1 with the thickness of the wall) and 2.3 (edges of plates on the grid stay below it). */
  static constexpr double ThicknessFactor = 3.0;

  /** Defaults of the automatic thickness: walls from and to so many voxels, and its maximumPoreSize. */
  static constexpr double        FewestVoxelsOfWalls = 3.0;
  static constexpr double        MostVoxelsOfWalls = 16.0;
  static constexpr std::uint64_t DefaultMaximumPoreSize = 32;

  /** The default of a mode. */
  static std::uint64_t
  GetDefaultMaximumPoreSize(MedialVoxelThicknessMode mode);

  /** The choices of users; thicknesses are in the units of the spacing. */
  struct Settings
  {
    MedialVoxelThicknessMode       mode{ MedialVoxelThicknessMode::Fixed };
    double                         thickness{ 3.0 };        ///< of the mode Fixed
    double                         minimumThickness{ 0.0 }; ///< of the mode Automatic; see LimitsOfWalls()
    double                         maximumThickness{ 0.0 };
    std::optional<std::uint64_t>   maximumPoreSize; ///< without one, the default of the mode
    MedialVoxelPseudoGeodesicBound bound{ MedialVoxelPseudoGeodesicBound::FreeSpace };
  };

  /** The parameters for \a settings; a fixed thickness is at least MedialVoxelGridLimits::LeastThickness(). */
  static MedialVoxelParameters
  ForSettings(const MedialVoxelGrid & grid, const Settings & settings);

  /** One \a thickness everywhere. */
  static MedialVoxelParameters
  ForThickness(double thickness, MedialVoxelPseudoGeodesicBound bound);

  /** Thickness of the thinnest and thickest walls that set their own threshold. */
  struct Limits
  {
    double minimum;
    double maximum;
  };

  /** The limits of the user, in the units of the spacing; where they are 0: 3 and 16 voxels of the smallest spacing of
   * the axes longer than 1. At least MedialVoxelGridLimits::LeastThickness(), the default maximum 4 times that. */
  static Limits
  LimitsOfWalls(const MedialVoxelGrid & grid, double minimum, double maximum);

  /** Thresholds from the thickness of the walls, from \a minimum on; walls up to \a maximum become sheets. */
  static MedialVoxelParameters
  ForWalls(double minimum, double maximum, MedialVoxelPseudoGeodesicBound bound);

  /** The largest threshold that a cell can have. */
  double
  GetLargestEpsilon() const;

  /** epsilon = pi * thickness / 2 (Michikawa and Suzuki, Eq. 1). */
  static double
  EpsilonFromThickness(double thickness);
};

/** \struct MedialVoxelCounts
 * \brief Numbers of voxels and of dual cells decided by each phase.
 *
 * Every candidate cell is decided by exactly one phase: candidateCells is the sum of the four numbers after it.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelCounts
{
  std::uint64_t objectVoxels{ 0 };
  std::uint64_t boundaryVoxels{ 0 };
  std::uint64_t notANumberVoxels{ 0 };
  std::uint64_t filledVoxels{ 0 };  ///< of pores that became object
  std::uint64_t removedVoxels{ 0 }; ///< of small components that became background
  std::uint64_t candidateCells{ 0 };
  std::uint64_t trivialCells{ 0 };
  std::uint64_t boundCells{ 0 };
  std::uint64_t geodesicMedialCells{ 0 };
  std::uint64_t geodesicNonMedialCells{ 0 };

  /** Count a cell that is not trivial by the label it got. */
  void
  AddDecision(std::uint8_t label)
  {
    boundCells += (label == MedialVoxelLabel::MedialByBound) ? 1 : 0;
    geodesicMedialCells += (label == MedialVoxelLabel::MedialByGeodesic) ? 1 : 0;
    geodesicNonMedialCells += (label == MedialVoxelLabel::NonMedial) ? 1 : 0;
  }

  MedialVoxelCounts &
  operator+=(const MedialVoxelCounts & other);
};

/** All counts with their names, in one line. */
extern MedialVoxel_EXPORT std::ostream &
                          operator<<(std::ostream & out, const MedialVoxelCounts & counts);

} // end namespace itk

#endif
