// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelExtractRun_h
#define medialvoxelExtractRun_h

#include "JobResult.h"
#include "OutputSet.h"
#include "PieceLoop.h"
#include "Survey.h"

#include <functional>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** Opens the input to find out. */
VolumeGeometry
FindLabelGeometry(const ExtractOptions & options, const VolumeHeader & header);

/** \class ExtractRun
 * \brief Computes ranges of slices of an opened volume and has them written to the volumes of a job. */
class ExtractRun
{
public:
  /** \param job header and plan */
  ExtractRun(const ExtractOptions & options, const JobResult & job, ProgressSink & sink);

  VolumeGeometry
  GetLabelGeometry() const
  {
    return m_Runner->GetGeometry();
  }

  /** Has results of a request written to a volume. */
  void
  AddVolume(const VolumeRequest & request, VoxelOutput & volume);

  /** Lets someone see the tiles beside the survey. */
  void
  AddObserver(itk::MedialVoxelTileObserver & observer);

  /** For the progress, when not all of the slices are to be done. */
  void
  SetSlicesToDo(std::uint64_t slices);

  /** To be called once before the first range, when the volumes and observers are set.
   * \throw StoppedBySignal when the sink asks to stop. */
  void
  Prepare();

  /** Computes a range; writing it may still be under way.
   * \throw StoppedBySignal when the sink asks to stop. */
  void
  Run(const SliceRange & range);

  /** Waits until all is written; throws what failed. */
  void
  Wait();

  /** Gives back the memory of results, after an error as well. */
  void
  Release();

  /** Gives back all memory of the filters, of which nothing can be asked any more. */
  void
  DropFilters();

  /** Of all filters and ranges so far. */
  RunnerSums
  GetSums() const;

  Survey &
  GetSurvey()
  {
    return m_Survey;
  }

  const InputVolume &
  GetInput() const
  {
    return *m_Input;
  }

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
  struct Destination
  {
    VolumeContent content;
    VolumeFiller  filler;
    VoxelOutput * volume;
  };

  /** Results of a filter. */
  void
  Write(VolumeFiller filler, const PieceLoop::Range & range, const PieceResults & results);

  const ExtractOptions &       m_Options;
  std::unique_ptr<InputVolume> m_Input;
  PieceLoop                    m_Loop;
  std::unique_ptr<PieceRunner> m_Runner;
  std::unique_ptr<PieceRunner> m_DistanceRunner;
  Survey                       m_Survey;

  std::vector<itk::MedialVoxelTileObserver *> m_Observers;
  std::vector<Destination>                    m_Destinations;
  WriteBehind                                 m_Writer; // ends before what it writes
};

} // end namespace medialvoxel

#endif
