// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SlicerXml.h"

#include "Version.h"

namespace medialvoxel
{
namespace
{

/** Parameters that Slicer shows together. */
struct SlicerGroup
{
  const char * name;
  const char * description;
  bool         isAdvanced;
};

constexpr SlicerGroup Groups[] = {
  { "IO", "Input and output volumes", false },
  { "Object", "Which voxels are the object, and how thick its walls are", false },
  { "Further outputs", "Distances, thickness, medial surface, report and picture", true },
  { "Run", "Resources of the run; they do not change the results", true },
};

/** A number that the module returns. */
struct SlicerResult
{
  const char * name;
  const char * label;
  const char * description;
};

constexpr SlicerResult Results[] = {
  { "objectVoxels", "Voxels of the object", "Number of voxels of the object" },
  { "candidateCells", "Candidate cells", "Number of cells with a corner in the object" },
  { "trivialCells", "Not medial, trivial", "Number of cells whose nearest boundary points are equal or adjacent" },
  { "boundCells", "Medial by bound", "Number of cells of label 2" },
  { "geodesicMedialCells", "Medial by geodesic search", "Number of cells of label 3" },
  { "geodesicNonMedialCells",
    "Not medial by geodesic search",
    "Number of cells that a geodesic search found not medial" },
  { "medialCells", "Medial cells", "Number of cells of the labels 2 and 3" },
  { "pseudoPercent", "Decided without search, percent", "Share of the candidate cells decided without a path search" },
  { "correctPercent", "Decided by search, percent", "Share of the candidate cells decided by a path search" },
  { "distanceSeconds", "Distance, seconds", "Seconds for the distances, summed over the threads" },
  { "classificationSeconds", "Classification, seconds", "Seconds for the classification, summed over the threads" },
  { "totalSeconds", "Total, seconds", "Seconds from start to end" },
};

std::string
Child(const std::string & name, const std::string & text)
{
  return text.empty() ? "" : "      <" + name + ">" + text + "</" + name + ">\n";
}

std::string
Describe(const std::string & indent, const std::string & text)
{
  return indent + "<description><![CDATA[" + text + "]]></description>\n";
}

/** The label of the parameter that an option is; the name of the option where the module has none. */
std::string
GetLabel(const std::string & name)
{
  for (const OptionRow & row : ListOptions())
  {
    if (row.name == name && !row.slicer.label.empty())
    {
      return row.slicer.label;
    }
  }
  return name;
}

/** The text of the manual, with the parameters of the module in place of the options. */
std::string
GetManualText(const OptionRow & row)
{
  std::string text = row.help + ". " + row.details;
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 1))
  {
    const std::size_t length = text.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", at) - at;
    text.replace(at, length, GetLabel(text.substr(at, length)));
  }
  return text.substr(0, text.find_last_not_of(". ") + 1);
}

std::string
BeginGroup(const std::string & name, const std::string & description, bool isAdvanced)
{
  return std::string("  <parameters") + (isAdvanced ? " advanced=\"true\"" : "") + ">\n    <label>" + name +
         "</label>\n" + Describe("    ", description);
}

std::string
MakeParameter(const OptionRow & row, int & numberOfArguments)
{
  const SlicerParameter & parameter = row.slicer;
  const OptionValue       value = GetModuleValue(row);
  const std::string       simple = value.isFlag ? "boolean" : value.choices.empty() ? "string" : "string-enumeration";
  const std::string       element = parameter.element.empty() ? simple : parameter.element;
  const bool              isFile = !parameter.channel.empty();
  std::string             text = "    <" + element + ">\n" + Child("name", parameter.name);
  text += row.IsArgument() ? "" : Child("longflag", parameter.name);
  text += Child("label", parameter.label) + Child("channel", parameter.channel);
  text += row.IsArgument() ? Child("index", std::to_string(numberOfArguments++)) : "";
  text += Describe("      ", parameter.description.empty() ? GetManualText(row) : parameter.description);
  text += isFile ? "" : "      <default>" + value.initial.value_or("") + "</default>\n";
  for (const std::string & choice : value.choices)
  {
    text += Child("element", choice);
  }
  text += parameter.limits.empty() ? "" : "      " + parameter.limits + "\n";
  return text + "    </" + element.substr(0, element.find(' ')) + ">\n";
}

} // namespace

OptionValue
GetModuleValue(const OptionRow & row)
{
  const OptionValue & value = row.slicer.value.set ? row.slicer.value : row.value;
  const bool          isText = !value.isFlag && value.choices.empty() && row.slicer.limits.empty();
  const bool          isNumber = row.slicer.element == "double" || row.slicer.element == "integer";
  return isText && !isNumber && !row.IsArgument() ? OrEmpty(value) : value;
}

std::string
MakeSlicerXml()
{
  std::string text =
    "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
    "<!-- SPDX-FileCopyrightText: MedialVoxel contributors -->\n"
    "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
    "<executable>\n"
    "  <category>Filtering.Morphology</category>\n"
    "  <title>Medial Voxel Extraction</title>\n" +
    Describe(
      "  ",
      "Extracts the medial voxels of an object in a CT volume: the sheet of cells in the middle of its walls. A "
      "cell is medial when the shortest path along the boundary between its two nearest boundary points is at "
      "least pi * thickness / 2 long. Labels: 0 no object, 1 not medial, 2 medial, decided by a bound, 3 medial, "
      "decided by a path search. The color table MedialVoxel.ctbl shows them as nothing, gray, white and red.") +
    "  <version>" + GetVersion() +
    "</version>\n"
    "  <documentation-url>https://github.com/InsightSoftwareConsortium/ITKMedialVoxel/blob/main/doc/getting-started/"
    "slicer.md</documentation-url>\n"
    "  <license>Apache-2.0</license>\n"
    "  <contributor><![CDATA[The MedialVoxel contributors]]></contributor>\n"
    "  <acknowledgements><![CDATA[The method is that of T. Michikawa and H. Suzuki, Efficient Medial Voxel Extraction "
    "for Large Volumetric Models (2012).]]></acknowledgements>\n";
  int numberOfArguments = 0;
  for (const SlicerGroup & group : Groups)
  {
    text += BeginGroup(group.name, group.description, group.isAdvanced);
    for (const OptionRow & row : ListOptions())
    {
      text += !row.slicer.name.empty() && row.slicer.group == group.name ? MakeParameter(row, numberOfArguments) : "";
    }
    text += "  </parameters>\n";
  }
  text +=
    BeginGroup("Results",
               "Counts of voxels and cells by the phase that decided them, percentages as in the paper's Table 1, "
               "seconds",
               false);
  for (const SlicerResult & result : Results)
  {
    text += "    <string>\n" + Child("name", result.name) + Child("label", result.label) + Child("channel", "output") +
            Describe("      ", result.description) + "      <default></default>\n    </string>\n";
  }
  return text + "  </parameters>\n</executable>\n";
}

} // end namespace medialvoxel
