// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEngineClient.h"

#include "itkMedialVoxelProgress.h"

namespace itk
{

MedialVoxelEngineClient::~MedialVoxelEngineClient() = default;

void
MedialVoxelEngineClient::UpdateProgress(float)
{}

bool
MedialVoxelEngineClient::IsAborted() const
{
  return false;
}

std::exception_ptr
MedialVoxelEngineClient::GetAbortException() const
{
  return std::make_exception_ptr(MedialVoxelAborted());
}

} // end namespace itk
