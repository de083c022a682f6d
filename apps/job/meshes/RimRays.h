// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelRimRays_h
#define medialvoxelRimRays_h

#include "VolumeHeader.h"

#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelObjectSource.h"
#include "itkMedialVoxelRimExtension.h"
#include "itkMedialVoxelSurfaceConsumer.h"

#include <mutex>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** The faces of a volume, half a voxel beyond its last voxels. */
itk::MedialVoxelRimLimits
GetRimLimits(const VolumeGeometry & geometry);

/** \class RimRays
 * \brief Finds the surface of a part from places inside it, in a volume that is read again around them.
 *
 * The surface is where values that are linear between voxels cross the threshold, or the middle between voxels of a
 * mask. The part ends half a voxel beyond the last voxels of the volume. */
class RimRays
{
public:
  using GrayRange = itk::MedialVoxelSheetExtraction::GrayRange;

  /** \param input stays as long as this; it is prepared
   * \param range of the values of the part; none: its bits count */
  RimRays(itk::MedialVoxelObjectSource &   input,
          const VolumeGeometry &           geometry,
          const std::optional<GrayRange> & range);

  /** As itk::MedialVoxelMeasureRimRays */
  std::vector<double>
  Measure(const itk::MedialVoxelRimRays & rays) const;

private:
  using Vector = std::array<double, 3>;

  /** Voxels around rays. */
  struct Window
  {
    itk::MedialVoxelBits object;
    itk::MedialVoxelGray gray;
  };

  Vector
  ToIndex(const Vector & point) const;
  Vector
  ToIndexStep(const Vector & vector) const;

  /** The voxels around all rays. */
  itk::MedialVoxelBox
  FindBox(const itk::MedialVoxelRimRays & rays) const;

  Window
  Read(const itk::MedialVoxelBox & box) const;

  /** How far a value is within the range: not negative in the part. */
  double
  GetMargin(const Window & window, const itk::MedialVoxelIndex & voxel) const;
  double
  Interpolate(const Window & window, const Vector & index) const;
  double
  MeasureRay(const Window & window, const Vector & start, const Vector & step, double steps) const;

  itk::MedialVoxelObjectSource & m_Input;
  itk::MedialVoxelIndex          m_Size;
  Vector                         m_Origin;
  std::array<Vector, 3>          m_ToIndex{}; ///< row by row, from physical vectors to steps of the index
  double                         m_Step;      ///< of rays, physical
  std::optional<GrayRange>       m_Range;
  mutable std::mutex             m_Reading; ///< of sources that are read by one thread at a time
};

} // end namespace medialvoxel

#endif
