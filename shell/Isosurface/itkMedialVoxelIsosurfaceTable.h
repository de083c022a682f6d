// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelIsosurfaceTable_h
#define itkMedialVoxelIsosurfaceTable_h

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelIsosurfaceTable
 * \brief Triangles of a surface in a cell, for each of the 256 ways in which its eight corners are object or not.
 *
 * Corner c lies at x = c & 1, y = c >> 1 & 1, z = c >> 2 & 1. On a side of the cell with two object corners at opposite
 * ends the object is connected, on both sides of it alike. No triangle has a side along a side of the cell but where
 * the surface crosses it. So the triangles of all cells together are a closed surface without an edge of more than two
 * faces.
 * \ingroup MedialVoxel
 */
class MedialVoxelIsosurfaceTable
{
public:
  static constexpr unsigned int NumberOfEdges = 12;

  /** Edges of the cell that the corners of a triangle lie on, counter-clockwise seen from outside of the object. */
  using Triangle = std::array<std::uint8_t, 3>;

  /** The triangles by number: bit c is set when corner c is object. */
  static const std::vector<Triangle> &
  Get(unsigned int objectCorners);

  /** Axis of an edge. Edges of an axis follow each other, by the lower of their corners. */
  static unsigned int
  GetAxis(unsigned int edge)
  {
    return edge / 4;
  }

  /** Corner of an edge with the lower coordinate along its axis. */
  static unsigned int
  GetLowerCorner(unsigned int edge);
};

} // end namespace itk

#endif
