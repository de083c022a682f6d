// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelObjectsImageFilter_hxx
#define itkMedialVoxelObjectsImageFilter_hxx

#include "itkMedialVoxelObjectRegion.h"
#include "itkMedialVoxelObjectUnion.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <variant>
#include <vector>

namespace itk
{

/** The objects of the input, and what the passes over them found. */
template <typename TInputImage, typename TOutputImage>
class MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::Objects : public MedialVoxelObjectMap
{
public:
  struct Cells
  {
    SizeValueType candidate{ 0 };
    SizeValueType medial{ 0 };
  };

  /** Finds the objects of the input and their passes, which reads all of it once. */
  explicit Objects(Self & filter)
    : m_Filter(filter)
    , m_Grid(filter.GetGrid())
    , m_Region(*this, m_Grid.GetSize(), filter.GetMaximumPoreSize())
  {
    this->Survey();
    m_Total.resize(this->GetObjectVoxels().size());
  }

  void
  ReadObjects(const MedialVoxelBox & box, MedialVoxelObjectNumber * objects) override
  {
    m_Filter.ForEachPart(box, [&](const MedialVoxelBox & part, const InputPixelType * const first) {
      const auto width = static_cast<std::size_t>(part.Extent(0));
      ForEachInputRow(part, [&](const std::int64_t offset, const MedialVoxelBox &) {
        this->GetTable().Translate(first + offset, width, objects);
        objects += width;
      });
    });
  }

  /** Fills the outputs, which are allocated. */
  MedialVoxelSums
  Run(const MedialVoxelBox & region)
  {
    this->Begin(region);
    MedialVoxelSums    sums;
    const unsigned int passes = this->GetNumberOfPasses();
    for (unsigned int pass = 0; pass < passes; ++pass)
    {
      this->ShowPass(pass);
      sums += m_Filter.RunEngine(region, pass, passes);
      this->TakePoreCells();
      if (passes > 1)
      {
        m_Filter.DropWindow();
      }
    }
    this->RemoveMarks();
    return sums;
  }

  /** What was found in a tile of the pass that is shown. Called by several threads at a time. */
  void
  TakeTile(const MedialVoxelTileResult & tile)
  {
    if (tile.isEmpty)
    {
      return;
    }
    const MedialVoxelStrides strides{ 1, tile.box.Extent(0), tile.box.Extent(0) * tile.box.Extent(1) };
    std::vector<float>       thicknesses;
    if (m_Filter.GetGenerateThickness())
    {
      thicknesses.resize(static_cast<std::size_t>(tile.box.NumberOfVoxels()));
      tile.WriteThickness(thicknesses.data(), strides);
    }
    Sums              sums;
    std::vector<Cell> poreCells;
    MedialVoxelForEachRow(tile.box, strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
      const std::uint8_t * const labels = tile.labels + offset;
      for (std::int64_t i = 0; i < row.Extent(0); ++i)
      {
        if (labels[i] == MedialVoxelLabel::NoObject)
        {
          continue;
        }
        const float thickness = thicknesses.empty() ? 0.0f : thicknesses[static_cast<std::size_t>(offset + i)];
        const Cell  cell{ { { row.lower[0] + i, row.lower[1], row.lower[2] } }, labels[i], thickness };
        if (const auto object = m_Region.FindObject(cell.index, this->GetShownPass()))
        {
          this->TakeCell(cell, object, sums);
        }
        else
        {
          poreCells.push_back(cell);
        }
      }
    });
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Pending.Add(sums);
    m_PoreCells.insert(m_PoreCells.end(), poreCells.begin(), poreCells.end());
  }

  void
  KeepSums(const bool isNew)
  {
    if (isNew)
    {
      std::fill(m_Total.begin(), m_Total.end(), Cells{});
      m_SharedCells = 0;
    }
    m_SharedCells += m_Pending.sharedCells;
    for (const auto & [object, cells] : m_Pending.cells)
    {
      m_Total[object].candidate += cells.candidate;
      m_Total[object].medial += cells.medial;
    }
  }

  SizeValueType
  GetSharedCells() const
  {
    return m_SharedCells;
  }

  const Cells &
  GetCells(const MedialVoxelObjectNumber object) const
  {
    return m_Total[object];
  }

private:
  struct Cell
  {
    MedialVoxelIndex index;
    std::uint8_t     label;
    float            thickness;
  };

  struct Sums
  {
    std::map<MedialVoxelObjectNumber, Cells> cells;
    SizeValueType                            sharedCells{ 0 };

    void
    Add(const Sums & other)
    {
      sharedCells += other.sharedCells;
      for (const auto & [object, added] : other.cells)
      {
        cells[object].candidate += added.candidate;
        cells[object].medial += added.medial;
      }
    }
  };

  template <typename TFunction>
  void
  ForEachInputRow(const MedialVoxelBox & part, TFunction && function) const
  {
    MedialVoxelForEachRow(part, Self::StridesOf(*m_Filter.GetInput()), function);
  }

  void
  Survey()
  {
    MedialVoxelLabelSurvey         survey(m_Filter.m_ObjectLabels, m_Grid.GetSize(), m_Filter.GetMaximumPoreSize());
    MedialVoxelLabelSurvey::Result found;
    try
    {
      m_Filter.ForEachPart(m_Grid.GetVoxelBox(), [&](const MedialVoxelBox & part, const InputPixelType * const first) {
        ForEachInputRow(part, [&](const std::int64_t offset, const MedialVoxelBox & row) {
          survey.Add(first + offset, static_cast<std::size_t>(row.Extent(0)));
        });
        m_Filter.UpdateProgress(0.0f);
        if (m_Filter.GetAbortGenerateData())
        {
          std::rethrow_exception(Self::MakeAbortException());
        }
      });
      found = survey.Finish();
    }
    catch (const MedialVoxelLabelError & error)
    {
      itkGenericExceptionMacro("The input is not a label map: " << error.what() << '.');
    }
    if (!found.missing.empty())
    {
      itkGenericExceptionMacro("No voxel of the input has the label " << found.missing.front() << " of ObjectLabels.");
    }
    this->Learn(found);
  }

  void
  Begin(const MedialVoxelBox & region)
  {
    m_Pending = {};
    m_PoreCells.clear();
    m_Outputs = region;
    m_Filter.GetOutput()->FillBuffer(OutputPixelType{});
    m_Filter.GetObjectOutput()->FillBuffer(InputPixelType{});
    if (m_Filter.GetGenerateThickness())
    {
      m_Filter.GetThicknessOutput()->FillBuffer(0.0f);
    }
    m_Region.Read(region);
  }

  /** No two threads have the same cell. */
  void
  TakeCell(const Cell & cell, const MedialVoxelObjectNumber object, Sums & sums) const
  {
    Cells & cells = sums.cells[object];
    ++cells.candidate;
    cells.medial += cell.label >= MedialVoxelLabel::MedialByBound ? 1 : 0;
    const std::size_t offset = m_Outputs.OffsetOf(cell.index);
    const auto        change = MedialVoxelObjectUnion::TakeCell(cell.label,
                                                         static_cast<InputPixelType>(this->GetTable().GetValue(object)),
                                                         m_Filter.GetOutput()->GetBufferPointer()[offset],
                                                         m_Filter.GetObjectOutput()->GetBufferPointer()[offset]);
    sums.sharedCells += change.isShared ? 1 : 0;
    if (change.isTaken && m_Filter.GetGenerateThickness())
    {
      m_Filter.GetThicknessOutput()->GetBufferPointer()[offset] = cell.thickness;
    }
  }

  /** The cells in filled pores, whose objects are found with more of the input, for which this thread alone asks. */
  void
  TakePoreCells()
  {
    for (const Cell & cell : m_PoreCells)
    {
      this->TakeCell(cell, m_Region.FindObjectOfPore(cell.index, this->GetShownPass()), m_Pending);
    }
    m_PoreCells.clear();
  }

  void
  RemoveMarks() const
  {
    OutputPixelType * const labels = m_Filter.GetOutput()->GetBufferPointer();
    std::transform(
      labels, labels + m_Outputs.NumberOfVoxels(), labels, MedialVoxelObjectUnion::WithoutMark<OutputPixelType>);
  }

  Self &                  m_Filter;
  MedialVoxelGrid         m_Grid;
  MedialVoxelObjectRegion m_Region;
  MedialVoxelBox          m_Outputs; ///< the voxels of the outputs
  std::vector<Cells>      m_Total;   ///< by object
  SizeValueType           m_SharedCells{ 0 };
  std::mutex              m_Mutex; // of what follows
  Sums                    m_Pending;
  std::vector<Cell>       m_PoreCells;
};

template <typename TInputImage, typename TOutputImage>
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::MedialVoxelObjectsImageFilter()
{
  this->SetSmoothing(SmoothingEnum::Off);
  this->ProcessObject::SetOutput(ObjectsName, this->MakeOutput(ObjectsName));
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::~MedialVoxelObjectsImageFilter() = default;

template <typename TInputImage, typename TOutputImage>
ProcessObject::DataObjectPointer
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::MakeOutput(
  const ProcessObject::DataObjectIdentifierType & name)
{
  if (name == ObjectsName)
  {
    return ObjectImageType::New().GetPointer();
  }
  return Superclass::MakeOutput(name);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::SetObjectLabels(const ObjectLabelsType & labels)
{
  ObjectLabelsType sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted != m_ObjectLabels)
  {
    m_ObjectLabels = std::move(sorted);
    this->Modified();
  }
}

template <typename TInputImage, typename TOutputImage>
auto
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetFoundLabels() const -> ObjectLabelsType
{
  return m_Objects ? m_Objects->GetTable().GetValues() : ObjectLabelsType{};
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfPasses() const
{
  return m_Objects ? m_Objects->GetNumberOfPasses() : 0;
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfSharedCells() const
{
  return m_Objects ? m_Objects->GetSharedCells() : 0;
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfVoxelsWithLabel(const std::int64_t label) const
{
  return static_cast<SizeValueType>(m_Objects->GetObjectVoxels()[this->FindObjectNumber(label)]);
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfCandidateCellsWithLabel(
  const std::int64_t label) const
{
  return m_Objects->GetCells(this->FindObjectNumber(label)).candidate;
}

template <typename TInputImage, typename TOutputImage>
SizeValueType
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetNumberOfMedialCellsWithLabel(
  const std::int64_t label) const
{
  return m_Objects->GetCells(this->FindObjectNumber(label)).medial;
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelObjectNumber
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::FindObjectNumber(const std::int64_t label) const
{
  const MedialVoxelObjectNumber number = m_Objects ? m_Objects->GetTable().GetNumber(label) : MedialVoxelObjectNumber{};
  if (number == 0)
  {
    itkExceptionMacro("The last update found no object with the label " << label << '.');
  }
  return number;
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (this->GetUseThresholds() || this->GetUseObjectValue() || this->GetBackgroundValue() != InputPixelType{})
  {
    itkExceptionMacro("Each value but 0 is an object: LowerThreshold, UpperThreshold, ObjectValue and BackgroundValue "
                      "must not be set.");
  }
  if (this->GetSmoothing() != SmoothingEnum::Off)
  {
    itkExceptionMacro("The objects of a label map are not smoothed; Smoothing must be Off.");
  }
  if (this->GetGenerateVectorDistance())
  {
    itkExceptionMacro("Vectors are for one object; set ObjectValue of MedialVoxelImageFilter instead.");
  }
  for (const std::int64_t label : m_ObjectLabels)
  {
    if (label == 0 || MedialVoxelToLabel(static_cast<InputPixelType>(label)) != label)
    {
      using PrintType = typename NumericTraits<InputPixelType>::PrintType;
      itkExceptionMacro("ObjectLabels has "
                        << label << "; labels are values of the pixel type other than 0, from "
                        << static_cast<PrintType>(std::numeric_limits<InputPixelType>::lowest()) << " to "
                        << static_cast<PrintType>(std::numeric_limits<InputPixelType>::max()) << '.');
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GenerateOutputInformation()
{
  Superclass::GenerateOutputInformation();
  this->GetObjectOutput()->SetOrigin(this->GetOutput()->GetOrigin());
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelEngineTask
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetTask(const MedialVoxelGrid & grid) const
{
  auto task = Superclass::GetTask(grid);
  if (this->GetGenerateThickness())
  {
    // Of a tile, until its cells have their objects.
    std::get<MedialVoxelExtraction>(task).observerBytesPerVoxel += sizeof(float);
  }
  return task;
}

template <typename TInputImage, typename TOutputImage>
MedialVoxelSums
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::RunRegion(const MedialVoxelBox & region)
{
  const ModifiedTimeType modifiedTime = this->GetPixelMTime();
  if (!m_Objects || m_ObjectsMTime != modifiedTime)
  {
    m_Objects.reset();
    m_Objects = std::make_unique<Objects>(*this);
    m_ObjectsMTime = modifiedTime;
  }
  return m_Objects->Run(region);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::TakeTile(const MedialVoxelTileResult & tile)
{
  m_Objects->TakeTile(tile);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::KeepSums(const bool isNew)
{
  m_Objects->KeepSums(isNew);
}

template <typename TInputImage, typename TOutputImage>
void
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "ObjectLabels:";
  for (const std::int64_t label : m_ObjectLabels)
  {
    os << ' ' << label;
  }
  os << std::endl;
  os << indent << "NumberOfPasses: " << this->GetNumberOfPasses() << std::endl;
  os << indent << "NumberOfSharedCells: " << this->GetNumberOfSharedCells() << std::endl;
}

template <typename TInputImage, typename TOutputImage>
const MedialVoxelObjectMap *
MedialVoxelObjectsImageFilter<TInputImage, TOutputImage>::GetObjectMap() const
{
  return m_Objects.get();
}

} // end namespace itk

#endif
