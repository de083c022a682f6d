// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrLayerWriter_h
#define medialvoxelZarrLayerWriter_h

#include "SpaceReserve.h"
#include "ZarrChunkFile.h"
#include "ZarrGrid.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class ZarrLayerWriter
 * \brief Writes slices of a volume, or some of their rows, to the chunks of an array.
 *
 * Incomplete chunks wait in their files, so only one chunk is in memory. A layer is complete with its last rows. */
class ZarrLayerWriter
{
public:
  /** The file of a component and a chunk. */
  using ChunkFileFunction = std::function<std::filesystem::path(std::uint64_t, const ZarrIndex &)>;

  /** \param sparse chunks of zeros have no file
   * \param writer, reserve must outlive it; space is given back where there is a reserve */
  ZarrLayerWriter(const ZarrGrid &              grid,
                  bool                          sparse,
                  ZarrChunkWriter &             writer,
                  std::optional<SpaceReserve> & reserve,
                  ChunkFileFunction             chunkFile);

  /** \param rows of whole chunks */
  void
  Write(const SliceRange & slices, const RowRange & rows, const char * voxels);

  /** Call after the last slices: completes the waiting chunks. */
  void
  Complete();

  /** Forgets open layers, which belong to an abandoned cluster, and the layers of that cluster. */
  void
  StartCluster();

  /** Complete ones. */
  std::uint64_t
  GetNumberOfChunkFiles() const
  {
    return m_ChunkFiles;
  }

  /** Layers that were completed since the cluster began. */
  const std::vector<std::uint64_t> &
  GetLayersOfCluster() const
  {
    return m_LayersOfCluster;
  }

  /** Memory for one chunk, whose contents each call to Write() changes. */
  std::vector<char> &
  GetBuffer()
  {
    return m_Chunk;
  }

private:
  enum class State : char
  {
    Missing,
    HasSpans,
    Complete
  };

  using States = std::vector<State>; ///< of the chunks of a layer

  void
  CompleteLayer(std::uint64_t layer);

  template <typename TFunction>
  void
  ForEachChunk(std::uint64_t layer, const RowRange & rows, TFunction && function);

  void
  WriteChunks(std::uint64_t layer, const RowRange & rows, const char * voxels);

  void
  WriteSpans(std::uint64_t layer, const SliceRange & slices, const RowRange & rows, const char * voxels);

  void
  WriteChunk(const std::filesystem::path & chunkFile);

  void
  GiveSpaceBack(std::uint64_t numberOfBytes);

  ZarrGrid                        m_Grid;
  bool                            m_Sparse;
  ZarrChunkWriter &               m_Writer;
  std::optional<SpaceReserve> &   m_Reserve;
  ChunkFileFunction               m_ChunkFile;
  std::vector<char>               m_Chunk;
  std::map<std::uint64_t, States> m_OpenLayers; ///< of which some voxels are written
  std::uint64_t                   m_ChunkFiles{ 0 };
  std::vector<std::uint64_t>      m_LayersOfCluster;
};

} // end namespace medialvoxel

#endif
