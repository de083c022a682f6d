// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurveys_h
#define medialvoxelSurveys_h

#include "PlaceSurvey.h"
#include "SheetSurvey.h"
#include "Survey.h"

#include <memory>
#include <string>

namespace medialvoxel
{

/** What an extraction finds out about its medial cells. */
struct SurveyRequest
{
  SurveySettings survey;
  PlaceSettings  places;         ///< without limits: none are looked for
  bool           sheet{ false }; ///< points of the sheet, to be shown
};

/** \class Surveys
 * \brief The surveys of a run, which go from one process to another together. */
class Surveys
{
public:
  /** \param surplusBytes as PlaceSurvey has it */
  Surveys(const VolumeGeometry &       geometry,
          const itk::MedialVoxelGrid & grid,
          const SurveyRequest &        settings,
          std::uint64_t                surplusBytes);

  Survey &
  GetSurvey()
  {
    return m_Survey;
  }
  const Survey &
  GetSurvey() const
  {
    return m_Survey;
  }

  /** Null when no places are looked for. */
  PlaceSurvey *
  GetPlaces() const
  {
    return m_Places.get();
  }

  /** Null when the sheet is not to be shown. */
  SheetSurvey *
  GetSheet() const
  {
    return m_Sheet.get();
  }

  /** None of the kinds that are not looked for. */
  std::vector<PlaceSummary>
  SummarizePlaces() const;

  /** Forgets all tiles. */
  void
  Clear();

  /** All that was found, as bytes that any machine reads. */
  std::string
  Save() const;

  /** Adds what others with the same arguments have found, in the order of their slices. \throw JobError Failure when
   * these are not their bytes */
  void
  Merge(const std::string & bytes);

  /** Memory that they take, beside a surplus. */
  static std::uint64_t
  GetBytes(const VolumeGeometry & geometry, const SurveyRequest & settings);

  /** Memory while they are saved, beside. */
  static std::uint64_t
  GetSavedBytes(const VolumeGeometry & geometry, const SurveyRequest & settings);

private:
  Survey                       m_Survey;
  std::unique_ptr<PlaceSurvey> m_Places;
  std::unique_ptr<SheetSurvey> m_Sheet;
};

} // end namespace medialvoxel

#endif
