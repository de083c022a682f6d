// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelThickness_h
#define itkMedialVoxelThickness_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelWallPoints.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace itk
{

/** \struct MedialVoxelWall
 * \brief The measured wall at a medial cell.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelWall
{
  float        thickness{ 0.0f };   ///< in the units of the grid's spacing, greater than 0
  float        area{ 0.0f };        ///< of the mid-surface that the cell stands for, in squared units; in 2-D a length
  std::uint8_t axis{ 0 };           ///< the axis along which the displacement through the wall is longest
  bool         isUnpaired{ false }; ///< the two sides do not face each other, so the thickness belongs to no wall
  bool         isUnresolved{ false }; ///< the blur has joined several walls in the gray values
  float        uncertainty{ std::numeric_limits<float>::quiet_NaN() }; ///< half width of the 95 % interval of the
                                                                       ///< thickness; NaN: not known

  /** The thickness of a wall is known. */
  bool
  IsMeasured() const
  {
    return !isUnpaired && !isUnresolved;
  }

  /** The thickness, or the negative of it where it is not that of a wall, as in the map. */
  float
  GetMarkedThickness() const
  {
    return this->IsMeasured() ? thickness : -thickness;
  }
};

/** \class MedialVoxelThickness
 * \brief Thickness of a wall at a medial cell, measured on the binary object.
 *
 * The boundary points of the corners are split into two sides, see MedialVoxelWallPoints::GetSides(). Where a and b are
 * at most 3.46 voxels apart, both points of a pair do not count when their surfaces lean to the same side by more than
 * 21.8 degrees: the voxels around them reach over the edge of the wall. The thickness is the distance of the means of
 * both sides, less the distance from the boundary voxels' centers to the faces of the wall. That distance follows from
 * the share of object voxels among the 3^D voxels around each point: a plane across the direction of the wall that cuts
 * off this share. Another wall behind a gap of one voxel does not count: of two object voxels that lie opposite each
 * other around a point, one that is more than a quarter of a voxel on the far side of the point is left out. Walls
 * parallel to an axis are measured exactly; doc/explanation/accuracy.md has the errors of others.
 *
 * The sides are unpaired when they do not face each other, with all points on the side of the nearer one of a and b,
 * see MedialVoxelWallPoints::GetNearerSides(): the sums of the directions from the boundary points to the object voxels
 * around them are more than 36.9 degrees (a cosine of 0.8) from opposite. There the points of the cell are on the end
 * of the wall too, or of several walls that meet, and the thickness belongs to none. The smallest thickness is a 64th
 * of the smallest spacing.
 *
 * Outside the image, where nothing is known, the outermost voxels are continued.
 *
 * A plane with the unit normal n passes through (|nx| sx + |ny| sy + |nz| sz) / (sx sy sz) cells of the size s for each
 * unit of its area. The inverse, with the direction from one side to the other as the normal, is the area that a cell
 * stands for. The areas of a wall parallel to an axis add up exactly. For other walls the sum is 1.1 times the area at
 * 2 voxels of thickness, where boundary points hardly define the direction, and less than 1.05 times at 6 and more.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelThickness
{
public:
  explicit MedialVoxelThickness(const MedialVoxelGrid & grid);

private:
  /** The object voxels around a point. */
  struct Block
  {
    std::uint32_t voxels{ 0 };   // see GetObjectAround()
    std::uint32_t opposite{ 0 }; // of them, voxels with another one at the opposite offset
    std::int64_t  sums{ 0 };     // their number and the sums of their offsets, side by side
  };

  /** Numbers that follow from the direction through a wall, the displacement between its sides in voxels times its
   * length. */
  struct Direction
  {
    std::array<double, 3>        across{};
    double                       step{ 0.0 };
    std::array<std::uint32_t, 2> out{}; // offsets that lead out of the wall, at each side; few walls need them
    bool                         knowsOut{ false };
  };

public:
  /** \class Memory
   * \brief The blocks around boundary points, which walls side by side share.
   * \ingroup MedialVoxel
   */
  class Memory
  {
  public:
    /** Before the first wall in another object. */
    void
    Clear()
    {
      for (Place & place : m_Places)
      {
        place.number = 0;
      }
    }

  private:
    friend class MedialVoxelThickness;

    static constexpr unsigned int BitsOfPlace = 11;
    static constexpr std::size_t  NumberOfPlaces = std::size_t{ 1 } << BitsOfPlace;

    struct Place
    {
      std::size_t number{ 0 }; // of the point, from 1 on
      Block       block;
    };

    std::vector<Place> m_Places = std::vector<Place>(NumberOfPlaces);
    Direction          m_Direction; // of the last wall
  };

  /** \param object  bits of all voxels that are neighbors of the boundary points and in the image */
  MedialVoxelWall
  Measure(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall) const;

  /** The same, faster for many walls near each other. */
  MedialVoxelWall
  Measure(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall, Memory & memory) const;

  /** The thickness for points of meshes, in less time: with all points, even on the end of the wall. */
  float
  MeasureThickness(const MedialVoxelBits & object, const MedialVoxelWallPoints & wall, Memory & memory) const;

  /** Object voxels among the 3^D voxels around \a point: bit 13 + x + 3 y + 9 z is that of the offset (x, y, z). */
  std::uint32_t
  GetObjectAround(const MedialVoxelBits & object, const MedialVoxelIndex & point) const;

  /** The smallest thickness that a wall has. */
  double
  GetSmallest() const
  {
    return m_Smallest;
  }

private:
  /** The two sides of a wall, and the displacement between them. */
  struct SidePair;

  /** \param sideOf     the sides of the corners
   * \param direction  direction of the last wall, or none
   * \param blockAt    called with a point, returns the block around it */
  template <typename TBlockAt>
  SidePair
  FindSides(const MedialVoxelWallPoints &            wall,
            const MedialVoxelWallPoints::SidesType & sideOf,
            Direction &                              direction,
            TBlockAt &&                              blockAt) const;

  template <typename TBlockAt>
  static MedialVoxelWallPoints::SidesType
  FindSidesWithoutEdges(const MedialVoxelWallPoints & wall, TBlockAt && blockAt);

  template <typename TBlockAt>
  MedialVoxelWall
  MeasureWall(const MedialVoxelWallPoints & wall, Direction & direction, TBlockAt && blockAt) const;

  float
  ThicknessOf(const SidePair & pair) const;

  const Block &
  RecallBlock(const MedialVoxelBits & object, const MedialVoxelIndex & point, Memory & memory) const;

  static void
  FindOffsetsOut(Direction & direction);

  Block
  GetBlock(const MedialVoxelBits & object, const MedialVoxelIndex & point) const;

  std::uint32_t
  GetAtFaceOfImage(const MedialVoxelBits & object, const MedialVoxelIndex & point) const;

  MedialVoxelGrid m_Grid;
  int             m_BlockVoxels{ 1 };  // 3^D
  double          m_CellVolume{ 1.0 }; // along the active axes
  double          m_Smallest{ 0.0 };
};

} // end namespace itk

#endif
