// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobRun_h
#define medialvoxelJobRun_h

#include "Job.h"
#include "LabelMapRun.h"
#include "PieceLoop.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class JobRun
 * \brief Runs the tasks of a planned job over ranges of slices of its volume, for its products. */
class JobRun
{
public:
  /** Starts the products of a job whose volume is prepared. \param job must outlive it, as the outputs must */
  JobRun(Job & job, OutputSet & outputs, ProgressSink & sink);

  /** Adds the memory of reading and of passes over a label map. */
  static void
  AddTo(Footprint & footprint, const Job & job);

  /** Decides how walls are measured; to be called once before the first range.
   * \throw StoppedBySignal when the sink asks to stop. */
  void
  Prepare();

  /** Computes a range, and reads the one that comes next, if any; writing it may still be under way.
   * \return its sums, with the time of the distances but not their counts
   * \throw StoppedBySignal when the sink asks to stop. */
  itk::MedialVoxelSums
  Run(const SliceRange & range, const SliceRange & nextRange = {});

  /** Waits until all is written; throws the failures. */
  void
  Wait()
  {
    m_Writer.Wait();
  }

  /** Gives back the memory of results, after an error as well. */
  void
  Release();

  /** After the last range: adds the objects to the result and gives back all memory of the engines. */
  void
  Finish();

  InputVolume &
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

  /** Runs and stops of it. */
  PieceLoop &
  GetLoop()
  {
    return m_Loop;
  }

private:
  struct Engine
  {
    VolumeFiller                 filler;
    std::unique_ptr<PieceEngine> engine;
  };

  static void
  AddWalls(Footprint &                            footprint,
           const VolumeHeader &                   header,
           const itk::MedialVoxelLocalThickness & thickness,
           bool                                   followsExtraction);

  void
  AddProduct(Product & product);

  /** Moves the end of a range to where all balls are known that reach it, unless no range follows. */
  void
  WaitForWalls(SliceRange & range, SliceRange & nextRange);

  /** The number of objects of a label map is known once it is prepared. */
  void
  ReserveForObjects();

  Job &                         m_Job;
  std::optional<ExtractOptions> m_Walls;
  InputVolume *                 m_Input;
  PieceLoop                     m_Loop;
  std::vector<Engine>           m_Engines; ///< in the order of the tasks
  std::unique_ptr<LabelMapRun>  m_Objects; ///< of a label map
  std::uint64_t                 m_SlicesOfBalls{ 0 };
  SliceRange                    m_Extracted{}; ///< the last range of the extraction
  SliceRange                    m_Painted{};   ///< and of the local thickness that follows it
  WriteBehind                   m_Writer;      // ends before its files
};

/** Each cell must have been decided once. \throw JobError Failure */
void
CheckCounts(const itk::MedialVoxelCounts & counts);

} // end namespace medialvoxel

#endif
