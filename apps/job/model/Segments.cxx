// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Segments.h"

#include "Errors.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{
namespace
{

std::int64_t
FindLabel(const SegmentTable & table, const std::string & name)
{
  const Segment * found = nullptr;
  for (const Segment & segment : table.GetSegments())
  {
    if (segment.name == name && found != nullptr)
    {
      Fail(ExitStatus::Usage,
           "'",
           name,
           "' is the name of the labels ",
           found->label,
           " and ",
           segment.label,
           "; name one of them by its number");
    }
    found = segment.name == name ? &segment : found;
  }
  if (found == nullptr)
  {
    Fail(ExitStatus::Usage,
         "the labels are all, whole numbers other than 0 from -2^63 to 2^63 - 1, or names of segments; '",
         name,
         table.IsEmpty() ? "' is none of these, as the input has no names; --segments gives them"
                         : "' is no name of a segment");
  }
  return found->label;
}

/** 3D Slicer stores labels of this range. */
bool
CanBeSegment(std::int64_t label)
{
  using Limits = std::numeric_limits<std::int32_t>;
  return label >= Limits::min() && label <= Limits::max();
}

} // namespace

bool
SegmentTable::Add(const Segment & segment)
{
  const bool isNew = m_Places.emplace(segment.label, m_Segments.size()).second;
  if (isNew)
  {
    m_Segments.push_back(segment);
  }
  return isNew;
}

const Segment *
SegmentTable::Find(std::int64_t label) const
{
  const auto found = m_Places.find(label);
  return found == m_Places.end() ? nullptr : &m_Segments[found->second];
}

LabelSelection
ResolveNames(const LabelSelection & selection, const SegmentTable & table)
{
  LabelSelection resolved{ selection.all, selection.values, {} };
  for (const std::string & name : selection.names)
  {
    resolved.values.push_back(FindLabel(table, name));
  }
  std::sort(resolved.values.begin(), resolved.values.end());
  resolved.values.erase(std::unique(resolved.values.begin(), resolved.values.end()), resolved.values.end());
  return resolved;
}

SegmentTable
SelectSegments(const SegmentTable & table, const LabelSelection & selection)
{
  if (table.IsEmpty() || selection.all)
  {
    return table;
  }
  SegmentTable selected;
  for (const Segment & segment : table.GetSegments())
  {
    if (std::binary_search(selection.values.begin(), selection.values.end(), segment.label))
    {
      selected.Add(segment);
    }
  }
  for (const std::int64_t label : selection.values)
  {
    if (CanBeSegment(label))
    {
      Segment segment;
      segment.label = label;
      selected.Add(segment);
    }
  }
  return selected;
}

} // end namespace medialvoxel
