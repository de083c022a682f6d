// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelFineSheet_h
#define itkMedialVoxelFineSheet_h

#include "itkMedialVoxelSheetSizes.h"
#include "itkMedialVoxelSheetTree.h"

#include <memory>

namespace itk
{

/** \class MedialVoxelFineSheet
 * \brief The surface that is remeshed: its walls, the lines that bound them, and the nearest point of each.
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

  MedialVoxelFineSheet(MedialVoxelSheet sheet, const MedialVoxelElementSize & size);

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
    return m_Lines.numberOfWalls;
  }
  Index
  GetWall(Index triangle) const
  {
    return m_Lines.wallOf[triangle];
  }

  /** Of each triangle. */
  const std::vector<Index> &
  GetWalls() const
  {
    return m_Lines.wallOf;
  }

  /** Mean length of the sides. */
  double
  GetMeanSide() const
  {
    return m_Lines.meanSide;
  }

  Nearest
  FindOnWall(const Point & point, Index wall, double within = MedialVoxelSheetTree::Anywhere) const
  {
    return m_WallTree.Find(point, wall, within);
  }
  bool
  HasWallWithin(const Point & point, Index wall, double within) const
  {
    return m_WallTree.HasWithin(point, wall, within);
  }

  /** Of the rims of a wall. */
  Nearest
  FindOnRim(const Point & point, Index wall, double within = MedialVoxelSheetTree::Anywhere) const
  {
    return m_LineTree->Find(point, 1 + wall, within);
  }
  Nearest
  FindOnJunction(const Point & point, double within = MedialVoxelSheetTree::Anywhere) const
  {
    return m_LineTree->Find(point, 0, within);
  }

  /** At least the thickness at some more points, as where the sheet bends. */
  void
  RaiseSizes(const std::vector<Index> & points)
  {
    m_Sizes.Raise(points);
  }

  float
  GetSize(Index point) const
  {
    return m_Sizes.Get(point);
  }

  /** The point of a triangle that is nearest to a place. */
  Index
  GetNearestPoint(Index triangle, const Point & place) const;

  /** The thickness at a place of a triangle, between those of its points that are known; 0: of none. */
  double
  GetThickness(Index triangle, const Point & place) const;

private:
  MedialVoxelSheet                      m_Sheet;
  MedialVoxelSheetLines                 m_Lines;
  MedialVoxelSheetSizes                 m_Sizes;
  MedialVoxelSheetTree                  m_WallTree;
  std::unique_ptr<MedialVoxelSheetTree> m_LineTree;
};

} // end namespace itk

#endif
