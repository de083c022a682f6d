// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"

#include "ClusterRange.h"
#include "CommandParts.h"
#include "CommandTable.h"
#include "CommandText.h"
#include "MeasureOptions.h"
#include "MeshOptions.h"
#include "OptionValues.h"
#include "Text.h"
#include "Version.h"
#include "VolumeFormats.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace medialvoxel
{
namespace
{

/** More than any volume has: each has half the size of the one before. */
constexpr std::uint64_t LargestLevel = 64;

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

/** Adds a choice that completions know, too; the first name is the default. */
template <typename TEnum>
CLI::Option *
AddChoice(CommandLine &                                      line,
          CLI::App &                                         app,
          const std::string &                                name,
          const std::string &                                help,
          const std::string &                                unit,
          TEnum &                                            target,
          const std::vector<std::pair<std::string, TEnum>> & choices)
{
  CLI::Option * const option = medialvoxel::AddChoice(app, name, help, unit, target, choices);
  line.choices[option] = ListNames(choices);
  return option;
}

/** Adds an option with a distance of voxels for each axis; \a target() is where it goes. */
template <typename TTarget>
CLI::Option *
AddSpacing(CLI::App & app, const std::string & name, const std::string & help, TTarget target)
{
  return AddText(app, name, help, "X,Y,Z", [target](const std::string & text) {
    for (const std::string & part : SplitAtCommas(text))
    {
      target().push_back(ToSpacing(part));
    }
  });
}

} // namespace

void
AddRawOptions(CommandLine & line, CLI::App & app, JobOptions & options)
{
  const std::string group = "Headerless input";
  auto * const      size = AddText(app, "--raw-size", "Voxels along each axis", "X,Y,Z", [&](const std::string & text) {
    const std::vector<std::string> parts = SplitAtCommas(text);
    if (parts.size() < 2 || parts.size() > 3)
    {
      throw CLI::ValidationError("'" + text + "' has " + std::to_string(parts.size()) + " values; it must have 2 or 3");
    }
    for (const std::string & part : parts)
    {
      GetRaw(options).size.push_back(ToCount(part, 1, LargestCount));
    }
  });
  auto * const      type = AddText(app, "--raw-type", "Type of the voxels", "TYPE", [&](const std::string & text) {
    const std::optional<PixelType> pixelType = PixelTypeFromName(ToLower(text));
    if (!pixelType)
    {
      std::vector<std::string> names;
      std::transform(PixelTypes.begin(),
                     PixelTypes.end(),
                     std::back_inserter(names),
                     [](const PixelTypeTraits & traits) { return std::string(traits.name); });
      throw CLI::ValidationError("'" + text + "' is not one of " + CLI::detail::join(names, "|") +
                                 SuggestName(text, names));
    }
    GetRaw(options).pixelType = *pixelType;
  });
  for (const PixelTypeTraits & traits : PixelTypes)
  {
    line.choices[type].emplace_back(traits.name);
  }
  auto * const spacing =
    AddSpacing(app, "--raw-spacing", "The same as --spacing", [&]() -> auto & { return GetRaw(options).spacing; });
  auto * const header =
    AddText(app, "--raw-header", "Bytes before the first voxel (default 0)", "BYTES", [&](const std::string & text) {
      GetRaw(options).headerBytes = ToCount(text, 0, LargestCount);
    });
  auto * const bigEndian =
    AddFlag(app, "--raw-big-endian", "The first byte of a voxel is the most significant", [&](bool value) {
      GetRaw(options).bigEndian = value;
    });
  size->group(group)->needs(type);
  type->group(group)->needs(size);
  for (CLI::Option * const option : { header, bigEndian })
  {
    option->group(group)->needs(size);
  }
  spacing->group(HiddenGroup)->needs(size); // not shown, as --spacing says it for any input
}

void
AddObjectOptions(CLI::App & app, JobOptions & options)
{
  AddText(app, "--lower", "Smallest value, or otsu (default: all but 0)", "L", [&](const std::string & text) {
    options.lowerIsOtsu = ToLower(text) == "otsu";
    options.lowerThreshold =
      options.lowerIsOtsu ? std::nullopt : std::optional<itk::MedialVoxelLimit>(ToLimit(text, " or otsu"));
  });
  AddText(app, "--upper", "Largest value of the object", "U", [&](const std::string & text) {
    options.upperThreshold = ToLimit(text);
  });
  AddText(app, "--label", "The one value of the object, as in a label map", "N", [&](const std::string & text) {
    options.label = ParseLabel(text);
    if (!options.label)
    {
      throw CLI::ValidationError("'" + text + "' is not a whole number from -2^63 to 2^64 - 1");
    }
  });
}

void
AddMemory(CLI::App & app, std::optional<std::uint64_t> & target)
{
  AddText(app,
          "--memory",
          "Limit, such as 2G (default: half of the free memory)",
          "SIZE",
          [&target](const std::string & text) { target = ToByteSize(text); })
    ->group("Run");
}

void
AddThreads(CLI::App & app, std::optional<unsigned int> & target)
{
  AddText(app, "--threads", "Threads (default: one per processor)", "N", [&target](const std::string & text) {
    target = static_cast<unsigned int>(ToCount(text, 1, itk::ITK_MAX_THREADS));
  })->group("Run");
}

void
AddProgress(CommandLine & line, CLI::App & app)
{
  const std::string group = "Run";
  AddChoice<ProgressStyle>(line,
                           app,
                           "--progress",
                           "Progress",
                           "STYLE",
                           line.progress,
                           { { "auto", ProgressStyle::Auto },
                             { "bar", ProgressStyle::Bar },
                             { "plain", ProgressStyle::Plain },
                             { "slicer", ProgressStyle::Slicer },
                             { "json", ProgressStyle::Json },
                             { "none", ProgressStyle::None } })
    ->group(group);
  AddFlag(app, "--quiet", "Print errors only", line.quiet)->group(group);
}

void
AddLog(CommandLine & line, CLI::App & app, std::string & target)
{
  const std::string group = "Run";
  auto * const      log = AddFile(app, "--log-file", "Append one line per step to this file", target)->group(group);
  AddChoice<LogLevel>(line,
                      app,
                      "--log-level",
                      "Least urgent lines",
                      "LEVEL",
                      line.logLevel,
                      { { "info", LogLevel::Info },
                        { "error", LogLevel::Error },
                        { "warning", LogLevel::Warning },
                        { "debug", LogLevel::Debug } })
    ->group(group)
    ->needs(log);
}

namespace
{

std::string
ListExtensions(unsigned int components)
{
  return CLI::detail::join(ListOutputExtensions(components), " ");
}

/** To be called after AddRunOptions(). */
void
AddCompression(CommandLine & line, CLI::App & app, JobOptions & options)
{
  AddFlag(app, "--compress", "Pack .mha and .nrrd outputs", options.compress)->group("Run");
  AddChoice<ZarrCompression>(line,
                             app,
                             "--zarr-compression",
                             "Compression of .zarr outputs",
                             "KIND",
                             options.zarrCompression,
                             { { GetName(ZarrCompression::Gzip), ZarrCompression::Gzip },
                               { GetName(ZarrCompression::BloscZstd), ZarrCompression::BloscZstd },
                               { GetName(ZarrCompression::None), ZarrCompression::None } })
    ->group("Run");
}

} // namespace

void
AddRunOptions(CommandLine & line, CLI::App & app, JobOptions & options)
{
  const std::string group = "Run";
  AddMemory(app, options.memoryBytes);
  AddFile(app, "--scratch", "Folder for input and mesh beyond the memory", options.scratchFolder)
    ->type_name("DIR")
    ->group(group);
  AddThreads(app, options.threads);
  AddText(app, "--divisions", "Number of pieces (default: chosen)", "N", [&](const std::string & text) {
    options.divisions = ToCount(text, 1, LargestCount);
  })->group(group);
  AddFlag(app, "--dry-run", "Check everything, print the plan and stop", options.dryRun)->group(group);
  AddFlag(app, "--sparse", "Leave zeros as holes in the files, reserve no space", options.sparse)->group(group);
  AddFlag(app, "--overwrite", "Replace existing outputs", options.overwrite)->group(group);
  AddProgress(line, app);
  AddLog(line, app, options.logFile);
}

void
AddInput(CLI::App & app, JobOptions & options)
{
  AddFile(app, "INPUT", "Volume: " + CLI::detail::join(ListInputFormats(), " "), options.input)->required();
  AddText(app, "--slices", "FIRST-LAST, of a folder or pattern of slices", "RANGE", [&](const std::string & text) {
    const std::optional<std::vector<ClusterRange>> ranges = ParseClusters(text);
    if (!ranges || ranges->size() != 1)
    {
      throw CLI::ValidationError("'" + text + "' is not a range such as 20-40, of whole numbers from 0 on");
    }
    options.slices.range = { ranges->front().first, ranges->front().last };
  });
  RefuseEmpty(app.add_option("--series", options.slices.series, "The DICOM series of a folder that has several")
                ->type_name("UID"),
              "the UID of a series")
    ->group(HiddenGroup); // not shown, as the message that lists the series says it
  AddSpacing(app, "--spacing", "Spacing, instead of that of the file", [&]() -> auto & { return options.spacing; });
  AddText(app, "--level", "Of an image with several sizes; 0 (default): largest", "N", [&](const std::string & text) {
    options.level = static_cast<unsigned int>(ToCount(text, 0, LargestLevel));
  });
  AddText(app, "--resample", "Resample to the spacing S, auto (smallest) or off", "S", [&](const std::string & text) {
    const std::string word = ToLower(text);
    options.resample = word == AutomaticSpacing   ? 0.0
                       : word == UnchangedSpacing ? KeepSpacing
                                                  : ToSpacing(text, ", auto or off");
  });
}

namespace
{

const std::vector<std::pair<std::string, itk::MedialVoxelBoundary>> Boundaries{
  { GetName(itk::MedialVoxelBoundary::Object), itk::MedialVoxelBoundary::Object },
  { GetName(itk::MedialVoxelBoundary::Background), itk::MedialVoxelBoundary::Background }
};

} // namespace

CLI::Option *
AddPoreSize(CLI::App & app, const std::string & help, std::optional<std::uint64_t> & target)
{
  return AddText(app, "--max-pore-size", help, "K", [&target](const std::string & text) {
    target = ToCount(text, 0, LargestPoreSize);
  });
}

void
AddThickness(CommandLine & line, CLI::App & app, ExtractOptions & options)
{
  AddText(app, "--thickness", "Thickness of the walls, or auto (default: auto)", "T", [&](const std::string & text) {
    options.thickness =
      ToLower(text) == AutomaticThickness ? std::nullopt : std::optional<double>(ToLength(text, " or auto"));
  });
  AddText(app,
          "--minimum-thickness",
          "auto: thinner walls count as this (default: 3 voxels)",
          "T",
          [&](const std::string & text) { options.minimumThickness = ToLength(text); });
  AddText(
    app, "--maximum-thickness", "auto: thickest wall to be a sheet (default: 16)", "T", [&](const std::string & text) {
      options.maximumThickness = ToLength(text);
    });
  AddPoreSize(app, "Largest pore or grain left out (auto: 32, else 0)", options.maximumPoreSize);
  AddChoice<std::optional<Smoothing>>(line,
                                      app,
                                      "--smooth",
                                      "Noise of the object: smooth it away?",
                                      "KIND",
                                      options.smoothing,
                                      { { GetName(Smoothing::Automatic), Smoothing::Automatic },
                                        { GetName(Smoothing::On), Smoothing::On },
                                        { GetName(Smoothing::Off), Smoothing::Off } });
  AddFlag(app, "--voxel-units", "Lengths are in voxels, not in units of the spacing", options.voxelUnits);
}

namespace
{} // namespace

void
AddLabels(CLI::App & app, ExtractOptions & options)
{
  AddFile(app, "OUTPUT", "Labels: " + ListExtensions(1), options.output)->required();
}

/** All but the arguments. */
void
AddExtractOptions(CommandLine & line, CLI::App & app, ExtractOptions & options, bool * const resumes)
{
  AddThickness(line, app, options);
  AddObjectOptions(app, options);
  AddText(app, "--labels", "Each value is an object: all, or L1,L2,...", "LIST", [&](const std::string & text) {
    options.labels = ToLabels(text);
  });
  AddFile(app, "--segments", "Names and colors of labels (.ctbl, .csv, .nrrd)", options.segmentFile);
  const std::string group = "Further outputs";
  AddFile(app, "--objects", "With --labels: the label of each cell's object", options.objectFile)->group(group);
  AddFile(app, "--vectors", "Vectors to the nearest boundary point", options.vectorFile)->group(group);
  AddChoice<itk::MedialVoxelBoundary>(
    line, app, "--vector-boundary", "Boundary that they lead to", "KIND", options.vectorBoundary, Boundaries)
    ->group(group);
  AddFile(app, "--distance", "Signed distance, negative inside the object", options.distanceFile)->group(group);
  AddMesh(app, "--mesh", options)->group(group);
  AddElementSize(app, options)->group(group);
  AddSectionWidth(app, options)->group(group);
  AddFile(app, "--preview", "Picture of slices and a projection (.png)", options.previewFile)->group(group);
  AddFile(app, "--html", "Page with picture, histogram and phases (.html)", options.htmlFile)->group(group);
  AddFile(app, "--report", "All numbers (JSON); - for stdout", options.reportFile)->group(group);
  AddMeasureOptions(line, app, options);
  AddRunOptions(line, app, options);
  AddCompression(line, app, options);
  if (resumes != nullptr)
  {
    AddFlag(app, "--resume", "Continue a stopped run, or start one that can", *resumes)->group("Run");
  }
  AddRawOptions(line, app, options);
}

namespace
{

void
DefineExtract(CommandLine & line)
{
  CLI::App &       app = *line.extract;
  ExtractOptions & options = line.extractOptions;
  AddInput(app, options);
  AddLabels(app, options);
  AddExtractOptions(line, app, options, &line.resumes);
  line.examples[&app] = {
    "medialvoxel extract part.mha out.mha --lower otsu --html part.html",
    "medialvoxel extract scan.raw out.nrrd --raw-size 708,965,325 --raw-type uint16",
  };
  app.footer("Labels: 0 no object, 1 not medial, 2 medial by bound, 3 medial by search.");
}

void
DefineDistance(CommandLine & line)
{
  CLI::App &        app = *line.distance;
  DistanceOptions & options = line.distanceOptions;
  using Region = itk::MedialVoxelRegion;
  AddInput(app, options);
  AddFile(app, "VECTORS", "Vectors to the boundary: " + ListExtensions(3), options.output)->required();
  AddChoice<itk::MedialVoxelBoundary>(
    line, app, "--boundary", "Boundary that the vectors lead to", "KIND", options.boundary, Boundaries);
  AddChoice<Region>(line,
                    app,
                    "--region",
                    "Voxels with a vector",
                    "PART",
                    options.region,
                    { { GetName(Region::Both), Region::Both },
                      { GetName(Region::Inside), Region::Inside },
                      { GetName(Region::Outside), Region::Outside } });
  AddText(app, "--maximum-distance", "Voxels farther than this become NaN", "X", [&](const std::string & text) {
    options.maximumDistance = ToDistance(text);
  });
  AddFlag(app, "--voxel-units", "Lengths are in voxels, not in units of the spacing", options.voxelUnits);
  AddObjectOptions(app, options);
  const std::string group = "Further outputs";
  AddFile(app, "--distance", "Signed distance, negative inside the object", options.distanceFile)->group(group);
  AddFile(app, "--report", "All numbers (JSON); - for stdout", options.reportFile)->group(group);
  AddRunOptions(line, app, options);
  AddCompression(line, app, options);
  AddRawOptions(line, app, options);
  line.examples[&app] = { "medialvoxel distance part.mha vectors.mha --lower 72 --distance distance.mha",
                          "medialvoxel distance mask.nrrd out.nrrd --region inside --boundary background" };
}

void
DefineInfo(CommandLine & line)
{
  AddInput(*line.info, line.infoOptions);
  AddFlag(*line.info, "--values", "Read the values: range, mean, percentiles, Otsu", line.showsValues);
  AddFlag(*line.info, "--labels", "Read a label map: objects, and passes for all of them", line.showsLabels);
  AddRawOptions(line, *line.info, line.infoOptions);
  line.examples[line.info] = { "medialvoxel info part.mha --values",
                               "medialvoxel info scan.raw --raw-size 708,965,325 --raw-type uint16" };
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
  line.mesh = app->add_subcommand("mesh", "Build the medial surface of an object");
  line.surface = app->add_subcommand("surface", "Build the surface of a part, with its wall thickness");
  line.distance = app->add_subcommand("distance", "Compute vectors to the boundary and distances");
  line.info = app->add_subcommand("info", "Describe a volume");
  line.check = app->add_subcommand("check", "Check the elements of a shell mesh");
  line.plan = app->add_subcommand("plan", "Prepare an extraction by several processes");
  line.work = app->add_subcommand("work", "Compute clusters of a planned extraction");
  line.finalize = app->add_subcommand("finalize", "Verify a computed extraction and name its outputs");
  line.status = app->add_subcommand("status", "Show the progress of a planned extraction");
  DefineExtract(line);
  DefineMesh(line);
  DefineSurface(line);
  DefineDistance(line);
  DefineInfo(line);
  DefineCheck(line);
  DefineJobCommands(line);
  line.generate = app->add_subcommand("generate", "Write completions and manual pages to a folder")->group("");
  line.generate->add_option("FOLDER", line.generateFolder, "An existing folder")->required();
  line.examples[line.generate] = { "medialvoxel generate .", "medialvoxel generate build/texts" };
  line.examples[app.get()] = { "medialvoxel info part.mha --values",
                               "medialvoxel extract part.mha out.mha --lower otsu --html part.html" };
  app->footer("Exit status: 0 done, 1 failure, 2 wrong usage, 3 refused before the start,\n"
              "4 corrupt input, 5 thin places (--fail-if-thin), 130 or 143 stopped by a signal.\n"
              "Help on a command: medialvoxel COMMAND --help");
  UseCompactHelp(line, *app);
  return app;
}

} // end namespace medialvoxel
