// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelExtractSummary_h
#define medialvoxelExtractSummary_h

#include "Surveys.h"
#include "FinishJob.h"
#include "HtmlReport.h"
#include "Options.h"
#include "OutputSet.h"

#include <vector>

namespace medialvoxel
{

/** \class ExtractSummary
 * \brief The outputs of an extraction that are made at its end: picture, histogram, page, report. */
class ExtractSummary : public JobSummary
{
public:
  /** Creates the files that the options ask for. \param surveys of the whole volume when the first output is made */
  ExtractSummary(const ExtractOptions & options, const Surveys & surveys, OutputSet & outputs);

  /** Draws the pictures from the survey and the finished volumes, and writes the preview. */
  void
  Draw(const OutputSet & outputs, const VolumeGeometry & geometry) override;

  /** Adds the thickness and what it warns of to the result and writes all but the preview. */
  void
  Write(JobResult & result) override;

private:
  /** A text, and who makes it. */
  struct Text
  {
    std::string ExtractOptions::* option;
    std::string (ExtractSummary::*make)(const JobResult &) const;
  };

  static const std::vector<Text> Texts;

  std::string
  MakeCsv(const JobResult & result) const;

  std::string
  MakePlaces(const JobResult & result) const;

  std::string
  MakePage(const JobResult & result) const;

  std::string
  MakeJson(const JobResult & result) const;

  std::string
  MakeParameters(const JobResult & result) const;

  const ExtractOptions &    m_Options;
  const Surveys &           m_Surveys;
  const Survey &            m_Survey;
  std::vector<OutputFile *> m_Texts; ///< in the order of the table; null where none is wanted
  OutputFile *              m_Preview;
  Pictures                  m_Pictures;
};

} // end namespace medialvoxel

#endif
