// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSameTopology_h
#define itkMedialVoxelSameTopology_h

#include "itkMedialVoxelBettiNumbers.h"
#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"
#include "itkMedialVoxelParameters.h"
#include "itkMedialVoxelTileResult.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace itk
{

/** \struct MedialVoxelTopologySums
 * \brief What was added for the topology of an object, or of several.
 * \ingroup MedialVoxel
 */
struct MedialVoxelTopologySums
{
  std::uint64_t           addedCells{ 0 };
  MedialVoxelBettiNumbers object; ///< without its closed pores
  MedialVoxelBettiNumbers cells;  ///< medial and added ones: the same numbers, or 0 in an image without background

  MedialVoxelTopologySums &
  operator+=(const MedialVoxelTopologySums & other)
  {
    addedCells += other.addedCells;
    object += other.object;
    cells += other.cells;
    return *this;
  }
};

/** \class MedialVoxelSameTopology
 * \brief Finds the cells that give the medial cells the topology of the object, from the tiles of a run.
 *
 * The tiles hold labels, object bits and levels of all voxels of the image, each voxel once. A slice goes on when all
 * of its tiles are taken. In memory are the slices whose tiles are being made, and those that later ones still change:
 * about 2.7 for each voxel of the deepest level, 22 more, and one for each voxel of the largest pore.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSameTopology
{
public:
  /** Takes the cells of a slice that get a label of their own, in the order of slices, in one thread at a time. */
  using Consumer = std::function<void(const MedialVoxelBits & added)>;

  /** \param maximumPoreSize of the extraction */
  MedialVoxelSameTopology(const MedialVoxelGrid & grid, std::uint64_t maximumPoreSize, Consumer consumer);
  ~MedialVoxelSameTopology();

  /** Call function(cell) for the added cells of a slice. */
  template <typename TFunction>
  static void
  ForEachCell(const MedialVoxelBits & added, TFunction && function)
  {
    const MedialVoxelBox & box = added.GetBox();
    MedialVoxelIndex       cell = box.lower;
    for (cell[1] = box.lower[1]; cell[1] < box.upper[1]; ++cell[1])
    {
      for (std::int64_t word = 0; word < added.GetWordsPerRow(); ++word)
      {
        for (auto bits = added.GetRow(cell[1], cell[2])[word]; bits != 0; bits &= bits - 1)
        {
          cell[0] = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(bits);
          function(cell);
        }
      }
    }
  }

  /** Give the label AddedForTopology to the added cells of a slice, which begins at \a first. */
  template <typename TLabel>
  static void
  Label(const MedialVoxelBits & added, TLabel * const first, const MedialVoxelStrides & strides)
  {
    ForEachCell(added, [&](const MedialVoxelIndex & cell) {
      first[cell[0] + cell[1] * strides[1]] = static_cast<TLabel>(MedialVoxelLabel::AddedForTopology);
    });
  }

  /** Called by several workers at a time; one of them finds the cells of the slices that are complete. */
  void
  TakeTile(const MedialVoxelTileResult & tile);

  /** Add the next slice as a whole instead of its tiles, as MedialVoxelTileResult::WriteTopologyCells() writes it. */
  void
  AddSlice(const std::uint16_t * cells);

  /** Memory of the slices that wait for others, and of the counts. */
  std::uint64_t
  GetHeldBytes() const;

  /** All memory, for walls of up to so many voxels without much noise. */
  static std::uint64_t
  GetUsualBytes(const MedialVoxelGrid & grid, std::uint64_t maximumPoreSize, std::uint64_t wallThickness);

  /** After the last slice. */
  MedialVoxelTopologySums
  GetSums() const;

private:
  class Implementation;

  std::unique_ptr<Implementation> m_Implementation;
};

} // end namespace itk

#endif
