// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFitSums_h
#define itkMedialVoxelFitSums_h

#include "itkMedialVoxelGrayLocal.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <memory>

namespace itk
{

/** \class MedialVoxelFitSums
 * \brief Sums over the voxels near a part of a line, as steps of a fit need them; eight voxels side by side.
 *
 * Numbers are in single precision, and each sum has eight parts in a fixed order. The errors of the normal distribution
 * are below 3e-7.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelFitSums
{
public:
  /** The samples up to \a reach from \a place. */
  MedialVoxelFitSums(const MedialVoxelGrayLocal::Samples & samples, double place, double reach);

  /** \struct Wall
   * \brief Of a blurred wall: w is a weight, r a value less the model, t and c are derivatives of the model for the
   * thickness and the center.
   * \ingroup MedialVoxel
   */
  struct Wall
  {
    double tt; ///< w t t
    double tc;
    double cc;
    double rt; ///< w r t
    double rc;
    double bendTT; ///< w r times the second derivative for the thickness
    double bendTC;
    double bendCC;
    double squaredTT; ///< w w t t
    double squaredTC;
    double squaredCC;
  };

  Wall
  SumWall(double center, double thickness, double blur) const;

  /** \struct Surface
   * \brief Of a blurred surface: p is the derivative for its place.
   * \ingroup MedialVoxel
   */
  struct Surface
  {
    double pp; ///< w p p
    double rp; ///< w r p
    double bend;
    double squaredPP; ///< w w p p
  };

  Surface
  SumSurface(double place, double blur) const;

  /** \struct Misfit
   * \brief Sums of w r, w, and w w.
   * \ingroup MedialVoxel
   */
  struct Misfit
  {
    double rest;
    double weight;
    double squaredWeight;
  };

  /** Of a wall, up to \a core from its center. */
  Misfit
  SumMisfit(double center, double thickness, double blur, double core) const;

  /** \struct Arrays
   * \brief The samples; their number is a multiple of the lanes, and the last may have the weight 0.
   * \ingroup MedialVoxel
   */
  struct Arrays
  {
    const float * along;
    const float * weight;
    const float * value;
    std::size_t   number;
  };

private:
  Arrays
  GetArrays() const;

  std::size_t              m_Room;
  std::unique_ptr<float[]> m_Samples; // places, weights and values, one after the other
  std::size_t              m_Number;
};

} // end namespace itk

#endif
