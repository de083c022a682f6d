// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialSurfaceProgress_h
#define itkMedialSurfaceProgress_h

#include "itkMedialVoxelProgress.h"

#include "itkProcessObject.h"

#include <cstdint>

namespace itk
{

/** \class MedialSurfaceProgress
 * \brief Work on a surface as a whole, in the thread that called Update() of its filter.
 * \ingroup MedialVoxel
 */
class MedialSurfaceProgress : public MedialVoxelProgress
{
public:
  /** \a filter is asked for an abort, and its observers hear that the work goes on. */
  explicit MedialSurfaceProgress(ProcessObject & filter)
    : m_Filter(filter)
  {}

  bool
  IsAborted() const override
  {
    return m_Filter.GetAbortGenerateData();
  }

  void
  Advance(std::uint64_t) override
  {}

  /** Not UpdateProgress(), which might round the fraction down. */
  void
  UpdateObservers() override
  {
    m_Filter.InvokeEvent(ProgressEvent());
  }

  [[noreturn]] void
  ThrowAborted() const override
  {
    ProcessAborted exception(__FILE__, __LINE__);
    exception.SetDescription("Filter execution was aborted by an external request");
    throw exception;
  }

private:
  ProcessObject & m_Filter;
};

} // end namespace itk

#endif
