// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelExtractRun_h
#define medialvoxelExtractRun_h

#include "Surveys.h"
#include "JobResult.h"
#include "LabelMapRun.h"
#include "OutputSet.h"
#include "PieceLoop.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** The task that the options describe, without who sees the tiles. */
itk::MedialVoxelExtraction
MakeExtraction(const ExtractOptions & options, const VolumeHeader & header);

/** A task beside the extraction, and the volumes that it fills. */
struct FurtherTask
{
  VolumeFiller               filler;
  itk::MedialVoxelEngineTask task;
};

/** Those that the outputs need, in the order in which they run. */
std::vector<FurtherTask>
ListFurtherTasks(const ExtractOptions & options, const VolumeHeader & header);

/** \class ExtractRun
 * \brief Computes ranges of slices of an opened volume and has them written to the volumes of a job. */
class ExtractRun
{
public:
  /** \param job header and plan */
  ExtractRun(const ExtractOptions & options, const JobResult & job, ProgressSink & sink);

  /** Has results of a request written to a volume. */
  void
  AddVolume(const VolumeRequest & request, VoxelOutput & volume);

  /** Lets someone see the tiles beside the survey. */
  void
  AddObserver(itk::MedialVoxelTileObserver & observer);

  /** Lets a mesh see the tiles. */
  void
  AddMesh(SurfaceMesh & mesh);

  /** For the progress, when not all of the slices are to be done. */
  void
  SetSlicesToDo(std::uint64_t slices);

  /** To be called once before the first range, when the volumes and observers are set.
   * \throw StoppedBySignal when the sink asks to stop. */
  void
  Prepare();

  /** Memory that the objects of a label map take beyond the plan; to be asked when it is prepared. */
  std::uint64_t
  GetUnplannedBytes() const;

  /** A plan with other limits of memory, before the first range. */
  void
  SetPlan(const JobPlan & plan);

  /** Computes a range, and reads the one that comes next, if any; writing it may still be under way.
   * \return its sums, with the time of the distances but not their counts
   * \throw StoppedBySignal when the sink asks to stop. */
  itk::MedialVoxelSums
  Run(const SliceRange & range, const SliceRange & nextRange = {});

  /** Waits until all is written; throws what failed. */
  void
  Wait();

  /** Gives back the memory of results, after an error as well. */
  void
  Release();

  /** Gives back all memory of the engines, which cannot run any more. */
  void
  DropEngines();


  /** How walls are measured, when gray values were looked at; to be asked when the run is prepared. */
  const std::optional<WallMeasure> &
  GetMeasure() const
  {
    return m_Measure;
  }

  /** What was found of the objects of a label map; null for other volumes. */
  Json
  SummarizeObjects() const;

  Surveys &
  GetSurveys()
  {
    return m_Surveys;
  }

  const InputVolume &
  GetInput() const
  {
    return *m_Input;
  }

  /** Finds the edges of the part from the rims of its surface; empty for label maps, whose objects touch. It reads the
   * input again, after the last range. */
  itk::MedialVoxelMeasureRimRays
  MakeRimRays() const;

  /** Seconds that writing took; to be asked when nothing is under way. */
  double
  GetWriteSeconds() const
  {
    return m_Writer.GetSeconds();
  }

  void
  ThrowIfStopRequested() const
  {
    m_Loop.ThrowIfStopRequested();
  }

private:
  void
  ChooseMeasure();

  /** The engine that makes what a volume holds. */
  PieceEngine &
  GetEngine(VolumeFiller filler);

  struct FurtherEngine
  {
    VolumeFiller                 filler;
    std::unique_ptr<PieceEngine> engine;
  };

  ExtractOptions               m_Options;
  VolumeHeader                 m_Header;
  std::optional<WallMeasure>   m_Measure;
  std::unique_ptr<InputVolume> m_Input;
  PieceLoop                    m_Loop;
  std::unique_ptr<PieceEngine> m_Engine;
  std::vector<FurtherEngine>   m_FurtherEngines;
  Surveys                      m_Surveys;
  std::unique_ptr<LabelMapRun> m_Objects; ///< of a label map
  LabelSelection               m_Labels;  ///< the same
  WriteBehind                  m_Writer;  // ends before what it writes
};

} // end namespace medialvoxel

#endif
