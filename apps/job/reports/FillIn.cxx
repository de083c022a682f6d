// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FillIn.h"

#include "EscapeHtml.h"
#include "Text.h"
#include "VolumeHeader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace medialvoxel
{
namespace
{

using Values = std::vector<const Json *>;

double
GetNumber(const Json & value)
{
  return value.is_number() ? value.get<double>() : 0.0;
}

/** The shortest text; "-" without a value. */
std::string
FormatPlain(const Json & value)
{
  if (value.is_number_float())
  {
    return FormatNumber(value.get<double>());
  }
  return value.is_string() ? value.get<std::string>() : value.is_number() ? value.dump() : "-";
}

std::string
FormatList(const Json & list, const std::string & separator, std::string (*format)(const Json &))
{
  return Join(list, separator, format);
}

std::string
FormatLength(const Json & value)
{
  return value.is_number() ? FormatShort(value.get<double>()) : "-";
}

/** A share of 1, or of the product of further values. */
std::string
FormatShareOf(const Values & values)
{
  const double all = std::accumulate(values.begin() + 1, values.end(), 1.0, [](double product, const Json * value) {
    return product * GetNumber(*value);
  });
  return all > 0.0 ? FormatFixed(100.0 * GetNumber(*values.front()) / all, 2) + " %" : "-";
}

/** A count of voxels as a share of a volume, by its size. */
std::string
FormatFilled(const Values & values)
{
  const auto volume =
    std::accumulate(values[1]->begin(), values[1]->end(), 1.0, [](double product, const Json & length) {
      return product * GetNumber(length);
    });
  return FormatFixed(100.0 * GetNumber(*values.front()) / volume, 2) + " %";
}

/** The largest of them. */
std::string
FormatLargest(const Values & values)
{
  return FormatLength(**std::max_element(
    values.begin(), values.end(), [](const Json * a, const Json * b) { return GetNumber(*a) < GetNumber(*b); }));
}

/** The first value as a share of the sum of the others; "-" of nothing. */
std::string
FormatShare(const Values & values)
{
  const auto all =
    std::accumulate(values.begin() + 1, values.end(), std::uint64_t{ 0 }, [](auto sum, const Json * value) {
      return sum + value->get<std::uint64_t>();
    });
  return all > 0 ? FormatPercent(values.front()->get<std::uint64_t>(), all) : "-";
}

/** A count, and its share where there is one. */
std::string
FormatCount(const Values & values)
{
  const std::string share = FormatShare(values);
  return FormatPlain(*values.front()) + (share == "-" ? "" : " (" + share + ")");
}

/** Lists one behind the other, each with three numbers. */
std::string
FormatPoints(const Values & values, const char * separator, std::string (*format)(const Json &))
{
  Json numbers = Json::array();
  for (const Json * const point : values)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      numbers.push_back(axis < point->size() ? (*point)[axis] : Json(0));
    }
  }
  return FormatList(numbers, separator, format);
}

std::string
FormatColor(const Values & values)
{
  constexpr double largest = 255.0;
  return FormatList(*values.front(), ",", [](const Json & shade) {
    return std::to_string(std::lround(shade.get<double>() * largest));
  });
}

std::string
DescribeUnit(const Json & result)
{
  const Json &   input = result["input"];
  VolumeGeometry geometry;
  geometry.spacing = input.value("spacing", std::vector<double>{});
  geometry.inMillimeters = !input["unit"].is_null();
  return geometry.DescribeUnit();
}

struct Format
{
  std::string_view name;
  std::string (*make)(const Values &);
};

const std::array<Format, 19> Formats{ {
  { "", [](const Values & values) { return FormatPlain(*values.front()); } },
  { "short", FormatLargest },
  { "rough", [](const Values & values) { return FormatShort(GetNumber(*values.front()), 3); } },
  { "fixed", [](const Values & values) { return FormatFixed(GetNumber(*values.front()), 2); } },
  { "percent", FormatShareOf },
  { "filled", FormatFilled },
  { "share", FormatShare },
  { "count", FormatCount },
  { "size", [](const Values & values) { return std::to_string(values.front()->size()); } },
  { "times", [](const Values & values) { return FormatList(*values.front(), " x ", FormatPlain); } },
  { "list", [](const Values & values) { return FormatList(*values.front(), ", ", FormatPlain); } },
  { "lengths", [](const Values & values) { return FormatList(*values.front(), ", ", FormatLength); } },
  { "points", [](const Values & values) { return FormatPoints(values, " ", FormatPlain); } },
  { "position", [](const Values & values) { return FormatPoints(values, ", ", FormatLength); } },
  { "color", FormatColor },
  { "bytes", [](const Values & values) { return FormatBytes(values.front()->get<std::uint64_t>()); } },
  { "seconds", [](const Values & values) { return FormatSeconds(GetNumber(*values.front())); } },
  { "name",
    [](const Values & values) {
      return std::filesystem::path(values.front()->get<std::string>()).filename().string();
    } },
  { "contrast", // noise, material and background
    [](const Values & values) {
      return FormatFixed(100.0 * (GetNumber(*values[0]) / std::fabs(GetNumber(*values[1]) - GetNumber(*values[2]))),
                         1) +
             " %";
    } },
} };

/** \class Filler
 * \brief Fills texts with the values of a result, or of a member of a list in it. */
class Filler
{
public:
  Filler(const Json & result, const Json & member, const Json & key, const PageParts * parts)
    : m_Result(result)
    , m_Member(&member)
    , m_Key(key)
    , m_Parts(parts)
  {}

  void
  Fill(std::string_view text, std::string & filled)
  {
    while (!text.empty())
    {
      const std::size_t plain = std::min(text.find_first_of("{["), text.size());
      filled += text.substr(0, plain);
      text.remove_prefix(plain);
      if (!text.empty())
      {
        const std::string_view inside = TakeBracket(text);
        text[0] == '{' ? this->FillPlace(inside, filled) : this->FillPart(inside, filled);
        text.remove_prefix(inside.size() + 2);
      }
    }
  }

  bool
  Holds(std::string_view condition) const
  {
    if (const std::size_t end = condition.find('|'); end != std::string_view::npos)
    {
      return this->Holds(condition.substr(0, end)) || this->Holds(condition.substr(end + 1));
    }
    if (const std::size_t end = condition.find('&'); end != std::string_view::npos)
    {
      return this->Holds(condition.substr(0, end)) && this->Holds(condition.substr(end + 1));
    }
    if (condition.front() == '!')
    {
      return !this->Holds(condition.substr(1));
    }
    const std::size_t end = std::min(condition.find_first_of("=>"), condition.size());
    const Json &      value = this->Find(condition.substr(0, end));
    if (end < condition.size())
    {
      return condition[end] == '>' ? GetNumber(value) > 0.0 : FormatPlain(value) == condition.substr(end + 1);
    }
    return !value.empty() && value != false && value != "";
  }

private:
  /** The text between a bracket at the front and its end. */
  static std::string_view
  TakeBracket(std::string_view text)
  {
    const char open = text.front();
    const char close = open == '{' ? '}' : ']';
    int        depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
      depth += text[i] == open ? 1 : (text[i] == close ? -1 : 0);
      if (depth == 0)
      {
        return text.substr(1, i - 1);
      }
    }
    throw std::invalid_argument("no end of " + std::string(text));
  }

  static const Json *
  FindIn(const Json & object, std::string_view path)
  {
    const Json * value = &object;
    while (!path.empty() && value != nullptr)
    {
      const std::size_t end = std::min(path.find('.'), path.size());
      const std::string key(path.substr(0, end));
      path.remove_prefix(std::min(end + 1, path.size()));
      if (value->is_array())
      {
        const std::size_t index = std::stoul(key);
        value = index < value->size() ? &(*value)[index] : nullptr;
      }
      else
      {
        value = value->is_object() && value->contains(key) ? &(*value)[key] : nullptr;
      }
    }
    return value;
  }

  /** The value at a path; null without one. */
  const Json &
  Find(std::string_view path) const
  {
    if (path == "." || path == "#" || path == "@")
    {
      return path == "." ? *m_Member : (path == "#" ? m_Number : m_Key);
    }
    const Json * const ofMember = FindIn(*m_Member, path);
    const Json * const value = ofMember != nullptr ? ofMember : FindIn(m_Result, path);
    static const Json  null;
    return value != nullptr ? *value : null;
  }

  void
  FillPlace(std::string_view place, std::string & filled)
  {
    if (place == "unit")
    {
      filled += DescribeUnit(m_Result);
      return;
    }
    std::vector<std::string> words = SplitAtBlanks(place);
    if (words.size() == 1)
    {
      words.insert(words.begin(), "");
    }
    if (words.front() == "part" && m_Parts != nullptr)
    {
      (*m_Parts)(words[1], filled);
      return;
    }
    const auto format = std::find_if(
      Formats.begin(), Formats.end(), [&words](const Format & known) { return known.name == words.front(); });
    if (format == Formats.end())
    {
      throw std::invalid_argument("no format " + words.front());
    }
    Values values;
    std::transform(words.begin() + 1, words.end(), std::back_inserter(values), [this](const std::string & path) {
      return &this->Find(path);
    });
    const std::string text = format->make(values);
    filled += m_Parts != nullptr ? EscapeHtml(text) : text;
  }

  /** A text on a condition, or one for each member. */
  void
  FillPart(std::string_view part, std::string & filled)
  {
    const std::size_t end = part.find_first_of("?:");
    if (end == std::string_view::npos)
    {
      throw std::invalid_argument("no condition in " + std::string(part));
    }
    const std::string_view head = part.substr(0, end);
    const std::string_view text = part.substr(end + 1);
    if (part[end] == '?')
    {
      this->Holds(head) ? this->Fill(text, filled) : void();
      return;
    }
    const std::size_t star = std::min(head.find('*'), head.size());
    const Json &      list = this->Find(head.substr(0, star));
    const std::size_t most = star < head.size() ? std::stoul(std::string(head.substr(star + 1))) : list.size();
    Filler            inner = *this;
    std::size_t       number = 0;
    for (auto member = list.begin(); member != list.end() && number < most; ++member)
    {
      inner.m_Member = &*member;
      inner.m_Key = list.is_object() ? Json(member.key()) : m_Key;
      inner.m_Number = ++number;
      inner.Fill(text, filled);
    }
  }

  const Json &      m_Result;
  const Json *      m_Member;
  Json              m_Key;
  Json              m_Number;
  const PageParts * m_Parts;
};

} // namespace

std::string
FillIn(std::string_view text, const Json & result)
{
  return FillIn(text, result, result, nullptr);
}

std::string
FillIn(std::string_view text, const Json & result, const Json & member, const Json & key)
{
  std::string filled;
  Filler(result, member, key, nullptr).Fill(text, filled);
  return filled;
}

std::string
FillInHtml(std::string_view text, const Json & result, const PageParts & parts)
{
  std::string filled;
  Filler(result, result, nullptr, &parts).Fill(text, filled);
  return filled;
}

bool
Holds(std::string_view condition, const Json & result)
{
  return Filler(result, result, nullptr, nullptr).Holds(condition);
}

} // end namespace medialvoxel
