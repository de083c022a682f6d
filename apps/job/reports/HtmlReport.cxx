// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HtmlReport.h"

#include "EscapeHtml.h"
#include "FillIn.h"
#include "PageText.h"
#include "PageView.h"
#include "ResultViews.h"
#include "Text.h"

#include <functional>
#include <map>

namespace medialvoxel
{
namespace
{

std::string
MakeRows(const TextTable & table, const char * kind)
{
  std::string rows;
  for (const auto & [name, value] : table)
  {
    rows += "<tr><th scope=\"row\">" + EscapeHtml(name) + "</th><td class=\"" + kind + "\">" + EscapeHtml(value) +
            "</td></tr>\n";
  }
  return "<table>\n" + rows + "</table>\n";
}

std::string
DescribeColors(const ColorRange & colors, const std::string & unit)
{
  return "The colors span " + FormatShort(colors.low) + " to " + FormatShort(colors.high) + ", in " + unit +
         "; values outside are clamped. If several cells share a pixel, the thickest is shown. Unpaired cells have no "
         "color.";
}

TextTable
DescribeRun(const Json & report, const std::string & command)
{
  TextTable       table{ { "ended", GetTime() }, { "command", command.empty() ? "not known" : command } };
  const TextTable rows = MakeTable(PageRun, report);
  table.insert(table.end(), rows.begin(), rows.end());
  return table;
}

} // namespace

std::string
MakeHtmlReport(const Json &           report,
               const std::string &    command,
               const Pictures &       pictures,
               const PageSheet &      sheet,
               const VolumeGeometry & geometry)
{
  const std::string unit = FillIn("{unit}", report);
  std::size_t       section = 0;
  const bool        hasView = HasView(sheet, geometry);
  const auto        rows = [&](Views view, const char * kind = "text") {
    return [&, view, kind] { return MakeRows(MakeTable(view, report), kind); };
  };
  const std::map<std::string, std::function<std::string()>> parts{
    { "style", [] { return GetPageFile("page.css"); } },
    { "view", [&] { return hasView ? GetPageFile("view.html") : ""; } },
    { "picture", [&] { return EncodeBase64(pictures.thicknesses.empty() ? pictures.labels : pictures.thicknesses); } },
    { "caption", [&] { return pictures.thicknesses.empty() ? "" : DescribeColors(sheet.colors, unit); } },
    { "section", [&] { return pictures.sections.at(section++); } },
    { "histogram", [&] { return MakeHistogramSvg(report["thickness"], unit); } },
    { "thickness", rows(PageThickness, "number") },
    { "measure", [&] { return EscapeHtml(FillIn(MeasureText, report)); } },
    { "local_thickness", rows(PageLocalThickness) },
    { "input", rows(PageInput) },
    { "parameters", rows(PageParameters) },
    { "run", [&] { return MakeRows(DescribeRun(report, command), "text"); } },
  };
  const std::string text = GetPageFile("report.html");
  return FillInHtml(text.substr(text.find("<!DOCTYPE")), report, [&](const std::string & name, std::string & page) {
    if (name != "scripts")
    {
      page += parts.at(name)();
    }
    else if (hasView)
    {
      AddPageScripts(page, sheet, geometry, unit);
    }
  });
}

} // end namespace medialvoxel
