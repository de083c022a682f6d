// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelEmbeddedXml_h
#define medialvoxelEmbeddedXml_h

#include <string_view>

namespace medialvoxel
{

/** The bytes of MedialVoxelExtraction.xml. */
std::string_view
GetEmbeddedXml();

} // end namespace medialvoxel

#endif
