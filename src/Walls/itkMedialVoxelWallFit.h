// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallFit_h
#define itkMedialVoxelWallFit_h

#include "itkMedialVoxelFitSums.h"
#include "itkMedialVoxelGrayLocal.h"
#include "itkMedialVoxelScan.h"

#include "MedialVoxelExport.h"

#include <array>
#include <optional>

namespace itk
{

/** \class MedialVoxelWallFit
 * \brief Fits blurred walls and blurred surfaces to the gray values along a line. Lengths are in voxels.
 *
 * A wall of the thickness t around c has the normalized values Phi((s - c + t/2) / blur) - Phi((s - c - t/2) / blur) at
 * the place s of the line, a surface at c has Phi((s - c) / blur). Each voxel near the line counts with its own place,
 * so that nothing is interpolated. The fit is by weighted least squares, and the noise of a voxel gives the standard
 * deviation of the result.
 *
 * Where another wall is near, the values between two walls have a valley. The thickness is then the mass of the values
 * between the valleys, which does not depend on the blur.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelWallFit
{
public:
  /** \struct Wall
   * \brief A fitted wall.
   * \ingroup MedialVoxel
   */
  struct Wall
  {
    double thickness{ 0.0 };
    double center{ 0.0 };      ///< place of its middle along the line
    double deviation{ 0.0 };   ///< standard deviation of the thickness from the noise
    bool   isCut{ false };     ///< measured between valleys
    bool   isResolved{ true }; ///< false: the values inside are lower than in one wall of this thickness
  };

  /** \struct Surface
   * \brief A fitted surface of a wall.
   * \ingroup MedialVoxel
   */
  struct Surface
  {
    double place{ 0.0 };     ///< along the line
    double deviation{ 0.0 }; ///< standard deviation of the place from the noise
  };

  /** Voxels of a line to each side of a wall, or of a surface, that are looked at, at most. */
  static constexpr double ReachOfWall = 8.0;
  static constexpr double ReachOfSurface = 4.0;

  MedialVoxelWallFit(const MedialVoxelScan & scan, unsigned int numberOfActiveAxes);

  /** The wall around place 0 of a line.
   *
   * \param samples  up to ReachOfWall
   * \return nothing where the values do not have one */
  std::optional<Wall>
  FitWall(const MedialVoxelGrayLocal::Samples & samples) const;

  /** The surface nearest to place 0 of a line into the material.
   *
   * \param samples  up to ReachOfSurface
   * \return nothing where the values do not rise through 1/2 */
  std::optional<Surface>
  FitSurface(const MedialVoxelGrayLocal::Samples & samples) const;

  /** The same with the blur, which is fitted too.
   *
   * \return nothing where the fit does not converge */
  static std::optional<double>
  FitBlur(const MedialVoxelGrayLocal::Samples & samples);

private:
  /** Places of a profile are a quarter of a voxel apart, and as far as ReachOfWall to both sides. */
  static constexpr double Step = 0.25;
  static constexpr int    Side = 32;
  static constexpr int    Places = 2 * Side + 1;
  using Profile = std::array<double, Places>;

  /** The values of a profile from sums of samples. */
  class Bins;

  static Profile
  Smooth(const Profile & profile);

  static double
  PlaceOf(int index)
  {
    return Step * (index - Side);
  }

  /** The place at which a profile falls below 1/2 on the way from a place that is above. */
  static std::optional<double>
  FindCrossing(const Profile & profile, int from, int direction);

  struct End
  {
    double place;
    bool   isValley;
  };

  /** How far a wall reaches, with its blur, to one side. */
  End
  FindEnd(const Profile & smooth, int peak, double crossing, int direction) const;

  /** \return false where the fit does not converge near its start */
  bool
  Fit(const MedialVoxelFitSums & sums, Wall & wall) const;

  bool
  IsResolved(const MedialVoxelFitSums & sums, const Wall & wall) const;

  double m_Blur;
  double m_Noise;  // of a voxel, with its correlation
  double m_Number; // of voxels that a place of a profile averages
};

} // end namespace itk

#endif
