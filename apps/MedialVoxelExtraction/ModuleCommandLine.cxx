// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ModuleCommandLine.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <optional>

namespace medialvoxel
{
namespace
{

/** The arguments one after the other. */
class ArgumentParser
{
public:
  ArgumentParser(const std::vector<std::string> & arguments, ParameterTable & table)
    : m_Arguments(arguments)
    , m_Table(table)
  {}

  ModuleAction
  Parse()
  {
    while (m_Next < m_Arguments.size())
    {
      const std::string & argument = m_Arguments[m_Next++];
      if (m_OnlyPositional || argument.size() < 2 || argument.front() != '-')
      {
        this->SetPositional(argument);
      }
      else if (argument == "--" || argument == "--ignore_rest")
      {
        m_OnlyPositional = true;
      }
      else if (const std::optional<ModuleAction> action = FindAction(argument))
      {
        return *action;
      }
      else
      {
        this->SetFlag(argument);
      }
    }
    this->RequirePositional();
    return ModuleAction::Run;
  }

private:
  static std::optional<ModuleAction>
  FindAction(const std::string & argument)
  {
    if (argument == "--help" || argument == "-h")
    {
      return ModuleAction::PrintHelp;
    }
    if (argument == "--version")
    {
      return ModuleAction::PrintVersion;
    }
    if (argument == "--xml")
    {
      return ModuleAction::PrintXml;
    }
    return std::nullopt;
  }

  void
  SetPositional(const std::string & text)
  {
    const auto next = std::find_if(m_Table.begin(), m_Table.end(), [](const Parameter & parameter) {
      return parameter.isPositional && !parameter.value;
    });
    if (next == m_Table.end())
    {
      Fail(ExitStatus::Usage, "'", text, "' is one argument too many");
    }
    if (text.empty())
    {
      Fail(ExitStatus::Usage, next->name, " is empty; it must be the name of a file");
    }
    SetValue(*next, text);
  }

  void
  SetFlag(const std::string & argument)
  {
    const size_t      equals = argument.find('=');
    const std::string flag = argument.substr(0, equals);
    const auto        found = std::find_if(m_Table.begin(), m_Table.end(), [&flag](const Parameter & parameter) {
      return !parameter.isPositional && "--" + parameter.name == flag;
    });
    if (found == m_Table.end())
    {
      Fail(ExitStatus::Usage, "unknown option '", flag, "'");
    }
    if (found->value)
    {
      Fail(ExitStatus::Usage, found->name, " is given twice");
    }
    SetValue(*found, equals == std::string::npos ? this->TakeValue(*found) : argument.substr(equals + 1));
  }

  std::string
  TakeValue(const Parameter & parameter)
  {
    const bool hasNext = m_Next < m_Arguments.size();
    if (parameter.kind == ParameterKind::Boolean)
    {
      const std::string text = hasNext ? ToLower(m_Arguments[m_Next]) : "";
      if (text != "true" && text != "false")
      {
        return "true";
      }
    }
    else if (!hasNext)
    {
      Fail(ExitStatus::Usage, parameter.name, " has no value");
    }
    return m_Arguments[m_Next++];
  }

  void
  RequirePositional() const
  {
    for (const Parameter & parameter : m_Table)
    {
      if (parameter.isPositional && !parameter.value)
      {
        Fail(ExitStatus::Usage, parameter.name, " is missing");
      }
    }
  }

  const std::vector<std::string> & m_Arguments;
  ParameterTable &                 m_Table;
  size_t                           m_Next{ 0 };
  bool                             m_OnlyPositional{ false };
};

/** The kind of values that a flag takes, as its users write it. */
std::string
DescribeKind(const Parameter & parameter)
{
  switch (parameter.kind)
  {
    case ParameterKind::Path:
      return "PATH";
    case ParameterKind::String:
      return "TEXT";
    case ParameterKind::Boolean:
      return "[true|false]";
    case ParameterKind::Integer:
      return std::to_string(parameter.minimum) + ".." + std::to_string(parameter.maximum);
    case ParameterKind::Double:
      return "NUMBER";
    case ParameterKind::Enumeration:
      return Join(parameter.elements, "|", [](const std::string & element) { return element; });
  }
  return "";
}

} // namespace

ModuleAction
ParseArguments(const std::vector<std::string> & arguments, ParameterTable & table)
{
  return ArgumentParser(arguments, table).Parse();
}

void
PrintHelp(std::ostream & out, const ParameterTable & table)
{
  out << "Extracts the medial voxels of an object in a volume, as a module of 3D Slicer or by itself.\n\n"
         "Usage: MedialVoxelExtraction [OPTIONS] inputVolume outputVolume\n\n";
  for (const Parameter & parameter : table)
  {
    out << (parameter.isPositional ? "  " + parameter.name : "  --" + parameter.name + " " + DescribeKind(parameter))
        << "\n      " << parameter.help;
    if (!parameter.defaultValue.empty())
    {
      out << " (default " << parameter.defaultValue << ")";
    }
    out << '\n';
  }
  out
    << "  --xml, --version, --help, -h\n      Print the description for 3D Slicer, the version, or this\n"
       "  --, --ignore_rest\n      What follows is no option\n\n"
       "Labels: 0 no object, 1 not medial, 2 medial by bound, 3 medial by geodesic search.\n"
       "Exit status: 0 done, 1 failure, 2 wrong usage, 3 refused, 4 corrupt input, 130 or 143 stopped by a signal.\n\n"
       "Example:\n"
       "  MedialVoxelExtraction --objectSelection AboveLower --lowerThreshold 72 part.mha medial.mha\n";
}

void
PrintValues(std::ostream & out, const ParameterTable & table)
{
  for (const Parameter & parameter : table)
  {
    out << parameter.name << ": " << parameter.value.value_or(parameter.defaultValue) << '\n';
  }
  out << std::flush;
}

} // end namespace medialvoxel
