// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelWallPass.h"

#include <variant>

namespace itk
{

namespace
{

/** Share of the progress of the extraction beside the painting, which is short. */
constexpr double ShareOfExtraction = 0.9;

const MedialVoxelLocalThickness &
ThicknessOf(const MedialVoxelEngineSettings & settings)
{
  return std::get<MedialVoxelLocalThickness>(settings.task);
}

std::shared_ptr<MedialVoxelWallBalls>
MakeBalls(const MedialVoxelGrid & grid, const MedialVoxelLocalThickness & thickness)
{
  return thickness.balls ? thickness.balls : std::make_shared<MedialVoxelWallBalls>(grid, thickness);
}

MedialVoxelEngineSettings
GetExtraction(MedialVoxelEngineSettings settings, MedialVoxelWallBalls & balls)
{
  const MedialVoxelSheetExtraction walls = *ThicknessOf(settings).walls;
  MedialVoxelSheetExtraction       extraction;
  extraction.parameters = walls.parameters;
  extraction.grayRange = walls.grayRange;
  extraction.AddObserver(balls);
  settings.task = extraction;
  return settings;
}

} // namespace

MedialVoxelWallPass::MedialVoxelWallPass(const MedialVoxelGrid & grid, const MedialVoxelEngineSettings & settings)
  : m_Painter(grid, 0.5 * ThicknessOf(settings).maximumThickness)
  , m_Balls(MakeBalls(grid, ThicknessOf(settings)))
  , m_Extraction(grid, GetExtraction(settings, *m_Balls))
{}

std::vector<MedialVoxelBox>
MedialVoxelWallPass::GetMissingObjectBoxes(const MedialVoxelBox & region) const
{
  for (const MedialVoxelBox & cells : m_Balls->FindMissing(m_Painter.GetCellBox(region)))
  {
    const auto missing = m_Extraction.GetMissingObjectBoxes(cells);
    if (!missing.empty())
    {
      return missing;
    }
  }
  return {};
}

double
MedialVoxelWallPass::GetShare(const MedialVoxelBox & region) const
{
  return m_Balls->FindMissing(m_Painter.GetCellBox(region)).empty() ? 0.0 : ShareOfExtraction;
}

MedialVoxelSums
MedialVoxelWallPass::Run(const MedialVoxelBox &    region,
                         MedialVoxelObjectSource & source,
                         MedialVoxelEngineClient & client)
{
  const MedialVoxelBox cells = m_Painter.GetCellBox(region);
  MedialVoxelSums      sums;
  m_Balls->DropBefore(cells);
  const auto missing = m_Balls->FindMissing(cells);
  const auto number = static_cast<double>(missing.size());
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    const auto            done = static_cast<double>(i);
    MedialVoxelStepClient step(client, ShareOfExtraction * done / number, ShareOfExtraction * (done + 1.0) / number);
    m_Balls->BeginRegion(missing[i]);
    sums += m_Extraction.Run(missing[i], source, step);
  }
  sums.counts = {}; // of cells around the region, too
  return sums;
}

} // end namespace itk
