// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Parameters.h"

#include "Text.h"

#include <algorithm>
#include <limits>

namespace medialvoxel
{
namespace
{

constexpr unsigned int MostThreads = 128;

Parameter
MakePath(const std::string & name, const std::string & help, std::string & target)
{
  return { name, ParameterKind::Path, help, target, [&target](const std::string & text) { target = text; } };
}

Parameter
MakePositional(const std::string & name, const std::string & help, std::string & target)
{
  Parameter parameter = MakePath(name, help, target);
  parameter.isPositional = true;
  return parameter;
}

Parameter
MakeBoolean(const std::string & name, const std::string & help, bool & target)
{
  return { name, ParameterKind::Boolean, help, "false", [&target](const std::string & text) {
            target = text == "true";
          } };
}

Parameter
MakeDouble(const std::string & name, const std::string & help, double & target)
{
  return { name, ParameterKind::Double, help, FormatNumber(target), [&target](const std::string & text) {
            target = ParseDouble(text).value();
          } };
}

Parameter
MakeInteger(const std::string &                       name,
            const std::string &                       help,
            std::int64_t                              value,
            std::int64_t                              minimum,
            std::int64_t                              maximum,
            const std::function<void(std::int64_t)> & assign)
{
  Parameter parameter{ name, ParameterKind::Integer, help, std::to_string(value), [assign](const std::string & text) {
                        assign(ParseInteger(text).value());
                      } };
  parameter.minimum = minimum;
  parameter.maximum = maximum;
  return parameter;
}

template <typename TEnum>
Parameter
MakeEnumeration(const std::string & name, const std::string & help, TEnum & target, const std::vector<TEnum> & values)
{
  Parameter parameter{ name,
                       ParameterKind::Enumeration,
                       help,
                       GetName(target),
                       [&target, values](const std::string & text) {
                         target = *std::find_if(
                           values.begin(), values.end(), [&text](const TEnum value) { return GetName(value) == text; });
                       } };
  for (const TEnum value : values)
  {
    parameter.elements.push_back(GetName(value));
  }
  return parameter;
}

void
AddObjectParameters(ParameterTable & table, ModuleOptions & options)
{
  using Limits = std::numeric_limits<std::int32_t>;
  table.push_back(MakeEnumeration<ObjectSelection>("objectSelection",
                                                   "Voxels of the object",
                                                   options.objectSelection,
                                                   { ObjectSelection::NonZero,
                                                     ObjectSelection::AboveLower,
                                                     ObjectSelection::BelowUpper,
                                                     ObjectSelection::Between,
                                                     ObjectSelection::Label }));
  table.push_back(
    MakeDouble("lowerThreshold", "Smallest value of the object, for AboveLower and Between", options.lowerThreshold));
  table.push_back(
    MakeDouble("upperThreshold", "Largest value of the object, for BelowUpper and Between", options.upperThreshold));
  table.push_back(MakeInteger("labelValue",
                              "The one value of the object, for Label",
                              options.labelValue,
                              Limits::min(),
                              Limits::max(),
                              [&options](std::int64_t value) { options.labelValue = value; }));
  using Mode = itk::MedialVoxelThicknessMode;
  table.push_back(MakeEnumeration<Mode>("thicknessMode",
                                        "Thickness of walls that become sheets: their own, or a fixed one",
                                        options.thicknessMode,
                                        { Mode::Automatic, Mode::Fixed }));
  table.push_back(
    MakeDouble("thickness", "The fixed thickness of walls, in the units of the spacing", options.thickness));
  table.push_back(MakeBoolean("voxelUnits", "Take lengths in voxels", options.job.voxelUnits));
  table.push_back(MakeBoolean("resample", "Bring the input to its smallest spacing first", options.resample));
  table.push_back(MakeInteger("maximumPoreSize",
                              "Voxels of pores and grains to leave out; -1 for 32 with Automatic and 0 with Fixed",
                              -1,
                              -1,
                              static_cast<std::int64_t>(LargestPoreSize),
                              [&options](std::int64_t value) {
                                options.job.maximumPoreSize.reset();
                                if (value >= 0)
                                {
                                  options.job.maximumPoreSize = static_cast<std::uint64_t>(value);
                                }
                              }));
}

void
AddOutputParameters(ParameterTable & table, ExtractOptions & job)
{
  using Boundary = itk::MedialVoxelBoundary;
  table.push_back(MakePath("vectorVolume", "Vectors to the nearest boundary point", job.vectorFile));
  table.push_back(MakeEnumeration<Boundary>("vectorBoundary",
                                            "Boundary that the vectors lead to",
                                            job.vectorBoundary,
                                            { Boundary::Object, Boundary::Background }));
  table.push_back(MakePath("distanceVolume", "Signed distance, negative inside the object", job.distanceFile));
  table.push_back(MakePath("thicknessMap", "Thickness of the walls at medial cells", job.thicknessFile));
  table.push_back(MakeBoolean("subVoxel", "Measure on gray values, at the thresholds", job.subVoxel));
  table.push_back(MakePath("meshModel", "Medial surface", job.meshFile));
  table.push_back(MakeDouble("minimumBranchLength", "Shorter branches are left out of it", job.minimumBranchLength));
  table.push_back(MakePath("reportFile", "Report as JSON", job.reportFile));
  table.push_back(MakePath("previewFile", "Picture of three slices as PNG", job.previewFile));
}

void
AddRunParameters(ParameterTable & table, ExtractOptions & job)
{
  table.push_back(MakeInteger(
    "numberOfThreads", "Number of threads, 0 for one per processor", 0, 0, MostThreads, [&job](std::int64_t value) {
      job.threads.reset();
      if (value > 0)
      {
        job.threads = static_cast<unsigned int>(value);
      }
    }));
  table.push_back({ "memory",
                    ParameterKind::String,
                    "Cap on the memory, such as 500M or 2G; empty for half of the free memory",
                    "",
                    [&job](const std::string & text) {
                      job.memoryBytes = ParseByteSize(text);
                      if (!job.memoryBytes && !text.empty())
                      {
                        Fail(ExitStatus::Usage, "memory: '", text, "' is not a size such as 500M or 2G");
                      }
                    } });
  table.push_back(
    MakePath("scratchFolder", "Folder for what memory cannot hold of a compressed volume", job.scratchFolder));
}

/** What every module for 3D Slicer understands beside its own parameters. */
void
AddCommonParameters(ParameterTable & table, ModuleOptions & options)
{
  table.push_back(
    MakePath("returnparameterfile", "File for counts, percentages and seconds", options.job.returnParameterFile));
  table.push_back({ "processinformationaddress",
                    ParameterKind::String,
                    "Address of a progress structure; a program has none but 0",
                    "0",
                    [](const std::string & text) {
                      if (text != "0")
                      {
                        Fail(ExitStatus::Usage, "processinformationaddress: '", text, "' is not 0");
                      }
                    } });
  table.push_back(MakeBoolean("echo", "Print all values before the run", options.echo));
}

bool
IsGiven(const ParameterTable & table, const std::string & name)
{
  return std::any_of(table.begin(), table.end(), [&name](const Parameter & parameter) {
    return parameter.name == name && parameter.value;
  });
}

void
CheckInteger(const Parameter & parameter, const std::string & text)
{
  const std::optional<std::int64_t> value = ParseInteger(text);
  if (!value || *value < parameter.minimum || *value > parameter.maximum)
  {
    Fail(ExitStatus::Usage,
         parameter.name,
         ": '",
         text,
         "' is not a whole number from ",
         parameter.minimum,
         " to ",
         parameter.maximum);
  }
}

} // namespace

std::string
GetName(ObjectSelection selection)
{
  switch (selection)
  {
    case ObjectSelection::NonZero:
      return "NonZero";
    case ObjectSelection::AboveLower:
      return "AboveLower";
    case ObjectSelection::BelowUpper:
      return "BelowUpper";
    case ObjectSelection::Between:
      return "Between";
    case ObjectSelection::Label:
      return "Label";
  }
  return "unknown";
}

std::string
GetName(const itk::MedialVoxelThicknessMode mode)
{
  return mode == itk::MedialVoxelThicknessMode::Automatic ? "Automatic" : "Fixed";
}

ParameterTable
DefineParameters(ModuleOptions & options)
{
  ParameterTable table;
  table.push_back(MakePositional("inputVolume", "Volume of gray values or labels", options.job.input));
  table.push_back(MakePositional("outputVolume", "Labels of the cells between the voxels", options.job.output));
  AddObjectParameters(table, options);
  AddOutputParameters(table, options.job);
  AddRunParameters(table, options.job);
  AddCommonParameters(table, options);
  return table;
}

void
SetValue(Parameter & parameter, const std::string & text)
{
  std::string value = text;
  switch (parameter.kind)
  {
    case ParameterKind::Path:
    case ParameterKind::String:
      break;
    case ParameterKind::Boolean:
      value = ToLower(text);
      if (value != "true" && value != "false")
      {
        Fail(ExitStatus::Usage, parameter.name, ": '", text, "' is neither true nor false");
      }
      break;
    case ParameterKind::Integer:
      CheckInteger(parameter, text);
      break;
    case ParameterKind::Double:
      if (!ParseDouble(text))
      {
        Fail(ExitStatus::Usage, parameter.name, ": '", text, "' is not a number");
      }
      break;
    case ParameterKind::Enumeration:
      if (std::find(parameter.elements.begin(), parameter.elements.end(), text) == parameter.elements.end())
      {
        const std::string names = Join(parameter.elements, "|", [](const std::string & element) { return element; });
        Fail(ExitStatus::Usage, parameter.name, ": '", text, "' is not one of ", names);
      }
      break;
  }
  parameter.assign(value);
  parameter.value = value;
}

void
ApplyObjectSelection(const ParameterTable & table, ModuleOptions & options)
{
  if (!IsGiven(table, "objectSelection"))
  {
    for (const char * name : { "lowerThreshold", "upperThreshold", "labelValue" })
    {
      if (IsGiven(table, name))
      {
        Fail(ExitStatus::Usage, name, " is given without objectSelection; it must say which limits hold");
      }
    }
  }
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
}

void
ApplyThickness(const ParameterTable & table, ModuleOptions & options)
{
  const bool isImplied = IsGiven(table, "thickness") && !IsGiven(table, "thicknessMode");
  if (isImplied || options.thicknessMode == itk::MedialVoxelThicknessMode::Fixed)
  {
    options.job.thickness = options.thickness;
  }
  if (options.resample)
  {
    options.job.resample = 0.0;
  }
}

} // end namespace medialvoxel
