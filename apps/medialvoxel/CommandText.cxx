// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandText.h"

#include "CommandTable.h"
#include "Errors.h"
#include "SlicerXml.h"
#include "Version.h"

#include <cctype>
#include <filesystem>
#include <fstream>

namespace medialvoxel
{
namespace
{

constexpr std::size_t Columns = 80;
constexpr std::size_t HelpColumn = 27;

/** The description, and as many of the choices as fit. */
std::string
Describe(const CommandLine & line, const CLI::Option & option, std::size_t width)
{
  const std::vector<std::string> & choices = GetChoices(line, option);
  std::string                      text = option.get_description();
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    const std::string next = (i == 0 ? ": " : "|") + choices[i];
    const std::string rest = i + 1 < choices.size() ? "|..." : "";
    if (text.size() + next.size() + rest.size() > width)
    {
      return text + "|...";
    }
    text += next;
  }
  return text;
}

void
AddHelpLine(std::string & text, const std::string & left, const std::string & right)
{
  text +=
    "  " + left + std::string(left.size() + 3 < HelpColumn ? HelpColumn - 2 - left.size() : 2, ' ') + right + "\n";
}

std::string
GetSynopsis(const CLI::App & app)
{
  std::string text = app.get_parent() ? "medialvoxel " + app.get_name() : "medialvoxel COMMAND";
  for (const CLI::Option * const argument : GetOptions(app, true))
  {
    text += argument->get_required() ? " " + argument->get_name(true) : " [" + argument->get_name(true) + "]";
  }
  for (const CLI::Option * const option : GetOptions(app, false))
  {
    text += option->get_required() ? " " + GetUsage(*option) : "";
  }
  return text + " [OPTION...]";
}

/** \class CompactHelp
 * \brief The formatter that CLI11 asks for help. */
class CompactHelp : public CLI::FormatterBase
{
public:
  explicit CompactHelp(const CommandLine & line)
    : m_Line(line)
  {}

  std::string
  make_help(const CLI::App * app, std::string, CLI::AppFormatMode mode) const override
  {
    std::string text = app->get_description() + "\nUsage: " + GetSynopsis(*app) + "\n";
    for (const CLI::App * const command : GetCommands(*app))
    {
      AddHelpLine(text, command->get_name(), command->get_description());
    }
    for (const CLI::Option * const argument : GetOptions(*app, true))
    {
      this->AddOption(text, *argument);
    }
    text += "Options (the first of several choices is the default):\n";
    std::string group = "Options";
    bool        leavesOut = false;
    for (const CLI::Option * const option : GetOptions(*app, false))
    {
      const bool isFurther = option->get_group() == FurtherGroup;
      leavesOut |= isFurther;
      if (option == app->get_help_ptr() || option == app->get_help_all_ptr() ||
          (isFurther && mode != CLI::AppFormatMode::All))
      {
        continue; // who reads this knows it, or needs it rarely
      }
      if (option->get_group() != group)
      {
        group = option->get_group();
        text += group + ":\n";
      }
      this->AddOption(text, *option);
    }
    text += "Examples:\n";
    for (const std::string & example : m_Line.examples.at(app))
    {
      text += "  " + CLI::detail::find_and_replace(example, "\n", "\n  ") + "\n";
    }
    text += app->get_footer().empty() ? "" : app->get_footer() + "\n";
    return text + (leavesOut && mode != CLI::AppFormatMode::All
                     ? "More options: medialvoxel " + app->get_name() + " --help-all\n"
                     : "");
  }

private:
  void
  AddOption(std::string & text, const CLI::Option & option) const
  {
    AddHelpLine(text, GetUsage(option), Describe(m_Line, option, Columns - HelpColumn));
  }

  const CommandLine & m_Line;
};

void
WriteFile(const std::filesystem::path & fileName, const std::string & text)
{
  std::ofstream file(fileName, std::ios::binary);
  file << text;
  if (!file.flush())
  {
    Fail(ExitStatus::Failure, "cannot write ", fileName.string());
  }
}

/** Text of roff: hyphens that can be copied, no accidental escapes or requests. */
std::string
ToRoff(const std::string & text)
{
  std::string result;
  for (const char character : text)
  {
    const bool startsLine = result.empty() || result.back() == '\n';
    result += startsLine && (character == '.' || character == '\'') ? "\\&" : "";
    result += character == '\\' ? "\\e" : character == '-' ? "\\-" : std::string(1, character);
  }
  return result;
}

} // namespace

void
UseCompactHelp(const CommandLine & line, CLI::App & app)
{
  const auto formatter = std::make_shared<CompactHelp>(line);
  app.formatter(formatter);
  for (CLI::App * const command : app.get_subcommands(nullptr))
  {
    command->formatter(formatter);
  }
}

std::string
MakeManualPage(const CommandLine & line, const CLI::App & app)
{
  const bool        isCommand = app.get_parent() != nullptr;
  const std::string name = isCommand ? "medialvoxel-" + app.get_name() : "medialvoxel";
  std::string       title = name;
  for (char & character : title)
  {
    character = static_cast<char>(std::toupper(static_cast<unsigned char>(character)));
  }
  std::string page =
    ".\\\" SPDX-FileCopyrightText: MedialVoxel contributors\n.\\\" SPDX-License-Identifier: Apache-2.0\n";
  page += ".TH " + ToRoff(title) + " 1 \"\" \"MedialVoxel " + GetVersion() + "\" \"User Commands\"\n";
  page += ".SH NAME\n" + ToRoff(name + " - " + app.get_description()) + "\n";
  page += ".SH SYNOPSIS\n.B " + ToRoff(GetSynopsis(app)) + "\n";
  if (!isCommand)
  {
    page += ".SH COMMANDS\n";
    for (const CLI::App * const command : GetCommands(app))
    {
      page += ".TP\n.B " + ToRoff(command->get_name()) + "\n" + ToRoff(command->get_description()) + "; see\n.BR " +
              ToRoff("medialvoxel-" + command->get_name()) + " (1).\n";
    }
  }
  const auto addOption = [&](const CLI::Option & option) {
    page += ".TP\n.B " + ToRoff(GetUsage(option)) + "\n" + ToRoff(option.get_description());
    const std::vector<std::string> & choices = GetChoices(line, option);
    page += choices.empty()
              ? ".\n"
              : ToRoff(": " + CLI::detail::join(choices, ", ") +
                       (FindRow(line, option)->value.initial ? " (default " + choices.front() + ")." : ".")) +
                  "\n";
    const std::string details = GetDetails(line, option);
    page += details.empty() ? "" : ToRoff(details) + "\n";
  };
  const Options arguments = GetOptions(app, true);
  page += arguments.empty() ? "" : ".SH ARGUMENTS\n";
  for (const CLI::Option * const argument : arguments)
  {
    addOption(*argument);
  }
  page += ".SH OPTIONS\n";
  std::string group = "Options";
  for (const CLI::Option * const option : GetOptions(app, false))
  {
    if (option->get_group() != group)
    {
      group = option->get_group();
      page += ".SS " + ToRoff(group) + "\n";
    }
    addOption(*option);
  }
  page += ".SH EXAMPLES\n.nf\n";
  for (const std::string & example : line.examples.at(&app))
  {
    page += ToRoff(example) + "\n";
  }
  page += ".fi\n";
  page += app.get_footer().empty() ? "" : ".SH NOTES\n" + ToRoff(app.get_footer()) + "\n";
  return page + (isCommand ? ".SH SEE ALSO\n.BR medialvoxel (1)\n" : "");
}

void
WriteCommandTexts(const CommandLine & line, const CLI::App & app)
{
  const std::filesystem::path folder = line.generateFolder;
  WriteFile(folder / "medialvoxel.bash", MakeBashCompletion(line, app));
  WriteFile(folder / "_medialvoxel", MakeZshCompletion(line, app));
  WriteFile(folder / "catalog.json", MakeCatalog(line, app));
  WriteFile(folder / "MedialVoxelExtraction.xml", MakeSlicerXml());
  WriteFile(folder / "medialvoxel.1", MakeManualPage(line, app));
  for (const CLI::App * const command : GetCommands(app))
  {
    WriteFile(folder / ("medialvoxel-" + command->get_name() + ".1"), MakeManualPage(line, *command));
  }
}

} // end namespace medialvoxel
