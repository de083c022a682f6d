// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSymmetricEquations_h
#define itkMedialVoxelSymmetricEquations_h

#include "itkMedialVoxelVector3.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace itk
{

/** Solves equations of a symmetric matrix, which the solution takes the place of; false: they have no one solution. */
template <std::size_t VSize>
bool
MedialVoxelSolveInPlace(std::array<std::array<double, VSize>, VSize> & matrix,
                        std::array<double, VSize> &                    values,
                        const std::size_t                              size)
{
  // Cholesky, with the lower triangle in place.
  for (std::size_t i = 0; i < size; ++i)
  {
    const double diagonal = matrix[i][i];
    for (std::size_t j = 0; j <= i; ++j)
    {
      double sum = matrix[i][j];
      for (std::size_t k = 0; k < j; ++k)
      {
        sum -= matrix[i][k] * matrix[j][k];
      }
      if (i == j && !(sum > 1e-9 * diagonal))
      {
        return false;
      }
      matrix[i][j] = i == j ? std::sqrt(sum) : sum / matrix[j][j];
    }
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      values[i] -= matrix[i][k] * values[k];
    }
    values[i] /= matrix[i][i];
  }
  for (std::size_t i = size; i-- > 0;)
  {
    for (std::size_t k = i + 1; k < size; ++k)
    {
      values[i] -= matrix[k][i] * values[k];
    }
    values[i] /= matrix[i][i];
  }
  return true;
}

/** The vector of least length whose products with directions are lengths.
 * \param small directions whose squared angle is less count as parallel */
inline MedialVoxelVector3
MedialVoxelFindShift(const std::vector<std::pair<MedialVoxelVector3, double>> & equations, const double small)
{
  std::array<std::array<double, 3>, 3> matrix{};
  MedialVoxelVector3                   shift{};
  for (unsigned int i = 0; i < 3; ++i)
  {
    matrix[i][i] = small;
    for (const auto & [direction, length] : equations)
    {
      for (unsigned int k = 0; k < 3; ++k)
      {
        matrix[i][k] += direction[i] * direction[k];
      }
      shift[i] += direction[i] * length;
    }
  }
  // Positive definite: there is a solution.
  MedialVoxelSolveInPlace(matrix, shift, 3);
  return shift;
}

} // end namespace itk

#endif
