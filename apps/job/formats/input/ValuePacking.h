// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelValuePacking_h
#define medialvoxelValuePacking_h

#include "InputVolume.h"
#include "ObjectValues.h"
#include "ValueReader.h"

namespace medialvoxel
{

/** Packs values, which begin at the box, to what is wanted of it. */
template <typename TValue>
void
PackValues(const ValueView &           view,
           const itk::MedialVoxelBox & box,
           const JobOptions &          options,
           const VoxelTargets &        targets)
{
  const auto * const values = static_cast<const TValue *>(view.values);
  const auto         pack = [&](const auto & predicate, itk::MedialVoxelBits * bits) {
    // Bits that stay clear need no look at each voxel.
    if (bits != nullptr && !(view.areEqual && !predicate(*values)))
    {
      itk::MedialVoxelPackBox(values, view.strides, box, predicate, *bits);
    }
  };
  pack(MakeObjectPredicate<TValue>(options), targets.object);
  pack([](TValue value) { return value != value; }, targets.notANumber);
  if (targets.gray != nullptr)
  {
    itk::MedialVoxelCopyBox(values, view.strides, box, *targets.gray);
  }
}

} // end namespace medialvoxel

#endif
