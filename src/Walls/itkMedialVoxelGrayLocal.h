// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGrayLocal_h
#define itkMedialVoxelGrayLocal_h

#include "itkMedialVoxelGray.h"
#include "itkMedialVoxelVector3.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelGrayLocal
 * \brief Gray values along a line, as the measurements of walls need them. Lengths are in voxels.
 *
 * Beyond a face of the image the outermost voxels are continued. Values are normalized: 0 is background, 1 is material.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGrayLocal
{
public:
  /** \class Samples
   * \brief Voxels near a line.
   * \ingroup MedialVoxel
   */
  class Samples
  {
  public:
    void
    Clear()
    {
      m_Number = 0;
    }

    std::size_t
    GetNumber() const
    {
      return m_Number;
    }

    /** Those whose weight is positive.
     *
     * \param along   places along the line, from the place that was asked for
     * \param weight  from 0, at Radius from the line, to 1, on the line
     * \param value   normalized */
    template <std::size_t VNumber>
    void
    PutRow(const std::array<float, VNumber> & along,
           const std::array<float, VNumber> & weight,
           const std::array<float, VNumber> & value)
    {
      if (m_Number + VNumber > m_Along.size())
      {
        const std::size_t room = 2 * (m_Number + VNumber);
        m_Along.resize(room);
        m_Weight.resize(room);
        m_Value.resize(room);
      }
      for (std::size_t i = 0; i < VNumber; ++i)
      {
        m_Along[m_Number] = along[i];
        m_Weight[m_Number] = weight[i];
        m_Value[m_Number] = value[i];
        m_Number += weight[i] > 0.0F ? 1 : 0; // the next one takes its place
      }
    }

    void
    Add(const double along, const double weight, const double value)
    {
      using One = std::array<float, 1>;
      this->PutRow(One{ { static_cast<float>(along) } },
                   One{ { static_cast<float>(weight) } },
                   One{ { static_cast<float>(value) } });
    }

    /** The values of other levels. */
    void
    Normalize(double background, double material);

    const float *
    GetAlong() const
    {
      return m_Along.data();
    }

    const float *
    GetWeights() const
    {
      return m_Weight.data();
    }

    const float *
    GetValues() const
    {
      return m_Value.data();
    }

  private:
    std::vector<float> m_Along;
    std::vector<float> m_Weight;
    std::vector<float> m_Value;
    std::size_t        m_Number{ 0 };
  };

  /** Distance from a line at which voxels no longer count: 9 lines a voxel apart average as many values. */
  static constexpr double Radius = 2.2;

  /** Square of the sum of the weights over the sum of their squares, for each voxel of length of a line. */
  static double
  GetEffectiveNumber(unsigned int numberOfActiveAxes);

  MedialVoxelGrayLocal(const MedialVoxelGrid & grid, double background, double material);

  /** The voxels near a line through a place, up to \a reach along it to both sides. */
  void
  FindSamples(const MedialVoxelGray &    gray,
              const MedialVoxelVector3 & place,
              const MedialVoxelVector3 & direction,
              double                     reach,
              Samples &                  samples) const;

private:
  MedialVoxelGrid m_Grid;
  double          m_Background;
  double          m_Scale; // to the contrast 1
};

} // end namespace itk

#endif
