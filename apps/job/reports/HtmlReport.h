// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelHtmlReport_h
#define medialvoxelHtmlReport_h

#include "Json.h"
#include "PageView.h"

#include <string>

namespace medialvoxel
{

/** Pictures as the bytes of PNG files; empty: there is none. */
struct Pictures
{
  std::string labels;
  std::string thicknesses;
};

/** The report of an extraction as one page that needs nothing beside itself: `page/report.html` with the values of the
 * report. What depends on the run and the machine stands in its last section. \param command that was typed; empty: it
 * is not known */
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
