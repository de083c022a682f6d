// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialSurfaceMeshFilter_hxx
#define itkMedialSurfaceMeshFilter_hxx

#include "itkMedialVoxelSurfaceObserver.h"
#include "itkMedialVoxelSurfacePieces.h"

#include "itkQuadrilateralCell.h"
#include "itkTriangleCell.h"

#include <algorithm>
#include <array>

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
      typename OutputMeshType::PointType point;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        point[axis] = static_cast<typename OutputMeshType::CoordRepType>(vertex.point[axis]);
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

  OutputMeshType & m_Mesh;
  bool             m_AsTriangles;
  bool             m_WithMarks;
  IdentifierType   m_NumberOfPoints{ 0 };
  IdentifierType   m_NumberOfCells{ 0 };
};

/** Keeps a surface until it is known which pieces of it are large enough. */
template <typename TInputImage, typename TOutputMesh>
class MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::PieceFilter : public MedialVoxelSurfaceConsumer
{
public:
  void
  AddVertices(const std::vector<MedialVoxelSurfaceVertex> & vertices) override
  {
    m_Pieces.AddVertices(vertices.size());
    m_Vertices.insert(m_Vertices.end(), vertices.begin(), vertices.end());
  }

  void
  AddQuads(const std::vector<MedialVoxelSurfaceQuad> & quads) override
  {
    for (const MedialVoxelSurfaceQuad & quad : quads)
    {
      m_Pieces.AddQuad(quad.vertices);
    }
    m_Quads.insert(m_Quads.end(), quads.begin(), quads.end());
  }

  void
  HandOn(const SizeValueType smallest, MedialVoxelSurfaceConsumer & consumer)
  {
    m_Pieces.Keep(smallest);
    std::vector<MedialVoxelSurfaceVertex> vertices;
    for (std::size_t i = 0; i < m_Vertices.size(); ++i)
    {
      if (m_Pieces.IsKept(i))
      {
        vertices.push_back(m_Vertices[i]);
      }
    }
    std::vector<MedialVoxelSurfaceQuad> quads;
    for (MedialVoxelSurfaceQuad & quad : m_Quads)
    {
      if (m_Pieces.IsKept(quad.vertices[0]))
      {
        for (std::uint64_t & vertex : quad.vertices)
        {
          vertex = m_Pieces.NumberOf(vertex);
        }
        quads.push_back(quad);
      }
    }
    consumer.AddVertices(vertices);
    consumer.AddQuads(quads);
  }

private:
  MedialVoxelSurfacePieces              m_Pieces;
  std::vector<MedialVoxelSurfaceVertex> m_Vertices;
  std::vector<MedialVoxelSurfaceQuad>   m_Quads;
};

template <typename TInputImage, typename TOutputMesh>
template <typename TFunction>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::Change(TFunction && function)
{
  const ModifiedTimeType before = m_LabelFilter->GetMTime();
  function(*m_LabelFilter);
  if (m_LabelFilter->GetMTime() != before)
  {
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetThicknessMode(const ThicknessModeEnum mode)
{
  this->Change([=](LabelFilterType & filter) { filter.SetThicknessMode(mode); });
}

template <typename TInputImage, typename TOutputMesh>
auto
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetThicknessMode() const -> ThicknessModeEnum
{
  return m_LabelFilter->GetThicknessMode();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetMinimumThickness(const double thickness)
{
  this->Change([=](LabelFilterType & filter) { filter.SetMinimumThickness(thickness); });
}

template <typename TInputImage, typename TOutputMesh>
double
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetMinimumThickness() const
{
  return m_LabelFilter->GetMinimumThickness();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetMaximumThickness(const double thickness)
{
  this->Change([=](LabelFilterType & filter) { filter.SetMaximumThickness(thickness); });
}

template <typename TInputImage, typename TOutputMesh>
double
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetMaximumThickness() const
{
  return m_LabelFilter->GetMaximumThickness();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetMaximumPoreSize(const SizeValueType numberOfVoxels)
{
  this->Change([=](LabelFilterType & filter) { filter.SetMaximumPoreSize(numberOfVoxels); });
}

template <typename TInputImage, typename TOutputMesh>
SizeValueType
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetMaximumPoreSize() const
{
  return m_LabelFilter->GetMaximumPoreSize();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::UnsetMaximumPoreSize()
{
  this->Change([](LabelFilterType & filter) { filter.UnsetMaximumPoreSize(); });
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetThickness(const double thickness)
{
  this->Change([=](LabelFilterType & filter) { filter.SetThickness(thickness); });
}

template <typename TInputImage, typename TOutputMesh>
double
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetThickness() const
{
  return m_LabelFilter->GetThickness();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetBackgroundValue(const InputPixelType value)
{
  this->Change([=](LabelFilterType & filter) { filter.SetBackgroundValue(value); });
}

template <typename TInputImage, typename TOutputMesh>
auto
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetBackgroundValue() const -> InputPixelType
{
  return m_LabelFilter->GetBackgroundValue();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetLowerThreshold(const double threshold)
{
  this->Change([=](LabelFilterType & filter) { filter.SetLowerThreshold(threshold); });
}

template <typename TInputImage, typename TOutputMesh>
double
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetLowerThreshold() const
{
  return m_LabelFilter->GetLowerThreshold();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetUpperThreshold(const double threshold)
{
  this->Change([=](LabelFilterType & filter) { filter.SetUpperThreshold(threshold); });
}

template <typename TInputImage, typename TOutputMesh>
double
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetUpperThreshold() const
{
  return m_LabelFilter->GetUpperThreshold();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::UnsetThresholds()
{
  this->Change([](LabelFilterType & filter) { filter.UnsetThresholds(); });
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetUseImageSpacing(const bool use)
{
  this->Change([=](LabelFilterType & filter) { filter.SetUseImageSpacing(use); });
}

template <typename TInputImage, typename TOutputMesh>
bool
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetUseImageSpacing() const
{
  return m_LabelFilter->GetUseImageSpacing();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::SetWorkingMemoryLimit(const SizeValueType bytes)
{
  this->Change([=](LabelFilterType & filter) { filter.SetWorkingMemoryLimit(bytes); });
}

template <typename TInputImage, typename TOutputMesh>
SizeValueType
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetWorkingMemoryLimit() const
{
  return m_LabelFilter->GetWorkingMemoryLimit();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::RequestPiece(const IndexValueType firstSlice)
{
  LabelImageType & labels = *m_LabelFilter->GetOutput();
  auto             region = labels.GetLargestPossibleRegion();
  const auto       end = region.GetIndex(2) + static_cast<IndexValueType>(region.GetSize(2));
  region.SetIndex(2, firstSlice);
  region.SetSize(2, std::min(this->GetSlicesPerPiece(), static_cast<SizeValueType>(end - firstSlice)));
  labels.SetRequestedRegion(region);
  labels.PropagateRequestedRegion();
}

/** What the label filter asks for to begin with; it pulls the rest. */
template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GenerateInputRequestedRegion()
{
  m_LabelFilter->SetInput(this->GetInput());
  m_LabelFilter->UpdateOutputInformation();
  this->RequestPiece(m_LabelFilter->GetOutput()->GetLargestPossibleRegion().GetIndex(2));
}

template <typename TInputImage, typename TOutputMesh>
SizeValueType
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetSlicesPerPiece() const
{
  // Labels of a piece, which nobody reads; larger ones gain nothing.
  constexpr SizeValueType voxelsPerPiece = SizeValueType{ 1 } << 25;
  const auto &            size = m_LabelFilter->GetOutput()->GetLargestPossibleRegion().GetSize();
  return m_NumberOfSlicesPerPiece > 0 ? m_NumberOfSlicesPerPiece
                                      : std::max<SizeValueType>(1, voxelsPerPiece / (size[0] * size[1]));
}

template <typename TInputImage, typename TOutputMesh>
MedialVoxelParameters
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetParameters(const MedialVoxelGrid & grid) const
{
  constexpr auto bound = MedialVoxelPseudoGeodesicBound::FreeSpace;
  if (this->GetThicknessMode() == ThicknessModeEnum::Fixed)
  {
    return MedialVoxelParameters::ForThickness(this->GetThickness(), bound);
  }
  const auto limits =
    MedialVoxelParameters::LimitsOfWalls(grid, this->GetMinimumThickness(), this->GetMaximumThickness());
  return MedialVoxelParameters::ForWalls(limits.minimum, limits.maximum, bound);
}

template <typename TInputImage, typename TOutputMesh>
MedialVoxelSurfaceBuilder::Placement
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetPlacement(const InputImageType & image)
{
  MedialVoxelSurfaceBuilder::Placement placement;
  typename InputImageType::PointType   origin;
  image.TransformIndexToPhysicalPoint(image.GetLargestPossibleRegion().GetIndex(), origin);
  for (unsigned int component = 0; component < 3; ++component)
  {
    placement.origin[component] = origin[component];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      placement.steps[axis][component] = image.GetDirection()[component][axis] * image.GetSpacing()[axis];
    }
  }
  return placement;
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GenerateData()
{
  const InputImageType & input = *this->GetInput();
  OutputMeshType &       mesh = *this->GetOutput();
  mesh.Initialize();
  mesh.SetPoints(OutputMeshType::PointsContainer::New());
  mesh.SetPointData(OutputMeshType::PointDataContainer::New());
  mesh.SetCells(OutputMeshType::CellsContainer::New());
  mesh.SetCellData(OutputMeshType::CellDataContainer::New());

  MedialVoxelIndex             size;
  MedialVoxelGrid::SpacingType spacing;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<std::int64_t>(input.GetLargestPossibleRegion().GetSize(axis));
    spacing[axis] = input.GetSpacing()[axis];
  }
  const MedialVoxelGrid        grid(size,
                             this->GetUseImageSpacing() ? spacing : MedialVoxelGrid::SpacingType{ { 1.0, 1.0, 1.0 } });
  MeshWriter                   writer(mesh, m_GenerateTriangles, m_MarkSides);
  PieceFilter                  pieces;
  const bool                   keepsAll = m_SmallestPiece <= 1;
  MedialVoxelSurfaceConsumer & consumer = keepsAll ? static_cast<MedialVoxelSurfaceConsumer &>(writer) : pieces;
  MedialVoxelSurfaceObserver   observer(grid, this->GetParameters(grid), spacing, GetPlacement(input), consumer);

  m_LabelFilter->SetTileObserver(&observer);
  try
  {
    this->RunPieces();
  }
  catch (...)
  {
    m_LabelFilter->SetTileObserver(nullptr);
    mesh.Initialize();
    throw;
  }
  m_LabelFilter->SetTileObserver(nullptr);
  observer.Finish();
  if (!keepsAll)
  {
    pieces.HandOn(m_SmallestPiece, writer);
  }
  this->UpdateProgress(1.0f);
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::RunPieces()
{
  LabelImageType &     labels = *m_LabelFilter->GetOutput();
  const auto &         region = labels.GetLargestPossibleRegion();
  const IndexValueType begin = region.GetIndex(2);
  const IndexValueType end = begin + static_cast<IndexValueType>(region.GetSize(2));
  const IndexValueType slices = static_cast<IndexValueType>(this->GetSlicesPerPiece());
  IndexValueType       slice = begin;

  m_LabelFilter->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  // What was classified before has no observer any more.
  m_LabelFilter->Modified();
  const auto onProgress = [&](const EventObject &) {
    const float done = static_cast<float>(slice - begin) + m_LabelFilter->GetProgress() * static_cast<float>(slices);
    this->UpdateProgress(std::min(1.0f, done / static_cast<float>(end - begin)));
    if (this->GetAbortGenerateData())
    {
      m_LabelFilter->AbortGenerateDataOn();
    }
  };
  const unsigned long tag = m_LabelFilter->AddObserver(ProgressEvent(), onProgress);
  try
  {
    for (; slice < end; slice += slices)
    {
      this->RequestPiece(slice);
      // Not Update(), which would have the input produce its first piece again.
      labels.UpdateOutputData();
    }
  }
  catch (...)
  {
    m_LabelFilter->RemoveObserver(tag);
    labels.ReleaseData();
    throw;
  }
  m_LabelFilter->RemoveObserver(tag);
  labels.ReleaseData();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfSlicesPerPiece: " << m_NumberOfSlicesPerPiece << std::endl;
  os << indent << "GenerateTriangles: " << (m_GenerateTriangles ? "On" : "Off") << std::endl;
  os << indent << "MarkSides: " << (m_MarkSides ? "On" : "Off") << std::endl;
  os << indent << "SmallestPiece: " << m_SmallestPiece << std::endl;
  itkPrintSelfObjectMacro(LabelFilter);
}

} // end namespace itk

#endif
