// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProductRows_h
#define medialvoxelProductRows_h

#include "Product.h"

namespace medialvoxel
{

/** A product of an extraction beside its volumes. */
struct ProductRow
{
  bool (*isWanted)(const ExtractOptions &);
  std::unique_ptr<Product> (*make)(const ExtractOptions &);
};

template <typename TProduct>
constexpr ProductRow
MakeRow()
{
  return { TProduct::IsWanted, [](const ExtractOptions & options) {
            return std::unique_ptr<Product>(std::make_unique<TProduct>(options));
          } };
}

// SurveyProducts.cxx
extern const ProductRow StatisticsRow;
extern const ProductRow PictureRow;
extern const ProductRow PlaceRow;
extern const ProductRow PageRow;

// MeshProducts.cxx
extern const ProductRow MeshRow;

std::unique_ptr<Product>
MakePart(const SurfaceOptions & options, const VolumeHeader & header);

} // end namespace medialvoxel

#endif
