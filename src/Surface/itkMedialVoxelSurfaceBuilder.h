// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceBuilder_h
#define itkMedialVoxelSurfaceBuilder_h

#include "itkMedialVoxelSurfaceCells.h"
#include "itkMedialVoxelSurfaceConsumer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelSurfaceBuilder
 * \brief Joins the cells of a medial surface, smooths it and hands it on, slice by slice.
 *
 * Vertices are numbered in the order of their cells (z, y, x) and of their lowest edges, quadrilaterals follow in the
 * order of the lower voxels of their edges and of the axes. In each of five steps a vertex moves 0.6 of the distance to
 * the mean of MedialVoxelSurfaceTopology::NeighborsToFollow(), then 0.15 of the distance to the plane midway between
 * its walls, or by the weight that is set. A step at a slice needs the step before at the two slices beside it, so half
 * a dozen slices are in memory beside those of a batch, and neither batches nor the division into pieces have an
 * influence.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceBuilder
{
public:
  static constexpr unsigned int NumberOfSteps = 5;

  /** Memory of a vertex of a batch beside its cell. */
  static constexpr std::size_t BytesOfVertex = 192;

  /** Calls task(number) for the numbers below the count, in any threads. */
  using RunTasks = std::function<void(std::size_t count, const std::function<void(std::size_t number)> & task)>;

  /** The number of 32 bits that is nearest to a coordinate. */
  static double
  RoundedToFloat(const double coordinate)
  {
    // GCC 12 leaves out casts to and fro where it makes vectors of them.
    const volatile float rounded = static_cast<float>(coordinate);
    return static_cast<double>(rounded);
  }

  /** For SetWeightOfPlane() with planes measured on gray values. */
  static constexpr double WeightOfGrayPlane = 0.7;

  /** \param spacing  lengths of the steps of the placement, as the cells were measured with */
  MedialVoxelSurfaceBuilder(const MedialVoxelSurfacePlacement &  placement,
                            const MedialVoxelGrid::SpacingType & spacing,
                            MedialVoxelSurfaceConsumer &         consumer);

  /** The share of the distance to the plane midway between its walls that a vertex moves in each step: 0 to 1, before
   * the first slice. Default 0.15, for planes that are as rough as voxels. */
  void
  SetWeightOfPlane(const double weight)
  {
    m_WeightOfPlane = weight;
  }

  /** Do slices of so many vertices together, unless a single one has more, in threads. Set it before the first slice;
   * by default each slice is done alone, in the calling thread. */
  void
  RunTasksWith(RunTasks run, const std::size_t verticesOfBatch)
  {
    m_RunTasks = std::move(run);
    m_VerticesOfBatch = verticesOfBatch;
  }
  const RunTasks &
  GetRunTasks() const
  {
    return m_RunTasks;
  }

  /** Take all vertices in cells of slice \a z, in order; slices come in order, and skipped slices have none. */
  void
  AddSlice(std::int64_t z, std::vector<MedialVoxelSurfaceCell> cells);

  /** Hand on the rest, after the last slice. */
  void
  Finish();

private:
  static constexpr unsigned int NumberOfDirections = MedialVoxelSurfaceTopology::NumberOfDirections;
  using Offsets = std::vector<std::array<float, 3>>;
  using Points = std::vector<std::array<double, 3>>;

  /** Where a vertex is joined to two through one face: the other one, and the voxel edges of the cell of whose
   * quadrilaterals it is. */
  struct SecondNeighbor
  {
    std::uint32_t                        cell;
    MedialVoxelSurfaceTopology::EdgeMask edges;
  };

  /** A slice in work. Only neighbors that the surface joins are set. */
  struct Slice
  {
    std::vector<MedialVoxelSurfaceCell>                        cells;
    std::vector<std::array<std::uint32_t, NumberOfDirections>> neighbors;
    std::map<std::uint64_t, SecondNeighbor>                    secondNeighbors; // by SecondKeyOf()
    std::vector<std::uint16_t>                                 followed;        // NeighborsToFollow() of each vertex
    Offsets                                                    offsets;         // after the last step
    Offsets                                                    previous;        // after the one before
    Points                                                     points;          // when they are handed on
    std::uint64_t                                              firstVertex{ 0 };
  };

  /** Cells of a slice that are handed on together, with their vertices and quadrilaterals. */
  struct Part
  {
    std::size_t                           slice;
    std::uint32_t                         begin;
    std::uint32_t                         end;
    std::vector<MedialVoxelSurfaceVertex> vertices{};
    std::vector<MedialVoxelSurfaceQuad>   quads{};
  };

  /** Slices by their place, and whether they take a step together. */
  struct Range
  {
    std::size_t begin;
    std::size_t end;

    bool
    Contains(const std::size_t at) const
    {
      return at >= begin && at < end;
    }
  };

  /** A vertex of a quadrilateral. */
  struct Corner
  {
    const Slice * slice;
    std::uint32_t cell;

    const MedialVoxelSurfaceCell &
    GetCell() const
    {
      return slice->cells[cell];
    }

    const std::array<double, 3> &
    GetPoint() const
    {
      return slice->points[cell];
    }
  };

  static std::uint64_t
  SecondKeyOf(const std::uint32_t cell, const unsigned int direction)
  {
    return std::uint64_t{ cell } * NumberOfDirections + direction;
  }

  static void
  RunHere(std::size_t count, const std::function<void(std::size_t number)> & task);

  static void
  Link(Slice & from, const std::vector<MedialVoxelSurfaceCell> & to, unsigned int direction);

  /** The vertex that one is joined to through the face in a direction by the quadrilateral of \a edge. */
  static std::uint32_t
  NeighborOf(const Slice & slice, std::uint32_t cell, unsigned int direction, unsigned int edge);

  static std::uint16_t
  NeighborsToFollow(const Slice & slice, std::uint32_t cell);

  static void
  FindNeighborsToFollow(Slice & slice);

  void
  Push(std::vector<MedialVoxelSurfaceCell> cells);

  /** Do the slices that wait, and hand on those before them that are done. */
  void
  DoBatch();

  template <typename TTask>
  void
  ForEachSlice(const Range & slices, TTask && task);

  void
  Join(std::size_t at, const Range & newSlices);

  void
  Smooth(std::size_t at, const Range & slicesOfStep);

  void
  PlacePoints(std::size_t at);

  void
  HandOn(const Range & slices);

  void
  HandOn(std::vector<Part> & parts);

  void
  Make(Part & part) const;

  MedialVoxelSurfaceQuad
  MakeQuad(std::size_t at, std::uint32_t cell, unsigned int axis) const;

  std::array<double, 3>
  PointOf(const Slice & slice, std::uint32_t cell) const;

  MedialVoxelSurfacePlacement  m_Placement;
  MedialVoxelGrid::SpacingType m_Spacing;
  MedialVoxelSurfaceConsumer & m_Consumer;
  double                       m_WeightOfPlane{ 0.15 };
  RunTasks                     m_RunTasks{ RunHere };
  std::deque<Slice>            m_Slices;
  std::size_t                  m_NumberOfWaiting{ 0 }; // the last ones
  std::size_t                  m_VerticesOfBatch{ 0 };
  std::size_t                  m_WaitingVertices{ 0 };
  std::vector<Slice>           m_Spare; // memory of slices that are done
  std::int64_t                 m_NextSlice{ 0 };
  std::uint64_t                m_NumberOfVertices{ 0 };
};

} // end namespace itk

#endif
