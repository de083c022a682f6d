// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceObserver_h
#define itkMedialVoxelSurfaceObserver_h

#include "itkMedialVoxelSurfaceTrimmer.h"
#include "itkMedialVoxelTileObserver.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelSurfacePieceError
 * \brief An execution found more cells of the surface than are to be kept; smaller ones find fewer.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfacePieceError : public std::runtime_error
{
public:
  MedialVoxelSurfacePieceError();
};

/** \class MedialVoxelSurfaceObserver
 * \brief Builds the medial surface while an image is classified piece by piece.
 *
 * The pieces are whole slices and follow each other along the last axis. Their cells are kept until the piece is done;
 * then a MedialVoxelSurfaceTrimmer takes them, and a MedialVoxelSurfaceBuilder the rest.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceObserver : public MedialVoxelTileObserver
{
public:
  /** Bytes for each voxel of a tile that a worker takes for thin walls and their noise. */
  static std::uint64_t
  GetBytesPerVoxel(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters);

  /** See MedialVoxelSurfaceCells and MedialVoxelSurfaceBuilder for the arguments. */
  MedialVoxelSurfaceObserver(const MedialVoxelGrid &              grid,
                             const MedialVoxelParameters &        parameters,
                             const MedialVoxelGrid::SpacingType & spacing,
                             const MedialVoxelSurfacePlacement &  placement,
                             MedialVoxelSurfaceConsumer &         consumer);

  /** As MedialVoxelSurfaceCells measures; vertices keep closer to the middle then. */
  void
  MeasureOnGrayValues(const MedialVoxelSheetExtraction::GrayRange & range) override;

  /** Cells that an execution over more than one slice may find before it fails with MedialVoxelSurfacePieceError; it
   * can then be run again in smaller pieces. Default without limit. */
  void
  SetMaximumNumberOfCells(const std::uint64_t number)
  {
    m_MaximumNumberOfCells = number;
  }

  /** Give vertices the part of the image that \a find returns for the index of their cell. One thread calls it for the
   * cells of an execution, after its end. */
  void
  FindPartsWith(std::function<std::uint16_t(const MedialVoxelIndex & cell)> find)
  {
    m_FindPart = std::move(find);
  }

  /** As MedialVoxelSurfaceBuilder::RunTasksWith(). */
  void
  RunTasksWith(const MedialVoxelSurfaceBuilder::RunTasks & run, const std::size_t verticesOfBatch)
  {
    m_Builder.RunTasksWith(run, verticesOfBatch);
  }

  std::uint64_t
  GetBytesPerVoxel() const override
  {
    return m_BytesPerVoxel;
  }

  std::unique_ptr<Workspace>
  MakeWorkspace() const override;

  bool
  LooksAround() const override
  {
    return true;
  }

  void
  Begin() override;

  MedialVoxelBox
  Examine(const MedialVoxelClassifiedTile & tile, Workspace * workspace) const override;

  void
  Observe(const MedialVoxelClassifiedTile & tile, Workspace * workspace) override;

  void
  Commit() override;

  /** Hand on the rest, after the last piece. */
  void
  Finish();

private:
  /** The cells of the current tile, and the workspace that finds them. */
  struct Worker;

  std::uint64_t             m_BytesPerVoxel;
  MedialVoxelSurfaceCells   m_Kernel;
  MedialVoxelSurfaceBuilder m_Builder;
  MedialVoxelSurfaceTrimmer m_Trimmer;
  std::uint64_t             m_MaximumNumberOfCells{ std::numeric_limits<std::uint64_t>::max() };
  std::mutex                m_Mutex;

  std::function<std::uint16_t(const MedialVoxelIndex & cell)> m_FindPart; ///< may be empty

  /** Cells by slice, from m_FirstSlice on; of each slice in any order. */
  std::vector<std::vector<MedialVoxelSurfaceCell>> m_Pending;
  std::int32_t                                     m_FirstSlice{ 0 };
  std::uint64_t                                    m_NumberOfPending{ 0 };
};

} // end namespace itk

#endif
