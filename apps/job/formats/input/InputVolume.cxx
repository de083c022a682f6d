// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "InputVolume.h"

#include "ObjectRule.h"

namespace medialvoxel
{
namespace
{

/** Between labels there are no values: not without a threshold, and not with one value for both. A label has no
 * thresholds. */
Interpolation
GetInterpolation(const JobOptions & options)
{
  const bool hasThreshold = options.lowerThreshold || options.upperThreshold;
  return hasThreshold && options.lowerThreshold != options.upperThreshold ? Interpolation::Linear
                                                                          : Interpolation::Nearest;
}

} // namespace

InputVolume::InputVolume(const VolumeHeader & header,
                         const JobOptions &   options,
                         std::uint64_t        bytesToKeep,
                         Smoothing            smoothing)
  : m_Source(header, GetInterpolation(options), bytesToKeep)
  , m_Input(std::make_unique<itk::MedialVoxelObjectInput>(m_Source,
                                                          header.geometry.GetVoxelBox(),
                                                          GetObjectRule(options),
                                                          smoothing))
{}

InputVolume::InputVolume(const VolumeHeader & header, std::uint64_t bytesToKeep)
  : m_Source(header, Interpolation::Nearest, bytesToKeep)
{}

std::optional<itk::MedialVoxelRoughness>
InputVolume::GetRoughness() const
{
  const auto * const object = this->GetObject();
  return object != nullptr ? object->GetRoughness() : std::nullopt;
}

std::optional<itk::MedialVoxelSmoothingLevel>
InputVolume::GetSmoothingLevel() const
{
  const auto * const object = this->GetObject();
  return object != nullptr ? object->GetSmoothingLevel() : std::nullopt;
}

void
InputVolume::UseSmoothingLevel(const std::optional<itk::MedialVoxelSmoothingLevel> & level)
{
  dynamic_cast<itk::MedialVoxelObjectInput &>(*m_Input).UseSmoothingLevel(level);
}

void
InputVolume::LookForThickWalls(const itk::MedialVoxelGrid & grid, double maximum)
{
  m_DefaultMaximum = maximum;
  dynamic_cast<itk::MedialVoxelObjectInput &>(*m_Input).LookForThickWalls(grid, maximum);
}

std::optional<double>
InputVolume::GetNeededMaximum() const
{
  const auto * const object = this->GetObject();
  return object != nullptr && object->GetNeededMaximum() ? object->GetNeededMaximum() : m_DefaultMaximum;
}

bool
InputVolume::IsReadInParallel(const VolumeHeader & header)
{
  return !header.stored && (header.compressed || header.chunks || header.liesInRows);
}

std::uint64_t
InputVolume::GetBytesToSmooth(const VolumeHeader & header)
{
  const auto & chunks = header.GetStored().chunks;
  const auto   rows = chunks && !header.stored ? static_cast<std::int64_t>(chunks->size[1]) : 1;
  return itk::MedialVoxelObjectInput::GetBytesToSmooth(header.geometry.GetVoxelBox(), header.GetValueType(), rows);
}

} // end namespace medialvoxel
