// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OptionTable.h"

#include "FormatNames.h"
#include "SlicerElements.h"
#include "Text.h"

#include <algorithm>
#include <sstream>

namespace medialvoxel
{
namespace
{

using namespace Commands;

std::string
JoinWords(const std::vector<std::string> & words, const char * separator)
{
  return Join(words, separator, [](const std::string & word) { return word; });
}

OptionValue
Slices()
{
  return Value<JobOptions>(
    [](JobOptions & options, const std::string & text) {
      const std::optional<std::vector<ClusterRange>> ranges = ParseClusters(text);
      if (!ranges || ranges->size() != 1)
      {
        throw WrongValue("'" + text + "' is not a range such as 20-40, of whole numbers from 0 on");
      }
      options.slices.range = { ranges->front().first, ranges->front().last };
    },
    [](const JobOptions & options) {
      const std::vector<std::uint64_t> & range = options.slices.range;
      return range.empty() ? std::nullopt
                           : std::optional<std::string>(std::to_string(range[0]) + "-" + std::to_string(range[1]));
    });
}

OptionValue
Series()
{
  return Value<JobOptions>(
    [](JobOptions & options, const std::string & text) {
      if (text.empty())
      {
        throw WrongValue("'' is not the UID of a series");
      }
      options.slices.series = text;
    },
    [](const JobOptions & options) {
      const std::string & series = options.slices.series;
      return series.empty() ? std::nullopt : std::optional<std::string>(series);
    });
}

OptionValue
Spacing()
{
  return Value<JobOptions>(
    [](JobOptions & options, const std::string & text) {
      options.spacing.clear();
      for (const std::string & part : SplitAtCommas(text))
      {
        options.spacing.push_back(ToSpacing(part));
      }
    },
    [](const JobOptions & options) {
      return options.spacing.empty() ? std::nullopt : std::optional<std::string>(FormatNumbers(options.spacing, ","));
    });
}

OptionValue
Resampling()
{
  return Value(
    &JobOptions::resample,
    [](const std::string & text) {
      const std::string word = ToLower(text);
      return word == AutomaticSpacing ? 0.0 : word == UnchangedSpacing ? KeepSpacing : ToSpacing(text, ", auto or off");
    },
    [](double spacing) {
      return spacing == 0.0 ? AutomaticSpacing : spacing == KeepSpacing ? UnchangedSpacing : FormatNumber(spacing);
    });
}

/** An option of a headerless file; the first one creates its description. */
OptionValue
OfRaw(void (*set)(RawDescription &, const std::string &), std::optional<std::string> (*get)(const RawDescription &))
{
  return Value<JobOptions>(
    [set](JobOptions & options, const std::string & text) {
      set(options.raw ? *options.raw : options.raw.emplace(), text);
    },
    [get](const JobOptions & options) { return options.raw ? get(*options.raw) : std::nullopt; });
}

void
SetRawSize(RawDescription & raw, const std::string & text)
{
  std::string numbers = ToLower(text); // 256x256x110, as the program prints it, is the same as 256,256,110
  std::replace(numbers.begin(), numbers.end(), 'x', ',');
  const std::vector<std::string> parts = SplitAtCommas(numbers);
  if (parts.size() < 2 || parts.size() > 3)
  {
    throw WrongValue("'" + text + "' has " + std::to_string(parts.size()) + " values; it must have 2 or 3");
  }
  raw.size.clear();
  for (const std::string & part : parts)
  {
    raw.size.push_back(ToCount(part, 1, LargestCount));
  }
}

std::optional<std::string>
GetRawSize(const RawDescription & raw)
{
  return Join(raw.size, ",", [](std::uint64_t length) { return std::to_string(length); });
}

/** TYPE, and perhaps :BYTES and :big behind it. */
void
SetRawType(RawDescription & raw, const std::vector<std::string> & names, const std::string & text)
{
  std::istringstream stream(text);
  std::string        word;
  std::getline(stream, word, ':');
  raw.pixelType = *PixelTypeFromName(names[FindChoice(names, word)]);
  raw.headerSize = 0;
  raw.bigEndian = false;
  bool hasNext = static_cast<bool>(std::getline(stream, word, ':'));
  if (hasNext && ToLower(word) != "big")
  {
    raw.headerSize = ToCount(word, 0, LargestCount);
    hasNext = static_cast<bool>(std::getline(stream, word, ':'));
  }
  raw.bigEndian = hasNext && ToLower(word) == "big";
  if (hasNext != raw.bigEndian || !stream.eof() || text.back() == ':')
  {
    throw WrongValue("'" + text + "' is not a type, or a type as in uint16:512, uint16:big or uint16:512:big");
  }
}

std::optional<std::string>
GetRawType(const RawDescription & raw)
{
  return std::string(GetTraits(raw.pixelType).name) + (raw.headerSize > 0 ? ":" + std::to_string(raw.headerSize) : "") +
         (raw.bigEndian ? ":big" : "");
}

OptionValue
RawType()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PixelTypeTraits & traits : PixelTypes)
    {
      all.emplace_back(traits.name);
    }
    return all;
  }();
  OptionValue value =
    OfRaw([](RawDescription & raw, const std::string & text) { SetRawType(raw, names, text); }, GetRawType);
  value.choices = names;
  return value;
}

/** A threshold, or otsu, which measures it. A measured one stands in its place. */
OptionValue
LowerThreshold()
{
  return Value<JobOptions>(
    [](JobOptions & options, const std::string & text) {
      options.lowerIsOtsu = ToLower(text) == "otsu";
      options.lowerThreshold =
        options.lowerIsOtsu ? std::nullopt : std::optional<itk::MedialVoxelExactNumber>(ToLimit(text, " or otsu"));
    },
    [](const JobOptions & options) {
      return options.lowerThreshold ? options.lowerThreshold->Format()
             : options.lowerIsOtsu  ? std::optional<std::string>("otsu")
                                    : std::nullopt;
    });
}

OptionValue
UpperThreshold()
{
  return Value(
    &JobOptions::upperThreshold,
    [](const std::string & text) { return ToLimit(text); },
    [](const itk::MedialVoxelExactNumber & limit) { return limit.Format(); });
}

OptionValue
ModuleThreshold(double ModuleOptions::* member)
{
  return Value(member, [](const std::string & text) { return ToLimit(text).GetNearestDouble(); }, FormatNumber);
}

OptionValue
ModuleLabel()
{
  using Limits = std::numeric_limits<std::int32_t>;
  return Value(
    &ModuleOptions::labelValue,
    [](const std::string & text) { return ToInteger(text, Limits::min(), Limits::max()); },
    [](std::int64_t label) { return std::to_string(label); });
}

bool
SeparatesObjects(const ExtractOptions & options)
{
  return options.labels.has_value();
}

void
AddInput(std::vector<OptionRow> & rows)
{
  AddRow(rows, "INPUT", "FILE", File(&JobOptions::input))
    .OfJobs(Volumes)
    .Help("DICOM folder, " + JoinWords(ListInputFormats(), " "),
          "A file, a folder of slices (DICOM, TIFF, PNG, JPEG or BMP), or a pattern of their names such as "
          "'scan/*.png'.")
    .Slicer({ "IO",
              "inputVolume",
              "Input volume",
              "Volume of one value per voxel, gray values or labels, or a segmentation whose segments do not overlap",
              SlicerImage("any", ".nrrd,.nhdr,.mha,.mhd,.nii,.nii.gz,.tif,.tiff"),
              "input" });
}

void
AddVolume(std::vector<OptionRow> & rows)
{
  const std::string group = "Input";
  AddRow(rows, "--slices", "RANGE", Slices())
    .OfJobs(Volumes, group)
    .Help(
      "FIRST-LAST, of a folder or pattern of slices",
      "Counted from 0 in the order of the slices; of a pattern with %d the numbers in the names. Both belong to the "
      "volume.");
  // Not shown, as the message that lists the series says it.
  AddRow(rows, "--series", "UID", Series())
    .OfJobs(Volumes, group)
    .Hidden()
    .Help("The DICOM series of a folder that has several");
  AddRow(rows, "--spacing", "X,Y,Z", Spacing())
    .OfJobs(Volumes, group)
    .Help("Spacing, instead of that of the file",
          "Default: that of the file, or 1. From 1e-12 to 1e12; the largest at most 1000 times the smallest.");
  // More than any volume has: each has half the size of the one before.
  constexpr std::uint64_t largestLevel = 64;
  AddRow(rows, "--resolution", "N", Count(&JobOptions::level, 0, largestLevel))
    .OfJobs(Volumes, group)
    .HiddenIn(Volumes & ~Info)
    .Help("Of an image with several sizes; 0 (default): largest",
          "Needs an OME-Zarr image with so many levels. Each has about half the size of the one before.");
  AddRow(rows, "--resample", "S", Resampling())
    .OfJobs(Volumes, group)
    .Hidden()
    .Help("Resample to the spacing S, auto (smallest) or off",
          "The input is brought to this spacing while it is read. Values between voxels are linear with a threshold; "
          "without one, or with one value for both, the nearest voxel counts. Default: auto for sheets and thickness "
          "where the largest spacing is more than 4 times the smallest, otherwise off.")
    .Slicer(
      { "IO",
        "resample",
        "Resample to equal spacing",
        "Resample the input to its smallest spacing while it is read. Use it if slices are more than 4 times as far "
        "apart as pixels: otherwise sheets have holes and the thickness is wrong. The outputs have the new spacing",
        "",
        "",
        Flag(&ModuleOptions::resample) });
}

void
AddRaw(std::vector<OptionRow> & rows)
{
  const std::string group = "Input";
  AddRow(rows, "--raw-size", "X,Y,Z", OfRaw(SetRawSize, GetRawSize))
    .OfJobs(Volumes, group)
    .Help("Voxels along each axis",
          "2 or 3 numbers, x first, as 256,256,110 or 256x256x110. The file must have exactly this size.")
    .Requires("--raw-type");
  AddRow(rows, "--raw-type", "TYPE", RawType())
    .OfJobs(Volumes, group)
    .Help("Type of the voxels",
          "uint16:512: behind a header of 512 bytes. uint16:big: the first byte of a voxel is the most significant. "
          "uint16:512:big: both.")
    .Requires("--raw-size");
}

void
AddObject(std::vector<OptionRow> & rows)
{
  const std::string group = "Object";
  using Selection = ObjectSelection;
  AddRow(rows, "", "", {})
    .Slicer({ group,
              "objectSelection",
              "Object",
              "Voxels of the object: NonZero, all values but 0; AboveLower, from the lower threshold up; BelowUpper, "
              "up to the "
              "upper threshold; Between, from the lower to the upper threshold; Label, the label value only; Labels, "
              "each of the "
              "labels is an object of its own",
              "",
              "",
              Choice<ModuleOptions, Selection>(&ModuleOptions::objectSelection,
                                               { { "NonZero", Selection::NonZero },
                                                 { "AboveLower", Selection::AboveLower },
                                                 { "BelowUpper", Selection::BelowUpper },
                                                 { "Between", Selection::Between },
                                                 { "Label", Selection::Label },
                                                 { "Labels", Selection::Labels } }) });
  AddRow(rows, "--lower", "L", LowerThreshold())
    .OfJobs(Runs)
    .Help(
      "Smallest value, or otsu (default: all but 0)",
      "Values of at least L are object. Whole numbers of 64 bits are exact. otsu measures L on the values, which reads "
      "the volume once more, or twice for more than 16 bits.")
    .Python(Extract | Mesh | Distance | Surface)
    .Slicer({ group,
              "lowerThreshold",
              "Lower threshold",
              "Smallest value of the object, used by AboveLower and Between",
              "double",
              "",
              ModuleThreshold(&ModuleOptions::lowerThreshold),
              "",
              true });
  AddRow(rows, "--upper", "U", UpperThreshold())
    .OfJobs(Runs)
    .Help("Largest value of the object", "Values of at most U are object.")
    .Python(Extract | Mesh | Distance | Surface)
    .Slicer({ group,
              "upperThreshold",
              "Upper threshold",
              "Largest value of the object, used by BelowUpper and Between",
              "double",
              "",
              ModuleThreshold(&ModuleOptions::upperThreshold),
              "",
              true });
  AddRow(rows, "--label", "N", Value(&JobOptions::label, ToLabel, FormatLabel))
    .OfJobs(Runs)
    .Help("The one value of the object, as in a label map", "From -2^63 to 2^64 - 1. Not with --lower and --upper.")
    .Python(Extract | Mesh | Distance | Surface)
    .Slicer({ group,
              "labelValue",
              "Label value",
              "The one value of the object, used by Label",
              "integer",
              "",
              ModuleLabel(),
              "",
              true });
}

void
AddObjects(std::vector<OptionRow> & rows)
{
  const std::string group = "Object";
  OptionValue       moduleLabels = OrEmpty(Value(&ModuleOptions::labels, ToLabels, FormatLabels));
  AddRow(rows, "--labels", "LIST", Value(&ExtractOptions::labels, ToLabels, FormatLabels))
    .Of(Extractions)
    .RefusedIn(Plan)
    .Help(
      "Each value is an object: all, or L1,L2,...",
      "Objects that touch are kept apart, and each has a row in the report. all: every value but 0, at most 65535, and "
      "at most 128 side by side. L1: a value, or the name of a segment. Labels of cells are those of runs with one "
      "--label at a time, put together.")
    .Python(Extract)
    .Slicer(
      { group,
        "labels",
        "Labels",
        "Values or names of segments that are objects, used by Labels, with commas between them; all is every value "
        "but 0",
        "",
        "",
        moduleLabels });
  AddRow(rows, "--segments", "FILE", File(&ExtractOptions::segmentFile))
    .Of(Extractions)
    .Hidden()
    .RefusedIn(Plan)
    .Help(
      "Names and colors of labels (.ctbl, .csv, .nrrd)",
      "A color table of 3D Slicer (.ctbl, .txt, .csv, .tsv) or a segmentation (.nrrd, .nhdr). Default: names of the "
      "input, where it is a segmentation.")
    .Needs("--labels", SeparatesObjects)
    .Slicer({ group,
              "colorTable",
              "Names of the labels",
              "Color table with names and colors of the labels, used by Labels. A segmentation has its own",
              "table type=\"color\" fileExtensions=\".ctbl\"",
              "input",
              OrEmpty(File(&ModuleOptions::colorTable)) });
  AddRow(rows, "--values", "", Flag(&ProgramOptions::showsValues))
    .Of(Info)
    .Help("Read the values: range, mean, percentiles, Otsu",
          "Reads the volume once, or twice for values of more than 16 bits.");
  AddRow(rows, "--labels", "", Flag(&ProgramOptions::showsLabels))
    .Of(Info)
    .Help("Read a label map: objects, and passes for all of them");
}

} // namespace

void
AddInputRows(std::vector<OptionRow> & rows)
{
  AddInput(rows);
  AddObject(rows);
  AddObjects(rows);
}

void
AddVolumeRows(std::vector<OptionRow> & rows)
{
  AddVolume(rows);
  AddRaw(rows);
}

} // end namespace medialvoxel
