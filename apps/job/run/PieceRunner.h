// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPieceRunner_h
#define medialvoxelPieceRunner_h

#include "InputVolume.h"
#include "JobPlan.h"
#include "Options.h"
#include "OutputRequest.h"
#include "RunnerSums.h"

#include "itkMedialVoxelTileObserver.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** Results of one piece: as many voxels as the piece has, x fastest; null where nothing was asked for. */
struct PieceResults
{
  std::array<const void *, NumberOfVolumeContents> voxels{};
  bool                                             isEmpty{ false }; ///< true: all is known to be zero

  const void *&
  operator[](VolumeContent content)
  {
    return voxels[static_cast<std::size_t>(content)];
  }
  const void *
  operator[](VolumeContent content) const
  {
    return voxels[static_cast<std::size_t>(content)];
  }
};

/** Hears the progress of a piece from 0 to 1, and answers true to stop. */
using PieceObserver = std::function<bool(double)>;

/** \class PieceRunner
 * \brief One filter on one input, run for one range of slices after the other. */
class PieceRunner
{
public:
  virtual ~PieceRunner() = default;

  /** What it computes, in one word. */
  virtual const char *
  GetName() const = 0;

  /** Geometry of the labels, or of the vectors for a runner without labels. */
  virtual VolumeGeometry
  GetGeometry() const = 0;

  /** Slices are indices along the last axis. The results are valid until the next run, or Release(). */
  virtual PieceResults
  Run(std::uint64_t firstSlice, std::uint64_t numberOfSlices) = 0;

  /** Makes results valid until the run after the next one begins, which takes their memory twice. */
  virtual void
  KeepPreviousResults() = 0;

  /** Lets someone see the tiles, in a runner of labels; others have none to show. Must outlive the runs. */
  virtual void
  SetTileObservers(const std::vector<itk::MedialVoxelTileObserver *> &)
  {}

  /** Sets what windows and threads may take from the next run on, in bytes; 0 is without limit. */
  virtual void
  SetMemoryLimit(std::uint64_t bytes) = 0;

  /** Gives back the memory of the results. */
  virtual void
  Release() = 0;

  virtual RunnerSums
  GetSums() const = 0;
};

/** How a filter cuts its work, which changes no result; 0: as it chooses. */
struct CutSettings
{
  std::uint64_t slabThickness{ 0 };
  std::uint64_t memoryLimit{ 0 };
};

CutSettings
GetCutSettings(const JobPlan & plan);

/** Settings of the distance filter that a job needs. */
struct DistanceSettings
{
  itk::MedialVoxelBoundary boundary{ itk::MedialVoxelBoundary::Object };
  itk::MedialVoxelRegion   region{ itk::MedialVoxelRegion::Both };
  bool                     generateDistance{ false };
  std::optional<double>    maximumDistance;
  CutSettings              cut;
};

template <typename TPixel>
std::unique_ptr<PieceRunner>
MakeExtractRunnerFor(InputVolume & input,
                     const VolumeHeader &,
                     const ExtractOptions &,
                     const CutSettings &,
                     const PieceObserver &);
template <typename TPixel>
std::unique_ptr<PieceRunner>
MakeDistanceRunnerFor(InputVolume & input,
                      const VolumeHeader &,
                      const JobOptions &,
                      const DistanceSettings &,
                      const PieceObserver &);

/** Opens a volume that ReadVolumeHeader() has checked. One that does not stream becomes a mask of the object that the
 * options describe, in memory or, when a scratch folder is given, in a file there.
 * \throw JobError Refused when the scratch folder has no space. */
std::unique_ptr<InputVolume>
OpenInputVolume(const VolumeHeader & header, const JobOptions & options, const std::filesystem::path & scratchFolder);

/** The runner of MedialVoxelImageFilter for the pixel type of the header. The input must outlive it. */
std::unique_ptr<PieceRunner>
MakeExtractRunner(InputVolume &          input,
                  const VolumeHeader &   header,
                  const ExtractOptions & options,
                  const CutSettings &    cut,
                  const PieceObserver &  observer);

/** The runner of VectorDistanceMapImageFilter for the pixel type of the header. The input must outlive it. */
std::unique_ptr<PieceRunner>
MakeDistanceRunner(InputVolume &            input,
                   const VolumeHeader &     header,
                   const JobOptions &       options,
                   const DistanceSettings & settings,
                   const PieceObserver &    observer);

} // end namespace medialvoxel

#endif
