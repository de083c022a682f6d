// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrayLocal_h
#define itkMedialVoxelGrayLocal_h

#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelVector3.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelGrayLocal
 * \brief Gray values along a line, as the measurements of walls need them. Lengths are in voxels.
 *
 * Beyond a face of the image the outermost voxels are continued. Values are normalized: 0 is background, 1 is material.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrayLocal
{
public:
  /** \struct Sample
   * \brief One voxel near a line.
   * \ingroup MedialVoxel
   */
  struct Sample
  {
    double along;  ///< its place along the line, from the place that was asked for
    double weight; ///< from 0, at Radius from the line, to 1, on the line
    double value;  ///< normalized
  };

  /** Distance from a line at which voxels no longer count: 9 lines a voxel apart average as many values. */
  static constexpr double Radius = 2.2;

  /** Square of the sum of the weights over the sum of their squares, for each voxel of length of a line. */
  static double
  GetEffectiveNumber(unsigned int numberOfActiveAxes);

  MedialVoxelGrayLocal(const MedialVoxelGrid & grid, double background, double material);

  /** The voxels near a line through a place, up to \a reach along it to both sides. */
  void
  FindSamples(const MedialVoxelGray &    gray,
              const MedialVoxelVector3 & place,
              const MedialVoxelVector3 & direction,
              double                     reach,
              std::vector<Sample> &      samples) const;

private:
  double
  GetValue(const MedialVoxelGray & gray, const MedialVoxelIndex & voxel) const;

  MedialVoxelGrid m_Grid;
  double          m_Background;
  double          m_Scale; // to the contrast 1
};

} // end namespace itk

#endif
