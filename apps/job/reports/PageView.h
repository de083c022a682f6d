// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPageView_h
#define medialvoxelPageView_h

#include "ColorRange.h"
#include "SheetSurvey.h"
#include "VolumeHeader.h"

#include <cstdint>
#include <string>
#include <vector>

namespace medialvoxel
{

/** The content of the view of a page. */
struct PageSheet
{
  const SheetSurvey * sheet{ nullptr }; ///< null: nothing
  ColorRange          colors{ 0.0, 1.0 };

  std::vector<std::uint32_t> walls{}; ///< numbers of the points; empty: they were not found
};

/** Whether the build has put a viewer library into the program. */
bool
HasPageViewer();

/** Whether a page has the view: with a viewer, points, and three dimensions. */
bool
HasView(const PageSheet & shown, const VolumeGeometry & geometry);

/** Adds the points and the scripts of the view of a page, which shows them where the browser has WebGL. The bytes of
 * the points are, by z, y, x of their blocks: the increase of the block number; for blocks of several voxels a byte
 * for each axis, the mean position of the cells in the block in 256ths; the mean thickness and 2, or 0 when all
 * cells are unpaired, 1 when none is measured; the thickness of the largest importance, where it was found; the
 * smallest number of a wall of the cells, or 0, where walls were found. Those of the part are runs of blocks, x
 * fastest, with an equal share of object: the share in 15ths, and 16 for each block after the first. Numbers are seven
 * bits to a byte, low ones first.
 * \param unit of the lengths, for a reader */
void
AddPageScripts(std::string & page, const PageSheet & shown, const VolumeGeometry & geometry, const std::string & unit);

/** Memory of the text, also while the page grows. \param numbers that points have, of the importance and the wall */
std::uint64_t
GetPageViewMemory(const VolumeGeometry & geometry, unsigned int numbers);

} // end namespace medialvoxel

#endif
