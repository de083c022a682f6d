// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelImportance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

namespace itk
{
namespace
{

double
GetCap(const MedialVoxelParameters & parameters)
{
  return parameters.mode == MedialVoxelThicknessMode::Fixed
           ? parameters.epsilon
           : std::max(parameters.epsilon, MedialVoxelParameters::EpsilonFromThickness(2.0 * parameters.largestRadius));
}

/** Longer than each edge of the boundary, so that neighbors are trivial. */
double
GetTrivialLength(const MedialVoxelGrid & grid)
{
  return 2.0 * grid.GetLongestEdge();
}

} // namespace

MedialVoxelImportance::MedialVoxelImportance(const MedialVoxelGrid & grid, const MedialVoxelParameters & parameters)
  : m_Grid(grid)
  , m_Parameters(parameters)
  , m_Threshold(grid, parameters)
  , m_Cap(GetCap(parameters))
  , m_Pairs(grid, GetTrivialLength(grid))
  , m_Blocks(grid)
  , m_Separation(grid)
  , m_Search(grid)
{}

MedialVoxelBox
MedialVoxelImportance::Compute(const MedialVoxelWindow &   window,
                               const MedialVoxelBox &      tile,
                               const MedialVoxelFeatures & features,
                               const MedialVoxelProgress & progress,
                               Workspace &                 workspace,
                               std::vector<float> &        importance) const
{
  auto & queries = workspace.m_Queries;
  queries.clear();
  importance.assign(static_cast<size_t>(tile.NumberOfVoxels()), 0.0F);
  MedialVoxelAbortChecker checker;
  m_Pairs.Visit(*window.object, features, tile, [&](MedialVoxelCells & cells) {
    checker.Count(static_cast<std::uint32_t>(cells.number));
    this->AddCells(features, tile, cells, workspace, importance);
    return !progress.IsAborted();
  });
  const MedialVoxelBits & boundary = *window.sites;
  m_Blocks.Tighten(boundary, progress, workspace.m_Blocks, queries);
  queries.erase(std::remove_if(
                  queries.begin(), queries.end(), [](const auto & query) { return query.bounds.Reach(query.epsilon); }),
                queries.end());
  const MedialVoxelBox missing = m_Separation.FindSeparated(boundary, progress, workspace.m_Separation, queries);
  if (!missing.IsEmpty())
  {
    return missing;
  }
  // Neighboring cells often have the same pair.
  const auto pairOf = [](const MedialVoxelSeparationQuery & query) { return std::tie(query.a, query.b); };
  std::sort(queries.begin(), queries.end(), [&](const auto & i, const auto & j) { return pairOf(i) < pairOf(j); });
  for (auto query = queries.begin(); query != queries.end() && !progress.IsAborted();)
  {
    const auto last =
      std::find_if(query, queries.end(), [&](const auto & other) { return pairOf(other) != pairOf(*query); });
    const float length = static_cast<float>(this->FindLength(boundary, *query, workspace));
    for (; query != last; ++query)
    {
      importance[query->cell] = length;
    }
  }
  return {};
}

void
MedialVoxelImportance::FindThresholds(const std::vector<MedialVoxelInscribedBall> & balls,
                                      const MedialVoxelFeatures &                   features,
                                      const MedialVoxelBox &                        tile,
                                      const std::vector<std::uint8_t> &             labels,
                                      const std::vector<float> &                    importance,
                                      Workspace &                                   workspace,
                                      std::vector<float> &                          thresholds) const
{
  const bool isAutomatic = m_Parameters.mode == MedialVoxelThicknessMode::Automatic;
  auto &     local = workspace.m_Threshold;
  const auto forEachCell = [&](const auto & function) {
    std::size_t      at = 0;
    MedialVoxelIndex cell;
    for (cell[2] = tile.lower[2]; cell[2] < tile.upper[2]; ++cell[2])
    {
      for (cell[1] = tile.lower[1]; cell[1] < tile.upper[1]; ++cell[1])
      {
        for (cell[0] = tile.lower[0]; cell[0] < tile.upper[0]; ++cell[0], ++at)
        {
          if (importance[at] > 0.0F)
          {
            function(cell, at);
          }
        }
      }
    }
  };
  if (isAutomatic)
  {
    local.cells.Reshape(tile);
    forEachCell([&](const MedialVoxelIndex & cell, std::size_t) { local.cells.Set(cell); });
    local.cells.Rank();
    m_Threshold.Compute(balls, features, local);
  }
  thresholds.assign(importance.size(), 0.0F);
  auto radius = local.radii.begin();
  forEachCell([&](const MedialVoxelIndex &, const std::size_t at) {
    thresholds[at] = static_cast<float>(isAutomatic ? m_Threshold.EpsilonOf(*radius++) : m_Parameters.epsilon);
    if (labels[at] < MedialVoxelLabel::MedialByBound && importance[at] >= thresholds[at])
    {
      thresholds[at] = std::nextafter(importance[at], std::numeric_limits<float>::infinity());
    }
    assert(labels[at] < MedialVoxelLabel::MedialByBound || importance[at] >= thresholds[at]);
  });
}

/** The importance of cells that their difference decides; the other ones become queries. */
void
MedialVoxelImportance::AddCells(const MedialVoxelFeatures & features,
                                const MedialVoxelBox &      tile,
                                MedialVoxelCells &          cells,
                                Workspace &                 workspace,
                                std::vector<float> &        importance) const
{
  const std::size_t offset = tile.OffsetOf(cells.first);
  for (auto rest = m_Pairs.FindNontrivial(cells); rest != 0; rest &= rest - 1)
  {
    const int           x = MedialVoxelLowestBit(rest);
    MedialVoxelDiagonal widest;
    if (!m_Pairs.Choose(features, cells, x, widest))
    {
      continue;
    }
    const std::size_t cell = offset + static_cast<std::size_t>(x);
    importance[cell] = static_cast<float>(m_Cap);
    if (m_Pairs.GetCell().FreeSpaceLength(widest.pair.difference) < m_Cap)
    {
      const MedialVoxelIndex b = widest.pair.GetB();
      workspace.m_Queries.push_back({ std::min(widest.pair.a, b), std::max(widest.pair.a, b), m_Cap, cell });
    }
  }
}

/** The geodesic distance, or the cap. */
double
MedialVoxelImportance::FindLength(const MedialVoxelBits &            boundary,
                                  const MedialVoxelSeparationQuery & query,
                                  Workspace &                        workspace) const
{
  if (query.isSeparated)
  {
    return m_Cap;
  }
  const MedialVoxelBox box = MedialVoxelBoundedGeodesic::SearchBoxOf(m_Grid, query.a, query.b, m_Cap);
  if (box.Extent(0) <= MedialVoxelPathSearch::LongestRow)
  {
    const double length = m_Search.FindLength(boundary, box, query.a, query.b, 0.0, m_Cap, workspace.m_Search);
    return std::min(length, m_Cap);
  }
  workspace.m_Graph.Build(boundary, box, MedialVoxelBoundaryGraph::MostNodes);
  const auto source = workspace.m_Graph.NodeOf(query.a);
  const auto target = workspace.m_Graph.NodeOf(query.b);
  workspace.m_Distances.ComputeTowards(workspace.m_Graph, m_Grid, source, target, m_Cap);
  return std::min(workspace.m_Distances.GetLengths()[target], m_Cap);
}

} // end namespace itk
