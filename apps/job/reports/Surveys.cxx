// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Surveys.h"

#include <string_view>

namespace medialvoxel
{
namespace
{

/** Digits of the number of bytes of a survey, which are before these. */
constexpr std::size_t LengthBytes = 8;

std::string
PackPart(const std::string & part)
{
  std::string packed(LengthBytes, '\0');
  for (std::size_t i = 0; i < LengthBytes; ++i)
  {
    packed[i] = static_cast<char>(std::uint64_t{ part.size() } >> (8 * i));
  }
  return packed + part;
}

/** Takes the first part away from \a bytes. */
std::string
TakePart(std::string_view & bytes)
{
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < LengthBytes && i < bytes.size(); ++i)
  {
    length |= std::uint64_t{ static_cast<std::uint8_t>(bytes[i]) } << (8 * i);
  }
  if (bytes.size() < LengthBytes || length > bytes.size() - LengthBytes)
  {
    RefuseSaved();
  }
  const std::string part(bytes.substr(LengthBytes, length));
  bytes.remove_prefix(LengthBytes + length);
  return part;
}

} // namespace

Surveys::Surveys(const VolumeGeometry &       geometry,
                 const itk::MedialVoxelGrid & grid,
                 const SurveyRequest &        settings,
                 std::uint64_t                surplusBytes)
  : m_Survey(geometry, grid, settings.survey)
{
  if (!settings.places.limits.empty())
  {
    m_Places = std::make_unique<PlaceSurvey>(geometry, grid, settings.places, m_Survey.GetAreaUnit(), surplusBytes);
  }
  if (settings.sheet)
  {
    m_Sheet =
      std::make_unique<SheetSurvey>(geometry, m_Survey.GetSums().GetAreas().GetBinWidth(), m_Survey.GetSample());
  }
}

std::vector<PlaceSummary>
Surveys::SummarizePlaces() const
{
  return m_Places ? m_Places->Summarize() : std::vector<PlaceSummary>();
}

void
Surveys::Clear()
{
  m_Survey.Clear();
  if (m_Places)
  {
    m_Places->Clear();
  }
  if (m_Sheet)
  {
    m_Sheet->Clear();
  }
}

std::string
Surveys::Save() const
{
  return PackPart(m_Survey.Save()) + (m_Places ? PackPart(m_Places->Save()) : "") +
         (m_Sheet ? PackPart(m_Sheet->Save()) : "");
}

void
Surveys::Merge(const std::string & bytes)
{
  std::string_view rest = bytes;
  m_Survey.Merge(TakePart(rest));
  if (m_Places)
  {
    m_Places->Merge(TakePart(rest));
  }
  if (m_Sheet)
  {
    m_Sheet->Merge(TakePart(rest));
  }
  if (!rest.empty())
  {
    RefuseSaved();
  }
}

namespace
{

std::uint64_t
GetSurveyBytes(const VolumeGeometry & geometry, const SurveyRequest & settings)
{
  return Survey::GetBytes(geometry, settings.survey) +
         (settings.places.limits.empty() ? 0 : PlaceSurvey::GetBytes(geometry, settings.places));
}

} // namespace

std::uint64_t
Surveys::GetBytes(const VolumeGeometry & geometry, const SurveyRequest & settings)
{
  return GetSurveyBytes(geometry, settings) + (settings.sheet ? SheetSurvey::GetBytes(geometry) : 0);
}

std::uint64_t
Surveys::GetSavedBytes(const VolumeGeometry & geometry, const SurveyRequest & settings)
{
  return GetSurveyBytes(geometry, settings) + (settings.sheet ? SheetSurvey::GetSavedBytes(geometry) : 0);
}

} // end namespace medialvoxel
