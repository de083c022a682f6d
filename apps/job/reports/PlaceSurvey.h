// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceSurvey_h
#define medialvoxelPlaceSurvey_h

#include "PlaceJoiner.h"
#include "PlaceSummary.h"
#include "VolumeHeader.h"
#include "ProductFootprint.h"
#include "TileSurvey.h"

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Which places are looked for. */
using PlaceSettings = std::map<PlaceKind, PlaceLimits>;

/** \class PlaceMemoryError
 * \brief The cells of a region take more memory than is planned; smaller regions take less. */
class PlaceMemoryError : public std::runtime_error
{
public:
  /** \param allowedBytes that are planned */
  explicit PlaceMemoryError(std::uint64_t allowedBytes);

  std::uint64_t
  GetAllowedBytes() const
  {
    return m_AllowedBytes;
  }

private:
  std::uint64_t m_AllowedBytes;
};

/** \class PlaceSurvey
 * \brief Finds the places whose walls are too thin or too thick while the tiles of a run are at hand. */
class PlaceSurvey : public TileSurvey
{
public:
  /** \param areaUnit     areas are multiples of it, in squared units of the grid
   * \param surplus for the cells of a region, beside the memory of GetFootprint() */
  PlaceSurvey(const VolumeGeometry &       geometry,
              const itk::MedialVoxelGrid & grid,
              const PlaceSettings &        settings,
              double                       areaUnit,
              std::uint64_t                surplus);

  /** The tiles from now on are of this region; tiles of a region that failed are forgotten. */
  void
  BeginRegion(const itk::MedialVoxelBox & region)
  {
    m_Region = region;
  }

  std::uint64_t
  GetBytesPerVoxel() const override
  {
    return PerVoxelOfTile;
  }

  void
  Begin() override;

  itk::MedialVoxelBits::WordType
  SelectCells(const itk::MedialVoxelCellRow & row) const override;

  /** \throw PlaceMemoryError when the cells take more memory than is planned */
  void
  Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) override;

  void
  Commit() override;

  void
  Clear() override;

  std::string
  Save() const override;

  void
  Merge(const std::string & bytes) override;

  /** Call when all tiles are added. */
  std::vector<PlaceSummary>
  Summarize() const;

  /** Memory of a run, and of its summary. */
  static ProductFootprint
  GetFootprint(const VolumeGeometry & geometry, const PlaceSettings & settings);

private:
  static constexpr std::uint64_t PerVoxelOfTile = 4; ///< thin walls

  /** Places of one kind. */
  struct Search
  {
    PlaceLimits           limits;
    PlaceJoiner           joiner;
    std::deque<PlaceCell> pending;
  };

  std::uint64_t
  GetUsedMemory() const;

  WallPlace
  Describe(const PlaceSums & sums, double lengthUnit) const;

  VolumeGeometry      m_Geometry;
  PlaceGrid           m_Grid;
  double              m_AreaUnit;
  std::uint64_t       m_AllowedBytes; ///< of cells that are pending or open
  itk::MedialVoxelBox m_Region;
  std::mutex          m_Mutex; // of the cells that are pending
  std::vector<Search> m_Searches;
};

} // end namespace medialvoxel

#endif
