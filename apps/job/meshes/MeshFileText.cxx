// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshFile.h"

#include "Errors.h"
#include "Text.h"

#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <istream>

namespace medialvoxel
{
namespace
{

using Fields = std::vector<std::string>;

/** \class Lines
 * \brief The lines of a file, and what is wrong in the present one. */
class Lines
{
public:
  Lines(std::istream & input, const std::string & fileName)
    : m_Input(input)
    , m_FileName(fileName)
  {}

  bool
  Next(std::string & line)
  {
    ++m_Number;
    return ReadMeshLine(m_Input, line, m_FileName);
  }

  [[noreturn]] void
  FailAt(const std::string & what) const
  {
    Fail(ExitStatus::CorruptInput, m_FileName, ": line ", m_Number, ": ", itk::MedialVoxelText::MakePrintable(what));
  }

  std::uint64_t
  ToNumber(const Fields & fields, std::size_t place) const
  {
    const std::string text = place < fields.size() ? fields[place] : "";
    const auto        value = ParseInteger(text);
    if (!value || *value < 1)
    {
      this->FailAt("'" + text + "' is not a number from 1 on");
    }
    return static_cast<std::uint64_t>(*value);
  }

  double
  ToCoordinate(const Fields & fields, std::size_t place) const
  {
    const std::string text = place < fields.size() && !fields[place].empty() ? fields[place] : "0";
    const auto        value = ParseDouble(WithExponent(text));
    if (!value)
    {
      this->FailAt("'" + text + "' is not a coordinate");
    }
    return *value;
  }

private:
  /** Nastran writes 1.5-3 for 1.5e-3, and D for e. */
  static std::string
  WithExponent(std::string text)
  {
    std::replace_if(text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd' || c == 'E'; }, 'e');
    const std::size_t sign = text.find_first_of("+-", 1);
    if (sign != std::string::npos && text[sign - 1] != 'e')
    {
      text.insert(sign, "e");
    }
    return text;
  }

  std::istream & m_Input;
  std::string    m_FileName;
  std::uint64_t  m_Number{ 0 };
};

Fields
SplitAtCommas(const std::string & line)
{
  Fields      fields;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1)
  {
    end = line.find(',', begin);
    fields.emplace_back(Trim(line.substr(begin, end == std::string::npos ? end : end - begin)));
  }
  return fields;
}

/** The value of "TYPE = S4" among the words of a keyword, in lower case. */
std::string
GetParameter(const Fields & words, const std::string & name)
{
  for (const std::string & word : words)
  {
    const std::size_t sign = word.find('=');
    if (sign != std::string::npos && ToLower(std::string(Trim(word.substr(0, sign)))) == name)
    {
      return ToLower(std::string(Trim(word.substr(sign + 1))));
    }
  }
  return "";
}

/** A line of Abaqus goes on in the next one behind a comma: a keyword always, numbers until they are enough. */
Fields
ReadAbaqusFields(Lines & lines, std::string line, const std::size_t enough)
{
  Fields      fields = SplitAtCommas(line);
  const auto  goesOn = [&] { return fields.back().empty() && (line.front() == '*' || fields.size() <= enough); };
  std::string more;
  while (fields.size() > 1 && goesOn() && lines.Next(more))
  {
    if (more.compare(0, 2, "**") == 0)
    {
      continue;
    }
    fields.pop_back();
    const Fields next = SplitAtCommas(more);
    fields.insert(fields.end(), next.begin(), next.end());
  }
  return fields;
}

/** Whether elements of Abaqus are shells: an S before the number of their nodes. */
bool
IsShell(const std::string & type)
{
  return type.size() > 1 && type[0] == 's' && type[1] >= '0' && type[1] <= '9';
}

/** Nodes of a shell element that is read; 0: of another kind. */
unsigned int
CountNodes(const std::string & type)
{
  return type == "s3" || type == "s3r" ? 3 : type == "s4" || type == "s4r" ? 4 : 0;
}

/** Fields of 8 characters, of 16 behind a star in the first one, or between commas. */
void
AppendFields(const std::string & line, Fields & fields)
{
  if (line.find(',') != std::string::npos)
  {
    const Fields more = SplitAtCommas(line);
    fields.insert(fields.end(), more.begin() + (fields.empty() ? 0 : 1), more.end());
    return;
  }
  const std::string name = line.substr(0, 8);
  const bool        isLarge = name.find('*') != std::string::npos;
  const std::size_t width = isLarge ? 16 : 8;
  if (fields.empty())
  {
    fields.emplace_back(Trim(name));
  }
  for (unsigned int k = 0; k < (isLarge ? 4u : 8u); ++k)
  {
    const std::size_t begin = 8 + k * width;
    fields.emplace_back(begin < line.size() ? Trim(line.substr(begin, width)) : "");
  }
}

/** Fields of the widths that a card of LS-DYNA has, or between commas. */
Fields
SplitCard(const std::string & line, const std::vector<std::size_t> & widths)
{
  if (line.find(',') != std::string::npos)
  {
    return SplitAtCommas(line);
  }
  Fields      fields;
  std::size_t begin = 0;
  for (const std::size_t width : widths)
  {
    fields.emplace_back(begin < line.size() ? Trim(line.substr(begin, width)) : "");
    begin += width;
  }
  return fields;
}

/** What a keyword of LS-DYNA says of the cards that follow. */
struct KeywordCards
{
  bool         areNodes{ false };
  bool         areShells{ false };
  unsigned int further{ 0 }; ///< cards of a shell behind the one with its nodes
};

KeywordCards
GetCards(const Lines & lines, const std::string & line)
{
  const std::string  keyword = ToLower(std::string(Trim(line)));
  constexpr char     shell[] = "*element_shell";
  const KeywordCards cards{ keyword == "*node", keyword.rfind(shell, 0) == 0 };
  const bool         isLong = keyword.rfind("*keyword", 0) == 0 && keyword.find("long=y") != std::string::npos;
  if (isLong || (!keyword.empty() && (keyword.back() == '+' || keyword.back() == '%')))
  {
    lines.FailAt("cards of the long format are not read");
  }
  if (keyword.rfind("*include", 0) == 0)
  {
    lines.FailAt("*INCLUDE is not read; put the mesh into one file");
  }
  if (!cards.areShells)
  {
    return cards;
  }
  const std::string option = keyword.substr(sizeof(shell) - 1);
  if (option.empty())
  {
    return cards;
  }
  if (option != "_thickness" && option != "_beta" && option != "_mcid" && option != "_offset")
  {
    lines.FailAt("elements of " + keyword + " are not read; those with THICKNESS, BETA, MCID or OFFSET are");
  }
  return { false, true, 1 };
}

/** Numbers and nodes of a shell; the last two are the same in triangles, or the last one is missing. */
void
AddShell(const Lines & lines, const Fields & fields, MeshFileBuilder & builder)
{
  std::vector<std::uint64_t> nodes;
  for (std::size_t place = 2; place < 6; ++place)
  {
    const bool isMissing = place == 5 && (place >= fields.size() || fields[place].empty() || fields[place] == "0");
    nodes.push_back(isMissing ? nodes.back() : lines.ToNumber(fields, place));
  }
  const auto rest = fields.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(6, fields.size()));
  if (std::any_of(rest, fields.end(), [](const std::string & f) { return !f.empty() && f != "0"; }))
  {
    lines.FailAt("shells of more than four nodes are not read");
  }
  if (nodes[2] == nodes[3])
  {
    nodes.pop_back();
  }
  builder.AddElement(lines.ToNumber(fields, 0), nodes);
}

/** GRID, CTRIA3 or CQUAD4; others mean nothing here. */
void
AddEntry(const Lines & lines, const Fields & fields, MeshFileBuilder & builder)
{
  std::string name = fields.empty() ? "" : ToLower(fields.front());
  name.erase(std::remove(name.begin(), name.end(), '*'), name.end());
  if (name == "grid")
  {
    builder.AddNode(
      lines.ToNumber(fields, 1),
      { { lines.ToCoordinate(fields, 3), lines.ToCoordinate(fields, 4), lines.ToCoordinate(fields, 5) } });
  }
  else if (name == "ctria3" || name == "cquad4")
  {
    std::vector<std::uint64_t> nodes;
    for (std::size_t k = 0; k < (name == "ctria3" ? 3u : 4u); ++k)
    {
      nodes.push_back(lines.ToNumber(fields, 3 + k));
    }
    builder.AddElement(lines.ToNumber(fields, 1), nodes);
  }
}

} // namespace

void
ReadAbaqusMesh(std::istream & input, MeshFileBuilder & builder)
{
  Lines        lines(input, builder.GetFileName());
  bool         readsNodes = false;
  unsigned int nodesOfElement = 0;
  for (std::string line; lines.Next(line);)
  {
    if (line.compare(0, 2, "**") == 0 || Trim(line).empty())
    {
      continue;
    }
    const std::size_t enough = nodesOfElement > 0 ? nodesOfElement + 1 : 0;
    const Fields      fields = ReadAbaqusFields(lines, line, enough);
    if (line.front() == '*')
    {
      const std::string keyword = ToLower(fields.front());
      const std::string type = GetParameter(fields, "type");
      readsNodes = keyword == "*node";
      nodesOfElement = keyword == "*element" ? CountNodes(type) : 0;
      if (keyword == "*include")
      {
        lines.FailAt("*INCLUDE is not read; put the mesh into one file");
      }
      if (keyword == "*element" && IsShell(type) && nodesOfElement == 0)
      {
        lines.FailAt("elements of type " + type + " are not read; S3, S3R, S4 and S4R are");
      }
    }
    else if (readsNodes)
    {
      builder.AddNode(
        lines.ToNumber(fields, 0),
        { { lines.ToCoordinate(fields, 1), lines.ToCoordinate(fields, 2), lines.ToCoordinate(fields, 3) } });
    }
    else if (nodesOfElement > 0)
    {
      std::vector<std::uint64_t> nodes;
      for (unsigned int k = 0; k < nodesOfElement; ++k)
      {
        nodes.push_back(lines.ToNumber(fields, k + 1));
      }
      builder.AddElement(lines.ToNumber(fields, 0), nodes);
    }
  }
}

void
ReadNastranMesh(std::istream & input, MeshFileBuilder & builder)
{
  Lines  lines(input, builder.GetFileName());
  Fields entry;
  for (std::string line; lines.Next(line);)
  {
    line = line.substr(0, line.find('$'));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
    {
      line.pop_back();
    }
    if (line.empty())
    {
      continue;
    }
    if (line.front() != '*' && line.front() != '+' && line.front() != ' ' && line.front() != ',')
    {
      AddEntry(lines, entry, builder);
      entry.clear();
    }
    AppendFields(line, entry);
  }
  AddEntry(lines, entry, builder);
}

void
ReadLsDynaMesh(std::istream & input, MeshFileBuilder & builder)
{
  Lines        lines(input, builder.GetFileName());
  KeywordCards cards;
  unsigned int toSkip = 0;
  for (std::string line; lines.Next(line);)
  {
    if (Trim(line).empty() || line.front() == '$')
    {
      continue;
    }
    if (line.front() == '*')
    {
      cards = GetCards(lines, line);
      toSkip = 0;
      if (ToLower(std::string(Trim(line))) == "*end")
      {
        return;
      }
    }
    else if (toSkip > 0)
    {
      --toSkip;
    }
    else if (cards.areNodes)
    {
      const Fields fields = SplitCard(line, { 8, 16, 16, 16 });
      builder.AddNode(
        lines.ToNumber(fields, 0),
        { { lines.ToCoordinate(fields, 1), lines.ToCoordinate(fields, 2), lines.ToCoordinate(fields, 3) } });
    }
    else if (cards.areShells)
    {
      AddShell(lines, SplitCard(line, std::vector<std::size_t>(10, 8)), builder);
      toSkip = cards.further;
    }
  }
}

} // end namespace medialvoxel
