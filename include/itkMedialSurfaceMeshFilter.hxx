// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialSurfaceMeshFilter_hxx
#define itkMedialSurfaceMeshFilter_hxx

#include "itkMedialSurfaceMeshWriter.hxx"
#include "itkMedialSurfaceProgress.h"
#include "itkMedialVoxelGridLimits.h"

#include <algorithm>
#include <cmath>

namespace itk
{

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

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::VerifyPreconditions() const
{
  Superclass::VerifyPreconditions();
  if (!(m_MinimumBranchLength >= 0.0) || !std::isfinite(m_MinimumBranchLength))
  {
    itkExceptionMacro("MinimumBranchLength is " << m_MinimumBranchLength << "; it must not be negative, and finite.");
  }
}

/** Whether the coordinates of the mesh are precise enough for neighboring points. */
template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::VerifyInputInformation() const
{
  Superclass::VerifyInputInformation();
  const auto & input = dynamic_cast<const InputImageType &>(*this->GetPrimaryInput());
  const auto   placement = GetPlacement(input);
  const auto   size = GetSize(input);
  if (sizeof(typename OutputMeshType::PointType::ValueType) < sizeof(double) && !placement.FitsFloat(size))
  {
    itkExceptionMacro("Coordinates of the image reach "
                      << placement.LargestCoordinate(size) << " with spacing " << input.GetSpacing()
                      << ": 32 bits do not keep points apart. Take a mesh of double coordinates.");
  }
}

/** The first region that the label filter requests; it pulls the rest. */
template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GenerateInputRequestedRegion()
{
  m_LabelFilter->SetInput(this->GetInput());
  m_LabelFilter->CopySheetProperties(*this);
  m_LabelFilter->UpdateOutputInformation();
  this->RequestPiece(m_LabelFilter->GetOutput()->GetLargestPossibleRegion().GetIndex(2));
}

template <typename TInputImage, typename TOutputMesh>
SizeValueType
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetSlicesPerPiece() const
{
  // Labels of a piece, which have no reader; larger pieces gain nothing.
  constexpr SizeValueType voxelsPerPiece = SizeValueType{ 1 } << 25;
  const auto &            size = m_LabelFilter->GetOutput()->GetLargestPossibleRegion().GetSize();
  return m_NumberOfSlicesPerPiece > 0 ? m_NumberOfSlicesPerPiece
                                      : std::max<SizeValueType>(1, voxelsPerPiece / (size[0] * size[1]));
}

template <typename TInputImage, typename TOutputMesh>
MedialVoxelSurfacePlacement
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::GetPlacement(const InputImageType & image)
{
  MedialVoxelSurfacePlacement        placement;
  typename InputImageType::PointType origin;
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

  MedialVoxelSurface::Settings settings;
  std::copy_n(input.GetSpacing().Begin(), 3, settings.spacing.begin());
  settings.grid = { GetSize(input),
                    this->GetUseImageSpacing() ? settings.spacing : MedialVoxelGrid::SpacingType{ { 1.0, 1.0, 1.0 } } };
  // Tiles classified before have no observer.
  m_LabelFilter->Modified();
  this->WatchLabelFilter([] { return 0.0f; },
                         [this] { MedialVoxelWithItkErrors([this] { m_LabelFilter->PrepareInput(); }); });
  settings.parameters = this->GetParameters(settings.grid, m_LabelFilter->GetNeededMaximum());
  settings.placement = GetPlacement(input);
  settings.minimumBranchLength = m_MinimumBranchLength;
  settings.smallestComponent = m_SmallestComponent;
  MeshWriter         writer(mesh, m_GenerateTriangles, m_MarkSides);
  MedialVoxelSurface surface(settings, writer);
  m_LabelFilter->m_TileObservers = { &surface.GetObserver() };
  MedialSurfaceProgress          progress(*this);
  const MedialVoxelProgressScope scope(progress);
  try
  {
    this->RunPieces();
    m_LabelFilter->m_TileObservers.clear();
    MedialVoxelWithItkErrors([&surface] { surface.Finish(); });
  }
  catch (...)
  {
    m_LabelFilter->m_TileObservers.clear();
    mesh.Initialize();
    throw;
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
  const auto getDone = [&] {
    const float done = static_cast<float>(slice - begin) + m_LabelFilter->GetProgress() * static_cast<float>(slices);
    return std::min(1.0f, done / static_cast<float>(end - begin));
  };
  this->WatchLabelFilter(getDone, [&] {
    for (; slice < end; slice += slices)
    {
      this->RequestPiece(slice);
      // Not Update(), which would have the input produce its first part again.
      labels.UpdateOutputData();
    }
  });
}

template <typename TInputImage, typename TOutputMesh>
template <typename TGetDone, typename TRun>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::WatchLabelFilter(const TGetDone & getDone, const TRun & run)
{
  const auto onProgress = [&](const EventObject &) {
    this->UpdateProgress(getDone());
    if (this->GetAbortGenerateData())
    {
      m_LabelFilter->AbortGenerateDataOn();
    }
  };
  const unsigned long tag = m_LabelFilter->AddObserver(ProgressEvent(), onProgress);
  try
  {
    run();
  }
  catch (...)
  {
    m_LabelFilter->RemoveObserver(tag);
    m_LabelFilter->GetOutput()->ReleaseData();
    throw;
  }
  m_LabelFilter->RemoveObserver(tag);
  m_LabelFilter->GetOutput()->ReleaseData();
}

template <typename TInputImage, typename TOutputMesh>
void
MedialSurfaceMeshFilter<TInputImage, TOutputMesh>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfSlicesPerPiece: " << m_NumberOfSlicesPerPiece << std::endl;
  os << indent << "GenerateTriangles: " << (m_GenerateTriangles ? "On" : "Off") << std::endl;
  os << indent << "MarkSides: " << (m_MarkSides ? "On" : "Off") << std::endl;
  os << indent << "MinimumBranchLength: " << m_MinimumBranchLength << std::endl;
  os << indent << "SmallestComponent: " << m_SmallestComponent << std::endl;
  itkPrintSelfObjectMacro(LabelFilter);
}

} // end namespace itk

#endif
