// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelResultViews_h
#define medialvoxelResultViews_h

#include "Json.h"
#include "Text.h"

#include <string>
#include <vector>

namespace medialvoxel
{

/** Where values of a report are shown. */
enum Views : unsigned int
{
  ExtractTable = 1 << 0, ///< of the terminal
  SurfaceTable = 1 << 1,
  DistanceTable = 1 << 2,
  LongTable = 1 << 10, ///< what it has beside with --phases
  PageInput = 1 << 3,  ///< and further tables of the page
  PageParameters = 1 << 4,
  PageThickness = 1 << 5,
  PageLocalThickness = 1 << 6,
  PageRun = 1 << 7,
  SlicerLines = 1 << 8 ///< that 3D Slicer reads back
};

/** A row of views, which FillIn() fills. */
struct ViewRow
{
  unsigned int views;
  std::string  condition; ///< of the row; empty: it is always there
  std::string  name;
  std::string  value;
  std::string  list{}; ///< pointer to it: the row is there for each member; empty: once
};

/** The lines of the views of a report, in their order. */
const std::vector<ViewRow> &
ListViewRows();

/** Names and values that views show of a report. */
TextTable
MakeTable(unsigned int views, const Json & report);

/** The return parameters of a module of 3D Slicer, a line each. */
std::string
MakeReturnParameters(const Json & report);

/** How the walls were measured. */
extern const char * const MeasureText;

} // end namespace medialvoxel

#endif
