// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetObserver_h
#define medialvoxelSheetObserver_h

#include "Options.h"
#include "ProductFootprint.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelSurfaceObserver.h"

#include <cstdint>
#include <memory>

namespace medialvoxel
{

/** What builds the sheet of a job while its pieces run.
 * \param grid     the image in the units of the options
 * \param surplus  memory for cells that wait until their piece is done, beside that of GetSheetFootprint()
 * \param run      tasks of several slices in threads; none: the slices are done one by one
 * \param consumer takes the sheet */
std::unique_ptr<itk::MedialVoxelSurfaceObserver>
MakeSheetObserver(const ExtractOptions &                           options,
                  const VolumeGeometry &                           geometry,
                  const itk::MedialVoxelGrid &                     grid,
                  std::uint64_t                                    surplus,
                  const itk::MedialVoxelSurfaceBuilder::RunTasks & run,
                  itk::MedialVoxelSurfaceConsumer &                consumer);

/** Its memory in a run over a part with thin walls. */
ProductFootprint
GetSheetFootprint(const ExtractOptions & options, const VolumeGeometry & geometry, const itk::MedialVoxelGrid & grid);

} // end namespace medialvoxel

#endif
