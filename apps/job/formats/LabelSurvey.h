// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelSurvey_h
#define medialvoxelLabelSurvey_h

#include "LabelTable.h"
#include "Options.h"

#include <cstdint>
#include <filesystem>
#include <unordered_map>
#include <vector>

namespace medialvoxel
{

/** \class LabelSurvey
 * \brief Finds the objects of a label map, and which of them are close, while its values come by once from the first to
 * the last. */
class LabelSurvey
{
public:
  /** What was found. */
  struct Result
  {
    std::vector<std::int64_t>  values;  ///< of the objects, ascending
    std::vector<ObjectNumber>  passes;  ///< by number in that order, with one for the background first
    std::vector<std::uint64_t> voxels;  ///< the same
    std::vector<ObjectNumber>  numbers; ///< in that order, by the number that Add() gave
  };

  LabelSurvey(const std::filesystem::path & fileName,
              const LabelSelection &        selection,
              const itk::MedialVoxelIndex & size,
              std::uint64_t                 maximumPoreSize);

  /** Adds values that follow the ones before.
   * \return their objects, numbered as they came, until the next call
   * \throw JobError CorruptInput for a number that is not whole, or for too many values */
  template <typename TValue>
  const std::vector<ObjectNumber> &
  Add(const TValue * values, std::size_t count)
  {
    m_Objects.resize(count);
    TValue       last{};
    ObjectNumber object = 0;
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

  /** \throw JobError Usage for a selected value that did not come, or when none came at all */
  Result
  Finish() const;

  std::uint64_t
  GetNotANumberVoxels() const
  {
    return m_NotANumberVoxels;
  }

private:
  template <typename TValue>
  ObjectNumber
  Find(TValue value)
  {
    if (value != value)
    {
      ++m_NotANumberVoxels;
      return 0;
    }
    const std::optional<std::int64_t> label = ToLabel(value);
    if (!label)
    {
      this->RefuseValue(static_cast<double>(value));
    }
    return this->FindLabel(*label);
  }

  ObjectNumber
  FindLabel(std::int64_t value);

  [[noreturn]] void
  RefuseValue(double value) const;

  void
  AddRows();

  std::filesystem::path                          m_FileName;
  LabelSelection                                 m_Selection;
  std::size_t                                    m_RowLength;
  itk::MedialVoxelObjectAdjacency                m_Adjacency;
  std::unordered_map<std::int64_t, ObjectNumber> m_Numbers; ///< by value, as they came
  std::vector<std::uint64_t>                     m_Voxels;  ///< by these numbers
  std::vector<ObjectNumber>                      m_Objects; ///< of the values that came last
  std::vector<ObjectNumber>                      m_Row;     ///< that is not complete
  std::uint64_t                                  m_NotANumberVoxels{ 0 };
};

} // end namespace medialvoxel

#endif
