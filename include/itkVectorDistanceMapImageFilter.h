// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkVectorDistanceMapImageFilter_h
#define itkVectorDistanceMapImageFilter_h

#include "itkMedialVoxelImageFilterBase.h"

#include "itkImage.h"
#include "itkVector.h"

#include <limits>

namespace itk
{

/** \class VectorDistanceMapImageFilter
 * \brief Exact vector distance map: the displacement from each voxel to its nearest boundary voxel.
 *
 * The vectors are exact; among boundary voxels at the same distance the one with the smallest index (z first, then y,
 * then x) is taken. For a voxel at index i the physical point TransformIndexToPhysicalPoint(i) plus its vector is the
 * physical point of the nearest boundary voxel. With UseImageSpacing off, vectors are differences of indices.
 *
 * GenerateDistanceOn() adds the signed distance, GetDistanceOutput(), with the conventions and defaults of
 * SignedMaurerDistanceMapImageFilter: negative inside the object unless InsideIsPositive is on, squared when
 * SquaredDistance is on. For Boundary Object and Region Both it equals that filter's output up to rounding to float.
 *
 * Voxels further than MaximumDistance, and all voxels of an image that has no boundary, are NaN in both outputs; voxels
 * outside Region are zero in both. (On an image without boundary SignedMaurerDistanceMapImageFilter gives the largest
 * number instead.)
 *
 * The filter streams: any requested region gives the same values as the whole image, for any number of threads, and
 * reads only the input that the region depends on. A voxel at distance d depends on input as far as d away, or on
 * MaximumDistance if that is less.
 *
 * \sa SignedMaurerDistanceMapImageFilter
 * \sa DanielssonDistanceMapImageFilter
 * \sa MedialVoxelImageFilter
 * \ingroup MedialVoxel
 */
template <typename TInputImage,
          typename TVectorImage = Image<Vector<float, TInputImage::ImageDimension>, TInputImage::ImageDimension>>
class ITK_TEMPLATE_EXPORT VectorDistanceMapImageFilter : public MedialVoxelImageFilterBase<TInputImage, TVectorImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(VectorDistanceMapImageFilter);

  using Self = VectorDistanceMapImageFilter;
  using Superclass = MedialVoxelImageFilterBase<TInputImage, TVectorImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(VectorDistanceMapImageFilter);
#else
  itkTypeMacro(VectorDistanceMapImageFilter, MedialVoxelImageFilterBase);
#endif

  using Superclass::ImageDimension;
  using InputImageType = TInputImage;
  using VectorImageType = TVectorImage;
  using DistanceImageType = Image<float, ImageDimension>;

  using BoundaryEnum = MedialVoxelEnums::Boundary;
  using RegionEnum = MedialVoxelEnums::Region;

  /** Voxels that distances are measured to: Object (default, that of SignedMaurerDistanceMapImageFilter) or Background
   * (the boundary that MedialVoxelImageFilter classifies with). */
  itkMedialVoxelSetEnumMacro(Boundary, BoundaryEnum);
  itkGetEnumMacro(Boundary, BoundaryEnum);

  /** Voxels that get a value. Default Both. */
  itkMedialVoxelSetEnumMacro(Region, RegionEnum);
  itkGetEnumMacro(Region, RegionEnum);

  /** Distance beyond which voxels are NaN, in physical units when UseImageSpacing is on, otherwise in voxels. Positive;
   * default infinity. A narrow band needs less input and less time. */
  itkSetMacro(MaximumDistance, double);
  itkGetConstMacro(MaximumDistance, double);

  /** Produce the signed distance output. Default off. */
  virtual void
  SetGenerateDistance(bool generate);
  itkGetConstMacro(GenerateDistance, bool);
  itkBooleanMacro(GenerateDistance);

  /** Make distances positive inside the object and negative outside. Default off. */
  itkSetMacro(InsideIsPositive, bool);
  itkGetConstMacro(InsideIsPositive, bool);
  itkBooleanMacro(InsideIsPositive);

  /** Give the square of the distance, with the same sign. Default off. */
  itkSetMacro(SquaredDistance, bool);
  itkGetConstMacro(SquaredDistance, bool);
  itkBooleanMacro(SquaredDistance);

  /** Signed distance, in the units of the vectors. Null unless GenerateDistance is on. */
  DistanceImageType *
  GetDistanceOutput();
  const DistanceImageType *
  GetDistanceOutput() const;

  using Superclass::MakeOutput;
  ProcessObject::DataObjectPointer
  MakeOutput(const ProcessObject::DataObjectIdentifierType & name) override;

protected:
  VectorDistanceMapImageFilter() = default;
  ~VectorDistanceMapImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() const override;

  MedialVoxelEngineTask
  GetTask(const MedialVoxelGrid & grid) const override;

  void
  TakeTile(const MedialVoxelTileResult & tile) override;

private:
  static constexpr const char * DistanceName = "Distance";

  BoundaryEnum m_Boundary{ BoundaryEnum::Object };
  RegionEnum   m_Region{ RegionEnum::Both };
  double       m_MaximumDistance{ std::numeric_limits<double>::infinity() };
  bool         m_GenerateDistance{ false };
  bool         m_InsideIsPositive{ false };
  bool         m_SquaredDistance{ false };
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkVectorDistanceMapImageFilter.hxx"
#endif

#endif
