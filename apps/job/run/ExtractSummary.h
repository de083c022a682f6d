// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelExtractSummary_h
#define medialvoxelExtractSummary_h

#include "HtmlReport.h"
#include "OutputSet.h"
#include "Survey.h"

namespace medialvoxel
{

/** \class ExtractSummary
 * \brief The outputs of an extraction that are made at its end: picture, histogram, page, report. */
class ExtractSummary
{
public:
  /** Creates the files that the options ask for. */
  ExtractSummary(const ExtractOptions & options, OutputSet & outputs);

  /** Draws the pictures from the survey and the finished volumes, and writes the preview.
   * \param thicknesses null when they are not wanted */
  void
  Draw(const VolumeGeometry & geometry,
       const Survey &         survey,
       const VoxelOutput *    labels,
       const VoxelOutput *    thicknesses);

  /** Adds the thickness and what it warns of to the result and writes all but the preview. */
  void
  Write(const Survey & survey, JobResult & result);

private:
  const ExtractOptions & m_Options;
  OutputFile *           m_ThicknessCsv;
  OutputFile *           m_Preview;
  OutputFile *           m_Html;
  OutputFile *           m_Report;
  OutputFile *           m_ReturnParameters;
  Pictures               m_Pictures;
};

} // end namespace medialvoxel

#endif
