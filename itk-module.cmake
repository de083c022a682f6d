# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# The one list of ITK modules that MedialVoxel needs, read by all three ways to build.
itk_module(
  MedialVoxel
  DEPENDS
  ITKCommon
  ITKIOImageBase
  ITKMesh
  TEST_DEPENDS
  ITKGoogleTest
  ITKIOMeta
  ITKIONRRD
  ITKDistanceMap
  ITKImageGrid
  DESCRIPTION
  "Exact nearest-boundary vectors and medial voxels of objects in CT volumes of any size."
  EXCLUDE_FROM_DEFAULT
  ENABLE_SHARED)
