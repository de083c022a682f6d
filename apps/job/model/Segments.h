// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSegments_h
#define medialvoxelSegments_h

#include "Options.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Red, green and blue, each from 0 to 1. */
using SegmentColor = std::array<double, 3>;

/** Name and color of an object of a label map. Texts have no control characters. */
struct Segment
{
  std::int64_t                label{ 0 }; ///< from -2^31 to 2^31 - 1, not 0
  std::string                 name;       ///< may be empty
  std::optional<SegmentColor> color;
  std::string                 id;   ///< in a segmentation of 3D Slicer; empty: it has none
  std::string                 tags; ///< 3D Slicer's terminology of the segment; empty: none
};

/** \class SegmentTable
 * \brief Segments in the order of their file, each label once. */
class SegmentTable
{
public:
  /** \return false for a label that is there, and nothing was added */
  bool
  Add(const Segment & segment);

  /** Null for a label that is not there. */
  const Segment *
  Find(std::int64_t label) const;

  const std::vector<Segment> &
  GetSegments() const
  {
    return m_Segments;
  }

  bool
  IsEmpty() const
  {
    return m_Segments.empty();
  }

private:
  std::vector<Segment>                m_Segments;
  std::map<std::int64_t, std::size_t> m_Places; ///< in the list, by label
};

/** The labels of a selection, with labels given by names.
 * \throw JobError Usage for a name that no segment has, or several have */
LabelSelection
ResolveNames(const LabelSelection & selection, const SegmentTable & table);

/** The segments of a selection, and one without a color for each selected label that has none. An empty table stays
 * empty. \param selection without names */
SegmentTable
SelectSegments(const SegmentTable & table, const LabelSelection & selection);

} // end namespace medialvoxel

#endif
