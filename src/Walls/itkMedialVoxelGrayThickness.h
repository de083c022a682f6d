// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrayThickness_h
#define itkMedialVoxelGrayThickness_h

#include "itkMedialVoxelGrayBoundary.h"
#include "itkMedialVoxelGrayNormals.h"
#include "itkMedialVoxelThickness.h"
#include "itkMedialVoxelWallFit.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>
#include <optional>

namespace itk
{

/** \class MedialVoxelGrayThickness
 * \brief Thickness of a wall at a medial cell, measured on the gray values that the object was cut from.
 *
 * With a known scan, walls of up to 6 voxels are fitted by MedialVoxelWallFit along the direction in which the values
 * around the cell change most, or measured between the valleys to other walls. Of thicker walls both surfaces are
 * fitted, and the thickness is the distance between them through the center of the cell. Both have an uncertainty: half
 * of the interval that holds 95 % of the true thicknesses, from the noise, 0.03 voxels for the place between the voxels
 * and 1 % of the thickness for the levels. The fit is in voxels, so that the blur counts in voxels, too. Where sides
 * are unpaired, and where the values have no wall, the measure below is kept.
 *
 * Without a scan, each boundary point of the cell's corners is moved by MedialVoxelGrayBoundary to where the values
 * cross the threshold. The line through the center of the cell in the mean direction of the gradients meets the
 * surfaces around the means of both sides. The thickness is the distance between them. Where a side has no crossing
 * within two voxels, the measurement on the object is kept; unpaired sides are found on the object. Walls do not reach
 * the value of their material when they are thinner than about three times the blur: the threshold cuts them too thin.
 * doc/explanation/accuracy.md has the errors of both.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrayThickness
{
public:
  /** Voxels around a cell that a wall of up to 6 voxels is measured by. */
  static constexpr std::int64_t Reach = static_cast<std::int64_t>(MedialVoxelWallFit::ReachOfWall) + 4;

  /** \class Workspace
   * \brief Memory of one thread, kept from cell to cell of one image.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    std::optional<MedialVoxelGrayNormals> normals; // with the first fit
    MedialVoxelGrayLocal::Samples         samples;
  };

  /** Of the boundary points of the corners, in their order. */
  using Crossings = std::array<MedialVoxelGrayBoundary::Crossing, 8>;

  /** Object are the voxels from \a lower to \a upper, of which one may be infinite.
   *
   * \param scan  the materials of the values, when known */
  MedialVoxelGrayThickness(const MedialVoxelGrid &        grid,
                           double                         lower,
                           double                         upper,
                           std::optional<MedialVoxelScan> scan = std::nullopt);

  /** The voxels whose values are read around the boundary points. */
  MedialVoxelBox
  GetReadBox(const MedialVoxelWallPoints & points) const;

  /** The crossings of the threshold next to the boundary points that are on a side.
   *
   * \param gray  values of GetReadBox(points) */
  Crossings
  FindCrossings(const MedialVoxelGray & gray, const MedialVoxelWallPoints & points) const;

  /** Replaces the thickness and the area of a wall that was measured on the object. */
  void
  Refine(const MedialVoxelGray &       gray,
         const MedialVoxelWallPoints & points,
         Workspace &                   workspace,
         MedialVoxelWall &             wall) const;

  /** The same when the crossings are known. */
  void
  Refine(const MedialVoxelGray &       gray,
         const MedialVoxelWallPoints & points,
         const Crossings &             crossings,
         Workspace &                   workspace,
         MedialVoxelWall &             wall) const;

  /** Moves the points. */
  const MedialVoxelGrayBoundary &
  GetBoundary() const
  {
    return m_Boundary;
  }

private:
  using PositionType = MedialVoxelGrayBoundary::PositionType;

  /** Direction from the boundary points nearer to a to the points nearer to b, in the units of the spacing. */
  PositionType
  GetDirection(const MedialVoxelWallPoints & points) const;

  /** The voxels around the boundary points, whether or not the image has them. */
  static MedialVoxelBox
  GetBoxAround(const MedialVoxelWallPoints & points, std::int64_t reach);

  /** The means of the boundary points of both sides, in voxels. */
  struct Sides;

  static Sides
  GetSides(const MedialVoxelWallPoints & points);

  bool
  LeadsAcross(const PositionType & normal, const Sides & sides) const;

  /** The result of a fit, in voxels. */
  struct Fitted;

  std::optional<Fitted>
  FitWall(const MedialVoxelGray &       gray,
          const MedialVoxelWallPoints & points,
          const Sides &                 sides,
          Workspace &                   workspace) const;

  std::optional<Fitted>
  FitSurfaces(const MedialVoxelGray &       gray,
              const MedialVoxelWallPoints & points,
              const Sides &                 sides,
              Workspace &                   workspace) const;

  /** \return false: the measure without a scan counts */
  bool
  RefineByFit(const MedialVoxelGray &       gray,
              const MedialVoxelWallPoints & points,
              Workspace &                   workspace,
              MedialVoxelWall &             wall) const;

  /** By the surfaces that the lines through the crossings meet. */
  void
  RefineByCrossings(const MedialVoxelGray &       gray,
                    const MedialVoxelWallPoints & points,
                    const Crossings &             crossings,
                    MedialVoxelWall &             wall) const;

  PositionType
  GetCenter(const MedialVoxelWallPoints & points) const;

  /** Fits need a scan. */
  struct Model
  {
    MedialVoxelScan      scan;
    MedialVoxelGrayLocal local;
    MedialVoxelWallFit   fit;
  };

  MedialVoxelGrid         m_Grid;
  MedialVoxelGrayBoundary m_Boundary;
  double                  m_CellVolume{ 1.0 }; // along the active axes
  double                  m_Smallest;          // of MedialVoxelThickness
  std::optional<Model>    m_Model;
};

} // end namespace itk

#endif
