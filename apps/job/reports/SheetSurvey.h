// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetSurvey_h
#define medialvoxelSheetSurvey_h

#include "CellSample.h"
#include "PartBlocks.h"
#include "SheetPoints.h"
#include "ProductFootprint.h"
#include "TileSurvey.h"

#include <cstdint>
#include <mutex>
#include <string>

namespace medialvoxel
{

/** \class SheetSurvey
 * \brief The medial sheet and its part, coarse enough to be looked at as a whole, taken while the tiles of a run are at
 * hand.
 *
 * It has no cells measured itself. */
class SheetSurvey : public TileSurvey
{
public:
  /** \param lengthUnit of which the thickness of a cell, and the one of its importance, is a multiple, in the units of
   * the grid
   * \param sample      of the cells whose thickness counts */
  SheetSurvey(const VolumeGeometry & geometry, double lengthUnit, const CellSample & sample = {});

  /** The sums of the blocks of a tile, and its counts. */
  static constexpr std::uint64_t PerVoxelOfTile = 2;

  std::uint64_t
  GetBytesPerVoxel() const override
  {
    return PerVoxelOfTile;
  }

  void
  Begin() override;

  void
  Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) override;

  void
  Commit() override;

  void
  Clear() override;

  const SheetPoints &
  GetPoints() const
  {
    return m_Total;
  }

  const PartBlocks &
  GetPart() const
  {
    return m_Part;
  }

  double
  GetLengthUnit() const
  {
    return m_LengthUnit;
  }

  std::string
  Save() const override;

  void
  Merge(const std::string & bytes) override;

  /** Memory of a run. */
  static ProductFootprint
  GetFootprint(const VolumeGeometry & geometry, bool hasImportance);

private:
  double      m_LengthUnit;
  CellSample  m_Sample;
  SheetPoints m_Pending;
  SheetPoints m_Total;
  PartBlocks  m_PendingPart;
  PartBlocks  m_Part;
  std::mutex  m_Mutex; // of the pending tiles
};

} // end namespace medialvoxel

#endif
