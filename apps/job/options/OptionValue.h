// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionValue_h
#define medialvoxelOptionValue_h

#include "ClusterOptions.h"
#include "OptionText.h"
#include "ProgramOptions.h"
#include "Text.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** The structures that the options of a command fill; null: it has none of this type. */
using OptionTarget = std::tuple<JobOptions *,
                                ExtractOptions *,
                                PartOptions *,
                                DistanceOptions *,
                                PlanOptions *,
                                WorkOptions *,
                                FinalizeOptions *,
                                ProgramOptions *,
                                ModuleOptions *>;

/** For structures beside each other; options of an extraction include the options of the job. */
template <typename... TOptions>
OptionTarget
MakeTarget(TOptions &... options)
{
  OptionTarget target{};
  const auto   set = [&target](auto & structure) {
    using Type = std::decay_t<decltype(structure)>;
    std::get<Type *>(target) = &structure;
    if constexpr (std::is_base_of_v<JobOptions, Type>)
    {
      std::get<JobOptions *>(target) = &structure;
    }
    if constexpr (std::is_base_of_v<ExtractOptions, Type>)
    {
      std::get<ExtractOptions *>(target) = &structure;
    }
  };
  (set(options), ...);
  return target;
}

/** How a text becomes the value of a member, and the value a text again. */
struct OptionValue
{
  std::function<void(const OptionTarget & target, const std::string & text)> set; ///< \throw WrongValue

  /** A text that sets the same value; nothing for one that is as if the option was not given, and where there is no
   * structure of this type. */
  std::function<std::optional<std::string>(const OptionTarget & target)> get;

  std::optional<std::string> initial;           ///< the result of get() for new structures
  std::vector<std::string>   choices;           ///< names that it takes, the default first; none: any text
  bool                       isFlag{ false };   ///< takes no word of its own, but a value behind an equals sign
  bool                       isLength{ false }; ///< its numbers may have a unit, which ReplaceUnits() takes away
};

/** A value that two functions set and get. */
template <typename TOptions>
OptionValue
Value(std::function<void(TOptions &, const std::string &)>        set,
      std::function<std::optional<std::string>(const TOptions &)> get)
{
  OptionValue value;
  value.initial = get(TOptions{});
  value.set = [set](const OptionTarget & target, const std::string & text) {
    set(*std::get<TOptions *>(target), text);
  };
  value.get = [get](const OptionTarget & target) {
    const TOptions * const options = std::get<TOptions *>(target);
    return options ? get(*options) : std::nullopt;
  };
  return value;
}

/** The value of a member. Unset, empty and equal to \a none count as not given. */
template <typename TOptions, typename TMember, typename TParse, typename TFormat>
OptionValue
Value(std::optional<TMember> TOptions::* member, TParse parse, TFormat format)
{
  return Value<TOptions>(
    [member, parse](TOptions & options, const std::string & text) {
      options.*member = static_cast<TMember>(parse(text));
    },
    [member, format](const TOptions & options) {
      return options.*member ? std::optional<std::string>(format(*(options.*member))) : std::nullopt;
    });
}

template <typename TOptions, typename TMember, typename TParse, typename TFormat>
OptionValue
Value(TMember TOptions::* member, TParse parse, TFormat format)
{
  return Value<TOptions>(
    [member, parse](TOptions & options, const std::string & text) {
      options.*member = static_cast<TMember>(parse(text));
    },
    [member, format](const TOptions & options) { return std::optional<std::string>(format(options.*member)); });
}

/** One of some names, in any case. */
template <typename TOptions, typename TMember>
OptionValue
Choice(TMember TOptions::* member, std::vector<std::pair<std::string, TMember>> choices)
{
  // The default stands first.
  const auto hasDefault = [member](const auto & choice) { return choice.second == TOptions{}.*member; };
  std::stable_partition(choices.begin(), choices.end(), hasDefault);
  std::vector<std::string> names;
  for (const auto & choice : choices)
  {
    names.push_back(choice.first);
  }
  OptionValue value = Value<TOptions>(
    [member, choices, names](TOptions & options, const std::string & text) {
      options.*member = choices[FindChoice(names, text)].second;
    },
    [member, choices](const TOptions & options) {
      for (const auto & choice : choices)
      {
        if (choice.second == options.*member)
        {
          return std::optional<std::string>(choice.first);
        }
      }
      return std::optional<std::string>();
    });
  value.choices = names;
  return value;
}

/** The same of enumerators that know their names. */
template <typename TOptions, typename TMember, typename TEnum>
OptionValue
Choice(TMember TOptions::* member, std::initializer_list<TEnum> enumerators)
{
  std::vector<std::pair<std::string, TMember>> choices;
  for (const TEnum enumerator : enumerators)
  {
    choices.emplace_back(GetName(enumerator), enumerator);
  }
  return Choice(member, std::move(choices));
}

/** On or off. */
template <typename TOptions, typename TMember>
OptionValue
Flag(TMember TOptions::* member)
{
  OptionValue value = Value(member, ToFlag, FormatFlag);
  value.isFlag = true;
  return value;
}

/** A text that is not empty, called \a what in errors. \param read converts it */
template <typename TOptions>
OptionValue
Text(std::string TOptions::* member, std::string what, std::string (*read)(const std::string &) = nullptr)
{
  return Value<TOptions>(
    [member, what, read](TOptions & options, const std::string & text) {
      if (text.empty())
      {
        throw WrongValue("'' is not " + what);
      }
      options.*member = read ? read(text) : text;
    },
    [member](const TOptions & options) {
      return (options.*member).empty() ? std::nullopt : std::optional<std::string>(options.*member);
    });
}

/** The name of a file or a folder. */
template <typename TOptions>
OptionValue
File(std::string TOptions::* member)
{
  return Text(member, "the name of a file", ToFileName);
}

/** A whole number. */
template <typename TOptions, typename TMember>
OptionValue
Count(TMember TOptions::* member, std::uint64_t least, std::uint64_t most = LargestCount)
{
  return Value(
    member,
    [least, most](const std::string & text) { return ToCount(text, least, most); },
    [](const auto & value) { return std::to_string(value); });
}

/** The same value, where numbers are lengths. */
inline OptionValue
OfLengths(OptionValue value)
{
  value.isLength = true;
  return value;
}

/** A length; ToLength or a function like it. */
template <typename TOptions, typename TMember>
OptionValue
Length(
  TMember TOptions::* member,
  double (*parse)(const std::string &) = [](const std::string & text) { return ToLength(text); })
{
  return OfLengths(Value(member, parse, FormatNumber));
}

/** The same value, where an empty text leaves it as it is. */
inline OptionValue
OrEmpty(OptionValue value)
{
  value.set = [set = value.set](const OptionTarget & target, const std::string & text) {
    if (!text.empty())
    {
      set(target, text);
    }
  };
  return value;
}

} // end namespace medialvoxel

#endif
