// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LabelSurvey.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{

LabelSurvey::LabelSurvey(const std::filesystem::path & fileName,
                         const LabelSelection &        selection,
                         const itk::MedialVoxelIndex & size,
                         std::uint64_t                 maximumPoreSize)
  : m_FileName(fileName)
  , m_Selection(selection)
  , m_RowLength(static_cast<std::size_t>(size[0]))
  , m_Adjacency(size, maximumPoreSize)
  , m_Voxels(1, 0)
{}

auto
LabelSurvey::Finish() const -> Result
{
  for (const std::int64_t value : m_Selection.values)
  {
    if (m_Numbers.count(value) == 0)
    {
      Fail(ExitStatus::Usage, m_FileName.string(), ": no voxel has the label ", value);
    }
  }
  Result result;
  for (const auto & [value, number] : m_Numbers)
  {
    result.values.push_back(value);
  }
  if (result.values.empty())
  {
    Fail(ExitStatus::Usage, m_FileName.string(), ": all voxels are 0; there is no object");
  }
  std::sort(result.values.begin(), result.values.end());

  const auto passes = m_Adjacency.MakePasses(result.values.size());
  result.passes.assign(1, 0);
  result.voxels.assign(1, m_Voxels[0]);
  result.numbers.assign(result.values.size() + 1, 0);
  for (std::size_t i = 0; i < result.values.size(); ++i)
  {
    const ObjectNumber came = m_Numbers.at(result.values[i]);
    result.passes.push_back(passes[came]);
    result.voxels.push_back(m_Voxels[came]);
    result.numbers[came] = static_cast<ObjectNumber>(i + 1);
  }
  return result;
}

ObjectNumber
LabelSurvey::FindLabel(std::int64_t value)
{
  if (value == 0)
  {
    return 0;
  }
  const auto known = m_Numbers.find(value);
  if (known != m_Numbers.end())
  {
    return known->second;
  }
  const auto & values = m_Selection.values;
  if (!m_Selection.all && !std::binary_search(values.begin(), values.end(), value))
  {
    return 0;
  }
  if (m_Voxels.size() > MostObjects)
  {
    Fail(ExitStatus::CorruptInput,
         m_FileName.string(),
         ": more than ",
         MostObjects,
         " different values; a label map has at most so many objects");
  }
  const auto number = static_cast<ObjectNumber>(m_Voxels.size());
  m_Voxels.push_back(0);
  m_Numbers[value] = number;
  return number;
}

void
LabelSurvey::RefuseValue(double value) const
{
  Fail(ExitStatus::CorruptInput,
       m_FileName.string(),
       ": a voxel has the value ",
       FormatNumber(value),
       "; labels are whole numbers from -2^63 to 2^63 - 1");
}

void
LabelSurvey::AddRows()
{
  m_Row.insert(m_Row.end(), m_Objects.begin(), m_Objects.end());
  std::size_t done = 0;
  for (; done + m_RowLength <= m_Row.size(); done += m_RowLength)
  {
    m_Adjacency.AddRow(m_Row.data() + done);
  }
  m_Row.erase(m_Row.begin(), m_Row.begin() + static_cast<std::ptrdiff_t>(done));
}

} // end namespace medialvoxel
