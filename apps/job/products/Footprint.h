// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFootprint_h
#define medialvoxelFootprint_h

#include "OutputRequest.h"
#include "ProductFootprint.h"

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelGrid.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

namespace medialvoxel
{

/** An engine with its windows and results. */
struct EngineFootprint
{
  VolumeFiller                   filler{ VolumeFiller::Extraction };
  itk::MedialVoxelEngineSettings settings{};
  std::uint64_t                  perVoxel{ 0 }; ///< bytes of its results
};

/** The memory of a job in bytes, and its space on the disk beside the outputs: all that runs adds itself. */
struct Footprint
{
  static constexpr std::uint64_t AllRows = std::numeric_limits<std::uint64_t>::max();

  itk::MedialVoxelGrid         grid;
  std::vector<EngineFootprint> engines;              ///< they take turns on each piece; the extraction is the first
  std::uint64_t                beside{ 0 };          ///< independent of pieces
  std::uint64_t                ofEnd{ 0 };           ///< of the end of the job, when the engines are gone
  std::uint64_t                perThread{ 0 };       ///< of threads that read, beyond their fixed share
  std::uint64_t                saving{ 0 };          ///< of a process that saves its results
  std::uint64_t                perVoxelOfUnion{ 0 }; ///< of the passes over a piece, beside its results; 0: one pass
  std::uint64_t                surplusTakers{ 0 };   ///< products that share the surplus
  PieceSurplus                 surplus;              ///< results that wait for their piece to be done
  std::uint64_t                slicesOfLayer{ 1 };   ///< pieces have a multiple of it where they can: a layer of chunks
  std::uint64_t                rowsOfLayer{ AllRows };   ///< slices may be done in multiples of it; 0: some cannot
  bool                         needsSlices{ true };      ///< slices are done as a whole
  bool                         keepsGrayValues{ false }; ///< windows hold them beside the object
  bool                         readsInput{ false };      ///< who takes results reads the input, as the engines do
  ScratchSpace                 scratch;                  ///< of files that grow with the results

  /** Counts in who sees the tiles of the extraction, and others. */
  void
  Add(const ProductFootprint & product)
  {
    if (product.perVoxelOfTile > 0)
    {
      auto & extraction = std::get<itk::MedialVoxelSheetExtraction>(engines.front().settings.task);
      extraction.isObserved = true;
      extraction.observerBytesPerVoxel += product.perVoxelOfTile;
    }
    beside += product.beside;
    saving += product.saving;
    surplus.most += product.surplus.most;
    surplus.planned += product.surplus.planned;
    surplus.mostOfSlice += product.surplus.mostOfSlice;
    surplus.shareOfRest = std::min(surplus.shareOfRest, product.surplus.shareOfRest);
    surplusTakers += product.surplus.most > 0 ? 1 : 0;
    scratch.folder = product.scratch.bytes > 0 ? product.scratch.folder : scratch.folder;
    scratch.bytes += product.scratch.bytes;
  }

  /** Bytes of results for each voxel of a piece: one engine after the other gives its own. */
  std::uint64_t
  GetResults() const
  {
    std::uint64_t most = 1;
    for (const EngineFootprint & engine : engines)
    {
      most = std::max(most, engine.perVoxel);
    }
    return perVoxelOfUnion > 0 ? 2 * most + perVoxelOfUnion : most;
  }

  /** Rows of slices that are done in rows, a multiple of it; 0: as a whole. */
  std::uint64_t
  GetRows() const
  {
    return needsSlices || rowsOfLayer == AllRows ? 0 : rowsOfLayer;
  }
};

} // end namespace medialvoxel

#endif
