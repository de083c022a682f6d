// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelInput.h"

#include "itkMedialVoxelObjectPass.h"
#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelProgress.h"
#include "itkMedialVoxelSmoother.h"
#include "itkMedialVoxelThickWalls.h"
#include "itkMedialVoxelValueSides.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <utility>

namespace itk
{
namespace
{

using Numbers = MedialVoxelSmoothingNumbers;
using Smoothing = MedialVoxelEnums::Smoothing;

/** A multiple of the rows of all blocks that are looked at. */
constexpr std::int64_t RowsOfBlocks = 32;

/** A multiple of the rows that are best read together. */
std::int64_t
GetRowsOfStrip(const std::int64_t rowsReadTogether)
{
  return (Numbers::RowsOfStrip + rowsReadTogether - 1) / rowsReadTogether * rowsReadTogether;
}

template <typename TValue>
MedialVoxelObjectPredicate<TValue>
MakePredicate(const MedialVoxelObjectRule & rule)
{
  using PredicateType = MedialVoxelObjectPredicate<TValue>;
  if (!rule.background)
  {
    return PredicateType::InRange(rule.lower, rule.upper);
  }
  if constexpr (std::is_floating_point<TValue>::value)
  {
    return PredicateType::DifferentFrom(static_cast<TValue>(rule.background->GetNearestDouble()));
  }
  else
  {
    return PredicateType::DifferentFrom(*rule.background->GetFirstValue<TValue>());
  }
}

/** Packs values of a span to the wanted targets. */
template <typename TValue>
void
PackValues(const MedialVoxelValueView &               view,
           const MedialVoxelBox &                     span,
           const MedialVoxelObjectPredicate<TValue> & predicate,
           const MedialVoxelTargets &                 targets)
{
  const auto * const values = static_cast<const TValue *>(view.values);
  const auto         pack = [&](const auto & rule, MedialVoxelBits * const bits) {
    // Bits that stay clear need no look at each voxel.
    if (bits != nullptr && !(view.areEqual && !rule(*values)))
    {
      MedialVoxelPackBox(values, view.strides, span, rule, *bits);
    }
  };
  pack(predicate, targets.object);
  pack([](const TValue value) { return value != value; }, targets.notANumber);
  if (targets.gray != nullptr)
  {
    MedialVoxelCopyBox(values, view.strides, span, *targets.gray);
  }
}

/** Fills strips of a box, each with a margin of values around it. */
template <typename TValue, typename TSmoothingRule>
void
FillSmoothed(MedialVoxelValueSource &                   source,
             const MedialVoxelBox &                     image,
             const MedialVoxelBox &                     box,
             const TSmoothingRule &                     rule,
             const MedialVoxelObjectPredicate<TValue> & predicate,
             const MedialVoxelTargets &                 targets)
{
  MedialVoxelSmoother<TValue, TSmoothingRule> smoother(image, rule);
  MedialVoxelForEachStrip(box, GetRowsOfStrip(source.GetRowsReadTogether()), [&](const MedialVoxelBox & part) {
    MedialVoxelCheckAbort();
    const MedialVoxelBox input = Numbers::GetInputBox(part, image);
    source.WithBox(input, [&](const MedialVoxelValueView & view) {
      const auto * const first = static_cast<const TValue *>(view.values);
      smoother.Run(first, view.strides, part, *targets.object);
      const std::int64_t offset = (part.lower[2] - input.lower[2]) * view.strides[2] +
                                  (part.lower[1] - input.lower[1]) * view.strides[1] + part.lower[0] - input.lower[0];
      PackValues<TValue>(
        { first + offset, view.strides }, part, predicate, { nullptr, targets.notANumber, targets.gray });
    });
  });
}

/** \class RoughnessSum
 * \brief The roughness of parts, which several threads add. */
class RoughnessSum
{
public:
  explicit RoughnessSum(const MedialVoxelBox & image)
    : m_Image(image)
  {}

  void
  Add(const MedialVoxelBits & object, const MedialVoxelBox & part)
  {
    const MedialVoxelRoughness        ofPart = MedialVoxelMeasureRoughness(object, part, m_Image);
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Sum += ofPart;
  }

  const MedialVoxelRoughness &
  Get() const
  {
    return m_Sum;
  }

private:
  MedialVoxelBox       m_Image;
  std::mutex           m_Mutex;
  MedialVoxelRoughness m_Sum;
};

} // namespace

MedialVoxelObjectInput::MedialVoxelObjectInput(MedialVoxelValueSource &      source,
                                               const MedialVoxelBox &        image,
                                               const MedialVoxelObjectRule & rule,
                                               const Smoothing               smoothing)
  : MedialVoxelInput(source)
  , m_Image(image)
  , m_Rule(rule)
  , m_Smoothing(smoothing)
{}

void
MedialVoxelObjectInput::Prepare(const Observer & observer)
{
  const bool measuresRoughness = m_Smoothing == Smoothing::Automatic;
  if (measuresRoughness || m_LookedFor)
  {
    this->ExamineObject(measuresRoughness, observer);
  }
  if (this->IsSmoothed() && !m_Level)
  {
    m_Level = this->FindSmoothingLevel(observer);
  }
}

void
MedialVoxelObjectInput::ExamineObject(const bool measuresRoughness, const Observer & observer)
{
  MedialVoxelValueSource & source = this->GetSource();
  const Smoothing          smoothing = std::exchange(m_Smoothing, Smoothing::Off);
  MedialVoxelObjectPass    pass;
  pass.fill = [this](const auto & box, auto & object) { this->Fill(box, { &object }); };
  pass.forEach = [&source](const auto & boxes, const auto & work) { source.ForEach(boxes, 0, work); };
  pass.observe = observer;
  pass.rows = source.GetRowsReadTogether();
  pass.slices = source.GetSlicesReadTogether();
  RoughnessSum                         roughness(m_Image);
  std::optional<MedialVoxelThickWalls> walls;
  if (m_LookedFor)
  {
    walls.emplace(m_LookedFor->grid, m_LookedFor->maximum);
  }
  pass.Run(m_Image, walls ? walls->GetStep() : 1, [&](const auto & object, const auto & box) {
    if (measuresRoughness)
    {
      pass.forEach(pass.Cut(box, 1), [&](const auto & part) { roughness.Add(object, part); });
    }
    if (walls)
    {
      pass.forEach(pass.Cut(box, RowsOfBlocks), [&](const auto & part) { walls->Add(object, part); });
    }
  });
  m_Smoothing = smoothing;
  if (measuresRoughness)
  {
    m_Roughness = roughness.Get();
    m_Smoothing = m_Roughness->NeedsSmoothing() ? Smoothing::On : Smoothing::Off;
  }
  if (walls)
  {
    m_NeededMaximum = walls->FindNeededMaximum([&observer] { observer(1.0); }, [&source](const auto number, const auto & work) {
      source.ForEach(MedialVoxelValueSource::Boxes(number), 0, [&work](const auto &) { work(); });
    });
  }
}

MedialVoxelSmoothingLevel
MedialVoxelObjectInput::FindSmoothingLevel(const Observer & observer)
{
  constexpr std::int64_t slicesPerStep = 16;
  if (m_Rule.background || m_Rule.lower == m_Rule.upper)
  {
    return {}; // one side has one value
  }
  MedialVoxelValueSource & source = this->GetSource();
  return MedialVoxelWithValueType(source.GetValueType(), [&](const auto zero) {
    using ValueType = std::decay_t<decltype(zero)>;
    const auto            predicate = MakePredicate<ValueType>(m_Rule);
    MedialVoxelValueSides sides;
    std::mutex            mutex;
    const auto            add = [&](const MedialVoxelBox & span, const MedialVoxelValueView & view) {
      MedialVoxelCheckAbort();
      MedialVoxelValueSides ofSpan;
      MedialVoxelForEachRow(span, view.strides, [&](const std::int64_t offset, const MedialVoxelBox & row) {
        ofSpan.Add(static_cast<const ValueType *>(view.values) + offset, row.Extent(0), predicate);
      });
      const std::lock_guard<std::mutex> lock(mutex);
      sides += ofSpan;
    };
    const std::int64_t step = std::max(slicesPerStep, source.GetSlicesReadTogether());
    for (MedialVoxelBox read = m_Image; read.lower[2] < m_Image.upper[2]; read.lower[2] = read.upper[2])
    {
      observer(1.0);
      read.upper[2] = std::min(read.lower[2] + step, m_Image.upper[2]);
      source.ForEach(MedialVoxelObjectPass::Cut(read, source.GetRowsReadTogether()), 0, [&](const auto & part) {
        source.ForEachSpan(part, add);
      });
      if (sides.AreDecided(std::is_integral<ValueType>::value))
      {
        break;
      }
    }
    return sides.GetLevel();
  });
}

std::int64_t
MedialVoxelObjectInput::GetRowsReadTogether() const
{
  const std::int64_t rows = MedialVoxelInput::GetRowsReadTogether();
  return this->IsSmoothed() ? GetRowsOfStrip(rows) : rows;
}

void
MedialVoxelObjectInput::Fill(const MedialVoxelBox & box, const MedialVoxelTargets & targets)
{
  assert(m_Smoothing != Smoothing::Automatic);
  assert(!this->IsSmoothed() || targets.object == nullptr || m_Level);
  MedialVoxelValueSource & source = this->GetSource();
  MedialVoxelWithValueType(source.GetValueType(), [&](const auto zero) {
    using ValueType = std::decay_t<decltype(zero)>;
    const auto predicate = MakePredicate<ValueType>(m_Rule);
    if (!this->IsSmoothed() || targets.object == nullptr)
    {
      source.ForEachSpan(box, [&](const MedialVoxelBox & span, const MedialVoxelValueView & view) {
        MedialVoxelCheckAbort();
        PackValues(view, span, predicate, targets);
      });
      return;
    }
    const auto fill = [&](const auto & rule) { FillSmoothed(source, m_Image, box, rule, predicate, targets); };
    if (m_Level->value)
    {
      fill(MedialVoxelValueSmoothing<ValueType>(*m_Level->value, m_Level->objectIsAbove));
    }
    else
    {
      fill(MedialVoxelMaskSmoothing<ValueType>(predicate));
    }
  });
}

std::uint64_t
MedialVoxelObjectInput::GetBytesToSmooth(const MedialVoxelBox &     image,
                                         const MedialVoxelValueType type,
                                         const std::int64_t         rowsReadTogether)
{
  MedialVoxelBox strip = image;
  strip.upper[1] = std::min(image.upper[1], GetRowsOfStrip(rowsReadTogether) + 2 * Numbers::Margin);
  strip.upper[2] = std::min(image.upper[2], Numbers::SlicesOfStrip + 2 * Numbers::Margin);
  using LargestSmoother = MedialVoxelSmoother<double, MedialVoxelValueSmoothing<double>>;
  const std::size_t bytesPerVoxel = MedialVoxelWithValueType(type, [](const auto zero) { return sizeof(zero); });
  return static_cast<std::uint64_t>(strip.NumberOfVoxels()) * bytesPerVoxel + LargestSmoother::GetBytes();
}

MedialVoxelScanResult
MedialVoxelObjectInput::SurveyScan(const MedialVoxelGrid &                      grid,
                                   const double                                 lower,
                                   const double                                 upper,
                                   const std::optional<MedialVoxelScanLevels> & levels,
                                   const Observer &                             observer,
                                   const unsigned int                           mostThreads)
{
  if (std::isfinite(lower) == std::isfinite(upper))
  {
    return { std::nullopt, "there are two thresholds" };
  }
  if (this->IsSmoothed() && !m_Level->value)
  {
    return MedialVoxelScanResult::OfMask();
  }
  MedialVoxelScanSurvey::Source source;
  source.fill = [this](const auto & box, auto & object, auto & gray) { this->Fill(box, { &object, nullptr, &gray }); };
  source.forEach = [&](const auto & boxes, const auto & work) { this->GetSource().ForEach(boxes, mostThreads, work); };
  source.observe = observer;
  return MedialVoxelScanSurvey(grid, std::isfinite(lower) ? lower : upper, levels).Run(source);
}

} // end namespace itk
