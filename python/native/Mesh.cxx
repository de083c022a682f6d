// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FilterRun.h"

#include "itkMedialSurfaceMeshFilter.h"

namespace medialvoxel
{
namespace
{

/** Points are as exact as the volume is large. */
using MeshType = itk::Mesh<float, 3, itk::DefaultStaticMeshTraits<float, 3, 3, double>>;

/** Takes the mesh apart, with coordinates in the order of the axes of the array. */
void
CopyMesh(const MeshType & source, ArrayMesh & mesh)
{
  mesh.points.reserve(3 * source.GetNumberOfPoints());
  mesh.thickness.reserve(source.GetNumberOfPoints());
  for (itk::IdentifierType i = 0; i < source.GetNumberOfPoints(); ++i)
  {
    const auto & point = source.GetPoints()->ElementAt(i);
    mesh.points.insert(mesh.points.end(), { point[2], point[1], point[0] });
    mesh.thickness.push_back(source.GetPointData()->ElementAt(i));
  }
  mesh.faces.reserve(static_cast<std::size_t>(mesh.cornersPerFace) * source.GetNumberOfCells());
  for (itk::IdentifierType i = 0; i < source.GetNumberOfCells(); ++i)
  {
    const MeshType::CellType & cell = *source.GetCells()->ElementAt(i);
    mesh.faces.insert(mesh.faces.end(), cell.PointIdsBegin(), cell.PointIdsEnd());
  }
}

template <typename TPixel>
nlohmann::json
MakeMesh(const ArrayCall & call, const ExtractOptions & options, ArrayMesh & mesh)
{
  auto filter = itk::MedialSurfaceMeshFilter<ArrayImage<TPixel>, MeshType>::New();
  filter->SetInput(MakeImage<TPixel>(call.array));
  SetJobOptions(*filter, options);
  SetWalls(*filter, options);
  filter->SetGenerateTriangles(options.meshTriangles);
  filter->SetMinimumBranchLength(options.minimumBranchLength);
  filter->SetSmallestComponent(static_cast<itk::SizeValueType>(options.smallestComponent));
  RunFilter(*filter, call.control);
  mesh.cornersPerFace = options.meshTriangles ? 3 : 4;
  CopyMesh(*filter->GetOutput(), mesh);
  return nlohmann::json::object();
}

} // namespace

nlohmann::json
MeshArray(const ArrayCall & call, const ExtractOptions & options, ArrayMesh & mesh)
{
  return DispatchPixelType(call.header.pixelType,
                           [&](auto zero) { return MakeMesh<decltype(zero)>(call, options, mesh); });
}

} // end namespace medialvoxel
