// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Parameters.h"

#include "EmbeddedXml.h"
#include "OptionValues.h"
#include "Version.h"

#include <iostream>
#include <limits>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MostThreads = 128;

/** The required argument with a name. */
void
AddPositional(CLI::App & app, const std::string & name, const std::string & help, std::string & target)
{
  AddFile(app, name, help, target)->required();
}

void
AddPath(CLI::App & app, const std::string & name, const std::string & help, std::string & target)
{
  AddOptionalFile(app, "--" + name, help, target);
}

void
AddBoolean(CLI::App & app, const std::string & name, const std::string & help, bool & target)
{
  AddFlag(app, "--" + name, help, target)->default_str("false");
}

CLI::Option *
AddThreshold(CLI::App & app, const std::string & name, const std::string & help, double & target)
{
  const auto parse = [&target](const std::string & text) { target = ToLimit(text).GetNearestDouble(); };
  return AddText(app, "--" + name, help, "NUMBER", parse)->default_str(FormatNumber(target));
}

/** Of what is greater than 0, or 0 where that is the default. */
void
AddLength(CLI::App & app, const std::string & name, const std::string & help, double & target)
{
  const bool mayBeNone = target == 0.0;
  AddText(app, "--" + name, help, "NUMBER", [&target, mayBeNone](const std::string & text) {
    target = mayBeNone ? ToLengthOrNone(text) : ToLength(text);
  })->default_str(FormatNumber(target));
}

/** \param value by default */
template <typename TAssign>
CLI::Option *
AddInteger(CLI::App &          app,
           const std::string & name,
           const std::string & help,
           std::int64_t        value,
           std::int64_t        minimum,
           std::int64_t        maximum,
           TAssign             assign)
{
  const auto parse = [=](const std::string & text) { assign(ToInteger(text, minimum, maximum)); };
  return AddText(app, "--" + name, help, std::to_string(minimum) + ".." + std::to_string(maximum), parse)
    ->default_str(std::to_string(value));
}

/** The first choice is the default. */
template <typename TEnum>
CLI::Option *
AddEnumeration(CLI::App &                                         app,
               const std::string &                                name,
               const std::string &                                help,
               TEnum &                                            target,
               const std::vector<std::pair<std::string, TEnum>> & choices)
{
  return AddChoice(app, "--" + name, help, CLI::detail::join(ListNames(choices), "|"), target, choices)
    ->default_str(choices.front().first);
}

void
AddObjectParameters(CLI::App & app, ModuleOptions & options)
{
  CLI::Option * const selection = AddEnumeration<ObjectSelection>(app,
                                                                  "objectSelection",
                                                                  "Voxels of the object",
                                                                  options.objectSelection,
                                                                  { { "NonZero", ObjectSelection::NonZero },
                                                                    { "AboveLower", ObjectSelection::AboveLower },
                                                                    { "BelowUpper", ObjectSelection::BelowUpper },
                                                                    { "Between", ObjectSelection::Between },
                                                                    { "Label", ObjectSelection::Label },
                                                                    { "Labels", ObjectSelection::Labels } });
  // Without a selection these would have no effect.
  AddThreshold(
    app, "lowerThreshold", "Smallest value of the object, for AboveLower and Between", options.lowerThreshold)
    ->needs(selection);
  AddThreshold(app, "upperThreshold", "Largest value of the object, for BelowUpper and Between", options.upperThreshold)
    ->needs(selection);
  using Limits = std::numeric_limits<std::int32_t>;
  AddInteger(app,
             "labelValue",
             "The one value of the object, for Label",
             options.labelValue,
             Limits::min(),
             Limits::max(),
             [&options](std::int64_t value) { options.labelValue = value; })
    ->needs(selection);
  AddText(app,
          "--labels",
          "Values or names that are objects, for Labels",
          "LIST",
          [&options](const std::string & text) {
            options.labels = text.empty() ? LabelSelection{ true, {}, {} } : ToLabels(text);
          })
    ->default_str("all");
  AddPath(app, "colorTable", "Names and colors of the labels, for Labels", options.colorTable);
  using Mode = itk::MedialVoxelThicknessMode;
  AddEnumeration<Mode>(app,
                       "thicknessMode",
                       "Thickness of walls that become sheets: their own, or a fixed one",
                       options.thicknessMode,
                       { { "Automatic", Mode::Automatic }, { "Fixed", Mode::Fixed } });
  AddLength(app, "thickness", "The fixed thickness of walls, in the units of the spacing", options.thickness);
  AddEnumeration<std::optional<Smoothing>>(
    app,
    "smoothing",
    "Smooth noise of the object away",
    options.job.smoothing,
    { { "Automatic", std::nullopt }, { "On", Smoothing::On }, { "Off", Smoothing::Off } });
  AddBoolean(app, "voxelUnits", "Take lengths in voxels", options.job.voxelUnits);
  AddBoolean(app, "resample", "Bring the input to its smallest spacing first", options.resample);
  AddInteger(app,
             "maximumPoreSize",
             "Voxels of pores and grains to leave out; -1 for 32 with Automatic and 0 with Fixed",
             -1,
             -1,
             static_cast<std::int64_t>(LargestPoreSize),
             [&options](std::int64_t value) {
               if (value >= 0)
               {
                 options.job.maximumPoreSize = static_cast<std::uint64_t>(value);
               }
             });
}

void
AddPlaceLimits(CLI::App &                   app,
               const std::string &          name,
               const std::string &          help,
               const PlaceKind              kind,
               std::optional<PlaceLimits> & target)
{
  AddText(app, "--" + name, help, "T,G", [&target, kind](const std::string & text) {
    target = text.empty() ? std::nullopt : std::optional<PlaceLimits>(ToPlaceLimits(text, kind));
  })->default_str("");
}

void
AddOutputParameters(CLI::App & app, ModuleOptions & options)
{
  ExtractOptions & job = options.job;
  using Boundary = itk::MedialVoxelBoundary;
  AddPath(app, "objectsVolume", "The label of each cell's object, for Labels", job.objectFile);
  AddPath(app, "vectorVolume", "Vectors to the nearest boundary point", job.vectorFile);
  AddEnumeration<Boundary>(
    app,
    "vectorBoundary",
    "Boundary that the vectors lead to",
    job.vectorBoundary,
    { { GetName(Boundary::Object), Boundary::Object }, { GetName(Boundary::Background), Boundary::Background } });
  AddPath(app, "distanceVolume", "Signed distance, negative inside the object", job.distanceFile);
  AddPath(app, "thicknessMap", "Thickness of the walls at medial cells", job.thicknessFile);
  AddPath(app, "uncertaintyMap", "Half of the 95 % interval of the thickness", job.uncertaintyFile);
  AddPath(app, "localThickness", "Thickness at each object voxel", job.localThicknessFile);
  AddEnumeration<LocalThicknessMethod>(app,
                                       "localThicknessMethod",
                                       "Of walls, or of largest balls",
                                       job.localThicknessMethod,
                                       { { GetName(LocalThicknessMethod::Wall), LocalThicknessMethod::Wall },
                                         { GetName(LocalThicknessMethod::Sphere), LocalThicknessMethod::Sphere } });
  AddText(app, "--maximumLocalThickness", "Largest of these", "T", [&job](const std::string & text) {
    if (!text.empty())
    {
      job.maximumLocalThickness = ToLength(text);
    }
  })->default_str("");
  AddEnumeration<std::optional<bool>>(app,
                                      "subVoxel",
                                      "Measure walls on gray values",
                                      job.subVoxel,
                                      { { "Automatic", std::nullopt }, { "On", true }, { "Off", false } });
  AddText(app, "--levels", "Values of background and material for that", "B,M", [&job](const std::string & text) {
    if (!text.empty())
    {
      job.levels = ToLevels(text);
    }
  })->default_str("");
  AddPlaceLimits(app, "thinBelow", "List places thinner than T, grown to G", PlaceKind::Thin, job.thinBelow);
  AddPlaceLimits(app, "thickAbove", "List places thicker than T, grown to G", PlaceKind::Thick, job.thickAbove);
  AddPath(app, "placesFile", "Table of these places (.csv)", job.placesFile);
  AddPath(app, "meshModel", "Medial surface", job.meshFile);
  AddLength(app, "minimumBranchLength", "Shorter branches are left out of it", job.minimumBranchLength);
  using Kind = ElementSize::Kind;
  AddEnumeration<Kind>(app,
                       "elementSizeMode",
                       "Length of the sides of its elements",
                       options.elementSizeMode,
                       { { "Voxel", Kind::Voxel }, { "Automatic", Kind::Automatic }, { "Fixed", Kind::Length } });
  AddLength(app, "elementSize", "The fixed length, in the units of the spacing", options.elementSize);
  AddBoolean(app, "extendRims", "Carry it on to the free edges of the part", job.extendsRims);
  AddPath(app, "reportFile", "Report as JSON", job.reportFile);
  AddPath(app, "previewFile", "Picture of three slices as PNG", job.previewFile);
}

void
AddRunParameters(CLI::App & app, ExtractOptions & job)
{
  AddInteger(app,
             "numberOfThreads",
             "Number of threads, 0 for one per processor",
             0,
             0,
             MostThreads,
             [&job](std::int64_t value) {
               if (value > 0)
               {
                 job.threads = static_cast<unsigned int>(value);
               }
             });
  AddText(app,
          "--memory",
          "Cap on the memory, such as 500M or 2G; empty for half of the free memory",
          "SIZE",
          [&job](const std::string & text) {
            job.memoryBytes = text.empty() ? std::nullopt : std::optional<std::uint64_t>(ToByteSize(text));
          });
  AddOptionalFile(app, "--scratchFolder", "For what memory cannot hold of a compressed volume", job.scratchFolder)
    ->type_name("DIR");
}

/** What every module for 3D Slicer understands beside its own parameters. */
void
AddCommonParameters(CLI::App & app, ModuleOptions & options)
{
  AddPath(app, "returnparameterfile", "File for counts, percentages and seconds", options.job.returnParameterFile);
  AddText(app,
          "--processinformationaddress",
          "Address of a progress structure; a program has none but 0",
          "ADDRESS",
          [](const std::string & text) {
            if (text != "0")
            {
              throw CLI::ValidationError("'" + text + "' is not 0");
            }
          })
    ->default_str("0");
  AddBoolean(app, "echo", "Print all values before the run", options.echo);
  app.set_version_flag("--version", "MedialVoxelExtraction " + GetVersion());
  app
    .add_flag_callback(
      "--xml",
      [] {
        std::cout << GetEmbeddedXml();
        throw CLI::Success();
      },
      "Print the description for 3D Slicer and exit")
    ->configurable(false);
}

} // namespace

std::unique_ptr<CLI::App>
DefineParameters(ModuleOptions & options)
{
  auto app = std::make_unique<CLI::App>(
    "Extracts the medial voxels of an object in a volume, as a module of 3D Slicer or by itself.",
    "MedialVoxelExtraction");
  AddPositional(*app, "inputVolume", "Volume of gray values or labels", options.job.input);
  AddPositional(*app, "outputVolume", "Labels of the cells between the voxels", options.job.output);
  AddObjectParameters(*app, options);
  AddOutputParameters(*app, options);
  AddRunParameters(*app, options.job);
  AddCommonParameters(*app, options);
  app->footer(
    "What follows -- or --ignore_rest is no option. A boolean is given as --voxelUnits or --voxelUnits=true.\n\n"
    "Labels: 0 no object, 1 not medial, 2 medial by bound, 3 medial by geodesic search.\n"
    "Exit status: 0 done, 1 failure, 2 wrong usage, 3 refused, 4 corrupt input, 130 or 143 stopped by a "
    "signal.\n\n"
    "Example:\n"
    "  MedialVoxelExtraction --objectSelection AboveLower --lowerThreshold 72 part.mha medial.mha");
  return app;
}

void
CompleteJob(const CLI::App & app, ModuleOptions & options)
{
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
