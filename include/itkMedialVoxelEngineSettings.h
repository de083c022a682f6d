// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelEngineSettings_h
#define itkMedialVoxelEngineSettings_h

#include "itkMedialVoxelEnums.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelScan.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace itk
{

class MedialVoxelTileObserver;
class MedialVoxelWallBalls;

/** \struct MedialVoxelSheetExtraction
 * \brief The task to label the medial cells and to measure them.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelSheetExtraction
{
  /** Range of the object's values, of which one end may be infinite, and their materials when known. */
  struct GrayRange
  {
    double                         lower;
    double                         upper;
    std::optional<MedialVoxelScan> scan{};
  };

  MedialVoxelParameters parameters;

  /** Boundary that vectors lead to; none without vectors. */
  std::optional<MedialVoxelBoundary> vectorBoundary;

  /** Measure the walls at all medial cells. */
  bool measuresThickness{ false };

  /** Find the geodesic distance of the pair of each cell. */
  bool findsImportance{ false };

  /** Find the thresholds that it is compared with, too. */
  bool findsImportanceThreshold{ false };

  /** Measure walls on the gray values of the voxels; unset: on the object. */
  std::optional<GrayRange> grayRange;

  /** Find the levels of the cells, for MedialVoxelSameTopology. */
  bool findsLevels{ false };

  /** Whether observers see the tiles, and their memory for each voxel of the tile of a worker. */
  bool          isObserved{ false };
  std::uint64_t observerBytesPerVoxel{ 0 };

  /** Observers; must outlive the runs. Not needed for planning. */
  std::vector<MedialVoxelTileObserver *> observers;

  /** Let \a observer see the tiles, and count its memory. */
  void
  AddObserver(MedialVoxelTileObserver & observer);

  /** Whether later steps need the cells of a tile. */
  bool
  KeepsRows() const
  {
    return measuresThickness || isObserved;
  }
};

/** \struct MedialVoxelDistanceMap
 * \brief The task to find the nearest boundary voxel of each voxel.
 * \ingroup MedialVoxel
 */
struct MedialVoxelDistanceMap
{
  MedialVoxelBoundary boundary{ MedialVoxelBoundary::Object };
  MedialVoxelRegion   region{ MedialVoxelRegion::Both };
  double              maximumDistance{ std::numeric_limits<double>::infinity() };

  /** Find where the boundary voxels are; false: perhaps only their distances, which is faster. */
  bool findsDisplacements{ true };
};

/** \struct MedialVoxelLocalThickness
 * \brief The task to find, for each object voxel, the diameter of the largest ball inside the object that covers it, or
 * the thickness of the wall whose ball is the largest that covers it.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelLocalThickness
{
  /** Diameter at which balls are cut, in the units of the spacing; positive and finite. */
  double maximumThickness{ 0.0 };

  /** Components of at most so many voxels change sides: of the background inside the object, then of the object. */
  std::uint64_t maximumPoreSize{ 0 };

  /** The extraction whose walls are painted, with its own maximumPoreSize; its other results are ignored. Unset:
   * diameters of balls are painted. */
  std::optional<MedialVoxelSheetExtraction> walls;

  /** Balls that another extraction of the same walls finds before; those that it does not find are added. Unset: all
   * are found. */
  std::shared_ptr<MedialVoxelWallBalls> balls;

  /** Largest ratio of the maximum thickness to the smallest spacing, and its default, to the largest. */
  static constexpr double MostVoxels = 256.0;
  static constexpr double DefaultVoxels = 32.0;

  static double
  GetDefaultMaximum(const MedialVoxelGrid & grid);

  /** The largest that is allowed. */
  static double
  GetLargestMaximum(const MedialVoxelGrid & grid);
};

using MedialVoxelEngineTask =
  std::variant<MedialVoxelSheetExtraction, MedialVoxelDistanceMap, MedialVoxelLocalThickness>;

/** \struct MedialVoxelEngineSettings
 * \brief A task, and the division of its work, which has no influence on results.
 * \ingroup MedialVoxel
 */
struct MedialVoxelEngineSettings
{
  MedialVoxelEngineTask task;

  /** Count the voxels whose value is not a number. */
  bool countsNotANumber{ false };

  /** Edge of the tiles; 0 chooses. */
  std::int64_t tileSize{ 0 };

  /** Extent of the slabs along the slowest axis; 0 chooses. */
  std::int64_t slabThickness{ 0 };

  /** Limit in bytes on the memory of windows and workers; 0 is without limit. */
  std::uint64_t memoryLimit{ 0 };

  /** Workers at the same time. */
  unsigned int numberOfWorkers{ 1 };

  /** Prepare a second window for the next slab while this one is processed, if there are several workers and enough
   * memory. */
  bool readsAhead{ true };
};

} // end namespace itk

#endif
