// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Outputs.h"
#include "PartSurface.h"
#include "Products.h"
#include "RimRays.h"
#include "ScanMeasure.h"
#include "SheetMesh.h"
#include "ThreadedTasks.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** \class MeshProduct
 * \brief The medial mesh. */
class MeshProduct : public ExtractProduct
{
public:
  using ExtractProduct::ExtractProduct;

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    footprint.Add(SheetMesh::GetFootprint(m_Options, header.geometry, footprint.grid));
    footprint.needsSlices = true;
  }

  double
  GetShareOfEnd() const override
  {
    return SheetMesh::IsRemeshed(m_Options) ? 0.5 : 0.0;
  }

  void
  Start(ProductStart & start) override
  {
    const VolumeHeader & header = start.job.input;
    m_Mesh = std::make_unique<SheetMesh>(m_Options,
                                         header.geometry,
                                         GetGrid(header),
                                         start.job.plan.GetSurplusShare(),
                                         [](const std::size_t count, const auto & task) { RunInThreads(count, task); });
    m_Links.observer = &m_Mesh->GetObserver();
    m_Links.mesh = m_Mesh.get();
    start.mesh = m_Mesh.get();
  }

  void
  Complete(JobResult & result, const ProductEnd & end) override
  {
    // Objects of a label map touch, which rays do not see.
    if (!m_Options.labels)
    {
      const auto range = GetGrayRange(result.wallMeasure.value(), m_Options, result.input);
      const auto rays = std::make_shared<RimRays>(end.input->GetInput(), result.input.geometry, range);
      m_Mesh->FindEdgesWith([rays](const itk::MedialVoxelRimRays & bundle) { return rays->Measure(bundle); });
    }
    const JobPlan &     plan = result.plan;
    const std::uint64_t memory = plan.memory.limit - std::min(plan.memory.limit, plan.memory.fixed);
    result.surface = m_Mesh->Write(*m_File, memory, plan.threads, end.progress);
    result.seconds.remeshing = result.surface->remeshingSeconds;
    result.seconds.walls += result.surface->wallSeconds;
  }

private:
  std::unique_ptr<SheetMesh> m_Mesh;
};

/** \class PartProduct
 * \brief The surface of the part, which takes the map of the thickness in place of a file. */
class PartProduct : public Product
{
public:
  PartProduct(const PartOptions & options, const VolumeHeader & header)
    : Product(options.output)
    , m_Options(options)
    , m_Map(ListVolumes(GetThicknessOptions(options), header).front())
  {}

  void
  AddTo(Footprint & footprint, const VolumeHeader & header) const override
  {
    footprint.engines.front().perVoxel += m_Map.layout.GetBytes();
    footprint.Add(PartSurface::GetFootprint(m_Options, header));
    footprint.readsInput = true;
  }

  void
  Start(ProductStart & start) override
  {
    m_Surface = std::make_unique<PartSurface>(m_Options, start.job.input, start.input->GetInput());
    m_Links.request = &m_Map;
    m_Links.volume = &m_Surface->GetMap();
  }

  void
  UseMeasure(const WallMeasure & measure) override
  {
    if (measure.usesGrayValues)
    {
      m_Surface->UseGrayValues();
    }
  }

  void
  Complete(JobResult & result, const ProductEnd & end) override
  {
    result.part = m_Surface->Write(*m_File, end.progress);
    if (m_Options.localThicknessMethod == LocalThicknessMethod::Sphere)
    {
      result.wallMeasure = WallMeasure{ false, std::nullopt, "largest balls are those of its voxels" };
    }
  }

private:
  const PartOptions &          m_Options;
  VolumeRequest                m_Map;
  std::unique_ptr<PartSurface> m_Surface;
};

} // namespace

const ProductRow MeshRow{ &ExtractOptions::meshFile, Make<MeshProduct> };

std::unique_ptr<Product>
MakePart(const PartOptions & options, const VolumeHeader & header)
{
  return std::make_unique<PartProduct>(options, header);
}

} // end namespace medialvoxel
