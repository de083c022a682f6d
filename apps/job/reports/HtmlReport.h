// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelHtmlReport_h
#define medialvoxelHtmlReport_h

#include "JobResult.h"
#include "Options.h"
#include "PageView.h"

#include <string>
#include <string_view>

namespace medialvoxel
{

/** Pictures as the bytes of PNG files; empty: there is none. */
struct Pictures
{
  std::string labels;
  std::string thicknesses;
};

/** The report of an extraction as one page that needs nothing beside itself: the sheet in a view, picture, phases,
 * histogram of the thickness, parameters, versions, how to cite. What depends on the run and the machine stands in its
 * last section. */
std::string
MakeHtmlReport(const ExtractOptions & options,
               const JobResult &      result,
               const Pictures &       pictures,
               const PageSheet &      sheet);

/** A histogram as SVG, to stand in a page. Empty without cells. \param unit text behind the numbers of the axis */
std::string
MakeHistogramSvg(const ThicknessSummary & thickness, const std::string & unit);

} // end namespace medialvoxel

#endif
