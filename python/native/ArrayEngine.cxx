// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ArrayEngine.h"

#include "ObjectRule.h"

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

namespace medialvoxel
{

nlohmann::json
ArrayMeasure::Describe() const
{
  nlohmann::json scan;
  if (found.scan)
  {
    scan = { { "background", found.scan->background },
             { "material", found.scan->material },
             { "blur", found.scan->blur },
             { "noise", found.scan->noise } };
  }
  const char * const on = found.scan ? "fits" : (range ? "crossings" : "object");
  return { { "on", on }, { "scan", scan }, { "reason", found.reason } };
}

ArrayEngine::ArrayEngine(const ArrayCall & call, const JobOptions & options)
  : m_Call(call)
  , m_Options(options)
  , m_Source(call)
  , m_Grid(medialvoxel::GetGrid(call.header))
  , m_Strides{ { 1, call.array.size[0], call.array.size[0] * call.array.size[1] } }
{}

itk::MedialVoxelObjectInput
ArrayEngine::MakeObject(const Smoothing smoothing)
{
  return { m_Source, m_Grid.GetVoxelBox(), GetObjectRule(m_Options), smoothing };
}

void
ArrayEngine::Prepare(itk::MedialVoxelObjectInput & object, ExtractOptions & options)
{
  if (const auto maximum = GetDefaultMaximumThickness(options, m_Grid))
  {
    object.LookForThickWalls(m_Grid, *maximum);
  }
  this->ReadBeforeRun([&](const auto & observer) { object.Prepare(observer); });
  options.neededMaximum = object.GetNeededMaximum();
}

ArrayMeasure
ArrayEngine::FindMeasure(itk::MedialVoxelObjectInput &                     object,
                         const bool                                        mayUseValues,
                         const std::string &                               whyOnObject,
                         const std::optional<itk::MedialVoxelScanLevels> & levels)
{
  if (!mayUseValues)
  {
    return { {}, { {}, whyOnObject } };
  }
  // Thresholds that no value reaches do not count.
  GrayRange    range = GetGrayRange(m_Options, m_Call.header);
  ArrayMeasure measure;
  measure.found = this->ReadBeforeRun(
    [&](const auto & observer) { return object.SurveyScan(m_Grid, range.lower, range.upper, levels, observer); });
  if (!measure.found.isMask)
  {
    range.scan = measure.found.scan;
    measure.range = range;
  }
  return measure;
}

itk::MedialVoxelSums
ArrayEngine::Run(itk::MedialVoxelInput &            input,
                 const itk::MedialVoxelEngineTask & task,
                 TileTaker                          taker,
                 const unsigned int                 run,
                 const unsigned int                 numberOfRuns)
{
  const PixelType                type = m_Call.header.pixelType;
  itk::MedialVoxelEngineSettings settings;
  settings.task = task;
  settings.countsNotANumber = type == PixelType::Float32 || type == PixelType::Float64;
  settings.memoryLimit = m_Options.memoryLimit.value_or(0);
  settings.numberOfWorkers = this->GetNumberOfThreads();
  m_Taker = std::move(taker);
  m_Run = run;
  m_NumberOfRuns = numberOfRuns;
  return itk::MedialVoxelEngine(m_Grid, settings).Run(m_Grid.GetVoxelBox(), input, *this);
}

unsigned int
ArrayEngine::GetNumberOfThreads() const
{
  return m_Options.threads.value_or(std::max(1u, std::thread::hardware_concurrency()));
}

void
ArrayEngine::WriteVectors(const itk::MedialVoxelTileResult & tile, float * const vectors) const
{
  using Writer = itk::MedialVoxelDisplacementWriter<3, float>;
  Writer::MatrixType matrix{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    matrix[2 - axis][axis] = m_Call.header.geometry.spacing[axis];
  }
  float * const first = vectors + 3 * (this->PlaceOf(vectors, tile.box) - vectors);
  tile.WriteVectors(Writer(matrix), first, m_Strides);
}

void
ArrayEngine::RunWorkers(const unsigned int numberOfWorkers, const std::function<void()> & work)
{
  std::vector<std::thread> others;
  for (unsigned int i = 1; i < numberOfWorkers; ++i)
  {
    others.emplace_back(work);
  }
  work();
  for (std::thread & other : others)
  {
    other.join();
  }
}

void
ArrayEngine::TakeTile(const itk::MedialVoxelTileResult & tile)
{
  m_Taker(tile);
}

void
ArrayEngine::UpdateProgress(const float fraction)
{
  m_Call.control.done.store((m_Run + static_cast<double>(fraction)) / m_NumberOfRuns, std::memory_order_relaxed);
}

bool
ArrayEngine::IsAborted() const
{
  return m_Call.control.stop.load(std::memory_order_relaxed) != 0;
}

void
ArrayEngine::Advance(std::uint64_t)
{}

} // end namespace medialvoxel
