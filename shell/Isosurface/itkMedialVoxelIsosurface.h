// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelIsosurface_h
#define itkMedialVoxelIsosurface_h

#include "itkMedialVoxelMargins.h"
#include "itkMedialVoxelRankedBits.h"

#include <array>
#include <cstdint>
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
 * \brief Takes a surface in parts. A face may come before its vertices.
 * \ingroup MedialVoxel
 */
class MedialVoxelIsosurfaceConsumer
{
public:
  virtual ~MedialVoxelIsosurfaceConsumer();

  virtual void
  AddVertices(const std::vector<MedialVoxelIsosurfaceVertex> & vertices) = 0;
  virtual void
  AddTriangles(const std::vector<MedialVoxelIsosurfaceTriangle> & triangles) = 0;
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
  /** Where margins are not known, or do not differ, vertices are in the middle.
   * \param isClosed at the faces of the image \param margins of the slices that are added, and the one before */
  MedialVoxelIsosurface(const MedialVoxelMargins & margins, bool isClosed, MedialVoxelIsosurfaceConsumer & consumer);

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

  MedialVoxelBox
  GetBoxOfSlice() const;

  /** Let the slices before and now be the last one and an empty one. */
  void
  BeginSlice();

  void
  EndSlice();

  /** Number the vertices along an axis, of which the lower ends are in a slice. */
  void
  FindCrossings(unsigned int axis, const MedialVoxelBits & lower, Edges & edges);

  void
  AddVertices(unsigned int axis, const Edges & edges);

  /** \param voxel of the image plus one \param lower true when it is the lower end that is object */
  MedialVoxelIsosurfaceVertex
  MakeVertex(unsigned int axis, const MedialVoxelIndex & voxel, bool lower) const;

  void
  AddCells();

  void
  AddCell(const MedialVoxelIndex & cell, unsigned int objectCorners, bool isCap);

  bool
  IsInside(unsigned int axis, std::int64_t index) const
  {
    return index > 0 && index <= m_Margins.GetSize()[axis];
  }

  void
  FlushVertices();
  void
  FlushTriangles();

  const MedialVoxelMargins &                 m_Margins;
  bool                                       m_IsClosed;
  MedialVoxelIsosurfaceConsumer &            m_Consumer;
  std::int64_t                               m_Z{ 0 };  ///< of the slice that comes next
  std::array<Slice, 2>                       m_Slices;  ///< before and now
  Edges                                      m_Between; ///< along z, from before to now
  std::uint64_t                              m_NumberOfVertices{ 0 };
  std::vector<MedialVoxelIsosurfaceVertex>   m_Vertices;
  std::vector<MedialVoxelIsosurfaceTriangle> m_Triangles;
};

} // end namespace itk

#endif
