// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileTask_h
#define itkMedialVoxelTileTask_h

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelMovingWindow.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSums.h"

#include <memory>

namespace itk
{

/** \class MedialVoxelTileTask
 * \brief The work on each tile of an image.
 * \ingroup MedialVoxel
 */
class MedialVoxelTileTask
{
public:
  /** Memory of one worker; derived classes add theirs. */
  struct Workspace
  {
    virtual ~Workspace() = default;
  };

  virtual ~MedialVoxelTileTask() = default;

  virtual std::unique_ptr<Workspace>
  MakeWorkspace() const = 0;

  /** Called before and after the tiles of a run, the latter only when all of them are done. */
  virtual void
  Begin() const
  {}
  virtual void
  Commit() const
  {}

  /** Compute one tile and give it to \a client.
   *
   * \return an empty box when done, otherwise the sites that must be known; then no observer or client was called */
  virtual MedialVoxelBox
  Process(const MedialVoxelBox &          tile,
          const MedialVoxelMovingWindow & window,
          const MedialVoxelProgress &     progress,
          Workspace &                     workspace,
          MedialVoxelEngineClient &       client,
          MedialVoxelSums &               sums) const = 0;
};

} // end namespace itk

#endif
