// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPieceEngine_h
#define medialvoxelPieceEngine_h

#include "JobPlan.h"
#include "Options.h"
#include "OutputRequest.h"
#include "VoxelOutput.h"

#include "itkMedialVoxelEngine.h"
#include "itkMultiThreaderBase.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** The slices and rows of a piece that are done at once. */
struct PieceRange
{
  SliceRange              slices;
  std::optional<RowRange> rows{}; ///< of these slices; nothing: all of them
};

/** Results of one piece. */
struct PieceResults
{
  /** The voxels of the piece for a volume, x fastest. */
  struct Part
  {
    VoxelOutput * volume;
    const void *  voxels;
  };

  std::vector<Part>    parts; ///< without blocks that need not be written
  itk::MedialVoxelSums sums;  ///< of this piece
};

/** Hears the progress of a piece from 0 to 1, and answers true to stop. */
using PieceObserver = std::function<bool(double)>;

/** A task on the volume of the header, as plans and runs need it. */
itk::MedialVoxelEngineSettings
MakeEngineSettings(const VolumeHeader & header, const itk::MedialVoxelEngineTask & task);

/** \class PieceEngine
 * \brief The engine of the library with one task on an opened volume, run for one range of slices after the other.
 *
 * Results and sums equal those of the filters of the library in a pipeline. */
class PieceEngine : private itk::MedialVoxelEngineClient
{
public:
  /** \param input must outlive it */
  PieceEngine(itk::MedialVoxelObjectSource &     input,
              const VolumeHeader &               header,
              const JobOptions &                 options,
              const JobPlan &                    plan,
              const itk::MedialVoxelEngineTask & task,
              const PieceObserver &              observer);

  /** Its result, in one word. */
  const char *
  GetName() const;

  /** Has results written to a volume, before the first run. The task must provide for them. */
  void
  AddVolume(const VolumeRequest & request, VoxelOutput & volume);

  /** Lets someone see the tiles of labels, before the first run. Must outlive the runs. */
  void
  AddObserver(itk::MedialVoxelTileObserver & observer);

  /** Makes results valid until the run after the next one begins, which takes their memory twice. */
  void
  KeepPreviousResults()
  {
    m_NumberOfSets = MostSets;
  }

  /** Lets someone know the region of each run before its first tile, before the first run. */
  void
  AddRegionListener(std::function<void(const itk::MedialVoxelBox &)> listener)
  {
    m_RegionListeners.push_back(std::move(listener));
  }

  /** Lets someone have all tiles instead of volumes. Called by several threads at a time. */
  void
  SendTilesTo(std::function<void(const itk::MedialVoxelTileResult &)> taker)
  {
    m_Taker = std::move(taker);
  }

  /** Writes the result of a tile to memory that has a place for each voxel of the volume. */
  void
  WriteTile(const itk::MedialVoxelTileResult & tile,
            const VolumeRequest &              request,
            void *                             first,
            const itk::MedialVoxelStrides &    strides) const;

  itk::MedialVoxelBox
  GetRegion(const PieceRange & range) const;

  /** Limits the memory of windows and threads from the next run on, in bytes; 0 is without limit. */
  void
  SetMemoryLimit(std::uint64_t bytes);

  /** Has the walls that the task finds, if any, measured on these gray values, or on the object, before the first run.
   */
  void
  SetGrayRange(const std::optional<itk::MedialVoxelSheetExtraction::GrayRange> & range);

  /** Reads the next piece, if any, meanwhile. The results are valid until the next run, or Release(). A piece without
   * a cell to decide and without an object is all zero; sparse volumes may skip it.
   * \throw itk::MedialVoxelAborted when the observer stops it
   * \throw itk::MedialVoxelMemoryShortage; errors of the input and the tile observers */
  PieceResults
  Run(const PieceRange & range, const PieceRange & nextRange);

  /** Forgets its knowledge of the input, which is another one from now on. */
  void
  DropWindow()
  {
    m_Engine.reset();
  }

  /** Gives back the memory of the results. */
  void
  Release();

private:
  static constexpr std::size_t MostSets = 2;

  /** Results of one kind for a piece; kept for the next one when they suffice for it. */
  class Buffer
  {
  public:
    void
    Reserve(std::uint64_t bytes);

    void
    Release();

    /** Sets all bytes to zero, as new ones are. */
    void
    Clear();

    std::byte *
    Get() const
    {
      return m_Bytes.get();
    }

  private:
    struct Freer
    {
      void
      operator()(std::byte * bytes) const
      {
        std::free(bytes);
      }
    };

    std::unique_ptr<std::byte[], Freer> m_Bytes;
    std::uint64_t                       m_Size{ 0 };
  };

  /** A volume, and where its results of pieces go by turns. */
  struct Destination
  {
    VolumeRequest                request;
    VoxelOutput *                volume;
    std::array<Buffer, MostSets> buffers;
  };

  void
  RunWorkers(unsigned int numberOfWorkers, const std::function<void()> & work) override;

  void
  TakeTile(const itk::MedialVoxelTileResult & tile) override;

  void
  UpdateProgress(float fraction) override;

  bool
  IsAborted() const override
  {
    return m_IsStopped;
  }

  /** Prepares the buffers of the set. Results of tiles without object are zero and need not be written. */
  void
  PrepareBuffers();

  bool
  MakesLabels() const;

  itk::MedialVoxelObjectSource &                                m_Input;
  VolumeGeometry                                                m_Geometry;
  bool                                                          m_SkipsEmptyPieces;
  itk::MedialVoxelGrid                                          m_Grid;
  itk::MedialVoxelEngineSettings                                m_Settings;
  std::vector<std::function<void(const itk::MedialVoxelBox &)>> m_RegionListeners;
  std::function<void(const itk::MedialVoxelTileResult &)>       m_Taker;
  PieceObserver                                                 m_Observer;
  itk::MultiThreaderBase::Pointer                               m_Threader = itk::MultiThreaderBase::New();
  std::unique_ptr<itk::MedialVoxelEngine>                       m_Engine; ///< keeps its window from piece to piece
  itk::MedialVoxelBox                                           m_Region; ///< of the piece
  std::vector<Destination>                                      m_Destinations;
  std::size_t                                                   m_NumberOfSets{ 1 };
  std::size_t                                                   m_Set{ 0 }; ///< of buffers, for the piece
  bool                                                          m_IsStopped{ false };

  std::array<std::atomic<bool>, MostSets> m_HasResults{}; ///< a set that is not all zero
};

} // end namespace medialvoxel

#endif
