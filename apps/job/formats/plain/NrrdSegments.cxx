// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "NrrdSegments.h"

#include "HeaderParsing.h"
#include "SealedJson.h"
#include "Text.h"

#include "itkMedialVoxelNrrdHeader.h"

#include <algorithm>
#include <limits>
#include <set>

namespace medialvoxel
{
namespace
{

// Names of vtkMRMLSegmentationStorageNode.
constexpr const char * RepresentationKey = "Segmentation_MasterRepresentation";
constexpr const char * RepresentationsKey = "Segmentation_ContainedRepresentationNames";
constexpr const char * OffsetKey = "Segmentation_ReferenceImageExtentOffset";
constexpr const char * Representation = "Binary labelmap";

constexpr const char * DefaultLabel = "1";

constexpr std::size_t LongestName = 1024;
constexpr std::size_t LongestTags = 65536;

std::string
MakeKey(std::size_t segment, const char * name)
{
  return "Segment" + std::to_string(segment) + "_" + name;
}

/** Valid UTF-8 without control characters. */
std::string
MakeText(const std::string & text)
{
  const std::string valid = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return itk::MedialVoxelText::MakePrintable(Json::parse(valid).get<std::string>());
}

/** The keys of a segment of a file. */
class SegmentReader
{
public:
  SegmentReader(const std::filesystem::path & fileName, const NrrdKeys & keys, std::size_t segment)
    : m_FileName(fileName)
    , m_Keys(keys)
    , m_Segment(segment)
  {}

  Segment
  Read() const
  {
    this->CheckLayer();
    Segment           segment;
    const std::string labelKey = MakeKey(m_Segment, "LabelValue");
    segment.label = ParseSegmentLabel(m_FileName, labelKey, this->Find("LabelValue").value_or(DefaultLabel));
    segment.id = MakeSegmentText(m_FileName, MakeKey(m_Segment, "ID"), this->Find("ID").value_or(""));
    segment.name = MakeSegmentText(m_FileName, MakeKey(m_Segment, "Name"), this->Find("Name").value_or(segment.id));
    segment.color = this->ReadColor();
    segment.tags = this->ReadTags();
    return segment;
  }

private:
  std::optional<std::string>
  Find(const char * name) const
  {
    const auto found = m_Keys.find(MakeKey(m_Segment, name));
    return found == m_Keys.end() ? std::nullopt : std::optional<std::string>(found->second);
  }

  void
  CheckLayer() const
  {
    const std::string layer = this->Find("Layer").value_or("0");
    if (ParseInteger(Trim(layer)) != 0)
    {
      RefuseHeader(m_FileName,
                   MakeKey(m_Segment, "Layer") + " is '" + layer + "'; segments are read from files of one layer, 0");
    }
  }

  std::optional<SegmentColor>
  ReadColor() const
  {
    const std::optional<std::string> text = this->Find("Color");
    if (!text)
    {
      return std::nullopt;
    }
    const std::string         key = MakeKey(m_Segment, "Color");
    const std::vector<double> numbers = ParseNumbers(m_FileName, key, *text, 3);
    if (std::any_of(numbers.begin(), numbers.end(), [](double number) { return number < 0.0 || number > 1.0; }))
    {
      RefuseHeader(m_FileName, key + " is '" + *text + "'; red, green and blue are from 0 to 1");
    }
    return SegmentColor{ { numbers[0], numbers[1], numbers[2] } };
  }

  std::string
  ReadTags() const
  {
    const std::string tags = this->Find("Tags").value_or("");
    if (tags.size() > LongestTags)
    {
      RefuseHeader(m_FileName,
                   MakeKey(m_Segment, "Tags") + " has " + std::to_string(tags.size()) + " bytes; up to " +
                     std::to_string(LongestTags) + " are read");
    }
    return MakeText(tags);
  }

  const std::filesystem::path & m_FileName;
  const NrrdKeys &              m_Keys;
  std::size_t                   m_Segment;
};

/** The ID of the segment, or one that none has. */
std::string
MakeId(const Segment & segment, std::set<std::string> & taken)
{
  std::string id = segment.id.empty() ? "Segment_" + std::to_string(segment.label) : segment.id;
  while (!taken.insert(id).second)
  {
    id += "_";
  }
  return id;
}

/** First and last voxel along each of three axes. */
std::string
MakeExtent(const std::vector<std::uint64_t> & size)
{
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    text += (axis == 0 ? "0 " : " 0 ") + std::to_string(axis < size.size() ? size[axis] - 1 : 0);
  }
  return text;
}

} // namespace

std::string
MakeSegmentText(const std::filesystem::path & fileName, const std::string & what, const std::string & text)
{
  if (text.size() > LongestName)
  {
    RefuseHeader(fileName,
                 what + " has " + std::to_string(text.size()) + " bytes; up to " + std::to_string(LongestName) +
                   " are read");
  }
  return MakeText(text);
}

std::int64_t
ParseSegmentLabel(const std::filesystem::path & fileName, const std::string & what, const std::string & text)
{
  using Limits = std::numeric_limits<std::int32_t>;
  const std::optional<std::int64_t> label = ParseInteger(Trim(text));
  if (!label || *label == 0 || *label < Limits::min() || *label > Limits::max())
  {
    RefuseHeader(fileName, what + " is '" + text + "'; a label is a whole number other than 0, from -2^31 to 2^31 - 1");
  }
  return *label;
}

bool
HasNrrdSegments(const NrrdKeys & keys)
{
  return keys.count(MakeKey(0, "ID")) > 0;
}

SegmentTable
ReadNrrdSegments(const std::filesystem::path & fileName)
{
  const NrrdKeys keys = itk::ReadMedialVoxelNrrdHeader(fileName).keyValues;
  SegmentTable   table;
  for (std::size_t number = 0; keys.count(MakeKey(number, "ID")) > 0; ++number)
  {
    if (number == MostNrrdSegments)
    {
      RefuseHeader(fileName, "it has more than " + std::to_string(MostNrrdSegments) + " segments");
    }
    const Segment segment = SegmentReader(fileName, keys, number).Read();
    if (!table.Add(segment))
    {
      RefuseHeader(fileName,
                   MakeKey(number, "LabelValue") + " is '" + std::to_string(segment.label) +
                     "', as that of another segment; each has a label of its own");
    }
  }
  return table;
}

NrrdKeys
MakeNrrdSegments(const SegmentTable & table, const std::vector<std::uint64_t> & size)
{
  if (table.IsEmpty())
  {
    return {};
  }
  NrrdKeys              keys{ { RepresentationKey, Representation },
                              { RepresentationsKey, std::string(Representation) + "|" },
                              { OffsetKey, "0 0 0" } };
  std::set<std::string> ids;
  std::size_t           number = 0;
  for (const Segment & segment : table.GetSegments())
  {
    const auto        set = [&](const char * name, const std::string & value) { keys[MakeKey(number, name)] = value; };
    const std::string id = MakeId(segment, ids);
    set("ID", id);
    set("Name", segment.name.empty() ? id : segment.name);
    set("NameAutoGenerated", "0");
    if (segment.color)
    {
      set("Color", FormatNumbers({ segment.color->begin(), segment.color->end() }, " "));
      set("ColorAutoGenerated", "0");
    }
    set("Extent", MakeExtent(size));
    set("LabelValue", std::to_string(segment.label));
    set("Layer", "0");
    set("Tags", segment.tags.empty() ? "|" : segment.tags);
    ++number;
  }
  return keys;
}

} // end namespace medialvoxel
