// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallPass_h
#define itkMedialVoxelWallPass_h

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelWallBalls.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{

/** \class MedialVoxelWallPass
 * \brief Finds the walls around a region before they are painted: an extraction of the cells whose balls are not known.
 * \ingroup MedialVoxel
 */
class MedialVoxelWallPass
{
public:
  /** \param settings  of a local thickness with walls */
  MedialVoxelWallPass(const MedialVoxelGrid & grid, const MedialVoxelEngineSettings & settings);

  const MedialVoxelWallBalls &
  GetBalls() const
  {
    return *m_Balls;
  }

  /** As those of the engine, for the cells around a region. */
  std::uint64_t
  GetBytes(const MedialVoxelBox & region) const
  {
    return m_Extraction.GetBytes(m_Painter.GetCellBox(region));
  }
  std::int64_t
  GetSlabThickness(const MedialVoxelBox & region) const
  {
    return m_Extraction.GetSlabThickness(m_Painter.GetCellBox(region));
  }

  /** Boxes of object voxels that the first step lacks. */
  std::vector<MedialVoxelBox>
  GetMissingObjectBoxes(const MedialVoxelBox & region) const;

  /** Share of the time of a region that its extraction takes: 0 when all balls are known. */
  double
  GetShare(const MedialVoxelBox & region) const;

  /** Find the balls that reach the region.
   *
   * \return seconds, and voxels that took two attempts */
  MedialVoxelSums
  Run(const MedialVoxelBox & region, MedialVoxelObjectSource & source, MedialVoxelEngineClient & client);

private:
  MedialVoxelWallPainter                m_Painter;
  std::shared_ptr<MedialVoxelWallBalls> m_Balls;
  MedialVoxelEngine                     m_Extraction;
};

/** \class MedialVoxelStepClient
 * \brief The client of one of several steps of a run.
 * \ingroup MedialVoxel
 */
class MedialVoxelStepClient : public MedialVoxelEngineClient
{
public:
  /** The step takes the progress from \a first to \a last. */
  MedialVoxelStepClient(MedialVoxelEngineClient & client, double first, double last)
    : m_Client(client)
    , m_First(first)
    , m_Last(last)
  {}

  void
  RunWorkers(const unsigned int numberOfWorkers, const std::function<void()> & work) override
  {
    m_Client.RunWorkers(numberOfWorkers, work);
  }

  /** The last step has the results. */
  void
  TakeTile(const MedialVoxelTileResult & tile) override
  {
    if (m_Last == 1.0)
    {
      m_Client.TakeTile(tile);
    }
  }

  void
  UpdateProgress(const float fraction) override
  {
    m_Client.UpdateProgress(static_cast<float>(m_First + (m_Last - m_First) * static_cast<double>(fraction)));
  }

  bool
  IsAborted() const override
  {
    return m_Client.IsAborted();
  }

  std::exception_ptr
  GetAbortException() const override
  {
    return m_Client.GetAbortException();
  }

private:
  MedialVoxelEngineClient & m_Client;
  double                    m_First;
  double                    m_Last;
};

} // end namespace itk

#endif
