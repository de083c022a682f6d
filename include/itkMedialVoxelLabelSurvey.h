// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelLabelSurvey_h
#define itkMedialVoxelLabelSurvey_h

#include "itkMedialVoxelLabelTable.h"
#include "itkMedialVoxelObjectAdjacency.h"

#include "MedialVoxelExport.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace itk
{

/** \class MedialVoxelLabelSurvey
 * \brief Finds the objects of a label map and the close pairs among them, in one pass over its values.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelLabelSurvey
{
public:
  /** The result. */
  struct Result
  {
    std::vector<std::int64_t>            values;  ///< of the objects, ascending
    std::vector<MedialVoxelObjectNumber> passes;  ///< by number in that order, with one for the background first
    std::vector<std::uint64_t>           voxels;  ///< the same
    std::vector<std::int64_t>            missing; ///< selected values that no voxel has
  };

  /** \param values of objects, none of them 0; empty: all but 0
   * \param size of the image, 1 along unused axes
   * \param maximumPoreSize of the extraction */
  MedialVoxelLabelSurvey(std::vector<std::int64_t> values,
                         const MedialVoxelIndex &  size,
                         std::uint64_t             maximumPoreSize);

  /** Adds the next values.
   * \return their objects, numbered as they came, until the next call
   * \throw MedialVoxelLabelError for a number that is not whole, for too many values, or for too many that are close */
  template <typename TValue>
  const std::vector<MedialVoxelObjectNumber> &
  Add(const TValue * const values, const std::size_t count)
  {
    m_Objects.resize(count);
    TValue                  last{};
    MedialVoxelObjectNumber object = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!(values[i] == last))
      {
        last = values[i];
        object = this->Find(last);
      }
      m_Objects[i] = object;
      ++m_Voxels[object];
    }
    this->AddRows();
    return m_Objects;
  }

  /** \throw MedialVoxelLabelError for more passes than a label map takes */
  Result
  Finish();

  std::uint64_t
  GetNotANumberVoxels() const
  {
    return m_NotANumberVoxels;
  }

private:
  template <typename TValue>
  MedialVoxelObjectNumber
  Find(const TValue value)
  {
    if (value != value)
    {
      ++m_NotANumberVoxels;
      return 0;
    }
    const std::optional<std::int64_t> label = MedialVoxelToLabel(value);
    if (!label)
    {
      using Shown = std::conditional_t<std::is_integral_v<TValue>, std::uint64_t, double>;
      RefuseValue(static_cast<Shown>(value)); // among whole numbers, only 64-bit ones are too large
    }
    return this->FindLabel(*label);
  }

  MedialVoxelObjectNumber
  FindLabel(std::int64_t value);

  [[noreturn]] static void
  RefuseValue(double value);
  [[noreturn]] static void
  RefuseValue(std::uint64_t value);

  void
  AddRows();

  std::vector<std::int64_t>                                 m_Selected; ///< ascending
  std::size_t                                               m_RowLength;
  MedialVoxelObjectAdjacency                                m_Adjacency;
  std::unordered_map<std::int64_t, MedialVoxelObjectNumber> m_Numbers; ///< by value, as they came
  std::vector<std::uint64_t>                                m_Voxels;  ///< by these numbers
  std::vector<MedialVoxelObjectNumber>                      m_Objects; ///< of the values that came last
  std::vector<MedialVoxelObjectNumber>                      m_Row;     ///< that is not complete
  std::uint64_t                                             m_NotANumberVoxels{ 0 };
};

} // end namespace itk

#endif
