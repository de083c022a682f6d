// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectSource_h
#define itkMedialVoxelObjectSource_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGray.h"

#include <cstdint>

namespace itk
{

/** Threads that may ask a source for voxels: the one that runs the engine, any but one at a time, or several at a time
 * for voxels of different rows.
 * \ingroup MedialVoxel */
enum class MedialVoxelSourceThreads : std::uint8_t
{
  Calling,
  OneAtATime,
  Several
};

/** \struct MedialVoxelTargets
 * \brief Where the voxels of a box go; null: they are not wanted.
 * \ingroup MedialVoxel
 */
struct MedialVoxelTargets
{
  MedialVoxelBits * object{ nullptr };     ///< clear bits; the source sets bits of the object
  MedialVoxelBits * notANumber{ nullptr }; ///< the same for values that are not a number
  MedialVoxelGray * gray{ nullptr };       ///< values
};

/** \class MedialVoxelObjectSource
 * \brief Where a window gets object bits from.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectSource
{
public:
  virtual ~MedialVoxelObjectSource();

  /** Threads that may call the functions that follow; by default the calling thread of the run alone, as pipelines and
   * interpreters need. */
  virtual MedialVoxelSourceThreads
  GetSourceThreads() const;

  /** Rows, from a multiple of them on, that are best filled by one thread, in all slices that are asked for; 1, the
   * default: several threads fill slices. */
  virtual std::int64_t
  GetRowsReadTogether() const;

  /** Fill the wanted targets for \a box. Sources without values are not asked for gray ones. */
  virtual void
  Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets) = 0;
};

} // end namespace itk

#endif
