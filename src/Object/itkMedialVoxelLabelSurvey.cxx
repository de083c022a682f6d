// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelLabelSurvey.h"

#include "itkMedialVoxelText.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace itk
{
namespace
{

[[noreturn]] void
RefuseText(const std::string & value)
{
  throw MedialVoxelLabelError("a voxel has the value " + value + "; labels are whole numbers from -2^63 to 2^63 - 1");
}

} // namespace

MedialVoxelLabelSurvey::MedialVoxelLabelSurvey(std::vector<std::int64_t> values,
                                               const MedialVoxelIndex &  size,
                                               const std::uint64_t       maximumPoreSize)
  : m_Selected(std::move(values))
  , m_RowLength(static_cast<std::size_t>(size[0]))
  , m_Adjacency(size, maximumPoreSize)
  , m_Voxels(1, 0)
{
  std::sort(m_Selected.begin(), m_Selected.end());
}

auto
MedialVoxelLabelSurvey::Finish() -> Result
{
  Result result;
  for (const auto & [value, number] : m_Numbers)
  {
    result.values.push_back(value);
  }
  std::sort(result.values.begin(), result.values.end());
  std::set_difference(m_Selected.begin(),
                      m_Selected.end(),
                      result.values.begin(),
                      result.values.end(),
                      std::back_inserter(result.missing));

  const auto passes = m_Adjacency.MakePasses(result.values.size());
  result.passes.assign(1, 0);
  result.voxels.assign(1, m_Voxels[0]);
  for (const std::int64_t value : result.values)
  {
    const MedialVoxelObjectNumber came = m_Numbers.at(value);
    result.passes.push_back(passes[came]);
    result.voxels.push_back(m_Voxels[came]);
  }
  return result;
}

MedialVoxelObjectNumber
MedialVoxelLabelSurvey::FindLabel(const std::int64_t value)
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
  if (!m_Selected.empty() && !std::binary_search(m_Selected.begin(), m_Selected.end(), value))
  {
    return 0;
  }
  if (m_Voxels.size() > MedialVoxelMostObjects)
  {
    throw MedialVoxelLabelError("more than " + std::to_string(MedialVoxelMostObjects) +
                                " different values; a label map has at most so many objects");
  }
  const auto number = static_cast<MedialVoxelObjectNumber>(m_Voxels.size());
  m_Voxels.push_back(0);
  m_Numbers[value] = number;
  return number;
}

void
MedialVoxelLabelSurvey::RefuseValue(const double value)
{
  RefuseText(MedialVoxelText::FormatNumber(value));
}

void
MedialVoxelLabelSurvey::RefuseValue(const std::uint64_t value)
{
  RefuseText(std::to_string(value));
}

void
MedialVoxelLabelSurvey::AddRows()
{
  m_Row.insert(m_Row.end(), m_Objects.begin(), m_Objects.end());
  std::size_t done = 0;
  for (; done + m_RowLength <= m_Row.size(); done += m_RowLength)
  {
    m_Adjacency.AddRow(m_Row.data() + done);
  }
  m_Row.erase(m_Row.begin(), m_Row.begin() + static_cast<std::ptrdiff_t>(done));
}

} // end namespace itk
