// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSmoothedSlices_h
#define medialvoxelSmoothedSlices_h

#include "ValueStream.h"

#include "itkMedialVoxelSmoothing.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace medialvoxel
{

/** Slices that are smoothed together, of a volume that comes from front to back. */
struct SmoothedSlicesNumbers
{
  static constexpr std::int64_t Step = 8;

  /** Slices whose values are in memory. */
  static constexpr std::int64_t MostSlices = Step + 2 * itk::MedialVoxelSmoothingNumbers::Margin + 1;
};

/** \class SmoothedSlices
 * \brief Smooths a volume whose values come from front to back. */
template <typename TValue, typename TRule>
class SmoothedSlices
{
public:
  /** \param take gets the object of slices, from front to back */
  SmoothedSlices(const itk::MedialVoxelBox &                       image,
                 const TRule &                                     rule,
                 std::function<void(const itk::MedialVoxelBits &)> take)
    : m_Image(image)
    , m_Take(std::move(take))
    , m_Smoother(image, rule)
  {
    const std::int64_t slices = std::min(SmoothedSlicesNumbers::MostSlices, image.upper[2]);
    m_Values.reserve(static_cast<std::size_t>(slices * this->GetVoxelsPerSlice()) + VoxelsPerChunk);
  }

  /** Adds values that follow those before. */
  void
  Append(const std::vector<TValue> & values)
  {
    m_Values.insert(m_Values.end(), values.begin(), values.end());
    const auto margin = itk::MedialVoxelSmoothingNumbers::Margin;
    while (m_Next < m_Image.upper[2])
    {
      itk::MedialVoxelBox box = m_Image;
      box.lower[2] = m_Next;
      box.upper[2] = std::min(m_Next + SmoothedSlicesNumbers::Step, m_Image.upper[2]);
      if (this->GetEnd() < std::min(box.upper[2] + margin, m_Image.upper[2]))
      {
        return;
      }
      this->Smooth(box);
      m_Next = box.upper[2];
      this->DropSlices(std::max<std::int64_t>(m_Next - margin, 0));
    }
  }

private:
  std::int64_t
  GetVoxelsPerSlice() const
  {
    return m_Image.Extent(0) * m_Image.Extent(1);
  }

  /** Slices that are complete. */
  std::int64_t
  GetEnd() const
  {
    return m_First + static_cast<std::int64_t>(m_Values.size()) / this->GetVoxelsPerSlice();
  }

  void
  Smooth(const itk::MedialVoxelBox & box)
  {
    const itk::MedialVoxelBox input = itk::MedialVoxelSmoothingNumbers::GetInputBox(box, m_Image);
    m_Object.Reshape(box);
    m_Smoother.Run(m_Values.data() + (input.lower[2] - m_First) * this->GetVoxelsPerSlice(),
                   { 1, m_Image.Extent(0), this->GetVoxelsPerSlice() },
                   box,
                   m_Object);
    m_Take(m_Object);
  }

  void
  DropSlices(std::int64_t first)
  {
    const auto number = static_cast<std::ptrdiff_t>((first - m_First) * this->GetVoxelsPerSlice());
    m_Values.erase(m_Values.begin(), m_Values.begin() + number);
    m_First = first;
  }

  itk::MedialVoxelBox                               m_Image;
  std::function<void(const itk::MedialVoxelBits &)> m_Take;
  itk::MedialVoxelSmoother<TValue, TRule>           m_Smoother;
  std::vector<TValue>                               m_Values;
  std::int64_t                                      m_First{ 0 }; ///< slice that the values begin with
  std::int64_t                                      m_Next{ 0 };  ///< slice to be smoothed
  itk::MedialVoxelBits                              m_Object;
};

} // end namespace medialvoxel

#endif
