// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallBalls_h
#define itkMedialVoxelWallBalls_h

#include "itkMedialVoxelCellPairs.h"
#include "itkMedialVoxelEngineSettings.h"
#include "itkMedialVoxelLocalThreshold.h"
#include "itkMedialVoxelTileObserver.h"
#include "itkMedialVoxelWallPainter.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

namespace itk
{

/** \class MedialVoxelWallBalls
 * \brief The balls of the walls that extractions find, for a MedialVoxelWallPainter.
 *
 * The ball of a measured medial cell q lies around its center. Its radius is d(q) of MedialVoxelLocalThreshold, at most
 * half of the maximum thickness, and its thickness that of the wall, at most the maximum.
 *
 * The balls of regions that follow each other along the slowest axis are kept together, so that no wall is measured
 * twice. A region with other extents across that axis begins anew.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelWallBalls : public MedialVoxelTileObserver
{
public:
  using Ball = MedialVoxelWallPainter::Ball;

  /** Bytes for each voxel of the known regions, when a sixteenth of the cells are medial. */
  static constexpr std::uint64_t BytesPerVoxel = sizeof(Ball) / 16 + 1;

  /** \param settings  with walls */
  MedialVoxelWallBalls(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & settings);

  /** Cells beside a region, along the slowest axis, whose balls may reach it. */
  std::uint64_t
  GetMargin() const
  {
    return m_Margin;
  }

  /** Boxes of cells whose balls are not known, of those in \a cells. */
  std::vector<MedialVoxelBox>
  FindMissing(const MedialVoxelBox & cells) const;

  /** Forget the balls before \a cells along the slowest axis. */
  void
  DropBefore(const MedialVoxelBox & cells);

  /** The known balls of \a cells, in any order. */
  void
  Copy(const MedialVoxelBox & cells, std::vector<Ball> & balls) const;

  /** The next extraction is of this region. */
  void
  BeginRegion(const MedialVoxelBox & region)
  {
    m_Region = region;
  }

  std::uint64_t
  GetBytesPerVoxel() const override
  {
    return sizeof(Ball) / 8;
  }

  std::unique_ptr<Workspace>
  MakeWorkspace() const override;

  void
  Begin() override;

  /** All medial ones. */
  MedialVoxelBits::WordType
  SelectCells(const MedialVoxelCellRow & row) const override;

  void
  Observe(const MedialVoxelClassifiedTile & tile, Workspace * workspace) override;

  void
  Commit() override;

private:
  struct TileBalls;

  /** Position along the slowest axis, and strip of rows along the one before. */
  using Key = std::array<std::int64_t, 2>;
  using Strips = std::map<Key, std::vector<Ball>>;

  template <typename TIndex>
  Key
  KeyOf(const TIndex & cell) const;

  bool
  Follows(const MedialVoxelBox & box) const;

  unsigned int              m_SlowestAxis;
  std::uint64_t             m_Margin;
  double                    m_MaximumRadius; // in units of the metric
  float                     m_Maximum;       // thickness
  MedialVoxelCellPairs      m_Pairs;
  MedialVoxelLocalThreshold m_Threshold;
  MedialVoxelBox            m_Region; // of the pending balls
  std::mutex                m_Mutex;
  Strips                    m_Pending;
  MedialVoxelBox            m_Known;
  Strips                    m_Balls; // of the known region
};

} // end namespace itk

#endif
