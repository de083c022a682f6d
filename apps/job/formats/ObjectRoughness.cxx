// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ObjectRoughness.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace medialvoxel
{
namespace
{

using Box = itk::MedialVoxelBox;

/** Few, as they are in memory, but enough for all threads. */
constexpr std::uint64_t LeastSlices = 16;

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

/** Slices, or strips of rows that are read together. */
std::vector<Box>
Cut(const Box & box, std::int64_t rows)
{
  std::vector<Box>   parts;
  const unsigned int axis = rows > 1 || box.Extent(2) == 1 ? 1 : 2;
  const std::int64_t unit = axis == 1 ? std::max<std::int64_t>(rows, 32) : 1;
  for (Box part = box; part.lower[axis] < box.upper[axis]; part.lower[axis] = part.upper[axis])
  {
    part.upper[axis] = std::min((part.lower[axis] / unit + 1) * unit, box.upper[axis]);
    parts.push_back(part);
  }
  return parts;
}

Box
WithSlices(Box box, std::int64_t begin, std::int64_t end)
{
  box.lower[2] = begin;
  box.upper[2] = end;
  return box;
}

} // namespace

itk::MedialVoxelRoughness
MeasureRoughness(InputVolume & input, const Box & image, std::uint64_t slicesOfChunk, const ReadObserver & observer)
{
  const std::int64_t        end = image.upper[2];
  const auto                step = static_cast<std::int64_t>(std::max(LeastSlices, slicesOfChunk));
  const bool                isParallel = input.GetSourceThreads() == itk::MedialVoxelSourceThreads::Several;
  PartRunner                runner;
  itk::MedialVoxelBits      object;
  itk::MedialVoxelRoughness roughness;
  std::mutex                mutex;
  // Slices are counted when the next one is there.
  std::int64_t counted = 0;
  for (std::int64_t z = 0; z < end; z += step)
  {
    observer(static_cast<double>(z) / static_cast<double>(end));
    const Box read = WithSlices(image, z, std::min(z + step, end));
    const Box window = WithSlices(image, std::max<std::int64_t>(counted - 1, 0), read.upper[2]);
    object.Reframe(window, window);
    runner.Run(Cut(read, input.GetRowsReadTogether()), isParallel, [&](const Box & part) {
      input.Fill(part, { &object, nullptr, nullptr });
    });
    const Box ready = WithSlices(image, counted, read.upper[2] == end ? end : read.upper[2] - 1);
    runner.Run(Cut(ready, 1), isParallel, [&](const Box & part) {
      const itk::MedialVoxelRoughness   ofPart = itk::MedialVoxelMeasureRoughness(object, part, image);
      const std::lock_guard<std::mutex> lock(mutex);
      roughness += ofPart;
    });
    counted = ready.upper[2];
  }
  return roughness;
}

} // end namespace medialvoxel
