// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProducts_h
#define medialvoxelProducts_h

#include "Product.h"

namespace medialvoxel
{

/** What the options ask for: the volumes of Outputs.cxx, the labels first, and the rows of Products.cxx.
 * \param options must outlive them; what is measured before the start may be set later */
ProductList
MakeProducts(const ExtractOptions & options, const VolumeHeader & header);
ProductList
MakeProducts(const DistanceOptions & options, const VolumeHeader & header);
ProductList
MakeProducts(const SurfaceOptions & options, const VolumeHeader & header);

} // end namespace medialvoxel

#endif
