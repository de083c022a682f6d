// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurvey_h
#define medialvoxelSurvey_h

#include "CellSample.h"
#include "PlaceSums.h"
#include "PreviewLayout.h"
#include "VolumeHeader.h"

#include "ThicknessSums.h"
#include "ProductFootprint.h"
#include "TileSurvey.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** The task of a survey. */
struct SurveySettings
{
  bool picture{ false }; ///< which slices to show, and the projection along the last axis

  /** Voxels of the largest volume of which all medial cells count. */
  std::uint64_t fullyMeasuredVoxels{ std::uint64_t{ 1 } << 23 };
};

/** \class Survey
 * \brief Statistics of the medial cells, taken while the tiles of a run are at hand.
 *
 * All of it is sums of whole numbers and maxima, which do not depend on the order of the tiles. Memory depends on the
 * size of the picture and on the length of the axes, and for a map of blocks that have an object on one bit for 16384
 * voxels. Of a large volume only a sample of the cells counts, though others may be measured for a map or for places.
 */
class Survey : public TileSurvey
{
public:
  Survey(const VolumeGeometry & geometry, const itk::MedialVoxelGrid & grid, const SurveySettings & settings);

  /** Bytes of thin walls and their noise in a tile. */
  static constexpr std::uint64_t PerVoxelOfTile = 2;

  std::uint64_t
  GetBytesPerVoxel() const override
  {
    return PerVoxelOfTile;
  }

  std::unique_ptr<Workspace>
  MakeWorkspace() const override;

  void
  Begin() override;

  void
  Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) override;

  void
  Commit() override;

  itk::MedialVoxelBits::WordType
  SelectCells(const itk::MedialVoxelCellRow & row) const override;

  void
  Clear() override;

  std::string
  Save() const override;

  void
  Merge(const std::string & bytes) override;

  /** Sums of the walls at the cells that count. Bins are a 64th of the smallest spacing of the grid, areas multiples
   * of GetAreaUnit(). */
  const ThicknessSums &
  GetSums() const
  {
    return m_Total.thickness;
  }

  /** Unit of areas in the sums, in squared units of the lengths; in two dimensions unit of the longest edge. */
  double
  GetAreaUnit() const
  {
    return m_AreaUnit;
  }

  /** The medial cells that count. */
  const CellSample &
  GetSample() const
  {
    return m_Sample;
  }

  /** Where the thinnest wall of the cells that count is; of several the first one by z, y, x. Unset without any. */
  std::optional<WallLocation>
  FindThinnest() const;

  unsigned int
  GetDimension() const
  {
    return m_Geometry.GetDimension();
  }

  /** Index of the slice across \a axis that shows most of the sheets, among the inner nine tenths; the middle one when
   * there are no medial cells.
   *
   * A sheet that a slice cuts across is a line in it; a sheet that lies in the slice is a blot that shows little. So
   * a cell counts 2 for the slices that cut its wall, and -1 for the one across the direction of its wall. */
  std::uint64_t
  GetBestSlice(unsigned int axis) const;

  /** False when all cells of the block of 64 x 16 x 16 that the cell is in are known to be 0. */
  bool
  MayHaveLabels(std::uint64_t x, std::uint64_t y, std::uint64_t z) const;

  static constexpr unsigned int BlockShiftX = 6;
  static constexpr unsigned int BlockShiftYZ = 4;

  /** A pixel of the projection along the last axis, or a voxel where voxels are larger. */
  struct ProjectedPixel
  {
    std::uint8_t  label{ 0 };       ///< largest label of all cells that it covers
    std::uint32_t medialCells{ 0 }; ///< their number
    std::uint32_t thickest{ 0 };    ///< largest bin of a measured cell, also outside of the sample; 0: none
  };
  using Projection = std::vector<ProjectedPixel>;

  /** x fastest. */
  const Projection &
  GetProjection() const
  {
    return m_Total.projection;
  }

  const std::array<unsigned int, 2> &
  GetProjectionSize() const
  {
    return m_ProjectionSize;
  }

  /** Memory of a run, with the results of a tile. */
  static ProductFootprint
  GetFootprint(const VolumeGeometry & geometry, const SurveySettings & settings);

private:
  struct SliceSums
  {
    std::int64_t  score{ 0 };
    std::uint64_t cells{ 0 };
  };

  struct Sums
  {
    explicit Sums(double binWidth)
      : thickness(binWidth)
    {}
    ThicknessSums                         thickness;
    PlaceCell                             thinnest{ 0, std::numeric_limits<float>::infinity() };
    std::array<std::vector<SliceSums>, 3> slices;
    Projection                            projection;
  };

  struct TileSums;

  void
  Resize(Sums & sums) const;

  std::size_t
  GetBin(const itk::MedialVoxelWall & wall) const;

  void
  AddWall(const itk::MedialVoxelClassifiedTile & tile,
          const itk::MedialVoxelIndex &          cell,
          const itk::MedialVoxelWall &           wall,
          TileSums &                             sums) const;

  void
  AddToTotal(const Sums & sums);

  /** The members that other processes get. */
  template <typename TSums, typename TNumbers>
  static void
  Exchange(TSums & sums, TNumbers & numbers);

  void
  AddSums(const itk::MedialVoxelClassifiedTile & tile, const TileSums & sums);

  void
  AddProjection(const TileSums & sums);

  void
  MarkBlock(const itk::MedialVoxelCellRow & row);

  std::size_t
  GetBlock(std::uint64_t x, std::uint64_t y, std::uint64_t z) const;

  VolumeGeometry                           m_Geometry;
  itk::MedialVoxelGrid                     m_Grid;
  PlaceGrid                                m_Cells;
  SurveySettings                           m_Settings;
  CellSample                               m_Sample;
  double                                   m_AreaUnit{ 1.0 };
  std::array<unsigned int, 2>              m_ProjectionSize{ { 0, 0 } };
  std::array<std::vector<unsigned int>, 2> m_PixelOf; ///< by axis and index
  std::vector<bool>                        m_Blocks;
  Sums                                     m_Pending;
  Sums                                     m_Total;
  std::mutex                               m_Mutex;
};

} // end namespace medialvoxel

#endif
