// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectPass_h
#define itkMedialVoxelObjectPass_h

#include "itkMedialVoxelBits.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace itk
{

/** \class MedialVoxelObjectPass
 * \brief Reads a whole object once, a few slices at a time, to examine it before a run.
 * \ingroup MedialVoxel
 */
class MedialVoxelObjectPass
{
public:
  using Boxes = std::vector<MedialVoxelBox>;
  using Work = std::function<void(const MedialVoxelBox &)>;

  /** Looks at a box of whole slices. \a object holds one more slice on each side, where the image has one. */
  using Look = std::function<void(const MedialVoxelBits & object, const MedialVoxelBox & box)>;

  /** Sets the bits of the object voxels of a box. */
  std::function<void(const MedialVoxelBox & box, MedialVoxelBits & object)> fill;

  /** Calls \a work for each of the boxes, in any order, also in several threads. */
  std::function<void(const Boxes & boxes, const Work & work)> forEach;

  /** Called with the share of the object that was read, from 0 to 1; may throw to abort. */
  std::function<void(double)> observe;

  std::int64_t rows{ 1 };   ///< that are best read together, in all slices; 1: slices are
  std::int64_t slices{ 1 }; ///< that are best read together

  /** Calls \a look for boxes that make up \a image, in their order. Each begins at a multiple of \a layer slices. */
  void
  Run(const MedialVoxelBox & image, std::int64_t layer, const Look & look) const;

  /** Single slices, or strips of rows when \a rows are read together or there is one slice. */
  static Boxes
  Cut(const MedialVoxelBox & box, std::int64_t rows);
};

} // end namespace itk

#endif
