// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"

#include "Report.h"
#include "Text.h"

#include "itkMultiThreaderBase.h"

#include <map>

namespace medialvoxel
{
namespace
{

/** A number, the whole number, and nothing but the number. */
double
ToDouble(const std::string & text)
{
  const std::optional<double> value = ParseDouble(text);
  if (!value)
  {
    throw CLI::ValidationError("'" + text + "' is not a number");
  }
  return *value;
}

std::uint64_t
ToCount(const std::string & text, std::uint64_t least, std::uint64_t most)
{
  const std::optional<std::int64_t> value = ParseInteger(text);
  if (!value || *value < 0 || static_cast<std::uint64_t>(*value) < least || static_cast<std::uint64_t>(*value) > most)
  {
    throw CLI::ValidationError("'" + text + "' is not a whole number from " + std::to_string(least) + " to " +
                               std::to_string(most));
  }
  return static_cast<std::uint64_t>(*value);
}

constexpr std::uint64_t LargestCount = std::uint64_t{ 1 } << 62;

/** Adds an option with one value that \a assign takes as text; what it throws names the option. */
template <typename TAssign>
CLI::Option *
AddText(CLI::App & app, const std::string & name, const std::string & help, const std::string & unit, TAssign assign)
{
  const auto parse = [name, assign](const CLI::results_t & results) {
    try
    {
      assign(results.front());
    }
    catch (const CLI::ValidationError & error)
    {
      throw CLI::ValidationError(name, error.what());
    }
    return true;
  };
  return app.add_option(name, parse, help)->type_name(unit)->type_size(1)->expected(1);
}

template <typename TEnum>
CLI::Option *
AddChoice(CLI::App &                           app,
          const std::string &                  name,
          const std::string &                  help,
          TEnum &                              target,
          const std::map<std::string, TEnum> & choices)
{
  std::string names;
  for (const auto & choice : choices)
  {
    names += (names.empty() ? "" : "|") + choice.first;
  }
  return AddText(app, name, help, names, [&target, choices, names](const std::string & text) {
    const auto found = choices.find(text);
    if (found == choices.end())
    {
      throw CLI::ValidationError("'" + text + "' is not one of " + names);
    }
    target = found->second;
  });
}

std::vector<std::string>
SplitAtCommas(const std::string & text)
{
  return CLI::detail::split(text, ',');
}

/** The description of a headerless file comes to life with the first option that belongs to it. */
RawDescription &
GetRaw(JobOptions & options)
{
  if (!options.raw)
  {
    options.raw.emplace();
  }
  return *options.raw;
}

void
AddRawOptions(CLI::App & app, JobOptions & options)
{
  const std::string group = "Headerless input";
  auto * const      size = AddText(app, "--raw-size", "Voxels along each axis", "X,Y,Z", [&](const std::string & text) {
    for (const std::string & part : SplitAtCommas(text))
    {
      GetRaw(options).size.push_back(ToCount(part, 1, LargestCount));
    }
  });
  auto * const      type =
    AddText(app,
            "--raw-type",
            "Type of the voxels",
            Join(PixelTypes, "|", [](const PixelTypeTraits & traits) { return std::string(traits.name); }),
            [&](const std::string & text) {
              const std::optional<PixelType> pixelType = PixelTypeFromName(text);
              if (!pixelType)
              {
                throw CLI::ValidationError("'" + text + "' is not a type of voxels");
              }
              GetRaw(options).pixelType = *pixelType;
            });
  auto * const spacing = AddText(
    app, "--raw-spacing", "Distance of voxels along each axis (default 1,1,1)", "X,Y,Z", [&](const std::string & text) {
      for (const std::string & part : SplitAtCommas(text))
      {
        GetRaw(options).spacing.push_back(ToDouble(part));
      }
    });
  auto * const header =
    AddText(app, "--raw-header", "Bytes before the first voxel (default 0)", "BYTES", [&](const std::string & text) {
      GetRaw(options).headerBytes = ToCount(text, 0, LargestCount);
    });
  auto * const bigEndian = app.add_flag_callback(
    "--raw-big-endian", [&] { GetRaw(options).bigEndian = true; }, "The first byte of a voxel is the most significant");
  size->group(group)->needs(type);
  type->group(group)->needs(size);
  for (CLI::Option * const option : { spacing, header, bigEndian })
  {
    option->group(group)->needs(size);
  }
}

void
AddObjectOptions(CLI::App & app, JobOptions & options)
{
  const std::string group = "Object (without a limit: all voxels that are not 0)";
  AddText(app, "--lower", "Smallest value of the object", "L", [&](const std::string & text) {
    options.lowerThreshold = ToDouble(text);
  })->group(group);
  AddText(app, "--upper", "Largest value of the object", "U", [&](const std::string & text) {
    options.upperThreshold = ToDouble(text);
  })->group(group);
}

void
AddRunOptions(CLI::App & app, JobOptions & options, CommandLine & line)
{
  const std::string group = "Run";
  AddText(app,
          "--memory",
          "Cap on the memory of the process, such as 500M or 2G (default: half of the free memory)",
          "SIZE",
          [&](const std::string & text) {
            options.memoryBytes = ParseByteSize(text);
            if (!options.memoryBytes)
            {
              throw CLI::ValidationError("'" + text + "' is not a size such as 500M or 2G");
            }
          })
    ->group(group);
  app.add_option("--scratch", options.scratchFolder, "Folder for what memory cannot hold of a compressed volume")
    ->type_name("DIR")
    ->group(group);
  AddText(app, "--threads", "Number of threads (default: one per processor)", "N", [&](const std::string & text) {
    options.threads = static_cast<unsigned int>(ToCount(text, 1, itk::ITK_MAX_THREADS));
  })->group(group);
  AddText(app,
          "--divisions",
          "Pieces that the volume is done in (default: chosen)",
          "N",
          [&](const std::string & text) { options.divisions = ToCount(text, 1, LargestCount); })
    ->group(group);
  app.add_flag("--dry-run", options.dryRun, "Check everything, print the plan and stop")->group(group);
  app.add_flag("--sparse", options.sparse, "Leave blocks of zeros as holes in the files and reserve no space")
    ->group(group);
  app.add_flag("--overwrite", options.overwrite, "Replace existing outputs")->group(group);
  AddChoice<ProgressStyle>(app,
                           "--progress",
                           "How to show progress (default auto: a bar on a terminal, else plain)",
                           line.progress,
                           { { "auto", ProgressStyle::Auto },
                             { "bar", ProgressStyle::Bar },
                             { "plain", ProgressStyle::Plain },
                             { "slicer", ProgressStyle::Slicer },
                             { "json", ProgressStyle::Json },
                             { "none", ProgressStyle::None } })
    ->group(group);
  app.add_flag("--quiet", line.quiet, "Print errors only")->group(group);
}

const std::map<std::string, itk::MedialVoxelBoundary> Boundaries{
  { GetName(itk::MedialVoxelBoundary::Object), itk::MedialVoxelBoundary::Object },
  { GetName(itk::MedialVoxelBoundary::Background), itk::MedialVoxelBoundary::Background }
};

void
DefineExtract(CommandLine & line)
{
  CLI::App &       app = *line.extract;
  ExtractOptions & options = line.extractOptions;
  using Bound = itk::MedialVoxelPseudoGeodesicBound;
  app.add_option("INPUT", options.input, "Volume: .mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz, .tif or headerless")
    ->required()
    ->type_name("");
  app.add_option("OUTPUT", options.output, "Labels of the dual cells: .mha, .mhd, .nrrd or .nhdr")
    ->required()
    ->type_name("");
  AddText(app,
          "--thickness",
          "Tau, the thickness of walls that become sheets, in the units of the spacing",
          "T",
          [&](const std::string & text) { options.thickness = ToDouble(text); })
    ->required();
  app.add_flag("--voxel-units", options.voxelUnits, "Take lengths in voxels instead");
  AddChoice<Bound>(app,
                   "--bound",
                   "Bound that decides without search (default free-space)",
                   options.bound,
                   { { GetName(Bound::FreeSpace), Bound::FreeSpace },
                     { GetName(Bound::Paper), Bound::Paper },
                     { GetName(Bound::Off), Bound::Off } });
  AddObjectOptions(app, options);
  const std::string group = "Further outputs";
  app.add_option("--vectors", options.vectorFile, "Vectors to the nearest boundary point")
    ->type_name("FILE")
    ->group(group);
  AddChoice<itk::MedialVoxelBoundary>(
    app, "--vector-boundary", "Boundary that the vectors lead to (default object)", options.vectorBoundary, Boundaries)
    ->group(group);
  app.add_option("--distance", options.distanceFile, "Signed distance, negative inside the object")
    ->type_name("FILE")
    ->group(group);
  app.add_option("--report", options.reportFile, "Report as JSON")->type_name("FILE")->group(group);
  app.add_option("--preview", options.previewFile, "Picture of three slices as PNG")->type_name("FILE")->group(group);
  app.add_option("--html", options.htmlFile, "Report as a page with picture and histogram")
    ->type_name("FILE")
    ->group(group);
  AddRunOptions(app, options, line);
  AddRawOptions(app, options);
  app.footer("Labels: 0 no object, 1 not medial, 2 medial by bound, 3 medial by geodesic search.\n\n"
             "Examples:\n"
             "  medialvoxel extract part.mha medial.mha --thickness 3 --lower 72 --preview medial.png\n"
             "  medialvoxel extract scan.raw medial.nrrd --thickness 2.5 --lower 200 \\\n"
             "      --raw-size 708,965,325 --raw-type uint16 --raw-spacing 0.5,0.5,0.8");
}

void
DefineDistance(CommandLine & line)
{
  CLI::App &        app = *line.distance;
  DistanceOptions & options = line.distanceOptions;
  using Region = itk::MedialVoxelRegion;
  app.add_option("INPUT", options.input, "Volume: .mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz, .tif or headerless")
    ->required()
    ->type_name("");
  app.add_option("VECTORS", options.output, "Vectors to the nearest boundary voxel: .mha, .mhd, .nrrd or .nhdr")
    ->required()
    ->type_name("");
  AddChoice<itk::MedialVoxelBoundary>(
    app, "--boundary", "Boundary that the vectors lead to (default object)", options.boundary, Boundaries);
  AddChoice<Region>(app,
                    "--region",
                    "Voxels that get a vector (default both)",
                    options.region,
                    { { GetName(Region::Inside), Region::Inside },
                      { GetName(Region::Outside), Region::Outside },
                      { GetName(Region::Both), Region::Both } });
  AddText(
    app, "--maximum-distance", "Voxels farther than this become not a number", "X", [&](const std::string & text) {
      options.maximumDistance = ToDouble(text);
    });
  app.add_flag("--voxel-units", options.voxelUnits, "Take lengths in voxels instead of the units of the spacing");
  AddObjectOptions(app, options);
  const std::string group = "Further outputs";
  app.add_option("--distance", options.distanceFile, "Signed distance, negative inside the object")
    ->type_name("FILE")
    ->group(group);
  app.add_flag("--squared-distance", options.squaredDistance, "Square the signed distance")->group(group);
  app.add_flag("--inside-positive", options.insideIsPositive, "Make the signed distance positive inside")->group(group);
  app.add_option("--report", options.reportFile, "Report as JSON")->type_name("FILE")->group(group);
  AddRunOptions(app, options, line);
  AddRawOptions(app, options);
  app.footer("Examples:\n"
             "  medialvoxel distance part.mha vectors.mha --lower 72 --distance distance.mha\n"
             "  medialvoxel distance mask.nrrd vectors.nrrd --region inside --boundary background");
}

void
DefineInfo(CommandLine & line)
{
  line.info
    ->add_option("INPUT", line.infoOptions.input, "Volume: .mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz, .tif or headerless")
    ->required()
    ->type_name("");
  AddRawOptions(*line.info, line.infoOptions);
}

} // namespace

std::unique_ptr<CLI::App>
DefineCommandLine(CommandLine & line)
{
  auto app =
    std::make_unique<CLI::App>("Medial voxels and vector distances of objects in volumes of any size", "medialvoxel");
  app->set_version_flag("--version", "medialvoxel " + GetVersion());
  app->require_subcommand(1);
  line.extract = app->add_subcommand("extract", "Extract the medial voxels of an object");
  line.distance = app->add_subcommand("distance", "Compute vectors to the nearest boundary voxel and signed distances");
  line.info = app->add_subcommand("info", "Describe a volume");
  DefineExtract(line);
  DefineDistance(line);
  DefineInfo(line);
  app->footer("Exit status: 0 done, 1 failure, 2 wrong usage, 3 refused before the start, 4 corrupt input,\n"
              "130 or 143 stopped by a signal. Help on a command: medialvoxel COMMAND --help");
  return app;
}

} // end namespace medialvoxel
