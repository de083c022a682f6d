// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LabelMap.h"

#include "Errors.h"
#include "Text.h"

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cstddef>

namespace medialvoxel
{
namespace
{

/** In the order of the voxels: slices, or rows of large slices. */
std::vector<itk::MedialVoxelBox>
CutIntoParts(const itk::MedialVoxelBox & box, const VolumeHeader & header)
{
  const std::size_t bytesPerVoxel =
    std::max(sizeof(ObjectNumber), std::size_t{ GetTraits(header.GetValueType()).bytes });
  const auto bytesPerSlice = static_cast<std::uint64_t>(box.Extent(0) * box.Extent(1)) * bytesPerVoxel;
  if (bytesPerSlice <= InputVolume::BytesPerPart)
  {
    return itk::MedialVoxelEngineClient::CutForPull(box, bytesPerVoxel);
  }
  std::vector<itk::MedialVoxelBox> parts;
  for (itk::MedialVoxelBox slice = box; slice.lower[2] < box.upper[2]; ++slice.lower[2])
  {
    slice.upper[2] = slice.lower[2] + 1;
    const auto rows = itk::MedialVoxelEngineClient::CutForPull(slice, bytesPerVoxel);
    parts.insert(parts.end(), rows.begin(), rows.end());
  }
  return parts;
}

} // namespace

LabelMap::LabelMap(const VolumeHeader &   header,
                   const LabelSelection & selection,
                   std::uint64_t          maximumPoreSize,
                   std::uint64_t          bytesToKeep)
  : m_Header(header)
  , m_Selection(selection)
  , m_MaximumPoreSize(maximumPoreSize)
  , m_Readers(header, Interpolation::Nearest, bytesToKeep)
{}

void
LabelMap::Prepare(const ReadObserver & observer)
{
  itk::MedialVoxelLabelSurvey survey(m_Selection.all ? std::vector<std::int64_t>{} : m_Selection.values,
                                     m_Header.geometry.GetVoxelBox().upper,
                                     m_MaximumPoreSize);
  itk::MedialVoxelLabelSurvey::Result found;
  try
  {
    this->MeasureReading([&] { this->Show(survey, observer); });
    found = survey.Finish();
  }
  catch (const itk::MedialVoxelLabelError & error)
  {
    Fail(ExitStatus::CorruptInput, m_Header.fileName.string(), ": ", error.what());
  }
  const std::string resampled =
    m_Header.stored ? ", when it is resampled to " + FormatSize(m_Header.geometry.size) + " voxels" : "";
  if (!found.missing.empty())
  {
    Fail(ExitStatus::Usage, m_Header.fileName.string(), ": no voxel has the label ", found.missing.front(), resampled);
  }
  if (found.values.empty())
  {
    Fail(ExitStatus::Usage, m_Header.fileName.string(), ": all voxels are 0", resampled, "; there is no object");
  }
  this->Learn(found);
  m_NotANumberVoxels = survey.GetNotANumberVoxels();
}

template <typename TFunction>
void
LabelMap::WithValues(const itk::MedialVoxelBox & part, TFunction && function)
{
  const PixelType        type = m_Header.GetValueType();
  const auto             count = static_cast<std::size_t>(part.NumberOfVoxels());
  std::vector<std::byte> bytes(count * GetTraits(type).bytes);
  m_Readers.With([&](ValueReader & reader) { reader.Read(part, bytes.data()); });
  DispatchPixelType(type, [&](auto zero) { function(reinterpret_cast<const decltype(zero) *>(bytes.data()), count); });
}

void
LabelMap::Show(itk::MedialVoxelLabelSurvey & survey, const ReadObserver & observer)
{
  const auto parts = CutIntoParts(m_Header.geometry.GetVoxelBox(), m_Header);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    observer(static_cast<double>(i) / static_cast<double>(parts.size()));
    this->WithValues(parts[i], [&](const auto * values, std::size_t count) { survey.Add(values, count); });
  }
}

void
LabelMap::Translate(const itk::MedialVoxelBox & part, ObjectNumber * objects)
{
  this->WithValues(part,
                   [&](const auto * values, std::size_t count) { this->GetTable().Translate(values, count, objects); });
}

void
LabelMap::ReadObjects(const itk::MedialVoxelBox & box, ObjectNumber * objects)
{
  for (const itk::MedialVoxelBox & part : CutIntoParts(box, m_Header))
  {
    this->MeasureReading([&] { this->Translate(part, objects); });
    objects += part.NumberOfVoxels();
  }
}

itk::MedialVoxelSourceThreads
LabelMap::GetSourceThreads() const
{
  return IsReadInParallel(m_Header) ? itk::MedialVoxelSourceThreads::Several : itk::MedialVoxelSourceThreads::Calling;
}

std::uint64_t
LabelMap::GetNumberOfBytesRead() const
{
  return m_Readers.GetNumberOfBytesRead();
}

void
LabelMap::Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets)
{
  if (targets.object == nullptr)
  {
    return;
  }
  for (const itk::MedialVoxelBox & part : CutIntoParts(box, m_Header))
  {
    itk::MedialVoxelPoll();
    this->FillPart(part, *targets.object);
  }
}

void
LabelMap::FillPart(const itk::MedialVoxelBox & part, itk::MedialVoxelBits & bits)
{
  std::vector<ObjectNumber> objects(static_cast<std::size_t>(part.NumberOfVoxels()));
  this->MeasureReading([&] { this->Translate(part, objects.data()); });
  const itk::MedialVoxelStrides strides{ 1, part.Extent(0), part.Extent(0) * part.Extent(1) };
  const auto                    isShown = [this](ObjectNumber object) { return this->IsShown(object); };
  itk::MedialVoxelPackBox(objects.data(), strides, part, isShown, bits);
}

} // end namespace medialvoxel
