// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSpread.h"

#include <algorithm>
#include <cmath>

namespace itk
{

void
MedialVoxelSpread::Add(const Point & point, const double weight)
{
  const Point offset = MedialVoxelSubtract(point, m_Origin);
  m_Weight += weight;
  m_Sum = MedialVoxelAddScaled(m_Sum, offset, weight);
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column <= row; ++column)
    {
      m_Squares[row][column] += weight * (offset[row] * offset[column]);
    }
  }
}

MedialVoxelSpread::Point
MedialVoxelSpread::GetMiddle() const
{
  return m_Weight > 0.0 ? MedialVoxelAddScaled(m_Origin, m_Sum, 1.0 / m_Weight) : m_Origin;
}

MedialVoxelMatrix3
MedialVoxelSpread::GetCovariance() const
{
  MedialVoxelMatrix3 covariance{};
  for (unsigned int row = 0; m_Weight > 0.0 && row < 3; ++row)
  {
    for (unsigned int column = 0; column <= row; ++column)
    {
      const double value = m_Squares[row][column] / m_Weight - m_Sum[row] / m_Weight * (m_Sum[column] / m_Weight);
      covariance[row][column] = value;
      covariance[column][row] = value;
    }
  }
  return covariance;
}

bool
MedialVoxelSpread::IsWithin(const double distance) const
{
  // The least variance is above a value where the covariance less that value is positive definite.
  MedialVoxelMatrix3 rest = this->GetCovariance();
  for (unsigned int k = 0; k < 3; ++k)
  {
    rest[k][k] -= distance * distance;
  }
  const double minor = rest[0][0] * rest[1][1] - rest[0][1] * rest[1][0];
  const double determinant = (rest[2][2] * minor - rest[2][1] * (rest[0][0] * rest[1][2] - rest[1][0] * rest[0][2])) +
                             rest[2][0] * (rest[0][1] * rest[1][2] - rest[1][1] * rest[0][2]);
  return !(rest[0][0] > 0.0 && minor > 0.0 && determinant > 0.0);
}

MedialVoxelSpread::Axes
MedialVoxelSpread::FindAxes() const
{
  MedialVoxelMatrix3          a = this->GetCovariance();
  const double                negligible = 1e-15 * (a[0][0] + a[1][1] + a[2][2]);
  const MedialVoxelMatrix3    axes = MedialVoxelFindEigenvectors(a, negligible);
  std::array<unsigned int, 3> order{ { 0, 1, 2 } };
  std::stable_sort(
    order.begin(), order.end(), [&](const unsigned int i, const unsigned int k) { return a[i][i] < a[k][k]; });
  Axes result{};
  for (unsigned int k = 0; k < 3; ++k)
  {
    result.variances[k] = std::max(0.0, a[order[k]][order[k]]);
    result.directions[k] = axes[order[k]];
  }
  return result;
}

} // end namespace itk
