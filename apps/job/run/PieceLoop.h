// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPieceLoop_h
#define medialvoxelPieceLoop_h

#include "InputVolume.h"
#include "JobPlan.h"
#include "PieceEngine.h"
#include "Progress.h"
#include "WriteBehind.h"

#include <cstdint>
#include <functional>

namespace medialvoxel
{

/** \class PieceLoop
 * \brief Runs and writes the pieces of a job, reports to the sink, and stops when asked. */
class PieceLoop
{
public:
  /** \param enginesPerPiece engines that each piece is given to, for the progress */
  PieceLoop(const JobPlan & plan, const VolumeHeader & header, unsigned int enginesPerPiece, ProgressSink & sink);

  /** The observer for the engines. */
  PieceObserver
  GetObserver();

  /** What the engines read, and the shares of the progress that preparing it was, and that comes after the loop. */
  void
  SetInput(const InputVolume & input, double shareOfPreparation, double shareOfEnd)
  {
    m_Input = &input;
    m_ShareOfPreparation = shareOfPreparation;
    m_ShareOfEnd = shareOfEnd;
  }

  /** Runs a piece and has its results written, in smaller ones when the walls need more memory than results of this
   * size leave. The piece that comes next, if any, is read meanwhile.
   * \return its sums
   * \throw StoppedBySignal when the sink asks to stop. */
  itk::MedialVoxelSums
  Run(PieceEngine & engine, const SliceRange & piece, const SliceRange & nextPiece, WriteBehind & writer);

  void
  ThrowIfStopRequested() const;

  /** Slices of which the progress is the part done; all of them by default. */
  void
  SetSlicesToDo(std::uint64_t slices)
  {
    m_SlicesToDo = slices;
  }

  /** A plan with other limits of memory. */
  void
  SetPlan(const JobPlan & plan)
  {
    m_Plan = plan;
  }

  /** For the progress, when each piece is given to an engine several times. */
  void
  SetRunsPerPiece(unsigned int runs)
  {
    m_RunsPerPiece = runs;
  }

private:
  itk::MedialVoxelSums
  RunSlices(PieceEngine & engine, const PieceRange & range, const PieceRange & nextRange, WriteBehind & writer);

  itk::MedialVoxelSums
  RunRange(PieceEngine & engine, const PieceRange & range, const PieceRange & nextRange, WriteBehind & writer);

  /** Rows that are done together; none at the end of the slices. */
  RowRange
  GetRowsFrom(std::uint64_t begin) const;

  std::uint64_t
  CountVoxels(const PieceRange & range) const;

  void
  RecordPiece(const PieceEngine & engine, const PieceRange & range, double seconds, std::uint64_t recomputedVoxels);

  /** Takes a share of the slices that are done at once. */
  void
  ShortenPieces(const PieceEngine & engine, double share, const char * reason);

  JobPlan        m_Plan;
  std::uint64_t  m_SlicesAtOnce;
  std::uint64_t  m_SlicesToDo;
  std::uint64_t  m_VoxelsPerSlice;
  std::uint64_t  m_RowsPerSlice;
  unsigned int   m_EnginesPerPiece;
  unsigned int   m_RunsPerPiece{ 1 };
  ProgressSink & m_Sink;

  const InputVolume * m_Input{ nullptr };
  double              m_ShareOfPreparation{ 0.0 };
  double              m_ShareOfEnd{ 0.0 };
  std::uint64_t       m_DoneVoxels{ 0 };
  std::uint64_t       m_VoxelsOfRange{ 0 };
  double              m_FractionOfRange{ 0.0 }; // that is done
};

} // end namespace medialvoxel

#endif
