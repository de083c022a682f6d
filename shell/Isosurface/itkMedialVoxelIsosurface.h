// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelIsosurface_h
#define itkMedialVoxelIsosurface_h

#include "itkMedialVoxelMargins.h"
#include "itkMedialVoxelRankedBits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace itk
{

/** \struct MedialVoxelIsosurfaceVertex
 * \brief Where the surface crosses the line between two voxels that are neighbors along an axis.
 * \ingroup MedialVoxel
 */
struct MedialVoxelIsosurfaceVertex
{
  std::array<double, 3> point;  ///< continuous index
  MedialVoxelIndex      object; ///< the voxel of the object
};

/** \struct MedialVoxelIsosurfaceTriangle
 * \brief A face, counter-clockwise seen from outside of the object where the axes are right-handed.
 * \ingroup MedialVoxel
 */
struct MedialVoxelIsosurfaceTriangle
{
  std::array<std::uint64_t, 3> vertices;       ///< counted from 0
  bool                         isCap{ false }; ///< closes the surface where the image cuts the object
};

/** \class MedialVoxelIsosurfaceConsumer
 * \brief Takes a surface in parts, in any order and from several threads at a time.
 * \ingroup MedialVoxel
 */
class MedialVoxelIsosurfaceConsumer
{
public:
  virtual ~MedialVoxelIsosurfaceConsumer();

  /** Vertices with the numbers from \a first on. */
  virtual void
  AddVertices(std::uint64_t first, const std::vector<MedialVoxelIsosurfaceVertex> & vertices) = 0;
  virtual void
  AddTriangles(std::uint64_t first, const std::vector<MedialVoxelIsosurfaceTriangle> & triangles) = 0;
};

/** \class MedialVoxelIsosurface
 * \brief Triangles between the voxels of an object and all others, slice by slice.
 *
 * Two neighbors along an axis, of which one is object, have one vertex between them: where their margins cross zero, in
 * linear interpolation. So that no two vertices coincide, it keeps 1/256 of their distance from both. Outside of the
 * image there is no object: there the surface is closed half a voxel beyond the last voxels, or left open. The numbers
 * of vertices and faces follow from the image alone.
 * \ingroup MedialVoxel
 */
class MedialVoxelIsosurface
{
public:
  /** Calls task(number) for the numbers below the count, in any threads. */
  using RunTasks = std::function<void(std::size_t count, const std::function<void(std::size_t number)> & task)>;

  /** Where margins are not known, or do not differ, vertices are in the middle.
   * \param isClosed at the faces of the image \param margins of the slices that are added, and the one before
   * \param run takes parts of each slice */
  MedialVoxelIsosurface(const MedialVoxelMargins &      margins,
                        bool                            isClosed,
                        MedialVoxelIsosurfaceConsumer & consumer,
                        RunTasks                        run);

  /** Take the next slice, whose bits are those of the object. The consumer gets the surface up to it. */
  void
  AddSlice(const MedialVoxelBits & object);

  /** After the last slice. */
  void
  Finish();

  /** Bytes taken for an image of this size. */
  static std::uint64_t
  GetBytes(const MedialVoxelIndex & size);

private:
  /** Vertices in or below a slice, in lines of one direction. */
  struct Edges
  {
    MedialVoxelRankedBits bits;
    std::uint64_t         first{ 0 }; ///< number of the first of them
  };

  /** What is known of a slice. Indices are those of the image plus one, so that there are voxels around it. */
  struct Slice
  {
    MedialVoxelBits      object;
    std::array<Edges, 2> edges; ///< along x and y
  };

  /** Rows of a slice, and the surface in them. */
  struct Part
  {
    std::int64_t                                            begin;
    std::int64_t                                            end;
    std::array<std::vector<MedialVoxelIsosurfaceVertex>, 3> vertices{}; ///< by axis
    std::array<std::uint64_t, 3>                            firstVertex{};
    std::vector<MedialVoxelIsosurfaceTriangle>              triangles{};
    std::uint64_t                                           firstTriangle{ 0 };
  };

  MedialVoxelBox
  GetBoxOfSlice() const;

  Edges &
  GetEdges(unsigned int axis)
  {
    return axis == 2 ? m_Between : m_Slices[1].edges[axis];
  }

  /** Let the slices before and now be the last one and an empty one. */
  void
  BeginSlice();

  void
  EndSlice();

  template <typename TTask>
  void
  ForEachPart(TTask && task);

  /** Find the vertices along an axis, of which the lower ends are in the slice, or in the one before. */
  void
  FindCrossings(unsigned int axis, Part & part);

  void
  NumberVertices();

  /** \param voxel of the image plus one \param lower true when it is the lower end that is object */
  MedialVoxelIsosurfaceVertex
  MakeVertex(unsigned int axis, const MedialVoxelIndex & voxel, bool lower) const;

  void
  AddCells(Part & part) const;

  void
  AddCell(const MedialVoxelIndex & cell, unsigned int objectCorners, bool isCap, Part & part) const;

  bool
  IsInside(unsigned int axis, std::int64_t index) const
  {
    return index > 0 && index <= m_Margins.GetSize()[axis];
  }

  const MedialVoxelMargins &      m_Margins;
  bool                            m_IsClosed;
  MedialVoxelIsosurfaceConsumer & m_Consumer;
  RunTasks                        m_RunTasks;
  std::int64_t                    m_Z{ 0 };  ///< of the slice that comes next
  std::array<Slice, 2>            m_Slices;  ///< before and now
  Edges                           m_Between; ///< along z, from before to now
  std::vector<Part>               m_Parts;   ///< of the slice
  std::uint64_t                   m_NumberOfVertices{ 0 };
  std::uint64_t                   m_NumberOfTriangles{ 0 };
};

} // end namespace itk

#endif
