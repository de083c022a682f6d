// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelReportSummary_h
#define medialvoxelReportSummary_h

#include "FinishJob.h"
#include "Outputs.h"
#include "Report.h"
#include "Warnings.h"

namespace medialvoxel
{

/** \class ReportSummary
 * \brief The end of a job whose only text is its report. */
template <typename TOptions>
class ReportSummary : public JobSummary
{
public:
  /** \param options must outlive it */
  ReportSummary(const TOptions & options, OutputSet & outputs)
    : m_Options(options)
    , m_Report(outputs.AddFile(GetReportFile(options)))
  {}

  void
  Write(JobResult & result) override
  {
    const std::vector<Warning> found = FindWarningsOfResult(m_Options, result);
    result.warnings.insert(result.warnings.end(), found.begin(), found.end());
    result.report = MakeReport(m_Options, result);
    if (m_Report != nullptr)
    {
      WriteText(*m_Report, FormatReport(result.report));
    }
  }

private:
  const TOptions & m_Options;
  OutputFile *     m_Report;
};

} // end namespace medialvoxel

#endif
