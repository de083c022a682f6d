// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VoxelOutput.h"

#include "Errors.h"

namespace medialvoxel
{

void
VoxelOutput::WriteRows(const SliceRange & slices, const RowRange &, const void *)
{
  Fail(ExitStatus::Failure, "slices ", FormatSlices(slices), " are not written in parts");
}

} // end namespace medialvoxel
