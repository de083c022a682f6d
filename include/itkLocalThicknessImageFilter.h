// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkLocalThicknessImageFilter_h
#define itkLocalThicknessImageFilter_h

#include "itkMedialVoxelImageFilterBase.h"

#include "itkImage.h"

namespace itk
{

/** \class LocalThicknessImageFilter
 * \brief Local thickness of each object voxel: of the wall, or the ball, that covers it.
 *
 * Values are in physical units when UseImageSpacing is on, otherwise in voxels; 0 in background.
 *
 * \par Wall
 * The default Method. Each medial cell of MedialVoxelImageFilter, with ThicknessMode Automatic and its defaults but
 * without smoothing and pores, measures the wall that it is in, from face to face. Its ball covers the voxels that are
 * nearer to the cell than the two boundary points of the wall are on average. The value is the thickness of the wall
 * whose ball is the largest that covers a voxel; of equal balls the thickest wall counts. Cells with unpaired sides,
 * which do not face each other, measure no wall and have no ball. Object voxels that no ball covers, in edges and
 * corners, are NaN: no comparison finds them thin or thick.
 *
 * \par Sphere
 * The definition of Hildebrand and Ruegsegger (1997), for comparison with other programs and bone literature. Balls lie
 * around object voxels; their radius is the distance R to the nearest background voxel, and they cover the voxels that
 * are nearer than R. The value is the largest 2 R of the balls that cover a voxel. A plate of w voxels reads w where w
 * is even and w + 1 where it is odd, and edges are thin.
 *
 * Balls are cut at LargestBall, so that a value depends on voxels nearby alone: the filter streams, and any
 * requested region gives the same values as the whole image, for any number of threads. Nothing is known outside of the
 * image, so that an object which the image cuts may be found too thick beside its faces.
 *
 * \sa MedialVoxelImageFilter, whose thickness output measures walls from face to face
 * \ingroup MedialVoxel
 */
template <typename TInputImage>
class ITK_TEMPLATE_EXPORT LocalThicknessImageFilter
  : public MedialVoxelImageFilterBase<TInputImage, Image<float, TInputImage::ImageDimension>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LocalThicknessImageFilter);

  using Self = LocalThicknessImageFilter;
  using Superclass = MedialVoxelImageFilterBase<TInputImage, Image<float, TInputImage::ImageDimension>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(LocalThicknessImageFilter);
#else
  itkTypeMacro(LocalThicknessImageFilter, MedialVoxelImageFilterBase);
#endif

  using Superclass::ImageDimension;
  using InputImageType = TInputImage;
  using OutputImageType = Image<float, TInputImage::ImageDimension>;

  using MethodEnum = MedialVoxelEnums::LocalThicknessMethod;

  /** How the thickness of a voxel is defined. Default Wall. */
  itkMedialVoxelSetEnumMacro(Method, MethodEnum);
  itkGetEnumMacro(Method, MethodEnum);

  /** Measure walls on the values of the image; one of the thresholds must be set. Default off. Walls have the thickness
   * of MedialVoxelImageFilter with SubvoxelThicknessOn(). Not with the Method Sphere. */
  itkSetMacro(SubvoxelThickness, bool);
  itkGetConstMacro(SubvoxelThickness, bool);
  itkBooleanMacro(SubvoxelThickness);

  /** Diameter at which balls are cut, and the largest thickness, in physical units when UseImageSpacing is on,
   * otherwise in voxels. Positive, at most 256 voxels of the smallest spacing; default 32 voxels of the largest
   * spacing. Memory and time grow with it. */
  void
  SetLargestBall(double thickness);
  void
  UnsetLargestBall();

  /** The value that was set; 0 when none was. */
  itkGetConstMacro(LargestBall, double);

  /** Object voxels with the value LargestBall, whose balls may be larger. Summed like the counts. */
  SizeValueType
  GetNumberOfVoxelsAtMaximum() const
  {
    return static_cast<SizeValueType>(this->GetSums().voxelsAtMaximum);
  }

  /** Object voxels that no wall covers, whose value is NaN; none with the Method Sphere. Summed like the counts. */
  SizeValueType
  GetNumberOfVoxelsWithoutWall() const
  {
    return static_cast<SizeValueType>(this->GetSums().voxelsWithoutWall);
  }

protected:
  LocalThicknessImageFilter() = default;
  ~LocalThicknessImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  std::unique_ptr<MedialVoxelInput>
  MakeInput(MedialVoxelValueSource & source) override;

  MedialVoxelEngineTask
  GetTask(const MedialVoxelGrid & grid) const override;

  void
  TakeTile(const MedialVoxelTileResult & tile) override;

  void
  VerifyPreconditions() const override;

  MedialVoxelSums
  RunRegion(const MedialVoxelBox & region) override;

private:
  MethodEnum m_Method{ MethodEnum::Wall };
  bool       m_SubvoxelThickness{ false };
  double     m_LargestBall{ 0.0 };
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkLocalThicknessImageFilter.hxx"
#endif

#endif
