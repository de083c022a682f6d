// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelProducts_h
#define medialvoxelProducts_h

#include "Product.h"

namespace medialvoxel
{

/** A product of an extraction beside its volumes. */
struct ProductRow
{
  std::string ExtractOptions::* file; ///< null: it writes none
  std::unique_ptr<Product> (*make)(const ExtractOptions &, std::string fileName);

  bool (*isWantedAnyway)(const ExtractOptions &){ [](const ExtractOptions &) { return false; } };

  bool
  IsWanted(const ExtractOptions & options) const
  {
    return (file != nullptr && !(options.*file).empty()) || isWantedAnyway(options);
  }
};

/** \class ExtractProduct
 * \brief One that rows make. */
class ExtractProduct : public Product
{
public:
  ExtractProduct(const ExtractOptions & options, std::string fileName)
    : Product(std::move(fileName))
    , m_Options(options)
  {}

protected:
  const ExtractOptions & m_Options;
};

template <typename TProduct>
std::unique_ptr<Product>
Make(const ExtractOptions & options, std::string fileName)
{
  return std::make_unique<TProduct>(options, std::move(fileName));
}

// Defined in SurveyProducts.cxx, MeshProducts.cxx and WallProducts.cxx.
extern const ProductRow StatisticsRow, PlaceRow, PictureRow, PageRow, MeshRow, WallRow, WallTableRow, SeamTableRow;

std::unique_ptr<Product>
MakePart(const PartOptions & options, const VolumeHeader & header);

/** The products that the options ask for: the volumes of Outputs.cxx, labels first, and the rows of Products.cxx.
 * \param options must outlive them; values measured before the start may be set later */
ProductList
MakeProducts(const ExtractOptions & options, const VolumeHeader & header);
ProductList
MakeProducts(const DistanceOptions & options, const VolumeHeader & header);
ProductList
MakeProducts(const PartOptions & options, const VolumeHeader & header);

} // end namespace medialvoxel

#endif
