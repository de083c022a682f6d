// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Parameters.h"

#include "Errors.h"
#include "OptionParser.h"
#include "OptionTable.h"
#include "SlicerXml.h"
#include "Version.h"

#include <iostream>

namespace medialvoxel
{
namespace
{

/** Word for a value in the help. */
std::string
GetUnit(const SlicerParameter & parameter, const OptionValue & value, const std::string & unit)
{
  const bool isNumber = parameter.element == "double" || parameter.element == "integer";
  return value.isFlag             ? ""
         : !value.choices.empty() ? CLI::detail::join(value.choices, "|")
         : isNumber               ? "NUMBER"
                                  : unit;
}

/** Adds the parameters of the table. */
void
AddParameters(CLI::App & app, const OptionTarget & target)
{
  for (const OptionRow & row : ListOptions())
  {
    const SlicerParameter & parameter = row.slicer;
    if (parameter.name.empty())
    {
      continue;
    }
    const OptionValue   value = GetModuleValue(row);
    const std::string   name = (row.IsArgument() ? "" : "--") + parameter.name;
    CLI::Option * const option =
      AddOption(app, name, GetUnit(parameter, value, row.unit), parameter.description, value, target);
    option->default_str(value.initial.value_or(""))->required(row.IsArgument());
    parameter.needsSelection ? option->needs(app.get_option("--objectSelection")) : option;
  }
}

/** Parameters that every module of 3D Slicer understands. */
void
AddCommonParameters(CLI::App & app, const OptionTarget & target)
{
  AddOption(app,
            "--returnparameterfile",
            "FILE",
            "File for counts, percentages and seconds",
            OrEmpty(File(&ExtractOptions::returnParameterFile)),
            target);
  OptionValue address;
  address.set = [](const OptionTarget &, const std::string & text) {
    if (text != "0")
    {
      throw WrongValue("'" + text + "' is not 0");
    }
  };
  AddOption(app,
            "--processinformationaddress",
            "ADDRESS",
            "Address of a progress structure; a program has none but 0",
            address,
            target)
    ->default_str("0");
  AddOption(app, "--echo", "", "Print all values before the run", Flag(&ModuleOptions::echo), target)
    ->default_str("false");
  app.set_version_flag("--version", "MedialVoxelExtraction " + GetVersion());
  app
    .add_flag_callback(
      "--xml",
      [] {
        std::cout << MakeSlicerXml();
        throw CLI::Success();
      },
      "Print the description for 3D Slicer and exit")
    ->configurable(false);
}

} // namespace

std::unique_ptr<CLI::App>
DefineParameters(ModuleOptions & options)
{
  auto app = MakeParser("Extracts the medial voxels of an object in a volume, as a module of 3D Slicer or by itself.",
                        "MedialVoxelExtraction");
  const OptionTarget target = MakeTarget(options.job, options.program, options);
  AddParameters(*app, target);
  AddCommonParameters(*app, target);
  app->footer(
    "What follows -- or --ignore_rest is no option. A boolean is given as --resample or --resample=true.\n\n"
    "Labels: 0 no object, 1 not medial, 2 medial by bound, 3 medial by geodesic search, 4 added for the topology.\n"
    "Exit status: 0 done, 1 failure, 2 wrong usage, 3 refused, 4 corrupt input, 130 or 143 stopped by a "
    "signal.\n\n"
    "Example:\n"
    "  MedialVoxelExtraction --objectSelection AboveLower --lowerThreshold 72 part.mha medial.mha");
  return app;
}

void
CompleteJob(const CLI::App & app, ModuleOptions & options)
{
  SetLengthsInVoxels(options.program, options.job, true);
  const ObjectSelection selection = options.objectSelection;
  if (selection == ObjectSelection::AboveLower || selection == ObjectSelection::Between)
  {
    options.job.lowerThreshold = options.lowerThreshold;
  }
  if (selection == ObjectSelection::BelowUpper || selection == ObjectSelection::Between)
  {
    options.job.upperThreshold = options.upperThreshold;
  }
  if (selection == ObjectSelection::Label)
  {
    options.job.label = ParseLabel(std::to_string(options.labelValue));
  }
  if (selection == ObjectSelection::Labels)
  {
    options.job.labels = options.labels;
    options.job.segmentFile = options.colorTable;
  }
  const bool hasLabels = app.count("--labels") > 0 && !app["--labels"]->results().front().empty();
  if (hasLabels && app.count("--objectSelection") == 0)
  {
    Fail(ExitStatus::Usage, "--labels requires --objectSelection");
  }
  const bool isImplied = app.count("--thickness") > 0 && app.count("--thicknessMode") == 0;
  if (isImplied || options.thicknessMode == itk::MedialVoxelThicknessMode::Fixed)
  {
    options.job.thickness = options.thickness;
  }
  const bool isLengthImplied = app.count("--elementSize") > 0 && app.count("--elementSizeMode") == 0;
  const auto kind = isLengthImplied ? ElementSize::Kind::Length : options.elementSizeMode;
  options.job.elementSize = { kind, kind == ElementSize::Kind::Length ? options.elementSize : 0.0 };
  if (options.resample)
  {
    options.job.resample = 0.0;
  }
}

void
PrintValues(std::ostream & out, const CLI::App & app)
{
  // Help, version and description have no values.
  for (const CLI::Option * const option :
       app.get_options([](const CLI::Option * candidate) { return candidate->get_configurable(); }))
  {
    out << option->get_single_name() << ": "
        << (option->count() > 0 ? option->results().front() : option->get_default_str()) << '\n';
  }
  out << std::flush;
}

} // end namespace medialvoxel
