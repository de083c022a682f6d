// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Products.h"

#include "Outputs.h"
#include "ProductRows.h"
#include "Report.h"
#include "ReturnParameters.h"
#include "VolumeFormats.h"
#include "Warnings.h"

#include <algorithm>
#include <type_traits>
#include <utility>

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
    : m_Options(options)
    , m_Request(std::move(request))
  {}

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

  void
  CreateFile(OutputSet & outputs) override
  {
    m_Volume = &outputs.AddVolume(m_Request);
  }

  std::optional<FilledVolume>
  GetVolume() override
  {
    return FilledVolume{ m_Request, *m_Volume };
  }

private:
  const JobOptions & m_Options;
  VolumeRequest      m_Request;
  VoxelOutput *      m_Volume{ nullptr };
};

/** \class ReportProduct
 * \brief Warnings of the result, which is complete but for them, and the report. */
template <typename TOptions>
class ReportProduct : public Product
{
public:
  explicit ReportProduct(const TOptions & options)
    : m_Options(options)
  {}

  static bool
  IsWanted(const TOptions &)
  {
    return true;
  }

  void
  Start(ProductStart & start) override
  {
    m_Survey = start.survey;
  }

  void
  Describe(JobResult & result) override
  {
    const std::vector<Warning> found = this->FindWarnings(result);
    result.warnings.insert(result.warnings.end(), found.begin(), found.end());
  }

private:
  std::vector<Warning>
  FindWarnings(const JobResult & result) const
  {
    if constexpr (std::is_same_v<TOptions, ExtractOptions>)
    {
      return FindWarningsOfResult(m_Options, result, *m_Survey);
    }
    else
    {
      return FindWarningsOfResult(m_Options, result);
    }
  }

  std::string
  GetFileName() const override
  {
    return GetReportFile(m_Options);
  }

  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    return MakeReport(m_Options, result);
  }

  const TOptions & m_Options;
  const Survey *   m_Survey{ nullptr };
};

/** \class ParameterProduct
 * \brief Counts and seconds for 3D Slicer. */
class ParameterProduct : public Product
{
public:
  explicit ParameterProduct(const ExtractOptions & options)
    : m_Options(options)
  {}

  static bool
  IsWanted(const ExtractOptions & options)
  {
    return !options.returnParameterFile.empty();
  }

private:
  std::string
  GetFileName() const override
  {
    return m_Options.returnParameterFile;
  }

  std::optional<std::string>
  MakeText(const JobResult & result) const override
  {
    return MakeReturnParameters(result);
  }

  const ExtractOptions & m_Options;
};

constexpr ProductRow ReportRow = MakeRow<ReportProduct<ExtractOptions>>();
constexpr ProductRow ParameterRow = MakeRow<ParameterProduct>();

template <typename TOptions>
ProductList
MakeVolumes(const TOptions & options, const VolumeHeader & header)
{
  ProductList products;
  for (VolumeRequest & request : ListVolumes(options, header))
  {
    products.push_back(std::make_unique<VolumeProduct>(options, std::move(request)));
  }
  return products;
}

} // namespace

ProductList
MakeProducts(const ExtractOptions & options, const VolumeHeader & header)
{
  ProductList products = MakeVolumes(options, header);
  // Each may use those before it.
  for (const ProductRow * const row :
       { &MeshRow, &StatisticsRow, &PictureRow, &PlaceRow, &PageRow, &ReportRow, &ParameterRow })
  {
    if (row->isWanted(options))
    {
      products.push_back(row->make(options));
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
MakeProducts(const SurfaceOptions & options, const VolumeHeader & header)
{
  ProductList products;
  products.push_back(MakePart(options, header));
  products.push_back(std::make_unique<ReportProduct<SurfaceOptions>>(options));
  return products;
}

} // end namespace medialvoxel
