// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFineSheet_h
#define itkMedialVoxelFineSheet_h

#include "itkMedialVoxelSheetTree.h"

#include <memory>
#include <utility>

namespace itk
{

/** A finished surface of triangles, in memory. */
struct MedialVoxelSheet
{
  using Index = std::uint32_t;

  std::vector<MedialVoxelVector3>   points;
  std::vector<float>                thickness; ///< of the wall at each point; not above 0 or not finite: unknown
  std::vector<std::array<Index, 3>> triangles; ///< no two with the same points

  /** Both halves of a quadrilateral along its shorter diagonal, that from the first corner where both are equal. */
  void
  AddQuad(const std::array<Index, 4> & corners);

  /** Leaves out triangles that come again. */
  void
  RemoveDuplicates();
};

/** \class MedialVoxelFineSheet
 * \brief The surface that is remeshed: its walls, the lines that bound them, and the nearest point of each.
 *
 * A wall is what sides of exactly two triangles join. The other sides are lines: rims belong to one triangle, junctions
 * to more than two. It also holds the sizes that elements are to have at its points.
 * \ingroup MedialVoxel
 */
class MedialVoxelFineSheet
{
public:
  using Index = MedialVoxelSheet::Index;
  using Point = MedialVoxelVector3;
  using Nearest = MedialVoxelSheetTree::Nearest;

  /** Memory for each triangle, with the sheet itself and what its making takes for a while. */
  static constexpr std::uint64_t BytesPerTriangle = 216;

  /** \param isShared of each point, whether triangles that are not in the sheet have it, too; empty: no. A side between
   * two of these is no line. */
  explicit MedialVoxelFineSheet(MedialVoxelSheet sheet, std::vector<bool> isShared = {});

  MedialVoxelFineSheet(const MedialVoxelFineSheet &) = delete;
  MedialVoxelFineSheet &
  operator=(const MedialVoxelFineSheet &) = delete;

  const MedialVoxelSheet &
  GetSheet() const
  {
    return m_Sheet;
  }
  Index
  GetNumberOfWalls() const
  {
    return m_Walls->GetNumberOfGroups();
  }
  Index
  GetWall(Index triangle) const
  {
    return m_WallOf[triangle];
  }

  bool
  HasShared() const
  {
    return !m_IsShared.empty();
  }
  bool
  IsShared(Index point) const
  {
    return !m_IsShared.empty() && m_IsShared[point];
  }

  /** Mean length of the sides. */
  double
  GetMeanSide() const
  {
    return m_MeanSide;
  }

  Nearest
  FindOnWall(const Point & point, Index wall, double within = MedialVoxelSheetTree::Anywhere) const
  {
    return m_Walls->Find(point, wall, within);
  }
  bool
  HasWallWithin(const Point & point, Index wall, double within) const
  {
    return m_Walls->HasWithin(point, wall, within);
  }

  /** Of the rims of a wall. */
  Nearest
  FindOnRim(const Point & point, Index wall, double within = MedialVoxelSheetTree::Anywhere) const
  {
    return m_Lines->Find(point, 1 + wall, within);
  }
  Nearest
  FindOnJunction(const Point & point, double within = MedialVoxelSheetTree::Anywhere) const
  {
    return m_Lines->Find(point, 0, within);
  }

  /** Sizes at all points: \a least, and where \a atThickness is set at least a share of the thickness; else so at
   * junctions. */
  void
  SetSizes(double least, bool atThickness, double shareOfThickness);

  /** At least the thickness at some more points, as where the sheet bends. */
  void
  RaiseSizes(const std::vector<Index> & points);

  float
  GetSize(Index point) const
  {
    return m_Sizes[point];
  }

  /** The point of a triangle that is nearest to a place. */
  Index
  GetNearestPoint(Index triangle, const Point & place) const;

  /** The thickness at a place of a triangle, between those of its points that are known; 0: of none. */
  double
  GetThickness(Index triangle, const Point & place) const;

private:
  void
  FindWallsAndLines();
  void
  SpreadSizes();

  MedialVoxelSheet                      m_Sheet;
  std::vector<bool>                     m_IsShared;
  std::vector<Index>                    m_WallOf;
  std::vector<std::array<Index, 2>>     m_Junctions;
  std::vector<float>                    m_Sizes;
  double                                m_MeanSide{ 0 };
  float                                 m_ShareOfThickness{ 1 };
  std::unique_ptr<MedialVoxelSheetTree> m_Walls;
  std::unique_ptr<MedialVoxelSheetTree> m_Lines;
};

} // end namespace itk

#endif
