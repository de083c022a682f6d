// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelImageFilter_h
#define itkMedialVoxelImageFilter_h

#include "itkMedialVoxelImageFilterBase.h"

#include "itkImage.h"
#include "itkVector.h"

#include <vector>

namespace itk
{

/** \class MedialVoxelImageFilter
 * \brief Medial voxels of a binary or thresholded image: the one-cell-thin sheet midway between opposite walls.
 *
 * The output labels dual cells. A dual cell is the center of 2^D neighboring voxels; it is stored at the index of its
 * lowest corner, in an image whose origin is shifted by half a voxel along every axis longer than 1. The last index of
 * each such axis has no cell and is always 0. The labels are
 *
 * - 0: no corner of the cell is an object voxel,
 * - 1: non-medial,
 * - 2: medial, decided by the bound,
 * - 3: medial, decided by the geodesic search.
 *
 * For the diagonal of the cell whose two nearest boundary points are seen under the widest angle, the cell is medial
 * when the geodesic distance of these points on the boundary is at least epsilon = pi Thickness / 2 (Eq. 1 of the
 * paper). Three phases decide: pairs of equal or adjacent points are not medial (trivial); pairs that a bound keeps
 * apart are medial; the others are searched. Labels 2 and 3 together are the same cells for the bounds FreeSpace and
 * Off.
 *
 * With a thickness of 3 voxels for walls below 6 voxels, or 5 for walls up to 8 that are curved or tilted, and further
 * than one wall thickness from rims and junctions, the medial cells are the dual cells that the mid-surface passes
 * through, without holes.
 *
 * An image without object is 0 everywhere. In an image without background every cell is 1 and counts as trivial,
 * because outside the image nothing is known.
 *
 * The filter streams: any requested region gives the same labels as the whole image, for any number of threads.
 *
 * \par Automatic thickness
 * One thickness does not fit a part with thin and thick walls: a small one leaves branches in the thick walls, a large
 * one shortens the sheets of thin ones. With ThicknessMode Automatic each cell p has a threshold of its own,
 * epsilon(p) = max(pi MinimumThickness / 2, 3 min(LT(p), MaximumThickness / 2)). LT(p) is the radius of the largest
 * inscribed ball that covers p. Balls are centered at cells whose pair is neither equal nor adjacent, with the radius
 * d(p) = (|N(vi) - p| + |N(vj) - p|) / 2; that of p itself counts whatever its size, others up to MaximumThickness / 2
 * and if |q - p| <= d(q). Only the threshold differs: the cell is medial when the geodesic distance of its pair is at
 * least epsilon(p), with label 2 where the bound says so. MedialVoxelLocalThreshold states the arithmetic. Results do
 * not depend on tiles, threads or requested regions here either; a larger MinimumThickness or MaximumThickness never
 * adds medial cells.
 *
 * \par Pores and dust
 * Noise leaves small cavities in walls, and grains beside them, each with a boundary of its own. With MaximumPoreSize
 * K, each connected component of the background of at most K voxels becomes object first, then each component of the
 * object of at most K voxels background; all that follows is of this object. Voxels are connected when they differ by
 * at most 1 along each axis, object and background alike: paths on the boundary run through the background this way,
 * and walls and gaps of one voxel that are tilted do not fall apart. A component that touches a face of the image
 * stays, as it may go on outside. NaN counts as background here too. GetNumberOfFilledVoxels() and
 * GetNumberOfRemovedVoxels() tell how many voxels have changed sides.
 *
 * \par Vectors
 * GenerateVectorDistanceOn() adds a second output, GetVectorDistanceOutput(): at object voxels the displacement to the
 * nearest boundary voxel, zero elsewhere, NaN at object voxels of an image that has no boundary. The geometry of this
 * image is the input's. All outputs always have the same requested region.
 *
 * \par Thickness
 * GenerateThicknessOn() adds an output, GetThicknessOutput(): at medial cells the thickness of the wall, at rims the
 * negative of what is measured there, zero elsewhere. The geometry of this image is that of the labels.
 * MedialVoxelThickness tells how it is measured: walls parallel to an axis exactly, others to a layer of voxels.
 * SubvoxelThicknessOn() measures it on the gray values that the thresholds cut the object from, as
 * MedialVoxelGrayThickness tells. doc/explanation/accuracy.md has the errors.
 *
 * \par Departures from the paper
 * - The boundary is the background border: background voxels with an object voxel among their 3^D-1 neighbors. Walls of
 *   1 and 2 voxels vanish with the object border. Background corners of a cell are their own nearest boundary point.
 * - The angle of a pair is measured at the center of the cell, where it exists for every cell; ties have a rule.
 * - The default bound is the length of the shortest path in the complete grid, which is proved; Eq. 2 is Paper.
 * - Slabs take the place of clusters: each has a window that is certain to hold what it depends on, and nothing is
 *   propagated between them.
 * - Pores and dust can be left out, see MaximumPoreSize; by default they are with an automatic thickness.
 * - The threshold can be that of each wall (automatic thickness). Any spacing is allowed, equal or not.
 * - Paths are searched in the box of the ellipsoid with the boundary points as foci, not of its bounding sphere. The
 *   edges of a path are counted by kind and summed in one order.
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
  using VectorImageType = Image<Vector<float, ImageDimension>, ImageDimension>;

  using ThicknessImageType = Image<float, ImageDimension>;

  using ThicknessModeEnum = MedialVoxelEnums::ThicknessMode;
  using PseudoGeodesicBoundEnum = MedialVoxelEnums::PseudoGeodesicBound;
  using BoundaryEnum = MedialVoxelEnums::Boundary;

  /** Where the threshold on the geodesic distance comes from: Fixed (default), the same for all cells from Thickness,
   * or Automatic, for each cell from the wall that it is in. See "Automatic thickness" above. */
  itkSetEnumMacro(ThicknessMode, ThicknessModeEnum);
  itkGetEnumMacro(ThicknessMode, ThicknessModeEnum);

  /** Thickness tau of the walls that are sheets, which sets the threshold epsilon = pi tau / 2 on the geodesic
   * distance.
   *
   * In physical units when UseImageSpacing is on, otherwise in voxels. Positive and finite; default 3. Where the
   * largest spacing is more than 4 times the smallest, it counts as at least the largest. A larger value
   * removes branches and shrinks the sheet at its rims. Used when ThicknessMode is Fixed. */
  itkSetMacro(Thickness, double);
  itkGetConstMacro(Thickness, double);

  /** Smallest thickness that sets a threshold when ThicknessMode is Automatic: walls that are thinner get that of
   * this thickness. A smaller value keeps more of thin walls in noise, and more of their branches.
   *
   * In the units of Thickness, positive and finite, or 0 (default) for 3 voxels, by the smallest spacing of the axes
   * longer than 1. */
  itkSetMacro(MinimumThickness, double);
  itkGetConstMacro(MinimumThickness, double);

  /** Largest thickness of a wall that is meant to be a sheet when ThicknessMode is Automatic. Thicker parts show the
   * branches towards their edges too. Time and memory grow with it.
   *
   * In the units of Thickness, finite and not smaller than MinimumThickness, or 0 (default) for 16 voxels, by the
   * smallest spacing of the axes longer than 1. */
  itkSetMacro(MaximumThickness, double);
  itkGetConstMacro(MaximumThickness, double);

  /** Largest number of voxels of a pore, or of a grain of dust, that is taken for noise. See "Pores and dust" above.
   *
   * At most 1000000; 0 takes none. The default is 0 when ThicknessMode is Fixed and 32 when it is Automatic, until a
   * value is set. The window on the input grows by so many voxels on each side. */
  virtual void
  SetMaximumPoreSize(SizeValueType numberOfVoxels);

  /** The value that was set, otherwise the default of the ThicknessMode. */
  virtual SizeValueType
  GetMaximumPoreSize() const;

  /** Return to the default. */
  virtual void
  UnsetMaximumPoreSize();

  /** Bound that decides cells without a search. Default FreeSpace. */
  itkSetEnumMacro(PseudoGeodesicBound, PseudoGeodesicBoundEnum);
  itkGetEnumMacro(PseudoGeodesicBound, PseudoGeodesicBoundEnum);

  /** Produce the vector distance output. Default off, which costs neither time nor memory. */
  virtual void
  SetGenerateVectorDistance(bool generate);
  itkGetConstMacro(GenerateVectorDistance, bool);
  itkBooleanMacro(GenerateVectorDistance);

  /** Boundary that the vectors lead to: Object (default; their norm is the distance of
   * SignedMaurerDistanceMapImageFilter inside the object) or Background (the vectors that classify the cells). */
  itkSetEnumMacro(VectorDistanceBoundary, BoundaryEnum);
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

  /** Measure the thickness on the values of the image, at the thresholds, one of which must be set. Default off. On,
   * the window on the input keeps 4 bytes for each voxel as well; values are read in single precision. */
  itkSetMacro(SubvoxelThickness, bool);
  itkGetConstMacro(SubvoxelThickness, bool);
  itkBooleanMacro(SubvoxelThickness);

  /** Thickness of the walls at medial cells, physical when UseImageSpacing is on, otherwise in voxels; negative at
   * rims, zero elsewhere. Null unless GenerateThickness is on. */
  ThicknessImageType *
  GetThicknessOutput();
  const ThicknessImageType *
  GetThicknessOutput() const;

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
#endif

  using Superclass::MakeOutput;
  ProcessObject::DataObjectPointer
  MakeOutput(const ProcessObject::DataObjectIdentifierType & name) override;

protected:
  MedialVoxelImageFilter() = default;
  ~MedialVoxelImageFilter() override = default;

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

private:
  static constexpr const char * VectorDistanceName = "VectorDistance";
  static constexpr const char * ThicknessName = "Thickness";

  /** Create a named output when it is switched on, remove it when it is switched off. */
  void
  SwitchOutput(bool & isOn, bool generate, const char * name);

  MedialVoxelParameters
  GetParameters(const MedialVoxelGrid & grid) const;

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
  bool                    m_SubvoxelThickness{ false };

  std::vector<MedialVoxelTileObserver *> m_TileObservers;
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMedialVoxelImageFilter.hxx"
#endif

#endif
