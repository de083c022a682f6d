// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialSurfaceMeshFilter_h
#define itkMedialSurfaceMeshFilter_h

#include "itkMedialVoxelImageFilter.h"
#include "itkMedialVoxelSurface.h"

#include "itkImageToMeshFilter.h"
#include "itkMesh.h"

#include <algorithm>

namespace itk
{

/** \class MedialSurfaceMeshFilter
 * \brief The medial surface of a binary or thresholded 3-D image as a mesh of quadrilaterals or triangles, with the
 * thickness of the walls.
 *
 * The surface is dual to the voxels: an edge between two neighboring voxels of which at least one is object is crossed
 * when their nearest boundary points are at least epsilon = pi Thickness / 2 apart along the boundary, as in
 * MedialVoxelImageFilter. A crossed edge has one quadrilateral, which joins the four dual cells around it. A cell has a
 * vertex for each connected part of the surface in it, where the planes midway between the boundary points of its edges
 * meet best. Single quadrilaterals that hang at a side of others, or touch them at a corner alone, are left out
 * (MedialVoxelSurfaceTrimmer), so that the surface is a manifold away from junctions. Five steps of smoothing
 * follow, in which rims and junctions of sheets keep to themselves and all vertices to the middle of their wall. As
 * edges and cells are shared, the surface has no cracks: it ends at rims and at the faces of the image, and more than
 * two quadrilaterals meet at junctions.
 *
 * Points are physical, with spacing, origin and direction applied. The data of a point is the thickness of the wall in
 * physical units, of MedialVoxelThickness at medial cells; other cells, which rims and junctions use, measure it
 * between their two nearest boundary points. The data of a cell is its area, or with MarkSides a number whose bits mark
 * the sides that are rims and junctions.
 *
 * Points are in the order of their dual cells (z, y, x) and, in one, of their lowest edges, cells in the order of the
 * lower voxels of their edges and of the axes (x, y, z). Quadrilaterals begin at their lowest dual cell and are
 * oriented so that their normal has a component along the direction (1, sqrt 2, sqrt 3) that is not negative: neighbors
 * agree but where the surface turns its edge to that direction. Surfaces with junctions, or with one side only, have no
 * common orientation. The mesh does not depend on threads or on the division of the work.
 *
 * An image in which an axis has a single voxel has no surface: the mesh is empty.
 *
 * \par Coordinates
 * Mesh<float, 3> and Mesh<double, 3> have coordinates of 32 bits. An image whose coordinates reach more than about
 * 16000 times its smallest spacing needs 64, or points would move by more than a thousandth of it: the filter throws.
 * A mesh with the traits DefaultStaticMeshTraits<float, 3, 3, double> has them.
 *
 * \par Units and gray values
 * Points of the mesh and thicknesses of walls are physical in any case; UseImageSpacing does the same for Thickness and
 * the nearest boundary points. SubvoxelThickness moves the boundary points to where values cross the threshold, see
 * MedialVoxelGrayBoundary, for the points of the mesh and for the thickness.
 *
 * \par Memory
 * Beside the mesh, the memory of MedialVoxelImageFilter for a piece of the image; the input is pulled part by part.
 *
 * \par QuadEdgeMesh
 * QuadEdgeMesh holds oriented manifolds only. A surface whose cells have no junction sides can be copied to one, cell
 * by cell, after its cells were given a common orientation.
 *
 * \sa MedialVoxelImageFilter
 * \ingroup MedialVoxel
 */
template <typename TInputImage, typename TOutputMesh = Mesh<float, 3>>
class ITK_TEMPLATE_EXPORT MedialSurfaceMeshFilter
  : public MedialVoxelSheetProperties<MedialVoxelObjectProperties<ImageToMeshFilter<TInputImage, TOutputMesh>>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialSurfaceMeshFilter);

  using Self = MedialSurfaceMeshFilter;
  using Superclass =
    MedialVoxelSheetProperties<MedialVoxelObjectProperties<ImageToMeshFilter<TInputImage, TOutputMesh>>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(MedialSurfaceMeshFilter);
#else
  itkTypeMacro(MedialSurfaceMeshFilter, ImageToMeshFilter);
#endif

  using InputImageType = TInputImage;
  using OutputMeshType = TOutputMesh;
  static_assert(InputImageType::ImageDimension == 3 && OutputMeshType::PointDimension == 3, "Surfaces are in 3-D.");

  /** Whether the object of the last update is that of smoothed values. */
  bool
  GetObjectIsSmoothed() const
  {
    return m_LabelFilter->GetObjectIsSmoothed();
  }

  /** The scan that the last update with SubvoxelThickness fitted walls with, as in MedialVoxelImageFilter. */
  MedialVoxelScanResult
  GetScan() const
  {
    return m_LabelFilter->GetScan();
  }

  /** Slices of the image that are processed at a time; 0 (default) chooses. Has no influence on the mesh. */
  itkSetMacro(NumberOfSlicesPerPiece, unsigned int);
  itkGetConstMacro(NumberOfSlicesPerPiece, unsigned int);

  /** Split each quadrilateral along its shorter diagonal, that from its first vertex when both are as long. Default
   * off. */
  itkSetMacro(GenerateTriangles, bool);
  itkGetConstMacro(GenerateTriangles, bool);
  itkBooleanMacro(GenerateTriangles);

  /** Have marks of the sides as data of the cells instead of areas: bit k (value 2^k) for a side from vertex k to the
   * next that belongs to this face alone, bit k + 4 for one of more than two. The diagonal of a split quadrilateral has
   * no mark. Default off. */
  itkSetMacro(MarkSides, bool);
  itkGetConstMacro(MarkSides, bool);
  itkBooleanMacro(MarkSides);

  /** Remove branches (MedialVoxelSurfaceBranches) of the surface that are shorter than this, in physical units. 0
   * (default) keeps all; must be finite and not negative. Nothing else changes but the numbers of the points and the
   * marks of sides where a branch was. Takes the memory of the surface a second time. */
  itkSetMacro(MinimumBranchLength, double);
  itkGetConstMacro(MinimumBranchLength, double);

  /** Remove connected components of fewer quadrilaterals than this. 0 (default) and 1 keep all. Nothing else changes
   * but the numbers of the points. Branches are removed first. */
  itkSetMacro(SmallestComponent, SizeValueType);
  itkGetConstMacro(SmallestComponent, SizeValueType);

protected:
  MedialSurfaceMeshFilter() = default;
  ~MedialSurfaceMeshFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() const override;

  void
  VerifyInputInformation() const override;

  void
  GenerateInputRequestedRegion() override;

  void
  GenerateData() override;

private:
  using LabelFilterType = MedialVoxelImageFilter<InputImageType>;
  using LabelImageType = typename LabelFilterType::OutputImageType;

  class MeshWriter;

  SizeValueType
  GetSlicesPerPiece() const;

  /** Has the pieces classified one after the other. */
  void
  RunPieces();

  /** Call run(), in which the label filter works, and report its progress from getDone(). */
  template <typename TGetDone, typename TRun>
  void
  WatchLabelFilter(const TGetDone & getDone, const TRun & run);

  void
  RequestPiece(IndexValueType firstSlice);

  static MedialVoxelIndex
  GetSize(const InputImageType & image)
  {
    MedialVoxelIndex size;
    std::copy_n(image.GetLargestPossibleRegion().GetSize().begin(), 3, size.begin());
    return size;
  }

  static MedialVoxelSurfacePlacement
  GetPlacement(const InputImageType & image);

  /** Classifies the cells; the labels themselves are of no use. */
  typename LabelFilterType::Pointer m_LabelFilter = LabelFilterType::New();
  unsigned int                      m_NumberOfSlicesPerPiece{ 0 };
  bool                              m_GenerateTriangles{ false };
  bool                              m_MarkSides{ false };
  double                            m_MinimumBranchLength{ 0.0 };
  SizeValueType                     m_SmallestComponent{ 0 };
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMedialSurfaceMeshFilter.hxx"
#endif

#endif
