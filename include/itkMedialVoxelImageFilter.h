// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilter_h
#define itkMedialVoxelImageFilter_h

#include "itkMedialVoxelImageFilterBase.h"
#include "itkMedialVoxelSameTopology.h"
#include "itkMedialVoxelSheetProperties.h"

#include "itkImage.h"
#include "itkVector.h"

#include <memory>
#include <vector>

namespace itk
{

/** \class MedialVoxelImageFilter
 * \brief Medial voxels of a binary or thresholded image: the one-cell-thin sheet midway between opposite walls.
 *
 * The output labels dual cells. A dual cell is the center of 2^D neighboring voxels. It is stored at the index of its
 * lowest corner, in an image whose origin is shifted by half a voxel along every axis longer than 1. The last index of
 * each such axis has no cell and is always 0. The labels are
 *
 * - 0: no corner of the cell is an object voxel,
 * - 1: non-medial,
 * - 2: medial, decided by the bound,
 * - 3: medial, decided by the geodesic search,
 * - 4: with SameTopology, added for the topology of the object.
 *
 * The pair of a cell is the diagonal whose two nearest boundary points are seen under the widest angle. The cell is
 * medial when the geodesic distance of these points on the boundary is at least epsilon = pi Thickness / 2 (Eq. 1 of
 * the paper). Labels 2 and 3 together are the same cells for the bounds FreeSpace and Off.
 *
 * An image without object is 0 everywhere. In an image without background every cell is 1 and counts as trivial,
 * because the outside of the image is unknown.
 *
 * The filter streams: any requested region gives the same labels as the whole image, for any number of threads.
 * doc/explanation/method.md has the definitions and proofs, doc/explanation/accuracy.md the measured errors.
 *
 * \par Vectors
 * GenerateVectorDistanceOn() adds the output GetVectorDistanceOutput(): at object voxels the displacement to the
 * nearest boundary voxel, zero elsewhere, NaN at object voxels of an image that has no boundary. Its geometry is that
 * of the input. All outputs always have the same requested region.
 *
 * \par Thickness
 * GenerateThicknessOn() adds the output GetThicknessOutput(): at medial cells the thickness of the wall, zero
 * elsewhere. It is negative where the two sides are unpaired: they do not face each other, as at rims. Its geometry is
 * that of the labels. MedialVoxelThickness describes the measurement: walls parallel to an axis are exact, others to a
 * layer of voxels. SubvoxelThicknessOn() measures on the gray values of a scan, see MedialVoxelGrayThickness; masks and
 * label maps are measured on the object.
 *
 * \par Topology
 * SameTopologyOn() adds cells with the label 4. Then the labels 2, 3 and 4 together have as many parts, tunnels and
 * cavities as the object; labels 2 and 3 stay. Two cells are joined when they are neighbors along an axis and one of
 * the voxels around the edge between them is object. Parts without a medial cell keep a line or a cell. Closed pores of
 * up to MaximumPoreSize voxels, joined at faces, are no cavities. An image without background gets no label 4. The
 * filter always updates the whole image then. MedialVoxelThinning has the rule.
 *
 * \par Departures from the paper
 * doc/explanation/method.md gives the reasons.
 * - The boundary consists of background voxels with an object voxel among their 3^D-1 neighbors. Background corners of
 *   a cell are their own nearest boundary point.
 * - The angle of a pair is measured at the center of the cell, where it always exists; ties have a rule.
 * - The default bound is the length of the shortest path in the complete grid, which is proved; Eq. 2 is Paper.
 * - Each slab has a window of all voxels it depends on; nothing is propagated between slabs.
 * - Paths are searched in the box of the ellipsoid with the boundary points as foci, not of its bounding sphere. The
 *   edges of a path are counted by kind and summed in one order.
 * - Pores and dust can be left out, the threshold can be automatic, and any spacing is allowed.
 * - The thickness of walls is measured, on the mask or on gray values; MedialSurfaceMeshFilter makes a surface.
 *
 * \par Reference
 * T. Michikawa, H. Suzuki: Efficient Medial Voxel Extraction for Large Volumetric Models.
 *
 * \sa MedialVoxelObjectsImageFilter, for the objects of a label map
 * \sa VectorDistanceMapImageFilter
 * \ingroup MedialVoxel
 */
template <typename TInputImage, typename TOutputImage = Image<unsigned char, TInputImage::ImageDimension>>
class ITK_TEMPLATE_EXPORT MedialVoxelImageFilter
  : public MedialVoxelSheetProperties<MedialVoxelImageFilterBase<TInputImage, TOutputImage>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialVoxelImageFilter);

  using Self = MedialVoxelImageFilter;
  using Superclass = MedialVoxelSheetProperties<MedialVoxelImageFilterBase<TInputImage, TOutputImage>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(MedialVoxelImageFilter);
#else
  itkTypeMacro(MedialVoxelImageFilter, MedialVoxelImageFilterBase);
#endif

  using Superclass::ImageDimension;
  using InputImageType = TInputImage;
  using OutputImageType = TOutputImage;
  using OutputPixelType = typename OutputImageType::PixelType;
  using typename Superclass::InputPixelType;
  using VectorImageType = Image<Vector<float, ImageDimension>, ImageDimension>;
  using ThicknessImageType = Image<float, ImageDimension>;
  using typename Superclass::SmoothingEnum;
  using BoundaryEnum = MedialVoxelEnums::Boundary;

  /** True when the last update smoothed the object. */
  bool
  GetObjectIsSmoothed() const
  {
    const MedialVoxelObjectInput * const input = this->GetObjectInput();
    return input != nullptr && input->IsSmoothed();
  }

  /** Share of the voxels at the border of the object that stand alone, from 0 to 1, when the last update measured it
   * for the Automatic smoothing; otherwise 0. See MedialVoxelRoughness. */
  double
  GetRoughness() const
  {
    const MedialVoxelObjectInput * const input = this->GetObjectInput();
    return input != nullptr && input->GetRoughness() ? input->GetRoughness()->GetRatio() : 0.0;
  }

  /** The MaximumThickness of the last update in which the default was raised; 0 when it was not. */
  double
  GetRaisedMaximumThickness() const
  {
    return this->GetNeededMaximum().value_or(0.0);
  }

  /** Add cells so that the sheet has the topology of the object. Default off, which costs neither time nor memory. */
  itkSetMacro(SameTopology, bool);
  itkGetConstMacro(SameTopology, bool);
  itkBooleanMacro(SameTopology);

  /** Number of cells that the last update with SameTopology added. */
  SizeValueType
  GetNumberOfAddedCells() const
  {
    return m_NumberOfAddedCells;
  }

  /** Produce the vector distance output. Default off, which costs neither time nor memory. */
  virtual void
  SetGenerateVectorDistance(bool generate);
  itkGetConstMacro(GenerateVectorDistance, bool);
  itkBooleanMacro(GenerateVectorDistance);

  /** Target of the vectors: Object (default; their norm is the distance of SignedMaurerDistanceMapImageFilter inside
   * the object) or Background (the vectors that classify the cells). */
  itkMedialVoxelSetEnumMacro(VectorDistanceBoundary, BoundaryEnum);
  itkGetEnumMacro(VectorDistanceBoundary, BoundaryEnum);

  /** Displacements to the nearest boundary voxel, physical when UseImageSpacing is on (direction cosines applied),
   * otherwise in voxels. Null unless GenerateVectorDistance is on. */
  VectorImageType *
  GetVectorDistanceOutput()
  {
    return dynamic_cast<VectorImageType *>(this->ProcessObject::GetOutput(VectorDistanceName));
  }

  /** Produce the thickness output. Default off, which costs neither time nor memory. */
  virtual void
  SetGenerateThickness(bool generate);
  itkGetConstMacro(GenerateThickness, bool);
  itkBooleanMacro(GenerateThickness);

  /** The scan that the last update with SubvoxelThickness fitted walls with, or the reason why it fitted none. Members
   * in Python: background, material, blur in voxels, noise of a value, all 0 without fits; reason; isMask. */
  MedialVoxelScanResult
  GetScan() const
  {
    return this->GetScanResult();
  }

  /** Produce the uncertainty output. Default off. SubvoxelThickness must be on. */
  virtual void
  SetGenerateUncertainty(bool generate);
  itkGetConstMacro(GenerateUncertainty, bool);
  itkBooleanMacro(GenerateUncertainty);

  /** Half of the interval that holds the thickness in 95 % of the cases, in the units of the thickness; NaN at medial
   * cells where it is not known, zero elsewhere. Null unless GenerateUncertainty is on. */
  ThicknessImageType *
  GetUncertaintyOutput()
  {
    return dynamic_cast<ThicknessImageType *>(this->ProcessObject::GetOutput(UncertaintyName));
  }

  /** Thickness of the walls at medial cells, physical when UseImageSpacing is on, otherwise in voxels; negative where
   * sides are unpaired, zero elsewhere. Null unless GenerateThickness is on. */
  ThicknessImageType *
  GetThicknessOutput()
  {
    return dynamic_cast<ThicknessImageType *>(this->ProcessObject::GetOutput(ThicknessName));
  }

  /** Produce the importance output. Default off. */
  virtual void
  SetGenerateImportance(bool generate);
  itkGetConstMacro(GenerateImportance, bool);
  itkBooleanMacro(GenerateImportance);

  /** Length of the shortest path on the boundary between the two points that decide a cell, physical when
   * UseImageSpacing is on, otherwise in voxels; at most pi / 2 times the largest thickness, zero at trivial cells and
   * where no corner is object. The cells from pi / 2 times a thickness on are the medial cells for this thickness. Null
   * unless GenerateImportance is on. */
  ThicknessImageType *
  GetImportanceOutput()
  {
    return dynamic_cast<ThicknessImageType *>(this->ProcessObject::GetOutput(ImportanceName));
  }

  /** Produce the thresholds of the importance, too. Default off. */
  virtual void
  SetGenerateImportanceThreshold(bool generate);
  itkGetConstMacro(GenerateImportanceThreshold, bool);
  itkBooleanMacro(GenerateImportanceThreshold);

  /** What the importance of a cell is compared with, in its units: medial cells have an importance of at least their
   * threshold, all others a lower one; zero where the importance is zero. Null unless GenerateImportanceThreshold is
   * on. */
  ThicknessImageType *
  GetImportanceThresholdOutput()
  {
    return dynamic_cast<ThicknessImageType *>(this->ProcessObject::GetOutput(ImportanceThresholdName));
  }

  using Superclass::MakeOutput;
  ProcessObject::DataObjectPointer
  MakeOutput(const ProcessObject::DataObjectIdentifierType & name) override;

protected:
  MedialVoxelImageFilter() = default;
  ~MedialVoxelImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() const override;

  void
  GenerateOutputInformation() override;

  void
  EnlargeOutputRequestedRegion(DataObject * output) override;

  MedialVoxelEngineTask
  GetTask(const MedialVoxelGrid & grid) const override;

  void
  TakeTile(const MedialVoxelTileResult & tile) override;

  MedialVoxelSums
  RunRegion(const MedialVoxelBox & region) override;

  std::unique_ptr<MedialVoxelInput>
  MakeInput(MedialVoxelValueSource & source) override;

  SizeValueType m_NumberOfAddedCells{ 0 };

private:
  friend class MedialVoxelFilterAccess;
  template <typename, typename>
  friend class MedialSurfaceMeshFilter;

  static constexpr const char * VectorDistanceName = "VectorDistance";
  static constexpr const char * ThicknessName = "Thickness";
  static constexpr const char * UncertaintyName = "Uncertainty";
  static constexpr const char * ImportanceName = "Importance";
  static constexpr const char * ImportanceThresholdName = "ImportanceThreshold";

  /** Create a named output when it is switched on, remove it when it is switched off. */
  void
  SwitchOutput(bool & isOn, bool generate, const char * name);

  /** Give the label to cells of a slice. */
  void
  LabelAddedCells(const MedialVoxelBits & added);

  bool m_SameTopology{ false };

  std::unique_ptr<MedialVoxelSameTopology> m_Topology; ///< during an update

  bool         m_GenerateVectorDistance{ false };
  BoundaryEnum m_VectorDistanceBoundary{ BoundaryEnum::Object };
  bool         m_GenerateThickness{ false };
  bool         m_GenerateUncertainty{ false };
  bool         m_GenerateImportance{ false };
  bool         m_GenerateImportanceThreshold{ false };

  /** Observers see each tile with its boundary points, and must outlive the updates. Their memory counts for
   * WorkingMemoryLimit. */
  std::vector<MedialVoxelTileObserver *> m_TileObservers;
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMedialVoxelImageFilter.hxx"
#endif

#endif
