// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectSource_h
#define itkMedialVoxelObjectSource_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGray.h"

#include <cstdint>

namespace itk
{

/** Threads that may ask a source for voxels: only the one that runs the engine; any, one at a time; or several at a
 * time for different rows.
 * \ingroup MedialVoxel */
enum class MedialVoxelSourceThreads : std::uint8_t
{
  Calling,
  OneAtATime,
  Several
};

/** \struct MedialVoxelTargets
 * \brief Targets of the voxels of a box; null: not wanted.
 * \ingroup MedialVoxel
 */
struct MedialVoxelTargets
{
  MedialVoxelBits * object{ nullptr };     ///< clear bits; the source sets bits of the object
  MedialVoxelBits * notANumber{ nullptr }; ///< the same for values that are not a number
  MedialVoxelGray * gray{ nullptr };       ///< values
};

/** \class MedialVoxelObjectSource
 * \brief Source of the object bits of a window.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectSource
{
public:
  virtual ~MedialVoxelObjectSource();

  /** Threads that may call the functions below; by default only the calling thread of the run, as pipelines and
   * interpreters need. */
  virtual MedialVoxelSourceThreads
  GetSourceThreads() const;

  /** Number of rows, from a multiple of it on, that one thread should fill in all requested slices; 1, the default:
   * several threads fill slices. */
  virtual std::int64_t
  GetRowsReadTogether() const;

  /** Fill the wanted targets for \a box. Sources without values are not asked for gray ones. */
  virtual void
  Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets) = 0;
};

} // end namespace itk

#endif
