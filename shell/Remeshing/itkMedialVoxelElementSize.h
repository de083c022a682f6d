// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelElementSize_h
#define itkMedialVoxelElementSize_h

#include "itkMedialVoxelRimExtension.h"

namespace itk
{

/** How large elements are to be. */
struct MedialVoxelElementSize
{
  double least{ 0 };           ///< of the sides, units of the points, > 0
  bool   atThickness{ false }; ///< at least the thickness everywhere; else so at junctions and bends
  bool   joinsTriangles{ true };
  double noise{ 0 }; ///< how far the fine sheet may be off anywhere, and steps may move it; 0: half its mean side
  double shareOfThickness{ 1 }; ///< that stands for the thickness

  bool                      extendsRims{ false }; ///< to the free edges of the part
  MedialVoxelMeasureRimRays measureRimRays{};     ///< finds these edges; empty: they are half a thickness away
  MedialVoxelRimLimits      rimLimits{};          ///< faces of the volume, where rims end at the latest

  double
  GetNoise(double meanSide) const
  {
    return noise > 0.0 ? noise : meanSide / 2.0;
  }

  /** That sides of a coarse sheet have, which elements are made of: a share of these, but not near the fine sides. */
  MedialVoxelElementSize
  MakeCoarse(double meanSide) const;
};

} // end namespace itk

#endif
