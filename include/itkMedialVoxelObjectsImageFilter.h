// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectsImageFilter_h
#define itkMedialVoxelObjectsImageFilter_h

#include "itkMedialVoxelImageFilter.h"
#include "itkMedialVoxelObjectUnion.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{

/** \class MedialVoxelObjectsImageFilter
 * \brief Medial voxels of all objects of a label map, each as if it were alone.
 *
 * Each value of the input but 0 is an object of its own; ObjectLabels chooses some. Values are whole numbers from -2^63
 * to 2^63 - 1, at most 65535 different ones. The boundary of an object is every voxel that is not in it, so that
 * objects that touch stay apart. The result unites updates of MedialVoxelImageFilter with one ObjectValue at a time: a
 * cell that is medial for several of its objects, or for none, gets the smallest label. With SameTopology, cells that
 * are medial for an object come before those that are added for one. The output GetObjectOutput() has the label of the
 * object of each cell. Numbers of voxels and cells are sums over the objects.
 *
 * Objects that are more than a reach apart (MedialVoxelObjectAdjacency) share a pass. An update reads all of the input
 * once to find them, and holds 5 bytes more for each voxel of the requested region.
 *
 * Thresholds, ObjectValue, BackgroundValue, GenerateVectorDistance, GenerateImportance, SubvoxelThickness and Smoothing
 * are for one object: an update with one of them is refused. Smoothing is Off by default.
 *
 * \sa MedialVoxelImageFilter
 * \ingroup MedialVoxel
 */
template <typename TInputImage, typename TOutputImage = Image<unsigned char, TInputImage::ImageDimension>>
class ITK_TEMPLATE_EXPORT MedialVoxelObjectsImageFilter : public MedialVoxelImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialVoxelObjectsImageFilter);

  using Self = MedialVoxelObjectsImageFilter;
  using Superclass = MedialVoxelImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
#ifdef itkOverrideGetNameOfClassMacro
  itkOverrideGetNameOfClassMacro(MedialVoxelObjectsImageFilter);
#else
  itkTypeMacro(MedialVoxelObjectsImageFilter, MedialVoxelImageFilter);
#endif

  using Superclass::ImageDimension;
  using typename Superclass::InputPixelType;
  using typename Superclass::OutputPixelType;
  using typename Superclass::SmoothingEnum;
  using ObjectImageType = Image<InputPixelType, ImageDimension>;
  using ObjectLabelsType = std::vector<std::int64_t>;

  /** Values of the objects. None is 0, and each occurs in the image. Empty (default): all values but 0. */
  virtual void
  SetObjectLabels(const ObjectLabelsType & labels);
  itkGetConstReferenceMacro(ObjectLabels, ObjectLabelsType);

  /** Label of the object of each cell; 0 where no corner of the cell is in an object. */
  ObjectImageType *
  GetObjectOutput()
  {
    return dynamic_cast<ObjectImageType *>(this->ProcessObject::GetOutput(ObjectsName));
  }

  /** Labels of the objects that the last update found in the whole input, ascending. */
  ObjectLabelsType
  GetFoundLabels() const;

  /** Passes over the input that these objects take; 1 without an object, 0 before an update. */
  SizeValueType
  GetNumberOfPasses() const;

  /** Number of cells that are medial or added for several objects; summed like the counts. */
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

  /** Number of cells that SameTopology added for the object with a label, shared ones too. The label is one of
   * GetFoundLabels(). */
  SizeValueType
  GetNumberOfAddedCellsWithLabel(std::int64_t label) const;

  using Superclass::MakeOutput;
  ProcessObject::DataObjectPointer
  MakeOutput(const ProcessObject::DataObjectIdentifierType & name) override;

protected:
  MedialVoxelObjectsImageFilter();
  ~MedialVoxelObjectsImageFilter() override;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() const override;

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

  std::unique_ptr<MedialVoxelInput>
  MakeInput(MedialVoxelValueSource & source) override;

private:
  class Objects;

  /** Of the object with a label, in the last update. */
  MedialVoxelObjectUnion::Cells
  FindCells(std::int64_t label) const;

  static constexpr const char * ObjectsName = "Objects";

  /** Of an object that the last update found; throws for other labels. */
  MedialVoxelObjectNumber
  FindObjectNumber(std::int64_t label) const;

  /** Make the input, and know its objects. */
  void
  PrepareObjects();

  ObjectLabelsType m_ObjectLabels; ///< ascending, each once

  std::unique_ptr<Objects> m_Objects; ///< of the input at a time
};

} // end namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMedialVoxelObjectsImageFilter.hxx"
#endif

#endif
