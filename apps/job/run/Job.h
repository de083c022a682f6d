// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJob_h
#define medialvoxelJob_h

#include "Footprint.h"
#include "InputVolume.h"
#include "JobResult.h"
#include "Options.h"
#include "Product.h"
#include "Progress.h"

#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace medialvoxel
{

/** A task of an engine, and the volumes that it fills. */
struct JobTask
{
  VolumeFiller               filler;
  itk::MedialVoxelEngineTask task;
  bool                       keepsGrayValues{ false }; ///< of the voxels in its windows
};

/** The differences between the ends of jobs. */
struct JobEnd
{
  InputVolume *         input{ nullptr }; ///< of the run, if this process had one
  std::function<void()> recordCosts;      ///< fills in time and memory of the job
  std::function<void()> publish;          ///< gives the outputs their names
};

/** \struct Job
 * \brief The work of a command on a volume: the tasks and products that it plans and then runs. */
struct Job
{
  /** Checks all that the options and the header tell, for ExtractOptions, DistanceOptions, or PartOptions.
   * \throw JobError */
  template <typename TOptions>
  explicit Job(const TOptions & wanted);

  /** A job on a header that was read, without checks. */
  template <typename TOptions>
  Job(const TOptions & wanted, VolumeHeader header);

  Job(const Job &) = delete;

  /** Checks the outputs and plans the job, before anything is written.
   * \param isShared processes work on parts of it, with the memory that each of them takes
   * \throw JobError */
  void
  Plan(bool isShared = false);

  /** Plans one of these processes on this machine: the outputs exist already and are being written.
   * \throw JobError Refused when nothing fits */
  void
  PlanProcess();

  /** Begins to unpack a compressed volume, and measures the values that must be known before the run. The sink must
   * outlive the reading.
   * \throw JobError; StoppedBySignal when the sink asks to stop */
  void
  Open(const ProgressSink & sink);

  /** Warns of values that are no mask, where no threshold makes one of them. After Open(). */
  void
  CheckValues(ProgressSink & sink);

  /** Opens the volume and reads what must be known of all of it: the objects, noise, and thick walls, for which the
   * maximum thickness rises. \throw StoppedBySignal when the sink asks to stop; as InputVolume::Prepare() */
  void
  Prepare(ProgressSink & sink);

  /** Finds out from the prepared volume how walls are measured. \throw as FindWallMeasure() */
  void
  Measure(const ReadObserver & observer);

  /** Ends it: volumes, products, costs, texts, names; then the sink hears of new warnings.
   * \throw StoppedBySignal when the sink asks to stop; no output has its name then. */
  void
  Finish(OutputSet & outputs, ProgressSink & sink, const JobEnd & end);

  /** All that it takes, as its tasks and products say. */
  Footprint
  GetFootprint(bool isShared = false) const;

  /** The extraction whose walls are measured, if any are. */
  std::optional<ExtractOptions>
  GetWalls() const;

  /** Its name, for a reader. */
  const char *
  GetTitle() const;

  std::variant<ExtractOptions, DistanceOptions, PartOptions> command;

  JobOptions &         options; ///< of the command
  JobResult            result;
  std::vector<JobTask> tasks; ///< in the order in which they run, the extraction first
  ProductList          products;

  std::unique_ptr<InputVolume> volume;                    ///< once it is prepared
  double                       shareOfPreparation{ 0.0 }; ///< of the progress

  /** Of the progress, when it ends with Finish(). */
  double
  GetShareOfEnd() const;

private:
  std::unique_ptr<InputVolume>
  OpenVolume() const;

  /** Keeps the maximum thickness that walls need, and makes tasks and products with it. */
  void
  UseMaximum(double maximum);
};

} // end namespace medialvoxel

#endif
