// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelThinning_h
#define itkMedialVoxelThinning_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <vector>

namespace itk
{

/** \class MedialVoxelThinning
 * \brief Thins the cells of an object to a set that holds the medial cells and has the topology of the object.
 *
 * The cells of an object have an object corner. In the passes t = 0, 1, 2, ... the eight parities of x, y and z take
 * turns. A turn deletes the cells of its parity that are simple (see MedialVoxelCellLink), not medial, and of a level
 * from t - 7 to t: each cell has eight chances. Cells of one parity share no voxel, so their order within a turn is
 * free. The turns of a pass follow a Gray code that rotates from pass to pass.
 *
 * Slices arrive one after the other. A turn on a slice needs all earlier turns on the slices beside it, and nothing
 * else. So each slice goes on as far as its neighbors let it, and the result is that of the whole image.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelThinning
{
public:
  /** Of a cell: the distance of its nearest corner to the boundary in smallest spacings, rounded down; at most
   * NoLevel - 1. */
  using LevelType = std::uint16_t;

  /** Of cells without a boundary in the image, which stay and are not added. */
  static constexpr LevelType NoLevel = (1u << 13) - 1;

  /** Number of times that a cell can be deleted. */
  static constexpr std::int64_t NumberOfChances = 8;

  /** Takes a slice that is done, in the order of slices.
   * \param kept   cells of the slice that are left, medial ones too
   * \param added  those that are not medial and have a level */
  using Consumer = std::function<void(std::int64_t slice, const MedialVoxelBits & kept, const MedialVoxelBits & added)>;

  MedialVoxelThinning(const MedialVoxelGrid & grid, Consumer consumer);

  /** The box of the voxels and cells of a slice. */
  MedialVoxelBox
  GetSliceBox(std::int64_t slice) const;

  /** Add the next slice; after the last one all are done.
   *
   * \param object  voxels of the slice
   * \param medial  cells of the slice
   * \param levels  of the cells of the slice with an object corner, at x + size y */
  void
  AddSlice(MedialVoxelBits object, MedialVoxelBits medial, std::vector<LevelType> levels);

  /** Slices that are known and not done. */
  std::size_t
  GetNumberOfHeldSlices() const
  {
    return m_Slices.size();
  }

  /** At most, for levels up to \a level: a slice is done when 8/3 (level + 8) + 3 slices after it are known. */
  static std::uint64_t
  GetMostHeldSlices(const std::uint64_t level)
  {
    return 8 * (level + NumberOfChances) / 3 + 5;
  }

  /** Memory of these slices. */
  std::uint64_t
  GetHeldBytes() const
  {
    return m_HeldBytes;
  }

  /** Memory of a slice in \a box: its bits of four kinds, and levels. */
  static std::uint64_t
  GetBytesOfSlice(const MedialVoxelBox & box)
  {
    return 4 * MedialVoxelBits::GetBytes(box) + static_cast<std::uint64_t>(box.NumberOfVoxels()) * sizeof(LevelType);
  }

  /** The cells of a slice that have an object corner.
   * \param next  object voxels of the slice after it; none after the last one */
  static MedialVoxelBits
  FindCells(const MedialVoxelGrid & grid, const MedialVoxelBits & object, const MedialVoxelBits & next);

private:
  static constexpr std::int64_t NotBegun = -1;
  static constexpr std::int64_t Done = std::numeric_limits<std::int64_t>::max();

  /** Numbers of cells with the same parity of x and y. */
  using Counts = std::array<std::uint64_t, 4>;

  struct Slice
  {
    MedialVoxelBits        object;
    MedialVoxelBits        medial;
    std::vector<LevelType> levels;
    MedialVoxelBits        cells{};
    MedialVoxelBits        open{};            ///< cells that turns may still delete
    LevelType              lowest{ NoLevel }; ///< of the levels of cells that can be deleted
    std::vector<Counts>    counts{};          ///< of such cells, from this level on
    std::int64_t           turn{ NotBegun };  ///< the next one with work

    std::uint64_t
    GetBytes() const
    {
      return GetBytesOfSlice(object.GetBox()) + counts.capacity() * sizeof(Counts);
    }
  };


  Slice &
  At(const std::int64_t slice)
  {
    return m_Slices[static_cast<std::size_t>(slice - m_FirstSlice)];
  }

  void
  Begin(std::int64_t slice);

  void
  CountCells(std::int64_t slice);

  std::int64_t
  FindTurn(std::int64_t slice, std::int64_t turn);

  bool
  CanGoOn(std::int64_t slice);

  void
  GoOn(std::int64_t slice);

  void
  TakeTurn(std::int64_t slice);

  /** Rows around a row of cells: bits -1 and those after the last one are readable zeros. */
  struct Rows
  {
    std::array<const MedialVoxelBits::WordType *, 9> cells;  ///< at (dy + 1) + 3 (dz + 1)
    std::array<const MedialVoxelBits::WordType *, 4> voxels; ///< at dy + 2 dz, of the corners
  };

  Rows
  FindRows(std::int64_t slice, std::int64_t row);

  static bool
  IsSimple(const Rows & rows, std::int64_t x);

  void
  HandOver();

  MedialVoxelGrid   m_Grid;
  MedialVoxelBox    m_Image;
  MedialVoxelBox    m_Cells;
  Consumer          m_Consumer;
  std::deque<Slice> m_Slices;

  std::vector<MedialVoxelBits::WordType> m_NoBits; ///< in place of rows that the image does not have
  MedialVoxelBits                        m_Added;
  std::int64_t                           m_FirstSlice{ 0 };     ///< that is held
  std::int64_t                           m_NumberOfSlices{ 0 }; ///< that are known
  std::int64_t                           m_NumberHandedOver{ 0 };
  std::uint64_t                          m_HeldBytes{ 0 };
};

} // end namespace itk

#endif
