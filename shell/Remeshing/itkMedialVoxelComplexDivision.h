// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelComplexDivision_h
#define itkMedialVoxelComplexDivision_h

#include "itkMedialVoxelTriangleComplex.h"

namespace itk
{

/** Cuts places across their longest extent, until no part has more of them than \a most.
 * \param numbers of the places that count
 * \param share   of them, > 0 and < 1, on the low side of a cut: another share cuts elsewhere
 * \return numbers of each part, in their order */
std::vector<std::vector<MedialVoxelTriangleComplex::Index>>
MedialVoxelDividePlaces(const std::vector<MedialVoxelVector3> &        places,
                        std::vector<MedialVoxelTriangleComplex::Index> numbers,
                        std::size_t                                    most,
                        double                                         share);

/** Parts of a complex that can be done at the same time. */
struct MedialVoxelComplexDivision
{
  using Index = MedialVoxelTriangleComplex::Index;

  std::vector<std::vector<Index>> parts;    ///< numbers of the triangles of each
  std::vector<bool>               isShared; ///< of each vertex, whether several parts have it
};

/** Cuts a complex as MedialVoxelDividePlaces() cuts the middles of its triangles. */
MedialVoxelComplexDivision
MedialVoxelDivideComplex(const MedialVoxelTriangleComplex & complex, std::size_t most, double share);

} // end namespace itk

#endif
