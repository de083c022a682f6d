// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelEngineClient_h
#define itkMedialVoxelEngineClient_h

#include "itkMedialVoxelTileResult.h"

#include "MedialVoxelExport.h"

#include <exception>
#include <functional>

namespace itk
{

/** \class MedialVoxelEngineClient
 * \brief Gives an engine threads and takes its results.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelEngineClient
{
public:
  virtual ~MedialVoxelEngineClient();

  /** Call \a work \a numberOfWorkers times, once in this thread and otherwise in the available threads, and wait for
   * all calls. \a work throws nothing. */
  virtual void
  RunWorkers(unsigned int numberOfWorkers, const std::function<void()> & work) = 0;

  /** Store the results of a tile. Called by several workers at a time, for each tile once. */
  virtual void
  TakeTile(const MedialVoxelTileResult & tile) = 0;

  /** Called in the calling thread of a run when \a fraction of the region is done; does nothing by default. */
  virtual void
  UpdateProgress(float fraction);

  /** Called in the calling thread of a run; true aborts it. Default false. */
  virtual bool
  IsAborted() const;

  /** The exception of an aborted run, by default MedialVoxelAborted. */
  virtual std::exception_ptr
  GetAbortException() const;
};

} // end namespace itk

#endif
