// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceConsumer_h
#define itkMedialVoxelSurfaceConsumer_h

#include "itkMedialVoxelGrid.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \struct MedialVoxelSurfacePlacement
 * \brief Places of the voxels: the physical point of index 0, and the physical steps from voxel to voxel.
 * \ingroup MedialVoxel
 */
struct MedialVoxel_EXPORT MedialVoxelSurfacePlacement
{
  std::array<double, 3>                origin{};
  std::array<std::array<double, 3>, 3> steps{}; ///< by axis of the image

  /** Whether coordinates of 32 bits place the vertices of an image of this size within a thousandth of its shortest
   * step. When not, vertices would move and fall together. */
  bool
  FitsFloat(const MedialVoxelIndex & size) const;

  /** The largest absolute coordinate of the voxels. */
  double
  LargestCoordinate(const MedialVoxelIndex & size) const;
};

/** \struct MedialVoxelSurfaceVertex
 * \brief A vertex of a medial surface.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSurfaceVertex
{
  std::array<double, 3> point{};        ///< physical
  double                thickness{ 0 }; ///< of the wall, in physical units
  std::uint16_t         part{ 0 };      ///< of the image, where parts are distinguished

  std::array<std::int32_t, 3> cell{}; ///< its index
};

/** \struct MedialVoxelSurfaceQuad
 * \brief A quadrilateral of a medial surface, of one crossed voxel edge.
 *
 * The first vertex is in the lowest cell around the voxel edge. The others follow so that the normal, the cross product
 * of the diagonals 0-2 and 1-3, has a component that is not negative along (1, sqrt 2, sqrt 3): neighbors agree
 * wherever the surface does not turn its edge to that direction, which is no multiple of whole numbers.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSurfaceQuad
{
  std::array<std::uint64_t, 4> vertices{};

  /** Bits: side k, from vertex k to the next one, belongs to this quadrilateral alone (first), or to more than two
   * (second). */
  std::uint8_t rimSides{ 0 };
  std::uint8_t junctionSides{ 0 };

  /** Whether the diagonal 1-3 is shorter than 0-2. */
  bool isSplitAlong13{ false };

  /** Of the two triangles along the shorter diagonal. */
  std::array<double, 2> areas{};

  double
  GetArea() const
  {
    return areas[0] + areas[1];
  }

  /** Numbers of the vertices of a triangle, 0 or 1: its first two sides are sides of the quadrilateral and begin at the
   * first two vertices; the third one is the diagonal. */
  std::array<unsigned int, 3>
  GetTriangle(const unsigned int half) const
  {
    const unsigned int first = (isSplitAlong13 ? 1u : 0u) + 2u * half;
    return { { first, (first + 1) % 4, (first + 2) % 4 } };
  }
};

/** \class MedialVoxelSurfaceConsumer
 * \brief Takes a surface part by part: vertices in the order of their numbers, from 0, and quadrilaterals after their
 * vertices.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceConsumer
{
public:
  virtual ~MedialVoxelSurfaceConsumer();

  virtual void
  AddVertices(const std::vector<MedialVoxelSurfaceVertex> & vertices) = 0;

  virtual void
  AddQuads(const std::vector<MedialVoxelSurfaceQuad> & quads) = 0;
};

} // end namespace itk

#endif
