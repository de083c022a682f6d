// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelInput_h
#define itkMedialVoxelInput_h

#include "itkMedialVoxelEnums.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelExactNumber.h"
#include "itkMedialVoxelObjectMap.h"
#include "itkMedialVoxelRoughness.h"
#include "itkMedialVoxelScanSurvey.h"
#include "itkMedialVoxelSmoothingLevel.h"
#include "itkMedialVoxelValueSource.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace itk
{

/** \struct MedialVoxelObjectRule
 * \brief The values of the object: from a lower to an upper limit, or all but one. NaN is never object.
 *
 * Limits are compared as numbers: between two values of a type they act like the next value inside, and beyond the
 * range of the type like its end.
 * \ingroup MedialVoxel
 */
struct MedialVoxelObjectRule
{
  std::optional<MedialVoxelExactNumber> background{}; ///< all other values are object, whatever the limits are
  MedialVoxelExactNumber                lower{ -std::numeric_limits<double>::infinity() };
  MedialVoxelExactNumber                upper{ std::numeric_limits<double>::infinity() };
};

/** \class MedialVoxelInput
 * \brief The object and the values of an image, for the tasks of a run.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelInput : public MedialVoxelObjectSource
{
public:
  /** Called with the share of the image that a pass before the run has read, from 0 to 1; may throw to abort. */
  using Observer = std::function<void(double)>;

  /** \param source must outlive it */
  explicit MedialVoxelInput(MedialVoxelValueSource & source)
    : m_Source(source)
  {}

  MedialVoxelSourceThreads
  GetSourceThreads() const override;

  std::int64_t
  GetRowsReadTogether() const override;

  /** Read the image once where a decision needs it, before the first Fill(). */
  virtual void
  Prepare(const Observer & observer) = 0;

protected:
  MedialVoxelValueSource &
  GetSource() const
  {
    return m_Source;
  }

private:
  MedialVoxelValueSource & m_Source;
};

/** \class MedialVoxelObjectInput
 * \brief One object, defined by a rule on values. It is smoothed always, never, or when it is rough; values stay.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelObjectInput : public MedialVoxelInput
{
public:
  /** \param image all voxels */
  MedialVoxelObjectInput(MedialVoxelValueSource &      source,
                         const MedialVoxelBox &        image,
                         const MedialVoxelObjectRule & rule,
                         MedialVoxelEnums::Smoothing   smoothing);

  /** Have Prepare() find out whether walls are thicker than a maximum. */
  void
  LookForThickWalls(const MedialVoxelGrid & grid, double maximum)
  {
    m_LookedFor = { grid, maximum };
  }

  /** Take a level that was measured before. */
  void
  UseSmoothingLevel(const std::optional<MedialVoxelSmoothingLevel> & level)
  {
    m_Level = level;
  }

  /** Measures the roughness where the smoothing is automatic, the level of smoothed values where it is needed and not
   * known, and the thick walls that are looked for. */
  void
  Prepare(const Observer & observer) override;

  /** The maximum thickness that the walls need, where the one that was looked for is too small for a quarter of
   * them or more. At most twice as large. Known after Prepare(). */
  const std::optional<double> &
  GetNeededMaximum() const
  {
    return m_NeededMaximum;
  }

  /** Of the object that is not smoothed, if it was measured. */
  const std::optional<MedialVoxelRoughness> &
  GetRoughness() const
  {
    return m_Roughness;
  }

  /** Where the object is smoothed, after Prepare(). */
  const std::optional<MedialVoxelSmoothingLevel> &
  GetSmoothingLevel() const
  {
    return m_Level;
  }

  /** Known after Prepare(). */
  bool
  IsSmoothed() const
  {
    return m_Smoothing == MedialVoxelEnums::Smoothing::On;
  }

  std::int64_t
  GetRowsReadTogether() const override;

  void
  Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets) override;

  /** Bytes that each thread takes to smooth.
   * \param rowsReadTogether of the source */
  static std::uint64_t
  GetBytesToSmooth(const MedialVoxelBox & image, MedialVoxelValueType type, std::int64_t rowsReadTogether);

  /** Threads for which the smallest memory limit has room in a survey. */
  static constexpr unsigned int LeastSurveyThreads = 5;

  /** Find the materials beside a threshold from samples. With two thresholds there is no scan.
   * \param lower, upper thresholds, of which one or both may be infinite
   * \param levels       of the materials, when known
   * \param mostThreads  each takes 7 MiB */
  MedialVoxelScanResult
  SurveyScan(const MedialVoxelGrid &                      grid,
             double                                       lower,
             double                                       upper,
             const std::optional<MedialVoxelScanLevels> & levels,
             const Observer &                             observer,
             unsigned int                                 mostThreads = LeastSurveyThreads);

private:
  struct LookedFor
  {
    MedialVoxelGrid grid;
    double          maximum;
  };

  /** Roughness and thick walls, in one pass. */
  void
  ExamineObject(bool measuresRoughness, const Observer & observer);

  /** Reads values until no further one changes the level. */
  MedialVoxelSmoothingLevel
  FindSmoothingLevel(const Observer & observer);

  MedialVoxelBox                           m_Image;
  MedialVoxelObjectRule                    m_Rule;
  MedialVoxelEnums::Smoothing              m_Smoothing;
  std::optional<MedialVoxelRoughness>      m_Roughness;
  std::optional<MedialVoxelSmoothingLevel> m_Level;
  std::optional<LookedFor>                 m_LookedFor;
  std::optional<double>                    m_NeededMaximum;
};

/** \class MedialVoxelLabelInput
 * \brief Many objects, each with its own value, processed in passes.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelLabelInput
  : public MedialVoxelInput
  , public MedialVoxelObjectMap
{
public:
  /** \param image all voxels
   * \param labels          values of objects, none of them 0; empty: all values but 0
   * \param maximumPoreSize of the extraction */
  MedialVoxelLabelInput(MedialVoxelValueSource &          source,
                        const MedialVoxelBox &            image,
                        const std::vector<std::int64_t> & labels,
                        std::uint64_t                     maximumPoreSize);

  /** Read all values once, in their order, to find the objects and their passes.
   * \throw MedialVoxelLabelError for a number that is not whole, and for too many labels */
  void
  Prepare(const Observer & observer) override;

  /** Chosen labels that no voxel has. */
  const std::vector<std::int64_t> &
  GetMissingLabels() const
  {
    return m_MissingLabels;
  }

  void
  ReadObjects(const MedialVoxelBox & box, MedialVoxelObjectNumber * objects) override;

  /** The objects of the current pass. Values that are not a number belong to the first pass. */
  void
  Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets) override;

private:
  /** Call function(span, view) in the order of the voxels. */
  void
  ForEachSpan(const MedialVoxelBox & box, const MedialVoxelValueSource::SpanFunction & function);

  MedialVoxelBox            m_Image;
  std::vector<std::int64_t> m_Labels;
  std::uint64_t             m_MaximumPoreSize;
  std::vector<std::int64_t> m_MissingLabels;
};

} // end namespace itk

#endif
