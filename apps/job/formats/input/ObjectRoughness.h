// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelObjectRoughness_h
#define medialvoxelObjectRoughness_h

#include "InputVolume.h"

#include "itkMedialVoxelRoughness.h"

namespace medialvoxel
{

/** Reads the object of a prepared volume once and measures it.
 * \param slicesOfChunk that are best read together
 * \throw what the observer throws, and InputVolume::Fill() */
itk::MedialVoxelRoughness
MeasureRoughness(InputVolume &               input,
                 const itk::MedialVoxelBox & image,
                 std::uint64_t               slicesOfChunk,
                 const ReadObserver &        observer);

} // end namespace medialvoxel

#endif
