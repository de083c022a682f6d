// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptionTable_h
#define medialvoxelOptionTable_h

#include "OptionValue.h"

#include <functional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Commands of the program; an option names its commands. */
namespace Commands
{
constexpr unsigned int Extract = 1;
constexpr unsigned int Mesh = 2;
constexpr unsigned int Surface = 4;
constexpr unsigned int Distance = 8;
constexpr unsigned int Info = 16;
constexpr unsigned int Plan = 32;
constexpr unsigned int Work = 64;
constexpr unsigned int Finalize = 128;
constexpr unsigned int Status = 256;
constexpr unsigned int Extractions = Extract | Plan;       ///< with the labels of cells
constexpr unsigned int Sheets = Extractions | Mesh;        ///< that find medial cells
constexpr unsigned int Runs = Sheets | Surface | Distance; ///< that make something of a volume
constexpr unsigned int Volumes = Runs | Info;              ///< that read one
constexpr unsigned int Processes = Runs | Work | Finalize; ///< that take a while
} // namespace Commands

/** The part of an option that a job of several processes keeps. */
enum class Kept
{
  No,     ///< it changes nothing of the job
  Result, ///< it changes a byte; jobs that differ in it are different
  Run     ///< it changes no byte
};

/** An option as a parameter of the module for 3D Slicer. */
struct SlicerParameter
{
  std::string group{};
  std::string name{}; ///< empty: the module has no parameter for it
  std::string label{};
  std::string description{}; ///< empty: the text of the manual
  std::string element{};     ///< of the XML, with its attributes; empty: that of a flag, a choice or a text
  std::string channel{};     ///< input or output, of files
  OptionValue value{};       ///< unset: that of the option, which an empty text leaves as it is
  std::string limits{};      ///< elements of the XML with the range

  bool needsSelection{ false }; ///< it has an effect with an objectSelection only
};

/** An option: a row of the table. Parser, help, manual, completion, reference, manifest and module come from it. */
struct OptionRow
{
  std::string     name;  ///< as --thickness; OUTPUT: an argument; empty: only the module has it
  std::string     unit;  ///< word for the value; empty for flags
  OptionValue     value; ///< member, range and default
  unsigned int    commands{ 0 };
  unsigned int    hiddenIn{ 0 };   ///< commands that show it with --help-all only, and apart in manuals
  unsigned int    refusedIn{ 0 };  ///< commands that take it to say why they do not make it
  unsigned int    optionalIn{ 0 }; ///< commands that do without this argument
  std::string     group{ "Options" };
  std::string     help;      ///< the line of the help, without a full stop
  std::string     details;   ///< further sentences, of the manual and the reference
  std::string     companion; ///< an option that has to be given, too
  std::string     need;      ///< the option works only with this
  Kept            kept{ Kept::No };
  unsigned int    python{ 0 }; ///< functions for arrays with a keyword of this name
  SlicerParameter slicer{};

  /** Whether it has an effect. */
  std::function<bool(const OptionTarget & target)> hasEffect;

  bool
  IsArgument() const
  {
    return !name.empty() && name.front() != '-';
  }

  OptionRow &
  Of(unsigned int those, std::string ofGroup = "Options")
  {
    commands = those;
    group = std::move(ofGroup);
    return *this;
  }
  OptionRow &
  OfJobs(unsigned int those, std::string ofGroup = "Options") ///< also kept by jobs of several processes
  {
    kept = Kept::Result;
    return this->Of(those, std::move(ofGroup));
  }
  OptionRow &
  HiddenIn(unsigned int those)
  {
    hiddenIn = those;
    return *this;
  }
  OptionRow &
  Hidden() ///< in all commands
  {
    return this->HiddenIn(commands);
  }
  OptionRow &
  RefusedIn(unsigned int those)
  {
    refusedIn = those;
    return *this;
  }
  OptionRow &
  OptionalIn(unsigned int those)
  {
    optionalIn = those;
    return *this;
  }
  OptionRow &
  Help(std::string line, std::string sentences = "")
  {
    help = std::move(line);
    details = std::move(sentences);
    return *this;
  }
  OptionRow &
  Requires(std::string option)
  {
    companion = std::move(option);
    return *this;
  }
  template <typename TOptions>
  OptionRow &
  Needs(std::string what, bool (*condition)(const TOptions &))
  {
    need = std::move(what);
    hasEffect = [condition](const OptionTarget & target) { return condition(*std::get<TOptions *>(target)); };
    return *this;
  }
  OptionRow &
  Needs(std::string what, bool (*condition)(const OptionTarget &))
  {
    need = std::move(what);
    hasEffect = condition;
    return *this;
  }
  OptionRow &
  KeepForRun()
  {
    kept = Kept::Run;
    return *this;
  }
  OptionRow &
  Python(unsigned int functions)
  {
    python = functions;
    return *this;
  }
  OptionRow &
  Slicer(SlicerParameter parameter)
  {
    slicer = std::move(parameter);
    return *this;
  }
};

/** All rows, in the order of the help. */
const std::vector<OptionRow> &
ListOptions();

/** Add the parts of the table, by subject. */
void
AddInputRows(std::vector<OptionRow> & rows);
void
AddVolumeRows(std::vector<OptionRow> & rows);
void
AddPlaceRows(std::vector<OptionRow> & rows);
void
AddJobRows(std::vector<OptionRow> & rows);
void
AddSheetRows(std::vector<OptionRow> & rows);
void
AddMeshRows(std::vector<OptionRow> & rows);
void
AddOutputRows(std::vector<OptionRow> & rows);
void
AddWallRows(std::vector<OptionRow> & rows);
void
AddRunRows(std::vector<OptionRow> & rows);

/** Adds a row. */
inline OptionRow &
AddRow(std::vector<OptionRow> & rows, std::string name, std::string unit, OptionValue value)
{
  OptionRow & row = rows.emplace_back();
  row.name = std::move(name);
  row.unit = std::move(unit);
  row.value = std::move(value);
  return row;
}

} // end namespace medialvoxel

#endif
