// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceTopology_h
#define itkMedialVoxelSurfaceTopology_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace itk
{

/** \class MedialVoxelSurfaceTopology
 * \brief How the quadrilaterals of a medial surface follow from the crossed voxel edges of its cells.
 *
 * A crossed edge between two voxels has one quadrilateral, which joins the four cells around it. The twelve voxel edges
 * of a cell are bits of a mask: bit 4 k + u + 2 v is the edge along axis k whose lower voxel is the cell's lowest
 * corner, moved by u along the next axis and by v along the one after it (x follows z). Two cells that share a face
 * are joined by an edge of the surface when one of the four voxel edges around that face is crossed, and as many
 * quadrilaterals meet there as are crossed. Where all four are, but voxels across from each other are of one side,
 * sheets pass each other that do not meet: the face is split between them, and has two edges of the surface. A cell has
 * a vertex for each connected part of its surface: quadrilaterals that meet at one of its faces are of one part. The
 * masks of the edges of the parts say all about the surface.
 *
 * Directions 2 n and 2 n + 1 lead from a cell to its lower and its upper neighbor along axis n.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceTopology
{
public:
  using EdgeMask = std::uint16_t;

  /** How the edges around a face are split. */
  enum Split : std::uint8_t
  {
    Unsplit = 0,
    AroundUneven = 1, ///< around the voxels that are above the first one along one of the axes of the face
    AroundEven = 2    ///< around the first voxel and the one across from it
  };

  /** The splits of the six faces of a cell, two bits for each direction. */
  using Splits = std::uint16_t;

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
  static constexpr const MedialVoxelIndex &
  OffsetOf(const unsigned int edge)
  {
    return Offsets[edge];
  }

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

  /** The edges around the face in a direction as they follow each other: from its first voxel, which is the lowest one,
   * along the axis after the normal to the next, and so on. */
  static constexpr std::array<unsigned int, 4>
  RingTowards(const unsigned int direction)
  {
    const unsigned int next = (direction / 2 + 1) % 3;
    const unsigned int afterNext = (direction / 2 + 2) % 3;
    const unsigned int side = direction % 2;
    return { { EdgeOf(next, 0, side), EdgeOf(afterNext, side, 1), EdgeOf(next, 1, side), EdgeOf(afterNext, side, 0) } };
  }

  /** Number that an edge of the face in a direction has in the cell behind that face. */
  static constexpr unsigned int
  Mirrored(const unsigned int edge, const unsigned int direction)
  {
    const unsigned int bit = (AxisOf(edge) + 1) % 3 == direction / 2 ? 1 : 2;
    return edge ^ bit;
  }

  static Split
  SplitOf(const Splits splits, const unsigned int direction)
  {
    return static_cast<Split>(splits >> 2 * direction & 3);
  }

  static Splits
  WithSplit(const Splits splits, const unsigned int direction, const Split split)
  {
    return static_cast<Splits>(splits | unsigned{ split } << 2 * direction);
  }

  /** Edges around the face in a direction that are not split from \a edge, one of them. */
  static EdgeMask
  JoinedEdges(unsigned int edge, unsigned int direction, Splits splits);

  /** The connected part of \a quads that has its lowest edge. */
  static EdgeMask
  FirstPart(EdgeMask quads, Splits splits);

  /** Quadrilaterals that meet at the edges of the surface from a cell in a direction: 0, when there is none, to 4. */
  static unsigned int
  QuadsTowards(const EdgeMask quads, const unsigned int direction)
  {
    return static_cast<unsigned int>(MedialVoxelPopulationCount(quads & EdgesTowards(direction)));
  }

  /** The directions, as bits, of the faces of which all edges are crossed. */
  static unsigned int
  AmbiguousDirections(const EdgeMask crossed)
  {
    // Both edges of the face along the one axis, and along the other.
    const unsigned int alongU = crossed & crossed >> 1;
    const unsigned int alongV = crossed & crossed >> 2;
    const auto         towards = [=](const unsigned int normal) {
      const unsigned int next = (normal + 1) % 3;
      const unsigned int afterNext = (normal + 2) % 3;
      return ((alongU >> EdgeOf(next, 0, 0) & alongV >> EdgeOf(afterNext, 0, 0) & 1u) |
              (alongU >> EdgeOf(next, 0, 1) & alongV >> EdgeOf(afterNext, 1, 0) & 1u) << 1)
             << 2 * normal;
    };
    return towards(0) | towards(1) | towards(2);
  }

  /** The edges of the face in a direction, of a mask, as they are numbered in the cell behind that face. */
  static constexpr EdgeMask
  MirroredEdges(const EdgeMask edges, const unsigned int direction)
  {
    const unsigned int facing = edges & EdgesTowards(direction);
    const unsigned int next = facing & 15u << 4 * ((direction / 2 + 1) % 3);
    const unsigned int afterNext = facing & ~next;
    return static_cast<EdgeMask>(direction % 2 == 0 ? afterNext << 1 | next << 2 : afterNext >> 1 | next >> 2);
  }

  /** Shared quadrilaterals of two vertices that are joined through the face in a direction.
   *
   * \param quads   of the one
   * \param behind  of the other, in that direction */
  static unsigned int
  QuadsBetween(const EdgeMask quads, const EdgeMask behind, const unsigned int direction)
  {
    return static_cast<unsigned int>(MedialVoxelPopulationCount(MirroredEdges(quads, direction) & behind));
  }

  /** The neighbors, as bits, that a vertex follows when it is smoothed: all joined ones; at a rim or a junction of
   * sheets only the ones along it, none where both meet.
   *
   * \param counts  quadrilaterals at the side to each neighbor: in the six directions, then the second ones there
   */
  static std::uint16_t
  NeighborsToFollow(const std::array<unsigned int, std::size_t{ 2 } * NumberOfDirections> & counts);

  /** The same as directions when there are no second neighbors. */
  static std::uint8_t
  DirectionsToFollow(EdgeMask quads);

private:
  static EdgeMask
  FindFirstPart(EdgeMask quads, Splits splits);

  static constexpr std::array<MedialVoxelIndex, NumberOfEdges> Offsets{ {
    { { 0, 0, 0 } },
    { { 0, 1, 0 } },
    { { 0, 0, 1 } },
    { { 0, 1, 1 } }, // along x
    { { 0, 0, 0 } },
    { { 0, 0, 1 } },
    { { 1, 0, 0 } },
    { { 1, 0, 1 } }, // along y
    { { 0, 0, 0 } },
    { { 1, 0, 0 } },
    { { 0, 1, 0 } },
    { { 1, 1, 0 } } // along z
  } };
};

} // end namespace itk

#endif
