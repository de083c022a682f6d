// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef KernelScene_h
#define KernelScene_h

#include "itkMedialVoxelFeatureTransform.h"

#include <memory>

/** Object and boundary bits of one synthetic part, whole, with unit spacing. */
struct KernelScene
{
  itk::MedialVoxelGrid grid;
  itk::MedialVoxelBits object;
  itk::MedialVoxelBits boundary;

  itk::MedialVoxelWindow
  GetWindow() const
  {
    return { &object, &boundary };
  }
};

enum KernelSceneName : int
{
  ThinScene, // 192^3 out of the side frame, walls of 2 to 4 voxels
  ThickScene // solids of 192^3, largest inscribed radius about 50 voxels
};

/** Computed once. */
const KernelScene &
GetKernelScene(KernelSceneName name);

/** Name of a scene for the label of a benchmark. */
const char *
GetKernelSceneLabel(KernelSceneName name);

#endif
