// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ReturnParameters.h"

#include "Report.h"
#include "Text.h"

#include <limits>

namespace medialvoxel
{

std::string
MakeReturnParameters(const JobResult & result)
{
  constexpr double               notANumber = std::numeric_limits<double>::quiet_NaN();
  const itk::MedialVoxelCounts & counts = result.sums.counts;
  const PhasePercent             percent = GetPhasePercent(counts).value_or(PhasePercent{ notANumber, notANumber });
  const TextTable                table{ { "objectVoxels", std::to_string(counts.objectVoxels) },
                                        { "candidateCells", std::to_string(counts.candidateCells) },
                                        { "trivialCells", std::to_string(counts.trivialCells) },
                                        { "boundCells", std::to_string(counts.boundCells) },
                                        { "geodesicMedialCells", std::to_string(counts.geodesicMedialCells) },
                                        { "geodesicNonMedialCells", std::to_string(counts.geodesicNonMedialCells) },
                                        { "medialCells", std::to_string(counts.boundCells + counts.geodesicMedialCells) },
                                        { "pseudoPercent", FormatNumber(percent.pseudo) },
                                        { "correctPercent", FormatNumber(percent.correct) },
                                        { "distanceSeconds", FormatNumber(result.seconds.distance) },
                                        { "classificationSeconds", FormatNumber(result.seconds.classification) },
                                        { "totalSeconds", FormatNumber(result.seconds.total) } };
  std::string                    lines;
  for (const auto & [name, value] : table)
  {
    lines += name + " = " + value + "\n";
  }
  return lines;
}

} // end namespace medialvoxel
