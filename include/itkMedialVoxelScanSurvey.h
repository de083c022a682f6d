// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelScanSurvey_h
#define itkMedialVoxelScanSurvey_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelScan.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace itk
{

/** \struct MedialVoxelScanLevels
 * \brief Values of both materials.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelScanLevels
{
  double background{ 0.0 };
  double material{ 0.0 };

  /** Error text for levels that do not fit an object between two thresholds, of which one or both may be infinite;
   * empty when they fit. One of the thresholds must be between the levels, the material in the object. */
  std::string
  FindProblem(double lower, double upper) const;
};

/** \class MedialVoxelScanSurvey
 * \brief Finds materials, blur and noise of a volume from samples of its gray values.
 *
 * - The background is the median of the values of voxels that have no object voxel within 3 voxels, but one within 8.
 *   Voxels near a wall that the object lacks do not count.
 * - The material is the median of values deep in the object: 5.5 voxels, or less when no wall is as thick.
 * - The noise is 1.4826 times the median deviation of the background. Its correlation is the largest ratio of the
 *   variance of means over 3^D and 5^D voxels of the background to that of independent values.
 * - The blur is the median of fits to surfaces of walls of at least 5 voxels.
 * - It is a mask or a label map where background and object have one value each, or where most faces between them are
 *   sharp: the values do not change from the voxels at the face to the voxels behind them. One of four object voxels
 *   is looked at.
 *
 * Of a large volume, it samples some blocks and some of their voxels, chosen by their place, so results do not depend
 * on how the volume is divided. Axes with one voxel do not count.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelScanSurvey
{
public:
  using Boxes = std::vector<MedialVoxelBox>;
  using Work = std::function<void(const MedialVoxelBox &)>;

  /** \struct Source
   * \brief Reads the volume.
   * \ingroup MedialVoxel
   */
  struct Source
  {
    /** Sets the bits of the object voxels of a box, and its values. */
    std::function<void(const MedialVoxelBox & box, MedialVoxelBits & object, MedialVoxelGray & gray)> fill;

    /** Calls \a work for each of the boxes, in any order, also in several threads, which take 7 MiB each. */
    std::function<void(const Boxes & boxes, const Work & work)> forEach;

    /** Called with the share of the blocks that was read, from 0 to 1, one call at a time; may throw to abort. */
    std::function<void(double)> observe;
  };

  using Result = MedialVoxelScanResult;

  /** \param threshold  that cuts the object from the background
   * \param levels     of the materials, when they are known */
  MedialVoxelScanSurvey(const MedialVoxelGrid & grid, double threshold, std::optional<MedialVoxelScanLevels> levels);

  /** Looks at the blocks of a volume.
   * \throw any exception of the functions of the source */
  Result
  Run(const Source & source) const;

private:
  MedialVoxelGrid                      m_Grid;
  double                               m_Threshold;
  std::optional<MedialVoxelScanLevels> m_Levels;
};

} // end namespace itk

#endif
