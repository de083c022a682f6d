// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobParts_h
#define medialvoxelJobParts_h

#include "Text.h"
#include "VolumeJob.h"
#include "WriteBehind.h"

#include "itkMacro.h"

#include <chrono>
#include <functional>
#include <new>
#include <utility>

namespace medialvoxel
{

using JobClock = std::chrono::steady_clock;

inline double
SecondsSince(JobClock::time_point start)
{
  return std::chrono::duration<double>(JobClock::now() - start).count();
}

/** The candidates that have a name. */
std::vector<OutputRequest>
SelectOutputs(const std::vector<OutputRequest> & candidates);

/** What all jobs do before their work begins: header, outputs, plan, threads. Candidates without a name drop out. */
JobResult
PrepareJob(const JobOptions &                 options,
           VolumeHeader                       header,
           const std::vector<OutputRequest> & candidates,
           const PieceFootprint &             footprint);

/** Lets the process keep to the plan: its threads, and memory that is given back. */
void
PrepareProcess(const JobPlan & plan);

/** The image of the header in the units of the options. */
itk::MedialVoxelGrid
GetGrid(const JobOptions & options, const VolumeHeader & header);

/** Counts in a filter on the volume of the header. */
void
AddEngine(PieceFootprint & footprint, const VolumeHeader & header, const itk::MedialVoxelEngineTask & task);

/** Slices of a layer of chunks of the .zarr outputs; 1 without any. */
std::uint64_t
GetSlicesOfLayer(const VolumeHeader & header, const std::vector<OutputRequest> & candidates);

/** Counts in what outputs take beside the results of a piece. */
void
AddOutputs(PieceFootprint &                   footprint,
           const JobOptions &                 options,
           const VolumeHeader &               header,
           const std::vector<OutputRequest> & candidates);

CutSettings
GetCutSettings(const JobPlan & plan);

/** Float32 vectors with as many components as the volume has dimensions. */
VoxelLayout
GetVectorLayout(const VolumeHeader & header);

constexpr VoxelLayout LabelLayout{ PixelType::UInt8, 1 };
constexpr VoxelLayout DistanceLayout{ PixelType::Float32, 1 };
constexpr VoxelLayout ThicknessLayout{ PixelType::Float32, 1 };

/** First and last slice. */
std::string
FormatSlices(const SliceRange & slices);

/** \class PieceLoop
 * \brief Runs the pieces of a job, has them written, tells the sink, and stops when asked. */
class PieceLoop
{
public:
  /** \param runnersPerPiece runners that each piece is given to, for the progress */
  PieceLoop(const JobPlan & plan, const VolumeHeader & header, unsigned int runnersPerPiece, ProgressSink & sink);

  /** To be handed to the runners. */
  PieceObserver
  GetObserver();

  /** Slices, and the same as voxels. */
  struct Range
  {
    SliceRange    slices;
    std::uint64_t firstVoxel;
    std::uint64_t numberOfVoxels;
  };

  /** Takes the results of a range, in the thread of the writer. */
  using WriteFunction = std::function<void(const Range &, const PieceResults &)>;

  /** Prepares the input, which is a part of the job's progress when it takes long.
   * \throw StoppedBySignal when the sink asks to stop. */
  void
  Prepare(InputVolume & input);

  /** Runs a piece, in smaller ones when the walls need more memory than results of this size leave.
   * \throw StoppedBySignal when the sink asks to stop. */
  void
  Run(PieceRunner & runner, const SliceRange & piece, WriteBehind & writer, const WriteFunction & write);

  void
  ThrowIfStopRequested() const;

  /** Slices of which the progress is the part done; all of them by default. */
  void
  SetSlicesToDo(std::uint64_t slices)
  {
    m_SlicesToDo = slices;
  }

private:
  void
  RunSlices(PieceRunner & runner, const SliceRange & slices, WriteBehind & writer, const WriteFunction & write);

  void
  RecordPiece(const PieceRunner & runner, const SliceRange & slices, double seconds, std::uint64_t recomputedVoxels);

  /** Halves the slices that are done at once. */
  void
  ShortenPieces(const PieceRunner & runner, const char * reason);

  JobPlan        m_Plan;
  std::uint64_t  m_SlicesAtOnce;
  std::uint64_t  m_SlicesToDo;
  std::uint64_t  m_VoxelsPerSlice;
  unsigned int   m_RunnersPerPiece;
  ProgressSink & m_Sink;
  InputVolume *  m_Input{ nullptr };
  double         m_ShareOfPreparation{ 0.0 };
  std::uint64_t  m_DoneSlices{ 0 };
  std::uint64_t  m_SlicesOfPiece{ 0 };
};

/** Peak of the memory that the process kept resident; 0 where the system does not tell. */
std::uint64_t
GetPeakMemoryBytes();

/** Fills in what the job took up to now. */
void
AddMeasurements(JobResult & result, const InputVolume & input, double writeSeconds, JobClock::time_point start);

/** Calls the function and turns failures of the pipeline, such as a file that is gone, into JobError. */
template <typename TFunction>
auto
WithPipelineErrors(TFunction && function)
{
  try
  {
    return function();
  }
  catch (const itk::ExceptionObject & error)
  {
    throw JobError(ExitStatus::Failure, RemoveOrigin(error.GetDescription()));
  }
  catch (const itk::MedialVoxelMemoryError & error)
  {
    Fail(ExitStatus::Refused,
         "the walls are so thick that the windows on the input need at least ",
         FormatBytes(error.GetNeededBytes()),
         ", ",
         FormatBytes(error.GetAllowedBytes()),
         " of the memory are left for them; allow more with --memory");
  }
  catch (const std::bad_alloc &)
  {
    throw JobError(ExitStatus::Failure, "out of memory");
  }
}

} // end namespace medialvoxel

#endif
