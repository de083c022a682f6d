// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ExtractSummary.h"

#include "Preview.h"
#include "Report.h"
#include "ReturnParameters.h"
#include "SurveySummary.h"
#include "ThicknessPreview.h"
#include "Warnings.h"

namespace medialvoxel
{

ExtractSummary::ExtractSummary(const ExtractOptions & options, OutputSet & outputs)
  : m_Options(options)
  , m_ThicknessCsv(outputs.AddFile(options.thicknessCsvFile))
  , m_Preview(outputs.AddFile(options.previewFile))
  , m_Html(outputs.AddFile(options.htmlFile))
  , m_Report(outputs.AddFile(GetReportFile(options)))
  , m_ReturnParameters(outputs.AddFile(options.returnParameterFile))
{}

void
ExtractSummary::Draw(const VolumeGeometry & geometry,
                     const Survey &         survey,
                     const VoxelOutput *    labels,
                     const VoxelOutput *    thicknesses)
{
  if (!m_Preview && !m_Html)
  {
    return;
  }
  const Canvas canvas = DrawPreview(*labels, geometry, survey);
  m_Pictures.labels = canvas.EncodePng();
  std::string preview = m_Pictures.labels;
  if (thicknesses)
  {
    const Canvas other =
      DrawThicknessPreview(*labels, *thicknesses, geometry, survey, m_Options.voxelUnits ? "VOXELS" : "UNITS");
    m_Pictures.thicknesses = other.EncodePng();
    preview = JoinCanvases(canvas, other).EncodePng();
  }
  if (m_Preview)
  {
    WriteText(*m_Preview, preview);
  }
}

void
ExtractSummary::Write(const Survey & survey, JobResult & result)
{
  result.thickness = Summarize(survey);
  const std::vector<Warning> found = FindWarningsOfResult(m_Options, result, survey);
  result.warnings.insert(result.warnings.end(), found.begin(), found.end());
  if (m_ThicknessCsv)
  {
    WriteText(*m_ThicknessCsv, MakeThicknessCsv(survey));
  }
  if (m_Html)
  {
    WriteText(*m_Html, MakeHtmlReport(m_Options, result, m_Pictures));
  }
  if (m_Report)
  {
    WriteText(*m_Report, MakeReport(m_Options, result));
  }
  if (m_ReturnParameters)
  {
    WriteText(*m_ReturnParameters, MakeReturnParameters(result));
  }
}

} // end namespace medialvoxel
