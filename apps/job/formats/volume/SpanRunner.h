// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSpanRunner_h
#define medialvoxelSpanRunner_h

#include "itkMedialVoxelGrid.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <atomic>
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
    std::atomic<bool>  hasFailed{ false };
    const auto         trySpan = [&](itk::SizeValueType i) {
      if (hasFailed)
      {
        return;
      }
      try
      {
        work(parts[i]);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        error = std::current_exception();
        hasFailed = true;
      }
    };
    if (isParallel)
    {
      m_Threader->ParallelizeArray(0, parts.size(), trySpan, nullptr);
    }
    else
    {
      for (std::size_t i = 0; i < parts.size(); ++i)
      {
        trySpan(i);
      }
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
