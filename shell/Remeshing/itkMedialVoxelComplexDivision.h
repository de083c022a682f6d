// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelComplexDivision_h
#define itkMedialVoxelComplexDivision_h

#include "itkMedialVoxelSheet.h"

#include <functional>

namespace itk
{

/** Parts of a sheet that can be done at the same time. */
struct MedialVoxelSheetDivision
{
  using Index = MedialVoxelSheet::Index;

  std::vector<std::vector<Index>> parts;    ///< numbers of the triangles of each
  std::vector<bool>               isShared; ///< of each point, whether several parts have it
};

/** Halves a sheet across its longest extent, until no part has more triangles than \a most. */
MedialVoxelSheetDivision
MedialVoxelDivideSheet(const MedialVoxelSheet & sheet, std::size_t most);

/** Calls task(number, check) for all numbers below a count, in any order and at the same time. Tasks call check()
 * often, which may throw to stop. */
using MedialVoxelTask = std::function<void(std::size_t number, const std::function<void()> & check)>;
using MedialVoxelRunTasks = std::function<void(std::size_t count, const MedialVoxelTask & task)>;

/** One after the other. */
void
MedialVoxelRunInOrder(std::size_t count, const MedialVoxelTask & task);

} // end namespace itk

#endif
