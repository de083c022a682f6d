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

/** The second picture with its caption. */
std::string
MakeThicknessPicture(const std::string & picture, const std::string & unit)
{
  return picture.empty() ? ""
                         : "<img alt=\"The same views, colored by the thickness\" src=\"data:image/png;base64," +
                             EncodeBase64(picture) +
                             "\">\n<p class=\"muted\">The colors span the 1st to the 99th percentile, in " + unit +
                             "; values outside are clamped. If several cells share a pixel, the thickest is shown. "
                             "Unpaired cells have "
                             "no color.</p>\n";
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
  const bool        hasView = HasView(sheet, geometry);
  const auto        rows = [&](Views view, const char * kind = "text") {
    return [&, view, kind] { return MakeRows(MakeTable(view, report), kind); };
  };
  const std::map<std::string, std::function<std::string()>> parts{
    { "style", [] { return GetPageFile("page.css"); } },
    { "view", [&] { return hasView ? GetPageFile("view.html") : ""; } },
    { "labels", [&] { return EncodeBase64(pictures.labels); } },
    { "thicknesses", [&] { return MakeThicknessPicture(pictures.thicknesses, unit); } },
    { "histogram", [&] { return MakeHistogramSvg(report["thickness"], unit); } },
    { "thickness", rows(PageThickness, "number") },
    { "percentiles", rows(PagePercentiles, "number") },
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
