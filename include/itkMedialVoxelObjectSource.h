// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectSource_h
#define itkMedialVoxelObjectSource_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGray.h"

namespace itk
{

/** \class MedialVoxelObjectSource
 * \brief Where a window gets object bits from; called by one thread at a time.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectSource
{
public:
  virtual ~MedialVoxelObjectSource();

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
