// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandTable.h"
#include "CommandText.h"
#include "OptionParser.h"

namespace medialvoxel
{
namespace
{

constexpr const char * License = "# SPDX-FileCopyrightText: MedialVoxel contributors\n"
                                 "# SPDX-License-Identifier: Apache-2.0\n";

/** "-h" and "--help". */
std::vector<std::string>
GetNames(const CLI::Option & option)
{
  return CLI::detail::split(option.get_name(false, true), ',');
}

std::string
JoinNames(const std::vector<const CLI::App *> & commands)
{
  return CLI::detail::join(commands, [](const CLI::App * command) { return command->get_name(); }, " ");
}

std::string
JoinNames(const Options & options)
{
  return CLI::detail::join(
    options, [](const CLI::Option * option) { return CLI::detail::join(GetNames(*option), " "); }, " ");
}

/** The completion of the value of an option, in bash. */
std::string
GetBashAction(const CommandLine & line, const CLI::Option & option)
{
  const std::vector<std::string> & choices = GetChoices(line, option);
  if (!choices.empty())
  {
    return "COMPREPLY=($(compgen -W '" + CLI::detail::join(choices, " ") + "' -- \"$cur\"))";
  }
  if (option.get_type_name() == "FILE" || option.get_type_name() == "DIR")
  {
    return option.get_type_name() == "DIR" ? "_medialvoxel_files -d" : "_medialvoxel_files -f";
  }
  return "COMPREPLY=()";
}

/** Text of a specification for _arguments in zsh, inside single quotes. */
std::string
ToZsh(const std::string & text)
{
  std::string result;
  for (const char character : text)
  {
    if (character == '[' || character == ']' || character == ':' || character == '\\')
    {
      result += '\\';
    }
    result += character == '\'' ? "'\\''" : std::string(1, character);
  }
  return result;
}

std::string
GetZshValue(const CommandLine & line, const CLI::Option & option)
{
  const std::vector<std::string> & choices = GetChoices(line, option);
  const std::string                message = ":" + ToZsh(option.get_type_name()) + ":";
  if (!choices.empty())
  {
    return message + "(" + CLI::detail::join(choices, " ") + ")";
  }
  const bool isFolder = option.get_type_name() == "DIR";
  return message + (isFolder ? "_files -/" : option.get_type_name() == "FILE" ? "_files" : "");
}

void
AddZshOptions(std::string & text, const CommandLine & line, const CLI::App & app, const std::string & indent)
{
  for (const CLI::Option * const option : GetOptions(app, false))
  {
    for (const std::string & name : GetNames(*option))
    {
      text += indent + "'" + name + (HasValue(*option) ? "=" : "") + "[" + ToZsh(option->get_description()) + "]" +
              (HasValue(*option) ? GetZshValue(line, *option) : "") + "' \\\n";
    }
  }
  for (const CLI::Option * const argument : GetOptions(app, true))
  {
    text += indent + "':" + argument->get_name(true) + ":_files' \\\n";
  }
}

} // namespace

std::string
MakeBashCompletion(const CommandLine & line, const CLI::App & app)
{
  std::string text = License;
  text += "# Completion of medialvoxel for bash.\n\n"
          "_medialvoxel_files()\n{\n"
          "  compopt -o filenames 2>/dev/null\n"
          "  mapfile -t COMPREPLY < <(compgen \"$1\" -- \"$cur\")\n}\n\n"
          "_medialvoxel()\n{\n"
          "  local cur=\"${COMP_WORDS[COMP_CWORD]}\" prev=\"${COMP_WORDS[COMP_CWORD - 1]}\" options=\n"
          "  COMPREPLY=()\n"
          "  # Bash takes --option=value apart.\n"
          "  if [[ \"$cur\" == \"=\" ]]; then\n    cur=\n"
          "  elif [[ \"$prev\" == \"=\" ]]; then\n    prev=\"${COMP_WORDS[COMP_CWORD - 2]}\"\n  fi\n"
          "  if ((COMP_CWORD == 1)); then\n"
          "    COMPREPLY=($(compgen -W '" +
          JoinNames(GetCommands(app)) + " " + JoinNames(GetOptions(app, false)) +
          "' -- \"$cur\"))\n    return\n  fi\n"
          "  case \"${COMP_WORDS[1]}\" in\n";
  for (const CLI::App * const command : GetCommands(app))
  {
    text += "    " + command->get_name() + ")\n      options='" + JoinNames(GetOptions(*command, false)) +
            "'\n      case \"$prev\" in\n";
    for (const CLI::Option * const option : GetOptions(*command, false))
    {
      if (HasValue(*option))
      {
        text += "        " + option->get_name() + ")\n          " + GetBashAction(line, *option) +
                "\n          return\n          ;;\n";
      }
    }
    text += "      esac\n      ;;\n";
  }
  return text + "  esac\n"
                "  if [[ \"$cur\" == -* ]]; then\n"
                "    COMPREPLY=($(compgen -W \"$options\" -- \"$cur\"))\n"
                "  elif [[ -n \"$options\" ]]; then\n"
                "    _medialvoxel_files -f\n"
                "  fi\n}\n\n"
                "complete -F _medialvoxel medialvoxel\n";
}

std::string
MakeZshCompletion(const CommandLine & line, const CLI::App & app)
{
  std::string text = std::string("#compdef medialvoxel\n") + License +
                     "# Completion of medialvoxel for zsh.\n\n"
                     "_medialvoxel()\n{\n  local curcontext=\"$curcontext\" state line\n  typeset -A opt_args\n"
                     "  _arguments -C \\\n";
  AddZshOptions(text, line, app, "    ");
  text += "    '1:command:((";
  for (const CLI::App * const command : GetCommands(app))
  {
    std::string description = command->get_description();
    description = CLI::detail::find_and_replace(description, " ", "\\ ");
    text += (command == GetCommands(app).front() ? "" : " ") + command->get_name() + "\\:" + description;
  }
  text += "))' \\\n    '*::arguments:->arguments'\n  [[ \"$state\" == arguments ]] || return\n  case \"$line[1]\" in\n";
  for (const CLI::App * const command : GetCommands(app))
  {
    text += "    " + command->get_name() + ")\n      _arguments -s \\\n";
    AddZshOptions(text, line, *command, "        ");
    text += "        && return\n      ;;\n";
  }
  return text + "  esac\n}\n\n_medialvoxel \"$@\"\n";
}

} // end namespace medialvoxel
