// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialSurfaceMeshWriter_hxx
#define itkMedialSurfaceMeshWriter_hxx

#include "itkMedialSurfaceMeshFilter.h"
#include "itkMedialVoxelProgress.h"

#include "itkQuadrilateralCell.h"
#include "itkTriangleCell.h"

#include <array>
#include <vector>

namespace itk
{

/** Puts a surface into a mesh. */
template <typename TInputImage, typename TOutputMesh>
class MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::MeshWriter : public MedialVoxelSurfaceConsumer
{
public:
  MeshWriter(OutputMeshType & mesh, bool asTriangles, bool withMarks)
    : m_Mesh(mesh)
    , m_AsTriangles(asTriangles)
    , m_WithMarks(withMarks)
  {}

  void
  AddVertices(const std::vector<MedialVoxelSurfaceVertex> & vertices) override
  {
    for (const MedialVoxelSurfaceVertex & vertex : vertices)
    {
      m_Checker.Count();
      typename OutputMeshType::PointType point;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        point[axis] = static_cast<typename OutputMeshType::PointType::ValueType>(vertex.point[axis]);
      }
      m_Mesh.SetPoint(m_NumberOfPoints, point);
      m_Mesh.SetPointData(m_NumberOfPoints, static_cast<typename OutputMeshType::PixelType>(vertex.thickness));
      ++m_NumberOfPoints;
    }
  }

  void
  AddQuads(const std::vector<MedialVoxelSurfaceQuad> & quads) override
  {
    for (const MedialVoxelSurfaceQuad & quad : quads)
    {
      m_Checker.Count();
      if (m_AsTriangles)
      {
        this->AddTriangle(quad, 0);
        this->AddTriangle(quad, 1);
      }
      else
      {
        const unsigned int marks = unsigned{ quad.rimSides } | unsigned{ quad.junctionSides } << 4;
        this->AddCell<QuadrilateralCell<CellInterfaceType>>(quad.vertices, quad.GetArea(), marks);
      }
    }
  }

private:
  using CellInterfaceType = typename OutputMeshType::CellType;
  using CellPixelType = typename OutputMeshType::CellPixelType;

  void
  AddTriangle(const MedialVoxelSurfaceQuad & quad, const unsigned int half)
  {
    const auto                   corners = quad.GetTriangle(half);
    std::array<std::uint64_t, 3> vertices;
    unsigned int                 marks = 0;
    for (unsigned int i = 0; i < 3; ++i)
    {
      vertices[i] = quad.vertices[corners[i]];
    }
    for (unsigned int side = 0; side < 2; ++side)
    {
      marks |= ((unsigned{ quad.rimSides } >> corners[side]) & 1u) << side;
      marks |= ((unsigned{ quad.junctionSides } >> corners[side]) & 1u) << (side + 4);
    }
    this->AddCell<TriangleCell<CellInterfaceType>>(vertices, quad.areas[half], marks);
  }

  template <typename TCell, typename TVertices>
  void
  AddCell(const TVertices & vertices, const double area, const unsigned int marks)
  {
    auto * const                             cell = new TCell;
    typename OutputMeshType::CellAutoPointer owner;
    owner.TakeOwnership(cell);
    for (unsigned int i = 0; i < vertices.size(); ++i)
    {
      cell->SetPointId(static_cast<int>(i), static_cast<IdentifierType>(vertices[i]));
    }
    m_Mesh.SetCell(m_NumberOfCells, owner);
    m_Mesh.SetCellData(m_NumberOfCells, static_cast<CellPixelType>(m_WithMarks ? marks : area));
    ++m_NumberOfCells;
  }

  OutputMeshType &        m_Mesh;
  bool                    m_AsTriangles;
  bool                    m_WithMarks;
  IdentifierType          m_NumberOfPoints{ 0 };
  IdentifierType          m_NumberOfCells{ 0 };
  MedialVoxelAbortChecker m_Checker;
};

} // end namespace itk

#endif
