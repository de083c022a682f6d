// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSpanRunner_h
#define medialvoxelSpanRunner_h

#include "itkMedialVoxelGrid.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace medialvoxel
{

/** \class SpanRunner
 * \brief Does something for each of some parts, in threads when that is allowed. */
class SpanRunner
{
public:
  /** At most so many threads, where each needs much memory. */
  void
  LimitThreads(unsigned int most)
  {
    m_Threader->SetNumberOfWorkUnits(std::min<itk::ThreadIdType>(m_Threader->GetNumberOfWorkUnits(), most));
  }

  void
  Run(const std::vector<itk::MedialVoxelBox> &                 parts,
      bool                                                     isParallel,
      const std::function<void(const itk::MedialVoxelBox &)> & work)
  {
    std::exception_ptr error;
    std::mutex         mutex;
    std::size_t        taken = 0;
    // Each thread takes a part when it is free: some take much longer than others.
    const auto takeParts = [&](itk::SizeValueType) {
      for (;;)
      {
        std::unique_lock<std::mutex> lock(mutex);
        if (error || taken == parts.size())
        {
          return;
        }
        const itk::MedialVoxelBox & part = parts[taken++];
        lock.unlock();
        try
        {
          work(part);
        }
        catch (...)
        {
          lock.lock();
          error = std::current_exception();
        }
      }
    };
    if (isParallel)
    {
      m_Threader->ParallelizeArray(
        0, std::min<std::size_t>(parts.size(), m_Threader->GetNumberOfWorkUnits()), takeParts, nullptr);
    }
    else
    {
      takeParts(0);
    }
    if (error)
    {
      std::rethrow_exception(error);
    }
  }

private:
  itk::MultiThreaderBase::Pointer m_Threader{ itk::MultiThreaderBase::New() };
};

} // end namespace medialvoxel

#endif
