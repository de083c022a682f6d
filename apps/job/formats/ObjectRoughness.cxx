// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectRoughness.h"

#include "itkMultiThreaderBase.h"

#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace medialvoxel
{
namespace
{

using Box = itk::MedialVoxelBox;

/** \class PartRunner
 * \brief Does something for each of some parts, in threads when that is allowed. */
class PartRunner
{
public:
  void
  Run(const std::vector<Box> & parts, bool isParallel, const std::function<void(const Box &)> & work)
  {
    std::exception_ptr error;
    std::mutex         mutex;
    const auto         tryPart = [&](itk::SizeValueType i) {
      try
      {
        work(parts[i]);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        error = std::current_exception();
      }
    };
    if (isParallel)
    {
      m_Threader->ParallelizeArray(0, parts.size(), tryPart, nullptr);
    }
    else
    {
      for (std::size_t i = 0; i < parts.size() && !error; ++i)
      {
        tryPart(i);
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

} // namespace

itk::MedialVoxelRoughness
MeasureRoughness(InputVolume & input, const Box & image, std::uint64_t slicesOfChunk, const ReadObserver & observer)
{
  const bool                    isParallel = input.GetSourceThreads() == itk::MedialVoxelSourceThreads::Several;
  PartRunner                    runner;
  itk::MedialVoxelRoughnessPass pass;
  pass.fill = [&input](const Box & box, itk::MedialVoxelBits & object) {
    input.Fill(box, { &object, nullptr, nullptr });
  };
  pass.forEach = [&](const auto & boxes, const auto & work) { runner.Run(boxes, isParallel, work); };
  pass.observe = observer;
  pass.rows = input.GetRowsReadTogether();
  pass.slices = static_cast<std::int64_t>(slicesOfChunk);
  return itk::MedialVoxelMeasureRoughness(pass, image);
}

} // end namespace medialvoxel
