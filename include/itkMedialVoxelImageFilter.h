// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilter_h
#define itkMedialVoxelImageFilter_h

#include "itkMedialVoxelImageFilterBase.h"

#include "itkImage.h"
#include "itkVector.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
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
 * - 3: medial, decided by the geodesic search.
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
 * \par Automatic thickness
 * With ThicknessMode Automatic each cell p has a threshold of its own,
 * epsilon(p) = max(pi MinimumThickness / 2, 3 min(LT(p), MaximumThickness / 2)), where LT(p) is the radius of the
 * largest inscribed ball that covers p. MedialVoxelLocalThreshold defines it. Walls from MinimumThickness to
 * MaximumThickness then become one sheet each, without branches. A larger MinimumThickness or MaximumThickness never
 * adds medial cells.
 *
 * \par Smoothing
 * With the Smoothing On, the values are smoothed before they are compared with the threshold. When there are two
 * thresholds, an ObjectValue or none of them, the mask is. Walls from 2 voxels on and edges stay in place;
 * MedialVoxelSmoothingNumbers has the definition. Automatic smooths when the object is rough.
 *
 * \par Pores and dust
 * With MaximumPoreSize K, each connected component of the background of at most K voxels becomes object first. Then
 * each component of the object of at most K voxels becomes background. Everything else refers to this object. Voxels
 * are connected when they differ by at most 1 along each axis. A component that touches a face of the image stays,
 * because it may continue outside. NaN counts as background here too.
 *
 * \par Vectors
 * GenerateVectorDistanceOn() adds the output GetVectorDistanceOutput(): at object voxels the displacement to the
 * nearest boundary voxel, zero elsewhere, NaN at object voxels of an image that has no boundary. Its geometry is that
 * of the input. All outputs always have the same requested region.
 *
 * \par Thickness
 * GenerateThicknessOn() adds the output GetThicknessOutput(): at medial cells the thickness of the wall, at rims the
 * negative of the measured value, zero elsewhere. Its geometry is that of the labels. MedialVoxelThickness describes
 * the measurement: walls parallel to an axis are exact, others to a layer of voxels. SubvoxelThicknessOn() measures on
 * the gray values of a scan, see MedialVoxelGrayThickness; masks and label maps are measured on the object.
 *
 * \par Objects
 * SeparateObjectsOn() takes each value of a label map but 0 for an object of its own; SetObjectLabels() chooses some.
 * The boundary of an object is every voxel that is not in it, so that objects that touch stay apart. The result is that
 * of updates with one ObjectValue at a time, put together: a cell that is medial for several objects, or for none of
 * those it belongs to, gets the smallest label. The output GetObjectOutput() has the label of the object of each cell.
 * Numbers of voxels and cells are sums over the objects. Objects that are more than a reach apart
 * (MedialVoxelObjectAdjacency) share a pass. An update reads all of the input once to find them, and holds 2 bytes more
 * for each voxel of the requested region.
 *
 * \par Departures from the paper
 * doc/explanation/method.md gives the reasons.
 * - The boundary consists of background voxels with an object voxel among their 3^D-1 neighbors. Background corners of
 *   a cell are their own nearest boundary point.
 * - The angle of a pair is measured at the center of the cell, where it always exists; ties have a rule.
 * - The default bound is the length of the shortest path in the complete grid, which is proved; Eq. 2 is Paper.
 * - Each slab has a window that is certain to contain all that it depends on; nothing is propagated between slabs.
 * - Paths are searched in the box of the ellipsoid with the boundary points as foci, not of its bounding sphere. The
 *   edges of a path are counted by kind and summed in one order.
 * - Pores and dust can be left out, the threshold can be automatic, and any spacing is allowed.
 * - The thickness of walls is measured, on the mask or on gray values; MedialSurfaceMeshFilter makes a surface.
 *
 * \par Reference
 * T. Michikawa, H. Suzuki: Efficient Medial Voxel Extraction for Large Volumetric Models.
 *
 * \sa VectorDistanceMapImageFilter
 * \ingroup MedialVoxel
 */
template <typename TInputImage, typename TOutputImage = Image<unsigned char, TInputImage::ImageDimension>>
class ITK_TEMPLATE_EXPORT MedialVoxelImageFilter : public MedialVoxelImageFilterBase<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialVoxelImageFilter);

  using Self = MedialVoxelImageFilter;
  using Superclass = MedialVoxelImageFilterBase<TInputImage, TOutputImage>;
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
  using InputPixelType = typename InputImageType::PixelType;
  using VectorImageType = Image<Vector<float, ImageDimension>, ImageDimension>;

  using ThicknessImageType = Image<float, ImageDimension>;
  using ObjectImageType = Image<InputPixelType, ImageDimension>;
  using ObjectLabelsType = std::vector<std::int64_t>;

  using ThicknessModeEnum = MedialVoxelEnums::ThicknessMode;
  using SmoothingEnum = MedialVoxelEnums::Smoothing;
  using PseudoGeodesicBoundEnum = MedialVoxelEnums::PseudoGeodesicBound;
  using BoundaryEnum = MedialVoxelEnums::Boundary;

  /** Source of the threshold on the geodesic distance. Fixed (default): Thickness, for all cells. Automatic: the wall
   * around each cell. */
  itkMedialVoxelSetEnumMacro(ThicknessMode, ThicknessModeEnum);
  itkGetEnumMacro(ThicknessMode, ThicknessModeEnum);

  /** Thickness tau of the walls that become sheets when ThicknessMode is Fixed; it sets epsilon = pi tau / 2.
   *
   * In physical units when UseImageSpacing is on, otherwise in voxels. Positive and finite; default 3. If the largest
   * spacing is more than 4 times the smallest, the thickness counts as at least the largest spacing. A larger value
   * removes branches and shrinks the sheet at its rims. */
  itkSetMacro(Thickness, double);
  itkGetConstMacro(Thickness, double);

  /** Thinner walls count as this thickness when ThicknessMode is Automatic. A smaller value keeps more of thin walls in
   * noise, and more of their branches.
   *
   * In the units of Thickness, positive and finite, or 0 (default) for 3 voxels, by the smallest spacing of the axes
   * longer than 1. */
  itkSetMacro(MinimumThickness, double);
  itkGetConstMacro(MinimumThickness, double);

  /** Walls of up to this thickness become one sheet when ThicknessMode is Automatic. Thicker ones also show branches
   * towards their edges. Time and memory grow with it.
   *
   * In the units of Thickness, finite and not smaller than MinimumThickness, or 0 (default) for 16 voxels, by the
   * smallest spacing of the axes longer than 1. */
  itkSetMacro(MaximumThickness, double);
  itkGetConstMacro(MaximumThickness, double);

  /** Cavities and grains of up to this many voxels are taken for noise and left out.
   *
   * From 0, which keeps all, to 1000000. Until a value is set, it is 0 when ThicknessMode is Fixed and 32 when it is
   * Automatic. The window on the input grows by this many voxels on each side. */
  virtual void
  SetMaximumPoreSize(SizeValueType numberOfVoxels);

  /** The value that was set, otherwise the default of the ThicknessMode. */
  virtual SizeValueType
  GetMaximumPoreSize() const;

  /** Return to the default. */
  virtual void
  UnsetMaximumPoreSize();

  /** Smooth noise of the object away, before pores and dust are looked for. Until a value is set it is Automatic when
   * ThicknessMode is Automatic, and Off when it is Fixed or SeparateObjects is on. Automatic reads all of the input
   * once more. SubvoxelThickness measures the values that are not smoothed. */
  virtual void
  SetSmoothing(SmoothingEnum smoothing);
  SmoothingEnum
  GetSmoothing() const;
  virtual void
  UnsetSmoothing();

  /** True when the last update smoothed the object. */
  bool
  GetObjectIsSmoothed() const
  {
    return m_SmoothsObject;
  }

  /** Share of the voxels at the border of the object that stand alone, from 0 to 1, when the last update measured it
   * for the Automatic smoothing; otherwise 0. See MedialVoxelRoughness. */
  double
  GetRoughness() const
  {
    return m_Roughness.GetRatio();
  }

  /** Bound that decides cells without a search. Default FreeSpace. */
  itkMedialVoxelSetEnumMacro(PseudoGeodesicBound, PseudoGeodesicBoundEnum);
  itkGetEnumMacro(PseudoGeodesicBound, PseudoGeodesicBoundEnum);

  /** Produce the vector distance output. Default off, which costs neither time nor memory. */
  virtual void
  SetGenerateVectorDistance(bool generate);
  itkGetConstMacro(GenerateVectorDistance, bool);
  itkBooleanMacro(GenerateVectorDistance);

  /** Boundary that the vectors lead to: Object (default; their norm is the distance of
   * SignedMaurerDistanceMapImageFilter inside the object) or Background (the vectors that classify the cells). */
  itkMedialVoxelSetEnumMacro(VectorDistanceBoundary, BoundaryEnum);
  itkGetEnumMacro(VectorDistanceBoundary, BoundaryEnum);

  /** Displacements to the nearest boundary voxel, physical when UseImageSpacing is on (direction cosines applied),
   * otherwise in voxels. Null unless GenerateVectorDistance is on. */
  VectorImageType *
  GetVectorDistanceOutput();
  const VectorImageType *
  GetVectorDistanceOutput() const;

  /** Produce the thickness output. Default off, which costs neither time nor memory. */
  virtual void
  SetGenerateThickness(bool generate);
  itkGetConstMacro(GenerateThickness, bool);
  itkBooleanMacro(GenerateThickness);

  /** Measure the thickness on the values of the image; one of the thresholds must be set. Default off. Where the image
   * has walls of 5 voxels, blurred walls are fitted to the values, which reads samples of the input once more;
   * otherwise, and with both thresholds, walls reach to where values cross the thresholds. A mask or label map is
   * measured on the object. The window keeps 4 bytes a voxel more, in single precision. See MedialVoxelGrayThickness.
   */
  itkSetMacro(SubvoxelThickness, bool);
  itkGetConstMacro(SubvoxelThickness, bool);
  itkBooleanMacro(SubvoxelThickness);

  /** Values of background and material for these fits, finite and not equal; default those of the scan. */
  virtual void
  SetScanLevels(double background, double material);
  virtual void
  UnsetScanLevels();

  /** What the last update with SubvoxelThickness fitted walls with, see MedialVoxelScan: values of both materials, the
   * blur in voxels, and the noise of a value. All are 0 when there were no fits. */
  itkGetConstMacro(BackgroundLevel, double);
  itkGetConstMacro(MaterialLevel, double);
  itkGetConstMacro(Blur, double);
  itkGetConstMacro(Noise, double);

  /** Why the last update with SubvoxelThickness fitted no walls; empty when it did. */
  itkGetConstReferenceMacro(ReasonWithoutScan, std::string);

  /** Produce the uncertainty output. Default off. SubvoxelThickness must be on. */
  virtual void
  SetGenerateUncertainty(bool generate);
  itkGetConstMacro(GenerateUncertainty, bool);
  itkBooleanMacro(GenerateUncertainty);

  /** Half of the interval that holds the thickness in 95 % of the cases, in the units of the thickness; NaN at medial
   * cells where it is not known, zero elsewhere. Null unless GenerateUncertainty is on. */
  ThicknessImageType *
  GetUncertaintyOutput();
  const ThicknessImageType *
  GetUncertaintyOutput() const;

  /** Thickness of the walls at medial cells, physical when UseImageSpacing is on, otherwise in voxels; negative at
   * rims, zero elsewhere. Null unless GenerateThickness is on. */
  ThicknessImageType *
  GetThicknessOutput();
  const ThicknessImageType *
  GetThicknessOutput() const;

  /** Take each value of the input but 0 for an object of its own, and produce the object output. Values are whole
   * numbers from -2^63 to 2^63 - 1, at most 65535 different ones. Default off. Not together with thresholds,
   * ObjectValue, BackgroundValue, GenerateVectorDistance and SubvoxelThickness. */
  virtual void
  SetSeparateObjects(bool separate);
  itkGetConstMacro(SeparateObjects, bool);
  itkBooleanMacro(SeparateObjects);

  /** Values that are objects of their own; setting them turns SeparateObjects on. None of them is 0, and some voxel has
   * each. Empty (default): all values but 0. */
  virtual void
  SetObjectLabels(const ObjectLabelsType & labels);
  itkGetConstReferenceMacro(ObjectLabels, ObjectLabelsType);

  /** Label of the object of each cell; 0 where no corner of the cell is in an object. Null unless SeparateObjects is
   * on.
   */
  ObjectImageType *
  GetObjectOutput();
  const ObjectImageType *
  GetObjectOutput() const;

  /** Labels of the objects that the last update with SeparateObjects found in the whole input, ascending. */
  ObjectLabelsType
  GetFoundLabels() const;

  /** Passes over the input that these objects take; 1 without an object. */
  SizeValueType
  GetNumberOfPasses() const;

  /** Number of cells that are medial for several objects; summed like the counts. */
  SizeValueType
  GetNumberOfSharedCells() const;

  /** Number of voxels of the whole input with a label, before pores are filled. The label is one of GetFoundLabels().
   */
  SizeValueType
  GetNumberOfVoxelsWithLabel(std::int64_t label) const;

  /** Number of cells with a corner in the object with a label; summed like the counts. The label is one of
   * GetFoundLabels(). */
  SizeValueType
  GetNumberOfCandidateCellsWithLabel(std::int64_t label) const;

  /** Number of cells that are medial for the object with a label, shared ones too; summed like the counts. The label is
   * one of GetFoundLabels(). */
  SizeValueType
  GetNumberOfMedialCellsWithLabel(std::int64_t label) const;

  /** Numbers of voxels and cells of the requested regions since the last UpdateOutputInformation() that was followed by
   * an execution. The pieces of a streamed update add up to the whole; an aborted execution adds nothing. */
  SizeValueType
  GetNumberOfObjectVoxels() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.objectVoxels);
  }
  SizeValueType
  GetNumberOfBoundaryVoxels() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.boundaryVoxels);
  }
  SizeValueType
  GetNumberOfFilledVoxels() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.filledVoxels);
  }
  SizeValueType
  GetNumberOfRemovedVoxels() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.removedVoxels);
  }
  SizeValueType
  GetNumberOfCandidateCells() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.candidateCells);
  }
  SizeValueType
  GetNumberOfTrivialCells() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.trivialCells);
  }
  SizeValueType
  GetNumberOfBoundCells() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.boundCells);
  }
  SizeValueType
  GetNumberOfGeodesicMedialCells() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.geodesicMedialCells);
  }
  SizeValueType
  GetNumberOfGeodesicNonMedialCells() const
  {
    return static_cast<SizeValueType>(this->GetSums().counts.geodesicNonMedialCells);
  }

#ifndef ITK_WRAPPING_PARSER
  /** See each tile with its boundary points while it is at hand. Not owned, and must outlive the updates; none
   * (default) cost nothing. Their memory counts for WorkingMemoryLimit. Have no influence on results. */
  void
  SetTileObservers(std::vector<MedialVoxelTileObserver *> observers);

  /** Parameters of the classification of the input. */
  MedialVoxelParameters
  GetParameters() const
  {
    return this->GetParameters(this->GetGrid());
  }

  /** Gray values that the last update measured walls on; none when these were measured on the object. */
  std::optional<MedialVoxelExtraction::GrayRange>
  GetGrayRange() const;
#endif

  using Superclass::MakeOutput;
  ProcessObject::DataObjectPointer
  MakeOutput(const ProcessObject::DataObjectIdentifierType & name) override;

protected:
  MedialVoxelImageFilter();
  ~MedialVoxelImageFilter() override;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  GenerateOutputInformation() override;

  MedialVoxelEngineTask
  GetTask(const MedialVoxelGrid & grid) const override;

  void
  TakeTile(const MedialVoxelTileResult & tile) override;

  MedialVoxelSums
  RunRegion(const MedialVoxelBox & region) override;

  void
  KeepSums(bool isNew) override;

  const MedialVoxelObjectMap *
  GetObjectMap() const override;

  bool
  SmoothsObject() const override
  {
    return m_SmoothsObject;
  }

private:
  class Objects;

  static constexpr const char * VectorDistanceName = "VectorDistance";
  static constexpr const char * ThicknessName = "Thickness";
  static constexpr const char * UncertaintyName = "Uncertainty";
  static constexpr const char * ObjectsName = "Objects";

  /** Create a named output when it is switched on, remove it when it is switched off. */
  void
  SwitchOutput(bool & isOn, bool generate, const char * name);

  MedialVoxelParameters
  GetParameters(const MedialVoxelGrid & grid) const;

  void
  VerifyObjectLabels() const;

  /** Decide whether the object is smoothed, once for each change of the input. */
  void
  PrepareSmoothing();

  /** Find out what the values are made of, once for each change of the input. */
  void
  PrepareScan();

  /** Of an object that the last update found; throws for other labels. */
  MedialVoxelObjectNumber
  FindObjectNumber(std::int64_t label) const;

  ThicknessModeEnum       m_ThicknessMode{ ThicknessModeEnum::Fixed };
  double                  m_Thickness{ 3.0 };
  double                  m_MinimumThickness{ 0.0 };
  double                  m_MaximumThickness{ 0.0 };
  SizeValueType           m_MaximumPoreSize{ 0 };
  bool                    m_HasMaximumPoreSize{ false };
  PseudoGeodesicBoundEnum m_PseudoGeodesicBound{ PseudoGeodesicBoundEnum::FreeSpace };
  bool                    m_GenerateVectorDistance{ false };
  BoundaryEnum            m_VectorDistanceBoundary{ BoundaryEnum::Object };
  bool                    m_GenerateThickness{ false };
  bool                    m_GenerateUncertainty{ false };
  bool                    m_SubvoxelThickness{ false };
  bool                    m_SeparateObjects{ false };
  bool                    m_HasSmoothing{ false };
  SmoothingEnum           m_Smoothing{ SmoothingEnum::Off };
  bool                    m_SmoothsObject{ false };
  MedialVoxelRoughness    m_Roughness;
  ModifiedTimeType        m_RoughnessMTime{ 0 };
  double                  m_BackgroundLevel{ 0.0 };
  double                  m_MaterialLevel{ 0.0 };
  double                  m_Blur{ 0.0 };
  double                  m_Noise{ 0.0 };
  double                  m_NoiseCorrelation{ 1.0 };
  std::string             m_ReasonWithoutScan;
  bool                    m_IsMask{ false }; ///< the input; measured on the object
  ModifiedTimeType        m_ScanMTime{ 0 };
  ObjectLabelsType        m_ObjectLabels; ///< ascending, each once

  std::optional<MedialVoxelScanLevels> m_ScanLevels;

  /** Of the input at a time. */
  std::unique_ptr<Objects> m_Objects;
  ModifiedTimeType         m_ObjectsMTime{ 0 };

  std::vector<MedialVoxelTileObserver *> m_TileObservers;
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMedialVoxelImageFilter.hxx"
#  include "itkMedialVoxelImageFilterObjects.hxx"
#endif

#endif
