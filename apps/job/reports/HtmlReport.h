// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelHtmlReport_h
#define medialvoxelHtmlReport_h

#include "Json.h"
#include "PageView.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** Pictures of a page. */
struct Pictures
{
  std::string              labels;      ///< PNG
  std::string              thicknesses; ///< PNG; empty: there is none
  std::vector<std::string> sections;    ///< HTML, of the places that the page shows
};

/** The report of an extraction as one page that needs no other file: `page/report.html` filled with the values of the
 * report. Values that depend on the run and the machine stand in its last section. \param command that was typed;
 * empty: unknown */
std::string
MakeHtmlReport(const Json &           report,
               const std::string &    command,
               const Pictures &       pictures,
               const PageSheet &      sheet,
               const VolumeGeometry & geometry);

/** A histogram as SVG, to stand in a page. \param thickness of a report, with cells
 * \param unit text behind the numbers of the axis */
std::string
MakeHistogramSvg(const Json & thickness, const std::string & unit);

} // end namespace medialvoxel

#endif
