// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTileObservers_h
#define medialvoxelTileObservers_h

#include "itkMedialVoxelTileObserver.h"

#include <vector>

namespace medialvoxel
{

/** \class TileObservers
 * \brief Several observers as one. Only the first one added may ask for more sites: the others see a tile after it. */
class TileObservers : public itk::MedialVoxelTileObserver
{
public:
  void
  Add(itk::MedialVoxelTileObserver & observer)
  {
    m_Observers.push_back(&observer);
  }

  void
  Begin() override
  {
    for (auto * const observer : m_Observers)
    {
      observer->Begin();
    }
  }

  itk::MedialVoxelBits::WordType
  SelectCells(const itk::MedialVoxelCellRow & row) const override
  {
    itk::MedialVoxelBits::WordType cells = 0;
    for (const auto * const observer : m_Observers)
    {
      cells |= observer->SelectCells(row);
    }
    return cells;
  }

  itk::MedialVoxelBox
  Observe(const itk::MedialVoxelClassifiedTile & tile) override
  {
    for (auto * const observer : m_Observers)
    {
      const itk::MedialVoxelBox missing = observer->Observe(tile);
      if (!missing.IsEmpty())
      {
        return missing;
      }
    }
    return {};
  }

  void
  Commit() override
  {
    for (auto * const observer : m_Observers)
    {
      observer->Commit();
    }
  }

private:
  std::vector<itk::MedialVoxelTileObserver *> m_Observers;
};

} // end namespace medialvoxel

#endif
