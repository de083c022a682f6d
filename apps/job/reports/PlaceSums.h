// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceSums_h
#define medialvoxelPlaceSums_h

#include "PackedNumbers.h"
#include "PlaceSummary.h"
#include "VolumeHeader.h"

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelTileObserver.h"

#include <array>
#include <cstdint>
#include <limits>

namespace medialvoxel
{

/** Which cells make places. Areas and lengths are whole multiples of units, so that sums do not depend on their order.
 * Limits have the precision of the map, so that a wall of exactly a limit is not beyond it. */
struct PlaceRule
{
  PlaceKind     kind{ PlaceKind::Thin };
  float         limit{ 0.0f };
  float         growLimit{ 0.0f };
  std::uint64_t minimumPlaceArea{ 0 }; ///< of the cells beyond the limit, in units of area
  double        lengthUnit{ 1.0 };

  /** A place has one of these cells. */
  bool
  Begins(float thickness) const
  {
    return kind == PlaceKind::Thin ? thickness < limit : thickness > limit;
  }

  /** A place has only these cells. */
  bool
  Grows(float thickness) const
  {
    return kind == PlaceKind::Thin ? thickness < growLimit : thickness > growLimit;
  }
};

/** Numbers the cells of a volume so that the neighbors of each have fixed differences to it. The numbers rise with z,
 * y, x; a row and a column beyond the image keep the ends of rows and slices apart. */
class PlaceGrid
{
public:
  /** \param dimension of the image, 2 or 3; slices lie along its last axis */
  PlaceGrid(const itk::MedialVoxelIndex & size, unsigned int dimension)
    : m_Size(size)
    , m_SliceAxis(dimension - 1)
    , m_RowStep(size[0] + 1)
    , m_SliceStep((size[3 - m_SliceAxis] + 1) * m_RowStep)
  {}

  std::int64_t
  GetKey(const itk::MedialVoxelIndex & cell) const
  {
    return cell[m_SliceAxis] * m_SliceStep + cell[3 - m_SliceAxis] * m_RowStep + cell[0];
  }

  itk::MedialVoxelIndex
  GetCell(std::int64_t key) const
  {
    itk::MedialVoxelIndex cell{};
    cell[m_SliceAxis] = key / m_SliceStep;
    cell[3 - m_SliceAxis] = key % m_SliceStep / m_RowStep;
    cell[0] = key % m_RowStep;
    return cell;
  }

  std::int64_t
  GetSlice(std::int64_t key) const
  {
    return key / m_SliceStep;
  }

  std::int64_t
  GetRow(std::int64_t key) const
  {
    return key % m_SliceStep / m_RowStep;
  }

  std::int64_t
  GetNumberOfSlices() const
  {
    return m_Size[m_SliceAxis];
  }

  std::int64_t
  GetNumberOfRows() const
  {
    return m_Size[3 - m_SliceAxis];
  }

  unsigned int
  GetSliceAxis() const
  {
    return m_SliceAxis;
  }

  unsigned int
  GetRowAxis() const
  {
    return 3 - m_SliceAxis;
  }

  /** From a cell to the middle of the three neighbors in each of the four rows before its own. */
  std::array<std::int64_t, 4>
  GetRowsBefore() const
  {
    return { -m_SliceStep - m_RowStep, -m_SliceStep, -m_SliceStep + m_RowStep, -m_RowStep };
  }

private:
  itk::MedialVoxelIndex m_Size;
  unsigned int          m_SliceAxis;
  std::int64_t          m_RowStep;
  std::int64_t          m_SliceStep;
};

/** Steps of voxels from a cell, or its index. */
using PlaceStep = std::array<std::int32_t, 3>;

/** A cell of a place. */
struct PlaceCell
{
  std::int64_t  key{ 0 };
  float         thickness{ 0.0f };
  std::uint32_t area{ 0 }; ///< in units of area
  PlaceStep     a{};       ///< to the boundary voxel on one side; of cells that begin places
  PlaceStep     b{};       ///< to that on the other side
  float         uncertainty{ std::numeric_limits<float>::quiet_NaN() }; ///< half of the 95 % interval

  /** Whether it is farther in the direction of a kind; of equal ones that with the smaller key. */
  bool
  IsWorse(const PlaceCell & other, const PlaceKind kind) const
  {
    return thickness != other.thickness ? (kind == PlaceKind::Thin) == (thickness < other.thickness) : key < other.key;
  }

  /** The members that other processes get. */
  template <typename TCell, typename TNumbers>
  static void
  Exchange(TCell & cell, TNumbers & numbers)
  {
    numbers.Exchange(cell.key);
    numbers.Exchange(cell.thickness);
    numbers.Exchange(cell.area);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      numbers.Exchange(cell.a[axis]);
      numbers.Exchange(cell.b[axis]);
    }
    numbers.Exchange(cell.uncertainty);
  }
};

/** Steps to the boundary voxels on both sides of a cell's wall; none where they are not known. */
void
TakeSides(PlaceCell & cell, const itk::MedialVoxelClassifiedTile & tile, const itk::MedialVoxelIndex & index);

/** Where the wall of a cell is. */
WallLocation
LocateWall(const PlaceCell & cell, const PlaceGrid & grid, const VolumeGeometry & geometry);

/** \class PlaceSums
 * \brief Sums over connected cells. */
struct PlaceSums
{
  static constexpr std::int32_t Far = std::numeric_limits<std::int32_t>::max();

  std::uint64_t cells{ 0 };
  std::uint64_t area{ 0 };
  std::uint64_t areaBeyond{ 0 }; ///< of the cells beyond the limit
  std::uint64_t thickness{ 0 };  ///< sum, in units of length
  float         minimum{ std::numeric_limits<float>::infinity() };
  float         maximum{ 0.0f };
  PlaceStep     first{ { Far, Far, Far } };
  PlaceStep     last{ { -1, -1, -1 } };
  PlaceCell     worst; ///< the cell with the minimum, or the maximum; of several the one with the smallest key
  bool          hasBegun{ false };

  void
  Add(const PlaceCell & cell, const PlaceRule & rule, const PlaceGrid & grid);

  void
  Add(const PlaceSums & other, const PlaceRule & rule);

  void
  Save(NumberWriter & numbers) const;

  /** \throw JobError Failure when these are not its numbers */
  static PlaceSums
  Load(NumberReader & numbers);

private:
  void
  TakeWorst(const PlaceCell & cell, const PlaceRule & rule);
};

} // end namespace medialvoxel

#endif
