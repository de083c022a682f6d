// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelProgress_h
#define itkMedialVoxelProgress_h

#include "MedialVoxelExport.h"

#include <cstdint>

namespace itk
{

/** \class MedialVoxelProgress
 * \brief What long work asks and tells: called once per row or tile, from any thread.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelProgress
{
public:
  virtual ~MedialVoxelProgress();

  /** True when the work is to stop as soon as possible; its results are then discarded. */
  virtual bool
  IsAborted() const = 0;

  /** \a voxels more of the requested region are done. */
  virtual void
  Advance(std::uint64_t voxels) = 0;
};

/** \class MedialVoxelNoProgress
 * \brief For work that nobody watches or stops.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelNoProgress : public MedialVoxelProgress
{
public:
  bool
  IsAborted() const override;

  void
  Advance(std::uint64_t voxels) override;
};

} // end namespace itk

#endif
