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

  /** Set the bits of the object voxels of \a box, which are clear, and in \a notANumber, unless it is null, those of
   * the voxels whose value is not a number. */
  virtual void
  FillObject(const MedialVoxelBox & box, MedialVoxelBits & object, MedialVoxelBits * notANumber) = 0;

  /** The same, and set the values of \a box. Sources that have none fail. */
  virtual void
  FillObjectAndGray(const MedialVoxelBox & box,
                    MedialVoxelBits &      object,
                    MedialVoxelBits *      notANumber,
                    MedialVoxelGray &      gray);

  /** Set the values of \a box, whose object bits are there. Sources that have none fail. */
  virtual void
  FillGray(const MedialVoxelBox & box, MedialVoxelGray & gray);

  /** Throws to stop; called while the window works on the bits. */
  virtual void
  ThrowIfAborted() const;
};

} // end namespace itk

#endif
