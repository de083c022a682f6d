// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceBuilder_h
#define itkMedialVoxelSurfaceBuilder_h

#include "itkMedialVoxelSurfaceCells.h"

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <vector>

namespace itk
{

/** \struct MedialVoxelSurfaceVertex
 * \brief A vertex of a medial surface.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSurfaceVertex
{
  std::array<double, 3> point{};        ///< physical
  double                thickness{ 0 }; ///< of the wall, in physical units
};

/** \struct MedialVoxelSurfaceQuad
 * \brief A quadrilateral of a medial surface: that of one crossed voxel edge.
 *
 * The first vertex is that of the lowest cell around the voxel edge. The others follow so that the normal, the cross
 * product of the diagonals 0-2 and 1-3, has a component that is not negative along (1, sqrt 2, sqrt 3): neighbors
 * agree wherever the surface does not turn its edge to that direction, and it has no ratio with walls along the voxels.
 * \ingroup MedialVoxel
 */
struct MedialVoxelSurfaceQuad
{
  std::array<std::uint64_t, 4> vertices{};

  /** Bits: side k, from vertex k to the next one, belongs to this quadrilateral alone, or to more than two. */
  std::uint8_t rimSides{ 0 };
  std::uint8_t junctionSides{ 0 };

  /** Whether the diagonal 1-3 is the shorter one; 0-2 is it when both are as long. */
  bool isSplitAlong13{ false };

  /** Of the two triangles along the shorter diagonal. */
  std::array<double, 2> areas{};

  double
  GetArea() const
  {
    return areas[0] + areas[1];
  }

  /** Numbers of the vertices of a triangle, 0 or 1: its first two sides are those of the quadrilateral that begin at
   * the first two vertices, the third one is the diagonal. */
  std::array<unsigned int, 3>
  GetTriangle(const unsigned int half) const
  {
    const unsigned int first = (isSplitAlong13 ? 1u : 0u) + 2u * half;
    return { { first, (first + 1) % 4, (first + 2) % 4 } };
  }
};

/** \class MedialVoxelSurfaceConsumer
 * \brief Takes a surface piece by piece: vertices in the order of their numbers, which count from 0, and quadrilaterals
 * whose vertices it has.
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

/** \class MedialVoxelSurfaceBuilder
 * \brief Joins the cells of a medial surface, smooths it and hands it on, slice by slice.
 *
 * Vertices are numbered in the order of their cells (z, y, x) and of their lowest edges, quadrilaterals follow in the
 * order of the lower voxels of their edges and of the axes. In each of five steps a vertex moves by 0.6 of the way to
 * the mean of those that MedialVoxelSurfaceTopology::NeighborsToFollow() names, then by 0.15 of the way to the plane
 * midway between its walls, or by the weight that is set. A step at a slice needs the step before at the two slices
 * beside it, so that a dozen slices are in memory, and how the cells come in pieces has no influence.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceBuilder
{
public:
  /** \struct Placement
   * \brief Where the voxels are: the physical point of index 0, and the physical steps from voxel to voxel.
   * \ingroup MedialVoxel
   */
  struct Placement
  {
    std::array<double, 3>                origin{};
    std::array<std::array<double, 3>, 3> steps{}; ///< by axis of the image
  };

  static constexpr unsigned int NumberOfSteps = 5;

  /** Whether coordinates of 32 bits place the vertices of an image of this size within a thousandth of its shortest
   * step. When not, vertices would move and fall together. */
  static bool
  FitsFloat(const Placement & placement, const MedialVoxelIndex & size);

  /** The number of 32 bits that is nearest to a coordinate. */
  static double
  RoundedToFloat(const double coordinate)
  {
    // GCC 12 leaves out casts to and fro where it makes vectors of them.
    const volatile float rounded = static_cast<float>(coordinate);
    return static_cast<double>(rounded);
  }

  /** The largest absolute coordinate of the voxels. */
  static double
  LargestCoordinate(const Placement & placement, const MedialVoxelIndex & size);

  /** For SetWeightOfPlane() with planes measured on gray values. */
  static constexpr double WeightOfGrayPlane = 0.7;

  /** \param spacing  lengths of the steps of the placement, as the cells were measured with */
  MedialVoxelSurfaceBuilder(const Placement &                    placement,
                            const MedialVoxelGrid::SpacingType & spacing,
                            MedialVoxelSurfaceConsumer &         consumer);

  /** Of the way to the plane midway between its walls, the part that a vertex goes in each step: 0 to 1, before the
   * first slice. Default 0.15, for planes that are as rough as voxels. */
  void
  SetWeightOfPlane(const double weight)
  {
    m_WeightOfPlane = weight;
  }

  /** Take all vertices in cells of slice \a z, in order; slices come in order, and those that are left out have none.
   */
  void
  AddSlice(std::int64_t z, std::vector<MedialVoxelSurfaceCell> cells);

  /** Hand on what is left, after the last slice. */
  void
  Finish();

private:
  static constexpr unsigned int NumberOfDirections = MedialVoxelSurfaceTopology::NumberOfDirections;
  using Offsets = std::vector<std::array<float, 3>>;

  /** Where a vertex is joined to two through one face: the other one, and the voxel edges of the cell of whose
   * quadrilaterals it is. */
  struct SecondNeighbor
  {
    std::uint32_t                        cell;
    MedialVoxelSurfaceTopology::EdgeMask edges;
  };

  /** A slice in work. Of the neighbors only those are set that the surface joins. */
  struct Slice
  {
    std::vector<MedialVoxelSurfaceCell>                        cells;
    std::vector<std::array<std::uint32_t, NumberOfDirections>> neighbors;
    std::map<std::uint64_t, SecondNeighbor>                    secondNeighbors; // by SecondKeyOf()
    Offsets                                                    offsets;         // after the last step
    Offsets                                                    previous;        // after the one before
    std::uint64_t                                              firstVertex{ 0 };
  };

  static std::uint64_t
  SecondKeyOf(const std::uint32_t cell, const unsigned int direction)
  {
    return std::uint64_t{ cell } * NumberOfDirections + direction;
  }

  static void
  Link(Slice & from, const std::vector<MedialVoxelSurfaceCell> & to, unsigned int direction);

  /** The vertex that one is joined to through the face in a direction by the quadrilateral of \a edge. */
  static std::uint32_t
  NeighborOf(const Slice & slice, std::uint32_t cell, unsigned int direction, unsigned int edge);

  static std::uint16_t
  NeighborsToFollow(const Slice & slice, std::uint32_t cell);

  void
  Push(std::vector<MedialVoxelSurfaceCell> cells);

  void
  Smooth(std::size_t at);

  void
  HandOn(std::size_t at);

  MedialVoxelSurfaceQuad
  MakeQuad(std::size_t at, std::uint32_t cell, unsigned int axis) const;

  std::array<double, 3>
  PointOf(const Slice & slice, std::uint32_t cell) const;

  Placement                    m_Placement;
  MedialVoxelGrid::SpacingType m_Spacing;
  MedialVoxelSurfaceConsumer & m_Consumer;
  double                       m_WeightOfPlane{ 0.15 };
  std::deque<Slice>            m_Slices;
  std::int64_t                 m_NextSlice{ 0 };
  std::uint64_t                m_NumberOfVertices{ 0 };
};

} // end namespace itk

#endif
