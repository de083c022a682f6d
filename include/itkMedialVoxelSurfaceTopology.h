// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceTopology_h
#define itkMedialVoxelSurfaceTopology_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelSurfaceTopology
 * \brief How the quadrilaterals of a medial surface follow from the crossed voxel edges of its cells.
 *
 * A crossed edge between two voxels has one quadrilateral, which joins the four cells around it. The twelve voxel edges
 * of a cell are bits of a mask: bit 4 k + u + 2 v is the edge along axis k whose lower voxel is the cell's lowest
 * corner, moved by u along the next axis and by v along the one after it (x follows z). The mask of the edges that
 * have a quadrilateral says all about the surface at the cell's vertex: two cells that share a face are joined by an
 * edge of the surface when one of the four voxel edges around that face is crossed, and as many quadrilaterals meet
 * there as are crossed.
 *
 * Directions 2 n and 2 n + 1 lead from a cell to its lower and its upper neighbor along axis n.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceTopology
{
public:
  using EdgeMask = std::uint16_t;

  static constexpr unsigned int NumberOfEdges = 12;
  static constexpr unsigned int NumberOfDirections = 6;

  static constexpr unsigned int
  EdgeOf(const unsigned int axis, const unsigned int u, const unsigned int v)
  {
    return 4 * axis + u + 2 * v;
  }

  static constexpr unsigned int
  AxisOf(const unsigned int edge)
  {
    return edge / 4;
  }

  /** From the lowest corner of a cell to the lower voxel of an edge. */
  static MedialVoxelIndex
  OffsetOf(unsigned int edge);

  /** The four voxel edges around the face between a cell and its neighbor. */
  static constexpr EdgeMask
  EdgesTowards(const unsigned int direction)
  {
    const unsigned int normal = direction / 2;
    const unsigned int side = direction % 2;
    unsigned int       mask = 0;
    for (unsigned int other = 0; other < 2; ++other)
    {
      mask |= 1u << EdgeOf((normal + 1) % 3, other, side);
      mask |= 1u << EdgeOf((normal + 2) % 3, side, other);
    }
    return static_cast<EdgeMask>(mask);
  }

  /** Quadrilaterals that meet at the edge of the surface from a cell in a direction: 0, when there is none, to 4. */
  static unsigned int
  QuadsTowards(const EdgeMask quads, const unsigned int direction)
  {
    return static_cast<unsigned int>(MedialVoxelPopulationCount(quads & EdgesTowards(direction)));
  }

  /** Directions, as bits, of the neighbors that a vertex follows when it is smoothed: all that it is joined to; at a
   * rim those along the rim, where a junction of sheets those along the junction, none where both meet. */
  static std::uint8_t
  DirectionsToFollow(EdgeMask quads);
};

} // end namespace itk

#endif
