// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWorkspacePool_h
#define itkMedialVoxelWorkspacePool_h

#include "itkMedialVoxelTileTask.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelWorkspacePool
 * \brief The memory of workers that no worker uses, kept for the next tile, also one of another region.
 *
 * Memory of tiles of another layout may be larger than needed, and is not kept. One thread at a time may call it.
 * \ingroup MedialVoxel
 */
class MedialVoxelWorkspacePool
{
public:
  using Workspace = MedialVoxelTileTask::Workspace;

  /** A workspace for a tile of a layout, of MedialVoxelSlabSchedule::Work; null when there is none. */
  std::unique_ptr<Workspace>
  Take(const std::uint64_t layout)
  {
    if (m_Layout < layout)
    {
      m_Workspaces.clear();
      m_Layout = layout;
    }
    if (m_Layout != layout || m_Workspaces.empty())
    {
      return nullptr;
    }
    std::unique_ptr<Workspace> workspace = std::move(m_Workspaces.back());
    m_Workspaces.pop_back();
    return workspace;
  }

  void
  Return(std::unique_ptr<Workspace> workspace, const std::uint64_t layout)
  {
    if (m_Layout == layout)
    {
      m_Workspaces.push_back(std::move(workspace));
    }
  }

  /** Free all but so many workspaces. */
  void
  KeepAtMost(const std::size_t number)
  {
    m_Workspaces.resize(std::min(m_Workspaces.size(), number));
  }

private:
  std::vector<std::unique_ptr<Workspace>> m_Workspaces;
  std::uint64_t                           m_Layout{ 0 };
};

} // end namespace itk

#endif
