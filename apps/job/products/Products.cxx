// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Products.h"

#include "ObjectTopologyProduct.h"
#include "Outputs.h"
#include "Report.h"
#include "ResultViews.h"
#include "TopologyProduct.h"
#include "VolumeFormats.h"
#include "Warnings.h"

#include <algorithm>
#include <optional>
#include <type_traits>

namespace medialvoxel
{
namespace
{

/** \class VolumeProduct
 * \brief A volume with values for each voxel or cell, as a row of Outputs.cxx has it. */
class VolumeProduct : public Product
{
public:
  VolumeProduct(const JobOptions & options, VolumeRequest request)
    : Product({})
    , m_Options(options)
    , m_Request(std::move(request))
  {
    m_Links.request = &m_Request;
  }

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    const std::string & name = m_Request.fileName;
    const VoxelLayout & layout = m_Request.layout;
    for (EngineFootprint & engine : footprint.engines)
    {
      engine.perVoxel += engine.filler == m_Request.filler ? layout.GetBytes() : 0;
    }
    footprint.beside += GetOutputMemory(name, header.geometry, layout, m_Options);
    footprint.slicesOfLayer = std::max(footprint.slicesOfLayer, GetSlicesOfLayer(name, header.geometry, layout));
    footprint.rowsOfLayer = std::min(footprint.rowsOfLayer, GetRowsOfLayer(name, header.geometry, layout));
  }

  void
  Start(ProductStart & start) override
  {
    m_Request.layout.segments = m_Request.filler == VolumeFiller::Objects ? &start.job.segments : nullptr;
  }

private:
  const JobOptions & m_Options;
  VolumeRequest      m_Request;
};

/** \class ReportProduct
 * \brief Warnings of the result, which is complete but for them, and the report that all texts are made of. */
template <typename TOptions>
class ReportProduct : public Product
{
public:
  explicit ReportProduct(const TOptions & options)
    : Product(GetReportFile(options))
    , m_Options(options)
  {}

  void
  Start(ProductStart & start) override
  {
    m_Survey = start.survey;
  }

  void
  Describe(JobResult & result) override
  {
    std::vector<Warning> found;
    if constexpr (std::is_same_v<TOptions, ExtractOptions>)
    {
      found = FindWarningsOfResult(m_Options, result, *m_Survey);
    }
    else
    {
      found = FindWarningsOfResult(m_Options, result);
    }
    result.warnings.insert(result.warnings.end(), found.begin(), found.end());
    result.report = MakeReport(m_Options, result);
  }

private:
  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    return FormatReport(result.report);
  }

  const TOptions & m_Options;
  const Survey *   m_Survey{ nullptr };
};

/** \class ParameterProduct
 * \brief Counts and seconds for 3D Slicer. */
class ParameterProduct : public ExtractProduct
{
  using ExtractProduct::ExtractProduct;

  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    return MakeReturnParameters(result.report);
  }
};

const ProductRow ReportRow{ &ExtractOptions::reportFile,
                            [](const ExtractOptions & options, std::string) -> std::unique_ptr<Product> {
                              return std::make_unique<ReportProduct<ExtractOptions>>(options);
                            },
                            [](const ExtractOptions &) { return true; } };

const ProductRow ParameterRow{ &ExtractOptions::returnParameterFile, Make<ParameterProduct> };

template <typename TOptions>
ProductList
MakeVolumes(const TOptions & options, const VolumeHeader & header)
{
  ProductList products;
  for (VolumeRequest & request : ListVolumes(options, header))
  {
    if (request.filler != VolumeFiller::Product)
    {
      products.push_back(std::make_unique<VolumeProduct>(options, std::move(request)));
    }
  }
  return products;
}

/** The topology is completed at the end, which makes the labels, and with several objects the map of them. */
void
ReplaceLabels(ProductList & products, const ExtractOptions & options, const VolumeHeader & header)
{
  const std::vector<VolumeRequest> volumes = ListVolumes(options, header);
  if (!options.labels)
  {
    products.front() = std::make_unique<TopologyProduct>(options, volumes.front());
    return;
  }
  const bool hasObjects = !options.objectFile.empty();
  products.front() = std::make_unique<ObjectTopologyProduct>(
    options, volumes.front(), hasObjects ? std::make_optional(volumes[1]) : std::nullopt);
  products.erase(products.begin() + 1, products.begin() + (hasObjects ? 2 : 1));
}

/** Labels that pictures are drawn of, which nobody asked for. */
std::unique_ptr<Product>
MakeDrawnLabels(const ExtractOptions & options, const VolumeHeader & header)
{
  const std::string & file = options.previewFile.empty() ? options.htmlFile : options.previewFile;
  ExtractOptions      drawn;
  drawn.output = file + ".labels.mha";
  VolumeRequest request = ListVolumes(drawn, header).front();
  request.isPublished = false;
  return std::make_unique<VolumeProduct>(options, std::move(request));
}

} // namespace

ProductList
MakeProducts(const ExtractOptions & options, const VolumeHeader & header)
{
  ProductList products = MakeVolumes(options, header);
  if (options.sameTopology)
  {
    ReplaceLabels(products, options, header);
  }
  if (options.output.empty() && PictureRow.IsWanted(options))
  {
    products.push_back(MakeDrawnLabels(options, header));
  }
  // Each may use the previous ones.
  for (const ProductRow * const row : { &MeshRow,
                                        &StatisticsRow,
                                        &PictureRow,
                                        &PlaceRow,
                                        &PageRow,
                                        &WallRow,
                                        &WallTableRow,
                                        &SeamTableRow,
                                        &ReportRow,
                                        &ParameterRow })
  {
    if (row->IsWanted(options))
    {
      products.push_back(row->make(options, row->file != nullptr ? options.*row->file : ""));
    }
  }
  return products;
}

ProductList
MakeProducts(const DistanceOptions & options, const VolumeHeader & header)
{
  ProductList products = MakeVolumes(options, header);
  products.push_back(std::make_unique<ReportProduct<DistanceOptions>>(options));
  return products;
}

ProductList
MakeProducts(const PartOptions & options, const VolumeHeader & header)
{
  ProductList products;
  products.push_back(MakePart(options, header));
  products.push_back(std::make_unique<ReportProduct<PartOptions>>(options));
  return products;
}

} // end namespace medialvoxel
