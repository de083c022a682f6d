// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"

#include "CommandTable.h"
#include "CommandText.h"
#include "Errors.h"
#include "OptionParser.h"
#include "MeshFormat.h"
#include "Version.h"

namespace medialvoxel
{
namespace
{

/** A command: its name, its description, and the structures that its options fill. */
struct CommandRow
{
  unsigned int command; ///< one of Commands
  CLI::App * CommandLine::* app;
  const char *              name;
  const char *              help;
  OptionTarget (*getTarget)(CommandLine &);
  std::vector<std::string> examples{};
  const char *             footer{ "" };
};

const std::vector<CommandRow> &
ListCommands()
{
  static const std::vector<CommandRow> rows{
    { Commands::Extract,
      &CommandLine::extract,
      "extract",
      "Extract the medial voxels of an object",
      [](CommandLine & line) { return MakeTarget(line.extractOptions, line.program); },
      { "medialvoxel extract part.mha out.mha --lower otsu --html part.html",
        "medialvoxel extract scan.raw out.nrrd --raw-size 708,965,325 --raw-type uint16" } },
    { Commands::Mesh,
      &CommandLine::mesh,
      "mesh",
      "Build the medial surface of an object",
      [](CommandLine & line) { return MakeTarget(line.meshOptions, line.program); },
      { "medialvoxel mesh part.mha part.vtp --lower 72",
        "medialvoxel mesh part.mha shell.inp --lower 72 --element-size 3" },
      "Vertices have the thickness of the wall, in the units of the spacing." },
    { Commands::Surface,
      &CommandLine::surface,
      "surface",
      "Build the surface of a part, with its wall thickness",
      [](CommandLine & line) { return MakeTarget(line.partOptions, line.program); },
      { "medialvoxel surface part.mha part.glb --lower 72",
        "medialvoxel surface part.mha part.vtp --lower 72 --ray --report part.json" },
      "Vertices have the local thickness of the part, in the units of the spacing." },
    { Commands::Distance,
      &CommandLine::distance,
      "distance",
      "Compute vectors to the boundary and distances",
      [](CommandLine & line) { return MakeTarget(line.distanceOptions, line.program); },
      { "medialvoxel distance part.mha vectors.mha --lower 72 --distance distance.mha",
        "medialvoxel distance mask.nrrd out.nrrd --region inside --boundary background" } },
    { Commands::Info,
      &CommandLine::info,
      "info",
      "Describe a volume",
      [](CommandLine & line) { return MakeTarget(line.infoOptions, line.program); },
      { "medialvoxel info part.mha --values", "medialvoxel info scan.raw --raw-size 708,965,325 --raw-type uint16" } },
    { Commands::Plan,
      &CommandLine::plan,
      "plan",
      "Prepare an extraction by several processes",
      [](CommandLine & line) { return MakeTarget(line.planOptions, line.program); },
      { "medialvoxel plan part.mha out.mha job --lower 72",
        "medialvoxel plan part.mha out.mha job --divisions 64 --threads 8 --slurm" } },
    { Commands::Work,
      &CommandLine::work,
      "work",
      "Compute clusters of a planned extraction",
      [](CommandLine & line) { return MakeTarget(line.workOptions, line.processOptions, line.program); },
      { "medialvoxel work job", "medialvoxel work job --clusters 0-9 --threads 4" },
      "Finished clusters are skipped; any number of processes may work at once." },
    { Commands::Finalize,
      &CommandLine::finalize,
      "finalize",
      "Verify a computed extraction and name its outputs",
      [](CommandLine & line) { return MakeTarget(line.finalizeOptions, line.processOptions, line.program); },
      { "medialvoxel finalize job", "medialvoxel finalize job --no-verify" } },
    { Commands::Status,
      &CommandLine::status,
      "status",
      "Show the progress of a planned extraction",
      [](CommandLine & line) { return MakeTarget(line.program); },
      { "medialvoxel status job", "medialvoxel status job --json" } },
  };
  return rows;
}

/** Adds the options of the table that a command has. */
void
AddOptions(CommandLine & line, CLI::App & app, const CommandRow & command)
{
  const OptionTarget         target = command.getTarget(line);
  std::vector<CLI::Option *> added;
  for (const OptionRow & row : ListOptions())
  {
    if ((row.commands & command.command) != 0)
    {
      CLI::Option * const option = AddOption(app, row.name, row.unit, row.help, row.value, target);
      option->required(row.IsArgument() && (row.optionalIn & command.command) == 0)
        ->group((row.refusedIn & command.command) != 0  ? HiddenGroup
                : (row.hiddenIn & command.command) != 0 ? FurtherGroup
                                                        : row.group);
      line.rows[option] = &row;
      added.push_back(option);
    }
  }
  for (CLI::Option * const option : added)
  {
    const std::string & companion = line.rows[option]->companion;
    companion.empty() ? option : option->needs(app.get_option(companion));
  }
}

/** Pieces of a mesh for solvers are left out that have fewer faces, of a voxel each: nothing holds them. */
constexpr std::uint64_t SmallestPiece = 100;

/** What meshes for solvers are like, unless it is said. Objects of a label map touch, so that rims may end there. */
void
CompleteElements(const CLI::App & app, ExtractOptions & options)
{
  if (options.meshFile.empty() || !HoldsElements(GetMeshFormat(options.meshFile)))
  {
    return;
  }
  if (app.count("--element-size") == 0)
  {
    options.elementSize.kind = ElementSize::Kind::Automatic;
  }
  const bool isForSolvers = options.elementSize.kind != ElementSize::Kind::Voxel;
  if (app.count("--extend-rims") == 0)
  {
    options.extendsRims = isForSolvers && !options.labels;
  }
  if (app.count("--min-component-size") == 0)
  {
    options.minimumComponentSize = isForSolvers ? SmallestPiece : 0;
  }
}

/** Structures for jobs that are parsed beside others. */
void
CompleteJobs(CommandLine & line)
{
  line.planOptions.jobFolder = line.program.jobFolder;
  line.workOptions.jobFolder = line.program.jobFolder;
  line.workOptions.memoryLimit = line.processOptions.memoryLimit;
  line.workOptions.threads = line.processOptions.threads;
  line.workOptions.scratchFolder = line.processOptions.scratchFolder;
  line.finalizeOptions.jobFolder = line.program.jobFolder;
}

} // namespace

std::unique_ptr<CLI::App>
DefineCommandLine(CommandLine & line)
{
  auto app = MakeParser("Medial voxels and vector distances of objects in volumes of any size", "medialvoxel");
  app->set_version_flag("-V,--version", "medialvoxel " + GetVersion());
  app->set_help_all_flag("--help-all", "Print help with all options and exit");
  app->require_subcommand(1);
  for (const CommandRow & row : ListCommands())
  {
    CLI::App * const command = line.*row.app = app->add_subcommand(row.name, row.help);
    line.examples[command] = row.examples;
    command->footer(row.footer);
    AddOptions(line, *command, row);
  }
  line.generate = app->add_subcommand("generate", "Write completions and manual pages to a folder")->group("");
  line.generate->add_option("FOLDER", line.generateFolder, "An existing folder")->required();
  line.examples[line.generate] = { "medialvoxel generate .", "medialvoxel generate build/texts" };
  line.examples[app.get()] = { "medialvoxel info part.mha --values",
                               "medialvoxel extract part.mha out.mha --lower otsu --html part.html" };
  app->footer("Exit status: 0 done, 1 failure, 2 wrong usage, 3 refused before the start,\n"
              "4 corrupt input, 5 thin places (--fail-if-thin), 6 too little was measured,\n"
              "130 or 143 stopped by a signal.\n"
              "Help on a command: medialvoxel COMMAND --help");
  UseCompactHelp(line, *app);
  return app;
}

void
CompleteCommandLine(CommandLine & line)
{
  for (const CommandRow & command : ListCommands())
  {
    if ((line.*command.app)->parsed() && !line.program.lengthsInVoxels.empty())
    {
      const bool hasSheets = (command.command & Commands::Distance) == 0;
      SetLengthsInVoxels(line.program, *std::get<JobOptions *>(command.getTarget(line)), hasSheets);
    }
  }
  CompleteElements(*line.extract, line.extractOptions);
  CompleteElements(*line.mesh, line.meshOptions);
  CompleteJobs(line);
  for (const CommandRow & command : ListCommands())
  {
    for (const CLI::Option * const option : (line.*command.app)->get_options())
    {
      const OptionRow * const row = FindRow(line, *option);
      if (row && option->count() > 0 && row->hasEffect && !row->hasEffect(command.getTarget(line)))
      {
        Fail(ExitStatus::Usage, row->name, " has no effect here; it needs ", row->need);
      }
    }
  }
}

} // end namespace medialvoxel
