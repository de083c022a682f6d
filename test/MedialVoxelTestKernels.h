// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestKernels_h
#define MedialVoxelTestKernels_h

// Between volumes of the oracles and the arrays that the kernels work on.

#include "MedialVoxelTestClassification.h"
#include "MedialVoxelTestPhantoms.h"

#include "itkMedialVoxelBits.h"

namespace MedialVoxelTest
{
inline itk::MedialVoxelIndex
KernelIndex(const Index3 & v)
{
  return { { v[0], v[1], v[2] } };
}

inline Index3
OracleIndex(const itk::MedialVoxelIndex & v)
{
  return { { static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2]) } };
}

inline itk::MedialVoxelBox
MakeBox(const Index3 & lower, const Index3 & upper)
{
  return { KernelIndex(lower), KernelIndex(upper) };
}

inline itk::MedialVoxelGrid
GridOf(const Volume & volume)
{
  return { KernelIndex(volume.size), volume.spacing };
}

/** The object bits of a box. */
inline itk::MedialVoxelBits
ObjectBits(const Volume & volume, const itk::MedialVoxelBox & box)
{
  itk::MedialVoxelBits bits(box);
  for (std::size_t i = 0; i < volume.object.size(); ++i)
  {
    const auto index = KernelIndex(volume.IndexAt(i));
    if (volume.object[i] && box.Contains(index))
    {
      bits.Set(index);
    }
  }
  return bits;
}

/** The sites of a box as bits. */
inline itk::MedialVoxelBits
SiteBits(const std::vector<Index3> & sites, const itk::MedialVoxelBox & box)
{
  itk::MedialVoxelBits bits(box);
  for (const Index3 & site : sites)
  {
    if (box.Contains(KernelIndex(site)))
    {
      bits.Set(KernelIndex(site));
    }
  }
  return bits;
}

/** Calls `visit` with every voxel of a box, x fastest. */
template <typename TVisitor>
void
ForEachVoxel(const itk::MedialVoxelBox & box, TVisitor && visit)
{
  for (auto z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (auto y = box.lower[1]; y < box.upper[1]; ++y)
    {
      for (auto x = box.lower[0]; x < box.upper[0]; ++x)
      {
        visit(itk::MedialVoxelIndex{ { x, y, z } });
      }
    }
  }
}

/** A random box inside a volume that is not empty. */
inline itk::MedialVoxelBox
RandomBox(const Index3 & size, std::mt19937 & generator)
{
  itk::MedialVoxelBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = generator() % size[axis];
    box.upper[axis] = box.lower[axis] + 1 + generator() % (size[axis] - box.lower[axis]);
  }
  return box;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestKernels_h
