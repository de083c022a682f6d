// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelValueSource_h
#define itkMedialVoxelValueSource_h

#include "itkMedialVoxelObjectSource.h"
#include "itkMedialVoxelValues.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace itk
{

/** \class MedialVoxelValueSource
 * \brief Source of the values of an image: a pipeline, a file, or memory.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelValueSource
{
public:
  using Boxes = std::vector<MedialVoxelBox>;
  using Work = std::function<void(const MedialVoxelBox &)>;
  using ViewFunction = std::function<void(const MedialVoxelValueView &)>;
  using SpanFunction = std::function<void(const MedialVoxelBox &, const MedialVoxelValueView &)>;

  virtual ~MedialVoxelValueSource();

  virtual MedialVoxelValueType
  GetValueType() const = 0;

  /** Threads that may ask for values; by default the calling thread alone. */
  virtual MedialVoxelSourceThreads
  GetSourceThreads() const;

  /** Number of rows, from a multiple of it on, to read together in all slices of a box; 1, the default: read whole
   * slices.
   */
  virtual std::int64_t
  GetRowsReadTogether() const;

  /** Slices that are best read together; 1 by default. */
  virtual std::int64_t
  GetSlicesReadTogether() const;

  /** Call \a function(view) with all values of \a box, valid during the call. */
  virtual void
  WithBox(const MedialVoxelBox & box, const ViewFunction & function) = 0;

  /** Call \a function(span, view) for spans of \a box that are best read each by itself; by default for
   * CutIntoSpans(). */
  virtual void
  ForEachSpan(const MedialVoxelBox & box, const SpanFunction & function);

  /** Cut \a box into spans of about a megabyte, in the order of the voxels.
   * \param bytesPerVoxel that a span takes */
  virtual Boxes
  CutIntoSpans(const MedialVoxelBox & box, std::size_t bytesPerVoxel) const;

  /** Call \a work for each of the boxes, by default one after the other.
   * \param mostThreads at the same time; 0 is without limit */
  virtual void
  ForEach(const Boxes & boxes, unsigned int mostThreads, const Work & work);

  /** Slices of a box, or rows of a single slice, of about a megabyte. */
  static Boxes
  CutForPull(const MedialVoxelBox & box, std::size_t bytesPerVoxel);
};

} // end namespace itk

#endif
