// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceComponents_h
#define itkMedialVoxelSurfaceComponents_h

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelSurfaceComponents
 * \brief Finds the connected components of a surface while it comes in, and numbers the vertices of kept components.
 *
 * Quadrilaterals that share a vertex are of one component. Memory is 4 bytes for each vertex, of which there can be
 * 2^31 - 1.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceComponents
{
public:
  /** Further vertices.
   * \throw std::length_error when there are too many */
  void
  AddVertices(std::uint64_t number);

  /** A quadrilateral of vertices that are known. */
  void
  AddQuad(const std::array<std::uint64_t, 4> & vertices);

  /** Keep the components of at least \a smallest quadrilaterals, after the last one. */
  void
  Keep(std::uint64_t smallest);

  /** After Keep(): components that it does not keep. */
  std::uint64_t
  GetNumberLeftOut() const
  {
    return m_LeftOut;
  }

  /** After Keep(). */
  bool
  IsKept(const std::uint64_t vertex) const
  {
    return m_Entries[vertex] >= 0;
  }

  /** Number of a kept vertex among the kept vertices. */
  std::uint64_t
  NumberOf(const std::uint64_t vertex) const
  {
    return static_cast<std::uint64_t>(m_Entries[vertex]);
  }

private:
  std::size_t
  RootOf(std::size_t vertex);

  /** The parent in the tree of a component, or of a root -1 less the quadrilaterals of its component; after Keep() the
   * new number, or -1. */
  std::vector<std::int32_t> m_Entries;
  std::uint64_t             m_LeftOut{ 0 };
};

} // end namespace itk

#endif
