// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshWarnings.h"

#include "FillIn.h"
#include "JobResult.h"
#include "MeshJson.h"
#include "WarningRules.h"

#include <optional>

namespace medialvoxel
{
namespace
{

/** Elements too large for a part lose details narrower than they are. */
std::optional<WarningText>
CheckElements(const JobResult & result)
{
  constexpr double nearlyAll = 0.9;
  if (!result.surface || !result.surface->remeshing || result.surface->remeshing->fineArea <= 0.0)
  {
    return std::nullopt;
  }
  const double share = result.surface->area / result.surface->remeshing->fineArea;
  if (share >= nearlyAll)
  {
    return std::nullopt;
  }
  return WarningText{
    "the mesh has only " + FormatShare(share) +
      " of the area of the sheet: its elements are too large for the rest; a smaller --element-size keeps it",
    { { "area_percent", 100.0 * share } }
  };
}

/** Walls and pieces that a mesh of elements lacks, together more than a part of little weight. */
std::optional<WarningText>
CheckLeftOut(const JobResult & result)
{
  constexpr double little = 0.05;
  if (!result.surface || !result.surface->remeshing)
  {
    return std::nullopt;
  }
  const auto & remeshing = *result.surface->remeshing;
  const double pieces = result.surface->pieces ? result.surface->pieces->area : 0.0;
  double       walls = 0.0;
  for (const itk::MedialVoxelWallLeftOut & wall : remeshing.wallsLeftOut)
  {
    walls += wall.area;
  }
  const double whole = remeshing.fineArea + pieces;
  if (!(walls + pieces > little * whole))
  {
    return std::nullopt;
  }
  return WarningText{ "the mesh lacks " + FormatShare((walls + pieces) / whole) + " of the area of the sheet: " +
                        std::to_string(remeshing.wallsLeftOut.size()) + " walls have no elements, and " +
                        std::to_string(result.surface->pieces ? result.surface->pieces->number : 0) +
                        " pieces are small; mesh.remeshing.left_out of the report lists the walls, a smaller "
                        "--element-size and --min-component-size keep more",
                      { { "area_percent", 100.0 * (walls + pieces) / whole } } };
}

/** Elements that solvers refuse or compute badly with. */
std::optional<WarningText>
CheckQuality(const JobResult & result)
{
  std::string failing;
  const Json  mesh = result.surface ? MakeMeshJson(*result.surface) : Json();
  for (const Json & limit : result.surface && result.surface->quality ? mesh["quality"]["limits"] : Json())
  {
    failing +=
      limit["holds"] ? "" : (failing.empty() ? "" : "; ") + FillIn(std::string("{name}: ") + MeshLimitText, limit);
  }
  return failing.empty()
           ? std::nullopt
           : std::optional<WarningText>({ "the mesh is beyond limits that solvers ask for: " + failing, {} });
}

const std::vector<Rule<JobResult>> MeshRules{ { "coarse_elements", CheckElements },
                                              { "walls_left_out", CheckLeftOut },
                                              { "poor_elements", CheckQuality } };

} // namespace

void
ApplyMeshRules(std::vector<Warning> & warnings, const JobResult & result)
{
  Apply(MeshRules, warnings, result);
}

void
AddMeshCodes(std::vector<std::string> & codes)
{
  AddCodes(MeshRules, codes);
}

} // end namespace medialvoxel
