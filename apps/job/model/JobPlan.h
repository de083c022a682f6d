// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelJobPlan_h
#define medialvoxelJobPlan_h

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace medialvoxel
{

/** Slices along the last axis, begin to end, the end excluded. */
struct SliceRange
{
  std::uint64_t begin{ 0 };
  std::uint64_t end{ 0 };
};

/** Rows of slices, begin to end, the end excluded. */
struct RowRange
{
  std::uint64_t begin{ 0 };
  std::uint64_t end{ 0 };
};

/** First and last slice. */
std::string
FormatSlices(const SliceRange & slices);

constexpr std::uint64_t NoMemoryLimit = std::numeric_limits<std::uint64_t>::max();

/** Space that files without a name take beside the outputs. */
struct ScratchSpace
{
  std::filesystem::path folder;
  std::uint64_t         bytes{ 0 };
};

/** The memory of a job, in bytes. */
struct PlannedMemory
{
  std::uint64_t planned{ 0 };       ///< peak of the process for walls of up to PlannedWallThickness
  std::uint64_t limit{ 0 };         ///< that the process keeps, or fails, whatever the walls
  std::uint64_t fixed{ 0 };         ///< depends neither on pieces nor on windows
  std::uint64_t perSlice{ 0 };      ///< results of the rows that are done at once
  std::uint64_t surplus{ 0 };       ///< for cells that wait until a piece is done; counted in fixed
  std::uint64_t surplusTakers{ 1 }; ///< that share it
  std::uint64_t toKeep{ 0 };        ///< of chunks of the input whose further slices are needed; counted in fixed
  std::uint64_t unpacked{ 0 };      ///< of the values of a compressed volume; 0: it is not compressed
};

/** How a job will be done, decided before it starts. */
struct JobPlan
{
  std::uint64_t numberOfSlices{ 0 };
  std::uint64_t divisions{ 1 };
  std::uint64_t sliceUnit{ 1 };    ///< pieces, but the last one, have a multiple of it
  std::uint64_t slicesAtOnce{ 0 }; ///< most slices that are done before they are written; 0: all of a piece
  std::uint64_t rowsAtOnce{ 0 };   ///< rows of the slices that are done after each other; 0: all
  unsigned int  threads{ 1 };
  std::uint64_t slabThickness{ 0 }; ///< slices that the engines process between two pulls of input; 0: they choose
  std::uint64_t slabSlices{ 1 };    ///< the same, or the engine's choice

  PlannedMemory memory;
  bool          writesBehind{ false }; ///< a piece is written while the next one is computed: both are in memory
  bool          readsAhead{ true };    ///< a second window is prepared for the next slab
  std::uint64_t numberOfEngines{ 1 };  ///< that keep windows

  ScratchSpace          growingScratch; ///< of files that grow with the results, as planned
  std::filesystem::path scratchFolder;  ///< of the values of a compressed volume; empty: they are in memory
  std::uint64_t         disk{ 0 };      ///< of all outputs; with sparse outputs the most they can grow to

  SliceRange
  GetPiece(std::uint64_t piece) const;

  /** The piece after this one, empty after the last one. */
  SliceRange
  GetNextPiece(std::uint64_t piece) const
  {
    return piece + 1 < divisions ? this->GetPiece(piece + 1) : SliceRange{};
  }

  /** Memory for the windows and threads of each engine beside the results of so many slices; 0 is without limit. */
  std::uint64_t
  GetEngineLimit(std::uint64_t slices) const;

  /** Memory of the results when pieces have so many slices. */
  std::uint64_t
  GetResults(std::uint64_t slices) const
  {
    return slices * memory.perSlice * (writesBehind ? 2 : 1);
  }

  std::uint64_t
  GetSurplusShare() const
  {
    return memory.surplus / memory.surplusTakers;
  }

  std::uint64_t
  GetNumberOfUnits() const
  {
    return (numberOfSlices + sliceUnit - 1) / sliceUnit;
  }

  /** Slices of the largest piece, which is the first one. */
  std::uint64_t
  GetMaximumSlices() const;

  /** Slices whose results are in memory together. */
  std::uint64_t
  GetSlicesAtOnce() const;
};

/** Walls, in voxels, whose distances the planned windows hold. Thicker walls take the rest of memoryLimit. */
constexpr unsigned int PlannedWallThickness = 16;

} // end namespace medialvoxel

#endif
