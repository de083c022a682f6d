// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelEigenvectors.h"

#include <cmath>

namespace itk
{

MedialVoxelMatrix3
MedialVoxelFindEigenvectors(MedialVoxelMatrix3 & matrix, const double negligible)
{
  constexpr unsigned int sweeps = 6; // more than 3 rows need
  MedialVoxelMatrix3     vectors{ { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } } };
  for (unsigned int step = 0; step < 3 * sweeps; ++step)
  {
    const unsigned int p = step % 3 == 2 ? 1 : 0;
    const unsigned int q = step % 3 == 0 ? 1 : 2;
    if (std::abs(matrix[p][q]) <= negligible)
    {
      continue;
    }
    const double ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
    const double tangent = (ratio < 0.0 ? -1.0 : 1.0) / (std::abs(ratio) + std::sqrt(ratio * ratio + 1.0));
    const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
    const double sine = tangent * cosine;
    const auto   rotate = [&](double & first, double & second) {
      const double value = first;
      first = cosine * value - sine * second;
      second = sine * value + cosine * second;
    };
    for (unsigned int k = 0; k < 3; ++k)
    {
      rotate(matrix[k][p], matrix[k][q]);
    }
    for (unsigned int k = 0; k < 3; ++k)
    {
      rotate(matrix[p][k], matrix[q][k]);
      rotate(vectors[p][k], vectors[q][k]);
    }
  }
  return vectors;
}

} // end namespace itk
