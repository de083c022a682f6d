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

  /** Give the label AddedForTopology to the added cells of a slice, which begins at \a first. */
  template <typename TLabel>
  static void
  Label(const MedialVoxelBits & added, TLabel * const first, const MedialVoxelStrides & strides)
  {
    const MedialVoxelBox & box = added.GetBox();
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      for (std::int64_t word = 0; word < added.GetWordsPerRow(); ++word)
      {
        for (auto bits = added.GetRow(y, box.lower[2])[word]; bits != 0; bits &= bits - 1)
        {
          const std::int64_t x = word * MedialVoxelBits::BitsPerWord + MedialVoxelLowestBit(bits);
          first[x + y * strides[1]] = static_cast<TLabel>(MedialVoxelLabel::AddedForTopology);
        }
      }
    }
  }

  /** Called by several workers at a time; one of them finds the cells of the slices that are complete. */
  void
  TakeTile(const MedialVoxelTileResult & tile);

  /** Add the next slice as a whole instead of its tiles, as MedialVoxelTileResult::WriteTopologyCells() writes it. */
  void
  AddSlice(const std::uint16_t * cells);

  /** Cells that the consumer got. */
  std::uint64_t
  GetNumberOfAddedCells() const;

  /** Memory of the slices that wait for others, and of the counts. */
  std::uint64_t
  GetHeldBytes() const;

  /** All memory, for walls of up to so many voxels without much noise. */
  static std::uint64_t
  GetUsualBytes(const MedialVoxelGrid & grid, std::uint64_t maximumPoreSize, std::uint64_t wallThickness);

  /** Parts, tunnels and cavities of the object, without its closed pores; after the last slice. */
  MedialVoxelBettiNumbers
  GetBettiNumbersOfObject() const;

  /** The same of the medial and the added cells: the same numbers, or 0 in an image without background,
   * which has none. */
  MedialVoxelBettiNumbers
  GetBettiNumbersOfCells() const;

private:
  class Implementation;

  std::unique_ptr<Implementation> m_Implementation;
};

} // end namespace itk

#endif
