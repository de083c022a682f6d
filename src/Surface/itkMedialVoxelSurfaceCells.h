// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceCells_h
#define itkMedialVoxelSurfaceCells_h

#include "itkMedialVoxelGrayThickness.h"
#include "itkMedialVoxelSurfaceCrossings.h"
#include "itkMedialVoxelSurfaceFit.h"
#include "itkMedialVoxelSurfaceTopology.h"
#include "itkMedialVoxelThickness.h"
#include "itkMedialVoxelTileObserver.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace itk
{

/** \struct MedialVoxelSurfaceCell
 * \brief A vertex of the medial surface in a cell, before smoothing; lengths in physical units. Sheets that pass each
 * other in a cell have a vertex each.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSurfaceCell
{
  std::array<std::int32_t, 3>          index{};       ///< of the cell
  MedialVoxelSurfaceTopology::EdgeMask quads{ 0 };    ///< voxel edges whose quadrilateral has it, at least one
  std::uint16_t                        part{ 0 };     ///< of the image, where parts are told apart
  std::array<float, 3>                 offset{};      ///< of the vertex from the center of the cell
  std::array<float, 3>                 normal{};      ///< of the plane midway between the walls, of length 1
  float                                distance{ 0 }; ///< of that plane from the center, along the normal
  float                                thickness{ 0 };
};

/** Whether a vertex comes before another: by cells in the order z, y, x, and by their lowest edges. */
inline bool
MedialVoxelIsBefore(const MedialVoxelSurfaceCell & a, const MedialVoxelSurfaceCell & b)
{
  for (unsigned int axis = 3; axis-- > 0;)
  {
    if (a.index[axis] != b.index[axis])
    {
      return a.index[axis] < b.index[axis];
    }
  }
  return MedialVoxelLowestBit(a.quads) < MedialVoxelLowestBit(b.quads);
}

/** \class MedialVoxelSurfaceCells
 * \brief Finds the vertices and quadrilaterals of the medial surface at the cells of a tile.
 *
 * Each crossed edge of MedialVoxelSurfaceCrossings with four cells around it has a quadrilateral, and a cell of
 * quadrilaterals a vertex for each of their connected parts (MedialVoxelSurfaceTopology): the MedialVoxelSurfaceFit of
 * the pairs N(v), N(w) of its crossed edges. All follows from the voxels of the cell alone, so tiles agree on shared
 * cells.
 *
 * MedialVoxelThickness measures a medial cell. In other cells, which rims and junctions use, and where sheets pass each
 * other, the thickness is measured between the two nearest points of a pair.
 *
 * On gray values MedialVoxelGrayBoundary moves the points of the pairs, the plane that is as far from both walls
 * counts, and MedialVoxelGrayThickness measures the thickness, where the tile has not measured it yet.
 *
 * Volumes in which an axis has a single voxel have no surface.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceCells
{
public:
  /** \class Workspace
   * \brief Memory of one thread, kept from tile to tile.
   * \ingroup MedialVoxel
   */
  struct Workspace
  {
    MedialVoxelSurfaceCrossings::Workspace crossings;
    MedialVoxelThickness::Memory           thickness;
  };

  /** \param grid        the image in the units in which its cells are classified
   *  \param parameters  of the classification; whatever the bound, the geodesic distance defines the surface
   *  \param spacing     of the image in the units in which the surface is measured */
  MedialVoxelSurfaceCells(const MedialVoxelGrid &              grid,
                          const MedialVoxelParameters &        parameters,
                          const MedialVoxelGrid::SpacingType & spacing);

  /** Measure on the gray values that the tiles have. */
  void
  MeasureOnGrayValues(const MedialVoxelSheetExtraction::GrayRange & range);

  /** The vertices in the cells of \a tile, in the order z, y, x of the cells and of the lowest edges.
   *
   * \param cells  replaced; incomplete after an abort
   * \return an empty box when all edges are decided, otherwise the box of sites that must be known to decide them, or
   * to have all gray values */
  MedialVoxelBox
  Find(const MedialVoxelClassifiedTile &     tile,
       Workspace &                           workspace,
       std::vector<MedialVoxelSurfaceCell> & cells) const;

private:
  /** What a vertex follows from. */
  struct Basis
  {
    MedialVoxelSurfaceTopology::EdgeMask crossed;         // its edges, at least
    bool                                 isMedial;        // the cell, which has no other vertex
    const MedialVoxelWall *              wall{ nullptr }; // there on gray values, when the run has measured it
  };

  MedialVoxelSurfaceTopology::EdgeMask
  GetPossibleQuads(const MedialVoxelIndex & cell) const;

  MedialVoxelSurfaceTopology::Splits
  FindSplits(const MedialVoxelClassifiedTile &    tile,
             const MedialVoxelIndex &             index,
             MedialVoxelSurfaceTopology::EdgeMask quads,
             Workspace &                          workspace,
             MedialVoxelBox &                     missing) const;

  void
  AddVertex(const MedialVoxelClassifiedTile &     tile,
            const MedialVoxelSurfaceCell &        cell,
            const Basis &                         basis,
            Workspace &                           workspace,
            std::vector<MedialVoxelSurfaceCell> & cells,
            MedialVoxelBox &                      missing) const;

  MedialVoxelWallPoints
  GetWallPoints(const MedialVoxelClassifiedTile & tile, const MedialVoxelIndex & index, const Basis & basis) const;

  void
  TakeNearestPair(MedialVoxelSurfaceTopology::EdgeMask crossed, MedialVoxelWallPoints & points) const;

  void
  Place(const MedialVoxelClassifiedTile & tile,
        const Basis &                     basis,
        const MedialVoxelWallPoints &     points,
        Workspace &                       workspace,
        MedialVoxelSurfaceCell &          cell) const;

  void
  FitToGrayValues(const MedialVoxelGray &                     gray,
                  const MedialVoxelIndex &                    index,
                  MedialVoxelSurfaceTopology::EdgeMask        crossed,
                  const MedialVoxelWallPoints &               points,
                  const MedialVoxelGrayThickness::Crossings & crossings,
                  MedialVoxelSurfaceFit &                     fit) const;

  MedialVoxelSurfaceFit::PointType
  FromCenter(const MedialVoxelIndex & index, const MedialVoxelIndex & voxel) const;

  MedialVoxelGrid                         m_Grid;
  MedialVoxelDualCell                     m_Cell;
  MedialVoxelSurfaceCrossings             m_Crossings;
  MedialVoxelGrid                         m_PhysicalGrid;
  MedialVoxelThickness                    m_Thickness;
  std::optional<MedialVoxelGrayThickness> m_Gray;        // empty: measured on the object
  bool                                    m_SharesWalls; // with the tiles, which measure in the units of the grid
  bool                                    m_DecidesTogether;
  bool                                    m_IsSolid;
};

} // end namespace itk

#endif
