// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPreviewFont_h
#define medialvoxelPreviewFont_h

#include <array>
#include <string>
#include <vector>

namespace medialvoxel
{

constexpr unsigned int GlyphWidth = 5;
constexpr unsigned int GlyphAscent = 7; ///< rows above the line that the text stands on
constexpr unsigned int GlyphHeight = 9;

/** Rows of pixels from the top, true where there is ink. */
using Glyph = std::array<std::array<bool, GlyphWidth>, GlyphHeight>;

/** A glyph for each character of a text in UTF-8. Printable characters of ASCII have their own; all others, and bytes
 * that are no UTF-8, have one that shows that something is there. */
std::vector<Glyph>
MakeGlyphs(const std::string & text);

} // end namespace medialvoxel

#endif
