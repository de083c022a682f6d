// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFillIn_h
#define medialvoxelFillIn_h

#include "Json.h"

#include <functional>
#include <string>
#include <string_view>

namespace medialvoxel
{

/** Further sources of a page beside the values: adds the part of a name. */
using PageParts = std::function<void(const std::string & name, std::string & page)>;

/** A text with values of a result in its places.
 *
 * `{path}` is the value at a path of keys with dots between, the shortest text of a number; "-" without a value.
 * `{format path...}` is a value or several in a format of the table in FillIn.cxx; `{unit}` is that of lengths.
 * `[condition?text]` is there where the condition holds: `path` for a value that is neither null nor false nor empty,
 * `path>0`, `path=text`, or one of these behind `!`; `a&b` where both hold, `a|b&c` where a or both others do.
 * `[path:text]` is there for each member of a list or object, `[path*20:text]` for 20 of them at most. Paths within
 * begin at the member, or at the result where the member lacks the key; `.` is the member itself, `#` its number from
 * 1, `@` its key, also within lists in it.
 * \throw std::invalid_argument for a format that is not known, and a bracket without its end */
std::string
FillIn(std::string_view text, const Json & result);

/** The same with a member of a list in it, and the key of that. */
std::string
FillIn(std::string_view text, const Json & result, const Json & member, const Json & key);

/** The same for HTML: texts of the result are escaped, and `{part name}` is a part. */
std::string
FillInHtml(std::string_view text, const Json & result, const PageParts & parts);

/** Whether a condition holds. */
bool
Holds(std::string_view condition, const Json & result);

} // end namespace medialvoxel

#endif
