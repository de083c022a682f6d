// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ColorTable.h"

#include "HeaderParsing.h"
#include "NrrdSegments.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

constexpr std::size_t   MaximumBytesPerLine = std::size_t{ 1 } << 16;
constexpr std::uint64_t MaximumTableSize = std::uint64_t{ 1 } << 24;
constexpr std::size_t   MostRows = 65535;
constexpr std::size_t   NoColumn = static_cast<std::size_t>(-1);

/** \class TableLines
 * \brief The lines of a table, and the error of a line. */
class TableLines
{
public:
  explicit TableLines(const std::filesystem::path & fileName)
    : m_FileName(fileName)
    , m_Lines(fileName, MaximumBytesPerLine)
  {}

  bool
  Next(std::string & line)
  {
    if (m_Lines.GetPosition() > MaximumTableSize)
    {
      RefuseHeader(m_FileName, "it has more than " + std::to_string(MaximumTableSize) + " bytes; no table has");
    }
    return m_Lines.Next(line);
  }

  [[noreturn]] void
  Refuse(const std::string & what) const
  {
    RefuseHeader(m_FileName, this->GetPlace() + what);
  }

  /** A value from 0 to 255 as a share of it. */
  double
  ParseShade(const std::string & name, const std::string & text) const
  {
    constexpr double            largest = 255.0;
    const std::optional<double> value = ParseDouble(Trim(text));
    if (!value || !(*value >= 0.0 && *value <= largest))
    {
      this->Refuse(name + " is '" + text + "'; it must be a number from 0 to 255");
    }
    return *value / largest;
  }

  /** Adds the row of a label, but not of 0. */
  void
  Add(SegmentTable &                      table,
      const std::string &                 label,
      const std::string &                 name,
      const std::optional<SegmentColor> & color) const
  {
    if (ParseInteger(Trim(label)) == 0)
    {
      return;
    }
    Segment segment;
    segment.label = ParseSegmentLabel(m_FileName, this->GetPlace() + "label", label);
    segment.name = MakeSegmentText(m_FileName, this->GetPlace() + "name", name);
    segment.color = color;
    if (!table.Add(segment))
    {
      this->Refuse("the label " + std::to_string(segment.label) + " is there twice");
    }
    if (table.GetSegments().size() > MostRows)
    {
      this->Refuse("the table has more than " + std::to_string(MostRows) + " rows");
    }
  }

private:
  std::string
  GetPlace() const
  {
    return "line " + std::to_string(m_Lines.GetLineNumber()) + ": ";
  }

  std::filesystem::path m_FileName;
  HeaderLines           m_Lines;
};

/** A name as it was before Slicer wrote it in one word. */
std::string
RestoreName(std::string name)
{
  if (name == "_")
  {
    return "";
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  const std::size_t first = name.find_first_not_of('\'');
  const std::size_t last = name.find_last_not_of('\'');
  return first == std::string::npos ? "" : name.substr(first, last - first + 1);
}

/** The cells of a line, without quotes. */
std::vector<std::string>
SplitCells(const TableLines & lines, const std::string & line, char separator)
{
  std::vector<std::string> cells(1);
  bool                     isQuoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const bool isDouble = isQuoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (isDouble)
    {
      cells.back() += line[++i];
    }
    else if (line[i] == '"')
    {
      isQuoted = !isQuoted;
    }
    else if (line[i] == separator && !isQuoted)
    {
      cells.emplace_back();
    }
    else
    {
      cells.back() += line[i];
    }
  }
  if (isQuoted)
  {
    lines.Refuse("a quotation mark is not closed");
  }
  return cells;
}

/** \class ColumnTable
 * \brief A table whose first line names its columns. */
class ColumnTable
{
public:
  ColumnTable(const std::filesystem::path & fileName, char separator)
    : m_Lines(fileName)
    , m_Separator(separator)
  {}

  SegmentTable
  Read()
  {
    this->ReadNames();
    SegmentTable table;
    for (std::string line; m_Lines.Next(line);)
    {
      if (!Trim(line).empty())
      {
        m_Cells = SplitCells(m_Lines, line, m_Separator);
        m_Lines.Add(table, this->GetCell(m_Label), this->GetCell(m_Name), this->ReadColor());
      }
    }
    return table;
  }

private:
  void
  ReadNames()
  {
    constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
    std::string                line;
    m_Lines.Next(line);
    if (line.compare(0, byteOrderMark.size(), byteOrderMark) == 0)
    {
      line.erase(0, byteOrderMark.size());
    }
    m_Names = SplitCells(m_Lines, line, m_Separator);
    m_Label = this->FindColumn("LabelValue");
    m_Name = this->FindColumn("Name");
    std::transform(std::begin(ShadeNames), std::end(ShadeNames), m_Shades.begin(), [this](const char * name) {
      return this->FindColumn(name);
    });
    if (m_Label == NoColumn)
    {
      m_Lines.Refuse("the first line does not name the column LabelValue");
    }
  }

  std::size_t
  FindColumn(const char * name) const
  {
    const auto found =
      std::find_if(m_Names.begin(), m_Names.end(), [&](const std::string & known) { return Trim(known) == name; });
    return found == m_Names.end() ? NoColumn : static_cast<std::size_t>(found - m_Names.begin());
  }

  /** Empty without this column. */
  std::string
  GetCell(std::size_t column) const
  {
    return column < m_Cells.size() ? m_Cells[column] : "";
  }

  std::optional<SegmentColor>
  ReadColor() const
  {
    SegmentColor color{};
    for (std::size_t i = 0; i < color.size(); ++i)
    {
      if (m_Shades[i] == NoColumn)
      {
        return std::nullopt;
      }
      color[i] = m_Lines.ParseShade(ShadeNames[i], this->GetCell(m_Shades[i]));
    }
    return color;
  }

  static constexpr std::array<const char *, 3> ShadeNames{ { "Color_R", "Color_G", "Color_B" } };

  TableLines                 m_Lines;
  char                       m_Separator;
  std::vector<std::string>   m_Names;
  std::vector<std::string>   m_Cells;
  std::size_t                m_Label{ NoColumn };
  std::size_t                m_Name{ NoColumn };
  std::array<std::size_t, 3> m_Shades{};
};

} // namespace

SegmentTable
ReadBlankTable(const std::filesystem::path & fileName)
{
  constexpr std::size_t fewestWords = 5;
  constexpr std::size_t mostWords = 6;
  TableLines            lines(fileName);
  SegmentTable          table;
  for (std::string line; lines.Next(line);)
  {
    if (line.rfind("# Color procedural file", 0) == 0)
    {
      lines.Refuse("it is a file of a color function, not of the colors of labels");
    }
    const std::vector<std::string> words = SplitAtBlanks(line);
    if (words.empty() || words[0][0] == '#')
    {
      continue;
    }
    if (words.size() < fewestWords || words.size() > mostWords)
    {
      lines.Refuse("it has " + std::to_string(words.size()) + " words, not label, name, red, green, blue and opacity");
    }
    const SegmentColor color{
      { lines.ParseShade("red", words[2]), lines.ParseShade("green", words[3]), lines.ParseShade("blue", words[4]) }
    };
    lines.Add(table, words[0], RestoreName(words[1]), color);
  }
  return table;
}

SegmentTable
ReadCommaTable(const std::filesystem::path & fileName)
{
  return ColumnTable(fileName, ',').Read();
}

SegmentTable
ReadTabTable(const std::filesystem::path & fileName)
{
  return ColumnTable(fileName, '\t').Read();
}

} // end namespace medialvoxel
