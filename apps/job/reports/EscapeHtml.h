// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelEscapeHtml_h
#define medialvoxelEscapeHtml_h

#include <string>

namespace medialvoxel
{

/** Text that a page shows as it is. Bytes that are no valid UTF-8 are left to the browser, which replaces them. */
std::string
EscapeHtml(const std::string & text);

} // end namespace medialvoxel

#endif
