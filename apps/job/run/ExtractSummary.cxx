// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ExtractSummary.h"

#include "Outputs.h"
#include "PlaceJson.h"
#include "Preview.h"
#include "Report.h"
#include "ResultViews.h"
#include "SurveySummary.h"
#include "ThicknessPreview.h"
#include "Warnings.h"

#include <algorithm>
#include <cstddef>

namespace medialvoxel
{
namespace
{

OutputFile *
AddFile(OutputSet & outputs, const ExtractOptions & options, std::string ExtractOptions::* option)
{
  const auto & kinds = ListOutputKinds(options);
  const auto   kind =
    std::find_if(kinds.begin(), kinds.end(), [option](const auto & known) { return known.option == option; });
  return outputs.AddFile(kind->GetFileName(options));
}

} // namespace

const std::vector<ExtractSummary::Text> ExtractSummary::Texts{
  { &ExtractOptions::thicknessCsvFile, &ExtractSummary::MakeCsv },
  { &ExtractOptions::placesFile, &ExtractSummary::MakePlaces },
  { &ExtractOptions::htmlFile, &ExtractSummary::MakePage },
  { &ExtractOptions::reportFile, &ExtractSummary::MakeJson },
  { &ExtractOptions::returnParameterFile, &ExtractSummary::MakeParameters }
};

ExtractSummary::ExtractSummary(const ExtractOptions & options, const Surveys & surveys, OutputSet & outputs)
  : m_Options(options)
  , m_Surveys(surveys)
  , m_Survey(surveys.GetSurvey())
  , m_Preview(AddFile(outputs, options, &ExtractOptions::previewFile))
{
  for (const Text & text : Texts)
  {
    m_Texts.push_back(AddFile(outputs, options, text.option));
  }
}

void
ExtractSummary::Draw(const OutputSet & outputs, const VolumeGeometry & geometry)
{
  if (!m_Preview && m_Options.htmlFile.empty())
  {
    return;
  }
  const VoxelOutput & labels = *outputs.FindVolume("labels");
  const Canvas        canvas = DrawPreview(labels, geometry, m_Survey);
  m_Pictures.labels = canvas.EncodePng();
  std::string preview = m_Pictures.labels;
  if (const VoxelOutput * const thicknesses = outputs.FindVolume("thickness_map"))
  {
    const Canvas other = DrawThicknessPreview(labels,
                                              *thicknesses,
                                              geometry,
                                              m_Survey,
                                              m_Options.voxelUnits     ? "voxels"
                                              : geometry.inMillimeters ? "mm"
                                                                       : "units");
    m_Pictures.thicknesses = other.EncodePng();
    preview = JoinCanvases(canvas, other).EncodePng();
  }
  if (m_Preview)
  {
    WriteText(*m_Preview, preview);
  }
}

void
ExtractSummary::Write(JobResult & result)
{
  result.thickness = MakeThickness(m_Survey.GetSums(), m_Survey);
  result.uncertainty = MakeUncertainty(m_Survey.GetSums());
  result.places = m_Surveys.SummarizePlaces();
  const std::vector<Warning> found = FindWarningsOfResult(m_Options, result, m_Survey);
  result.warnings.insert(result.warnings.end(), found.begin(), found.end());
  result.report = MakeReport(m_Options, result);
  for (std::size_t i = 0; i < Texts.size(); ++i)
  {
    if (m_Texts[i])
    {
      WriteText(*m_Texts[i], (this->*Texts[i].make)(result));
    }
  }
}

std::string
ExtractSummary::MakeCsv(const JobResult &) const
{
  return MakeThicknessCsv(m_Survey);
}

std::string
ExtractSummary::MakePlaces(const JobResult & result) const
{
  return MakePlacesCsv(result.places);
}

std::string
ExtractSummary::MakePage(const JobResult & result) const
{
  return MakeHtmlReport(result.report,
                        m_Options.command,
                        m_Pictures,
                        { m_Surveys.GetSheet(), GetColorRange(m_Survey.GetSums().GetAreas()) },
                        result.input.geometry);
}

std::string
ExtractSummary::MakeJson(const JobResult & result) const
{
  return FormatReport(result.report);
}

std::string
ExtractSummary::MakeParameters(const JobResult & result) const
{
  return MakeReturnParameters(result.report);
}

} // end namespace medialvoxel
