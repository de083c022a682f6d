// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelInput.h"

#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>

namespace itk
{

MedialVoxelLabelInput::MedialVoxelLabelInput(MedialVoxelValueSource &          source,
                                             const MedialVoxelBox &            image,
                                             const std::vector<std::int64_t> & labels,
                                             const std::uint64_t               maximumPoreSize)
  : MedialVoxelInput(source)
  , m_Image(image)
  , m_Labels(labels)
  , m_MaximumPoreSize(maximumPoreSize)
{}

void
MedialVoxelLabelInput::ForEachSpan(const MedialVoxelBox & box, const MedialVoxelValueSource::SpanFunction & function)
{
  MedialVoxelValueSource & source = this->GetSource();
  const std::size_t        bytesPerValue =
    MedialVoxelWithValueType(source.GetValueType(), [](const auto zero) { return sizeof(zero); });
  for (const MedialVoxelBox & span : source.CutIntoSpans(box, std::max(bytesPerValue, sizeof(MedialVoxelObjectNumber))))
  {
    MedialVoxelCheckAbort();
    source.WithBox(span, [&](const MedialVoxelValueView & view) { function(span, view); });
  }
}

void
MedialVoxelLabelInput::Prepare(const Observer & observer)
{
  MedialVoxelLabelSurvey survey(m_Labels, m_Image.upper, m_MaximumPoreSize);
  const double           voxels = static_cast<double>(m_Image.NumberOfVoxels());
  double                 done = 0.0;
  this->ForEachSpan(m_Image, [&](const MedialVoxelBox & span, const MedialVoxelValueView & view) {
    observer(done / voxels);
    done += static_cast<double>(span.NumberOfVoxels());
    MedialVoxelWithValueType(this->GetSource().GetValueType(), [&](const auto zero) {
      const auto * const first = static_cast<decltype(&zero)>(view.values);
      MedialVoxelForEachRow(span, view.strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
        survey.Add(first + offset, static_cast<std::size_t>(row.Extent(0)));
      });
    });
  });
  const MedialVoxelLabelSurvey::Result found = survey.Finish();
  m_MissingLabels = found.missing;
  this->Learn(found);
}

void
MedialVoxelLabelInput::ReadObjects(const MedialVoxelBox & box, MedialVoxelObjectNumber * objects)
{
  this->ForEachSpan(box, [&](const MedialVoxelBox & span, const MedialVoxelValueView & view) {
    MedialVoxelWithValueType(this->GetSource().GetValueType(), [&](const auto zero) {
      const auto * const first = static_cast<decltype(&zero)>(view.values);
      MedialVoxelForEachRow(span, view.strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
        const auto width = static_cast<std::size_t>(row.Extent(0));
        this->GetTable().Translate(first + offset, width, objects);
        objects += width;
      });
    });
  });
}

void
MedialVoxelLabelInput::Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets)
{
  if (targets.object == nullptr)
  {
    return;
  }
  MedialVoxelBits * const notANumber = this->GetShownPass() == 0 ? targets.notANumber : nullptr;
  const auto              isShown = [this](const MedialVoxelObjectNumber object) { return this->IsShown(object); };
  this->ForEachSpan(box, [&](const MedialVoxelBox & span, const MedialVoxelValueView & view) {
    MedialVoxelWithValueType(this->GetSource().GetValueType(), [&](const auto zero) {
      const auto * const                   first = static_cast<decltype(&zero)>(view.values);
      std::vector<MedialVoxelObjectNumber> numbers(static_cast<std::size_t>(span.Extent(0)));
      MedialVoxelForEachRow(span, view.strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
        this->GetTable().Translate(first + offset, numbers.size(), numbers.data());
        MedialVoxelPackBox(numbers.data(), {}, row, isShown, *targets.object);
      });
      if (notANumber != nullptr)
      {
        const auto isNotANumber = [](const auto value) { return value != value; };
        MedialVoxelPackBox(first, view.strides, span, isNotANumber, *notANumber);
      }
    });
  });
}

} // end namespace itk
