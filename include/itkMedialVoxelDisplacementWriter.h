// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelDisplacementWriter_h
#define itkMedialVoxelDisplacementWriter_h

#include "itkMedialVoxelFeatures.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace itk
{

/** \class MedialVoxelDisplacementWriter
 * \brief Turns displacements in voxels into vectors of an image: physical ones, or in index units.
 *
 * A physical vector is the direction matrix times the displacement times the spacing, like that of a displacement
 * field. A voxel without a site gets NaN in every component.
 * \ingroup MedialVoxel
 */
template <typename TVectorImage>
class MedialVoxelDisplacementWriter
{
public:
  static constexpr unsigned int Dimension = TVectorImage::ImageDimension;
  using VectorType = typename TVectorImage::PixelType;
  using ValueType = typename VectorType::ValueType;

  MedialVoxelDisplacementWriter(const TVectorImage & geometry, const bool usePhysicalUnits)
  {
    for (unsigned int row = 0; row < Dimension; ++row)
    {
      for (unsigned int column = 0; column < Dimension; ++column)
      {
        const double unit = (row == column) ? 1.0 : 0.0;
        m_Matrix[row][column] =
          usePhysicalUnits ? geometry.GetDirection()[row][column] * geometry.GetSpacing()[column] : unit;
      }
    }
  }

  VectorType
  operator()(const MedialVoxelFeatures & features, const std::size_t offset) const
  {
    VectorType vector;
    if (!features.HasSite(offset))
    {
      vector.Fill(std::numeric_limits<ValueType>::quiet_NaN());
      return vector;
    }
    const double displacement[3] = { static_cast<double>(features.dx[offset]),
                                     static_cast<double>(features.dy[offset]),
                                     static_cast<double>(features.dz[offset]) };
    for (unsigned int row = 0; row < Dimension; ++row)
    {
      double sum = 0.0;
      for (unsigned int column = 0; column < Dimension; ++column)
      {
        sum += m_Matrix[row][column] * displacement[column];
      }
      vector[row] = static_cast<ValueType>(sum);
    }
    return vector;
  }

private:
  double m_Matrix[Dimension][Dimension];
};

} // end namespace itk

#endif
