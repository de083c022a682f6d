// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSurface.h"

#include "itkMedialVoxelSurfaceObserver.h"
#include "itkMedialVoxelSurfaceStore.h"

namespace itk
{

class MedialVoxelSurface::Implementation
{
public:
  Implementation(const Settings & settings, MedialVoxelSurfaceConsumer & consumer)
    : m_Settings(settings)
    , m_Consumer(consumer)
    , m_Store(settings.placement.FitsFloat(settings.grid.GetSize()))
    , m_Observer(settings.grid,
                 settings.parameters,
                 settings.spacing,
                 settings.placement,
                 this->LeavesOut() ? static_cast<MedialVoxelSurfaceConsumer &>(m_Store) : consumer)
  {}

  bool
  LeavesOut() const
  {
    return m_Settings.smallestComponent > 1 || m_Settings.minimumBranchLength > 0.0;
  }

  void
  Finish()
  {
    m_Observer.Finish();
    if (m_Settings.minimumBranchLength > 0.0)
    {
      m_Store.RemoveBranches(m_Settings.minimumBranchLength);
    }
    if (m_Settings.smallestComponent > 1)
    {
      m_Store.RemoveSmallComponents(m_Settings.smallestComponent);
    }
    m_Store.HandOn(m_Consumer);
  }

  Settings                     m_Settings;
  MedialVoxelSurfaceConsumer & m_Consumer;
  MedialVoxelSurfaceStore      m_Store; ///< empty when nothing is left out
  MedialVoxelSurfaceObserver   m_Observer;
};

MedialVoxelSurface::MedialVoxelSurface(const Settings & settings, MedialVoxelSurfaceConsumer & consumer)
  : m_Implementation(std::make_unique<Implementation>(settings, consumer))
{}

MedialVoxelSurface::~MedialVoxelSurface() = default;

MedialVoxelTileObserver &
MedialVoxelSurface::GetObserver()
{
  return m_Implementation->m_Observer;
}

void
MedialVoxelSurface::Finish()
{
  m_Implementation->Finish();
}

} // end namespace itk
