// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SliceNames.h"

#include "FileNames.h"
#include "HeaderParsing.h"
#include "Text.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace medialvoxel
{
namespace
{

/** More are not believed to be one volume. */
constexpr std::uint64_t MostSlices = std::uint64_t{ 1 } << 20;

/** Digits beyond this are no number of a slice. */
constexpr std::size_t MostDigits = 15;

bool
IsDigit(char character)
{
  return character >= '0' && character <= '9';
}

/** A text between numbers, or a number. */
struct Token
{
  std::string   text;
  bool          isNumber{ false };
  std::uint64_t number{ 0 };
};

std::vector<Token>
SplitAtNumbers(const std::filesystem::path & file)
{
  const std::string  name = file.filename().string();
  std::vector<Token> tokens;
  for (std::size_t begin = 0; begin < name.size();)
  {
    const bool  isNumber = IsDigit(name[begin]);
    std::size_t end = begin + 1;
    while (end < name.size() && IsDigit(name[end]) == isNumber && (!isNumber || end - begin < MostDigits))
    {
      ++end;
    }
    const std::string text = name.substr(begin, end - begin);
    tokens.push_back({ text, isNumber, isNumber ? std::stoull(text) : 0 });
    begin = end;
  }
  return tokens;
}

/** The text of a number pattern before and behind the number, and its format. */
struct NumberPattern
{
  std::string prefix;
  std::string suffix;
  std::size_t width{ 0 };        ///< least digits
  bool        isFilled{ false }; ///< with zeros

  std::string
  MakeName(std::uint64_t number) const
  {
    std::string digits = std::to_string(number);
    if (digits.size() < width)
    {
      digits.insert(0, width - digits.size(), isFilled ? '0' : ' ');
    }
    return prefix + digits + suffix;
  }
};

std::optional<NumberPattern>
ParseNumberPattern(const std::string & name)
{
  constexpr std::size_t mostWidth = 2;
  const std::size_t     percent = name.find('%');
  if (percent == std::string::npos || name.find('%', percent + 1) != std::string::npos)
  {
    return std::nullopt;
  }
  std::size_t end = percent + 1;
  while (end < name.size() && IsDigit(name[end]))
  {
    ++end;
  }
  const std::string width = name.substr(percent + 1, end - percent - 1);
  if (end == name.size() || name[end] != 'd' || width.size() > mostWidth)
  {
    return std::nullopt;
  }
  return NumberPattern{ name.substr(0, percent),
                        name.substr(end + 1),
                        width.empty() ? 0 : static_cast<std::size_t>(std::stoul(width)),
                        !width.empty() && width.front() == '0' };
}

/** Whether the whole name matches a pattern with * and ?. */
bool
Matches(std::string_view name, std::string_view pattern)
{
  std::size_t afterStar = std::string_view::npos;
  std::size_t retry = 0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < name.size())
  {
    if (j < pattern.size() && pattern[j] == '*')
    {
      afterStar = ++j;
      retry = i;
    }
    else if (j < pattern.size() && (pattern[j] == '?' || pattern[j] == name[i]))
    {
      ++i;
      ++j;
    }
    else if (afterStar != std::string_view::npos)
    {
      i = ++retry;
      j = afterStar;
    }
    else
    {
      return false;
    }
  }
  return pattern.substr(j).find_first_not_of('*') == std::string_view::npos;
}

/** Regular files of a folder for which isWanted(name) is true, in natural order. */
template <typename TIsWanted>
std::vector<std::filesystem::path>
ListFolder(const std::filesystem::path & folder, TIsWanted && isWanted)
{
  std::error_code                    error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    itk::MedialVoxelCheckAbort();
    std::error_code   unknown;
    const std::string name = entry->path().filename().string();
    if (name.front() != '.' && isWanted(name) && entry->is_regular_file(unknown))
    {
      files.push_back(folder == "." ? entry->path().filename() : entry->path());
    }
    if (files.size() > MostSlices)
    {
      RefuseHeader(folder, "it has more than " + std::to_string(MostSlices) + " slices");
    }
  }
  if (error)
  {
    RefuseHeader(folder, "cannot be read: " + error.message(), HeaderError::Kind::Unreadable);
  }
  std::sort(files.begin(), files.end(), IsBefore);
  return files;
}

std::vector<std::filesystem::path>
ListNumbers(const std::filesystem::path &      folder,
            const NumberPattern &              pattern,
            const std::vector<std::uint64_t> & range)
{
  std::vector<std::filesystem::path> files;
  for (std::uint64_t number = range[0]; number <= range[1]; ++number)
  {
    itk::MedialVoxelCheckAbort();
    files.push_back(folder / pattern.MakeName(number));
    std::error_code error;
    if (!std::filesystem::is_regular_file(files.back(), error))
    {
      RefuseHeader(files.back(),
                   "the slice is missing; slices " + std::to_string(range[0]) + " to " + std::to_string(range[1]) +
                     " are wanted",
                   HeaderError::Kind::Unreadable);
    }
    if (files.size() > MostSlices)
    {
      RefuseHeader(folder / pattern.MakeName(range[0]),
                   "more than " + std::to_string(MostSlices) + " slices are wanted");
    }
  }
  return files;
}

/** Whether the pattern makes this name of a number. */
bool
IsMadeBy(const NumberPattern & pattern, const std::string & name)
{
  if (name.size() <= pattern.prefix.size() + pattern.suffix.size())
  {
    return false;
  }
  const std::size_t begin = name.find_first_not_of(' ', pattern.prefix.size());
  const std::string digits = name.substr(std::min(begin, name.size()), name.size() - pattern.suffix.size() - begin);
  return !digits.empty() && digits.size() <= MostDigits && std::all_of(digits.begin(), digits.end(), IsDigit) &&
         pattern.MakeName(std::stoull(digits)) == name;
}

/** The one place in which all names differ, if they differ in a number only. */
std::optional<std::size_t>
FindNumber(const std::vector<std::vector<Token>> & names)
{
  std::optional<std::size_t> place;
  const std::vector<Token> & first = names.front();
  for (const std::vector<Token> & name : names)
  {
    if (name.size() != first.size())
    {
      return std::nullopt;
    }
    for (std::size_t token = 0; token < name.size(); ++token)
    {
      if (name[token].text == first[token].text)
      {
        continue;
      }
      if (!name[token].isNumber || !first[token].isNumber || (place && *place != token))
      {
        return std::nullopt;
      }
      place = token;
    }
  }
  return place;
}

std::string
GetTexts(const std::vector<Token> & name)
{
  return Join(name, "", [](const Token & token) { return token.isNumber ? "#" : token.text; });
}

/** Whether several numbers differ, and the last of them comes again: sets that each begin anew. */
bool
AreSeveralSets(const std::vector<std::vector<Token>> & names)
{
  std::size_t last = names.front().size();
  for (std::size_t token = 0; token < names.front().size(); ++token)
  {
    const auto differs = [&](const auto & name) { return name[token].number != names.front()[token].number; };
    last = std::any_of(names.begin(), names.end(), differs) ? token : last;
  }
  if (last == names.front().size())
  {
    return false;
  }
  std::set<std::uint64_t> numbers;
  return !std::all_of(
    names.begin(), names.end(), [&](const auto & name) { return numbers.insert(name[last].number).second; });
}

/** Slices have one text around their number; a file with another text is of another set, or no slice. */
void
CheckTexts(const std::filesystem::path &              input,
           const std::vector<std::filesystem::path> & files,
           const std::vector<std::vector<Token>> &    names)
{
  const std::string texts = GetTexts(names.front());
  const auto        isOther = [&texts](const auto & name) { return GetTexts(name) != texts; };
  const auto        other = std::find_if(names.begin(), names.end(), isOther);
  const bool        areSets = other == names.end() && AreSeveralSets(names);
  std::error_code   error;
  const auto        hasNumber = [](const auto & name) { return GetTexts(name).find('#') != std::string::npos; };
  const bool        matters =
    std::filesystem::is_directory(input, error) || std::any_of(names.begin(), names.end(), hasNumber);
  if ((other == names.end() && !areSets) || !matters)
  {
    return;
  }
  const std::filesystem::path & second =
    areSets ? files.back() : files[static_cast<std::size_t>(other - names.begin())];
  const std::string start = names.front().front().isNumber ? "" : names.front().front().text;
  RefuseHeader(input,
               files.front().string() + " and " + second.string() +
                 " are of different sets, or one of them is no slice: their names differ in more than a number; name "
                 "the slices by a pattern, such as " +
                 (files.front().parent_path() / (start + "%d" + files.front().extension().string())).string());
}

} // namespace

bool
NamesSlices(const std::filesystem::path & input)
{
  std::error_code error;
  const auto      status = std::filesystem::status(input, error);
  if (std::filesystem::exists(status))
  {
    return std::filesystem::is_directory(status);
  }
  return input.filename().string().find_first_of("*?") != std::string::npos || IsNumberPattern(input);
}

bool
IsNumberPattern(const std::filesystem::path & input)
{
  std::error_code error;
  return !std::filesystem::exists(input, error) && ParseNumberPattern(input.filename().string());
}

std::vector<std::filesystem::path>
ListSliceFiles(const std::filesystem::path & input, const std::vector<std::uint64_t> & range)
{
  std::error_code error;
  if (std::filesystem::is_directory(input, error))
  {
    return ListFolder(input, [](const std::string &) { return true; });
  }
  if (std::filesystem::exists(input, error))
  {
    return { input };
  }
  const std::filesystem::path folder = FolderOf(input);
  const std::string           last = input.filename().string();
  if (const auto pattern = ParseNumberPattern(last))
  {
    return range.empty() ? ListFolder(folder, [&](const std::string & name) { return IsMadeBy(*pattern, name); })
                         : ListNumbers(folder, *pattern, range);
  }
  return ListFolder(folder, [&](const std::string & name) { return Matches(name, last); });
}

bool
IsBefore(const std::filesystem::path & a, const std::filesystem::path & b)
{
  const std::vector<Token> tokensOfA = SplitAtNumbers(a);
  const std::vector<Token> tokensOfB = SplitAtNumbers(b);
  const auto [inA, inB] = std::mismatch(
    tokensOfA.begin(), tokensOfA.end(), tokensOfB.begin(), tokensOfB.end(), [](const auto & x, const auto & y) {
      return x.isNumber && y.isNumber ? x.number == y.number : x.text == y.text;
    });
  if (inA == tokensOfA.end() || inB == tokensOfB.end())
  {
    return inA == tokensOfA.end() && inB == tokensOfB.end() ? a < b : inA == tokensOfA.end();
  }
  return inA->isNumber && inB->isNumber ? inA->number < inB->number : inA->text < inB->text;
}

void
CheckNumbers(const std::filesystem::path & input, const std::vector<std::filesystem::path> & files)
{
  std::vector<std::vector<Token>> names;
  std::transform(files.begin(), files.end(), std::back_inserter(names), SplitAtNumbers);
  if (files.size() < 2)
  {
    return;
  }
  const std::optional<std::size_t> place = FindNumber(names);
  if (!place)
  {
    CheckTexts(input, files, names);
    return;
  }
  const auto stepTo = [&](std::size_t slice) { return names[slice][*place].number - names[slice - 1][*place].number; };
  std::uint64_t step = stepTo(1);
  for (std::size_t slice = 2; slice < files.size(); ++slice)
  {
    step = std::min(step, stepTo(slice));
  }
  for (std::size_t slice = 1; slice < files.size(); ++slice)
  {
    const std::string around = files[slice - 1].string() + " and " + files[slice].string();
    if (stepTo(slice) == 0)
    {
      RefuseHeader(input, around + " have the same number; a slice is doubled");
    }
    if (step > 0 && stepTo(slice) != step)
    {
      RefuseHeader(input, "slices are missing between " + around);
    }
  }
}

} // end namespace medialvoxel
