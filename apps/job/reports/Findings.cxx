// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Findings.h"

namespace medialvoxel
{
namespace
{

/** Digits of the number of bytes of the survey, which are before those of the places. */
constexpr std::size_t LengthBytes = 8;

} // namespace

Findings::Findings(const VolumeGeometry &       geometry,
                   const itk::MedialVoxelGrid & grid,
                   const FindingSettings &      settings,
                   std::uint64_t                surplusBytes)
  : m_Survey(geometry, grid, settings.survey)
{
  if (!settings.places.limits.empty())
  {
    m_Places = std::make_unique<PlaceSurvey>(geometry, grid, settings.places, m_Survey.GetAreaUnit(), surplusBytes);
  }
}

std::vector<PlaceSummary>
Findings::SummarizePlaces() const
{
  return m_Places ? m_Places->Summarize() : std::vector<PlaceSummary>();
}

void
Findings::Clear()
{
  m_Survey.Clear();
  if (m_Places)
  {
    m_Places->Clear();
  }
}

std::string
Findings::Save() const
{
  const std::string survey = m_Survey.Save();
  if (!m_Places)
  {
    return survey;
  }
  std::string length(LengthBytes, '\0');
  for (std::size_t i = 0; i < LengthBytes; ++i)
  {
    length[i] = static_cast<char>(std::uint64_t{ survey.size() } >> (8 * i));
  }
  return length + survey + m_Places->Save();
}

void
Findings::Merge(const std::string & bytes)
{
  if (!m_Places)
  {
    m_Survey.Merge(bytes);
    return;
  }
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < LengthBytes && i < bytes.size(); ++i)
  {
    length |= std::uint64_t{ static_cast<std::uint8_t>(bytes[i]) } << (8 * i);
  }
  if (bytes.size() < LengthBytes || length > bytes.size() - LengthBytes)
  {
    RefusePart();
  }
  m_Survey.Merge(bytes.substr(LengthBytes, length));
  m_Places->Merge(bytes.substr(LengthBytes + length));
}

std::uint64_t
Findings::GetBytes(const VolumeGeometry & geometry, const FindingSettings & settings)
{
  return Survey::GetBytes(geometry, settings.survey) +
         (settings.places.limits.empty() ? 0 : PlaceSurvey::GetBytes(geometry, settings.places));
}

} // end namespace medialvoxel
