// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Version.h"

#include "itkVersion.h"

namespace medialvoxel
{

std::string
GetItkVersion()
{
  return itk::Version::GetITKVersion();
}

} // end namespace medialvoxel
