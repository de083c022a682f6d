// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelTileWalls_h
#define itkMedialVoxelTileWalls_h

#include "itkMedialVoxelClassifier.h"
#include "itkMedialVoxelGrayThickness.h"
#include "itkMedialVoxelThickness.h"

#include "MedialVoxelExport.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** Memory of the rows and walls of a tile, for each of its voxels, at most.
 * \ingroup MedialVoxel */
constexpr std::uint64_t MedialVoxelTileWallsBytesPerVoxel = MedialVoxelCellRow::BytesPerVoxel + sizeof(MedialVoxelWall);

/** \brief Measures the walls at the measured cells of a tile, which are medial.
 *
 * The boundary points of a tile whose features are complete lie where the window knows the boundary, and around there
 * it knows the object, so that walls of any thickness depend on nothing that the window does not hold.
 *
 * \param features  displacements from which the classifier decided the cells
 * \param memory    of any other tile
 * \param walls     resized to the number of measured cells, in the order of the rows and their bits
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT void
MedialVoxelMeasureWalls(const MedialVoxelThickness &            thickness,
                        const MedialVoxelClassifier &           classifier,
                        const MedialVoxelWindow &               window,
                        const MedialVoxelFeatures &             features,
                        const std::vector<MedialVoxelCellRow> & rows,
                        MedialVoxelThickness::Memory &          memory,
                        std::vector<MedialVoxelWall> &          walls);

/** \brief Measures them once more on gray values.
 *
 * \param gray    values that the window of the features knows
 * \param walls   measured on the object
 * \return an empty box, or the box of sites that a window must know so that all values are there, in which case the
 * walls are not complete
 * \ingroup MedialVoxel */
MedialVoxel_EXPORT MedialVoxelBox
MedialVoxelRefineWalls(const MedialVoxelGrayThickness &        thickness,
                       const MedialVoxelClassifier &           classifier,
                       const MedialVoxelGray &                 gray,
                       const MedialVoxelFeatures &             features,
                       const std::vector<MedialVoxelCellRow> & rows,
                       MedialVoxelGrayThickness::Workspace &   workspace,
                       std::vector<MedialVoxelWall> &          walls);

/** \brief Calls function(cell, wall) for the measured cells of rows.
 * \ingroup MedialVoxel */
template <typename TFunction>
void
MedialVoxelForEachWall(const std::vector<MedialVoxelCellRow> & rows,
                       const std::vector<MedialVoxelWall> &    walls,
                       TFunction &&                            function)
{
  auto wall = walls.begin();
  for (const MedialVoxelCellRow & row : rows)
  {
    for (MedialVoxelBits::WordType rest = row.measured; rest != 0; rest &= rest - 1)
    {
      function(MedialVoxelIndex{ { row.first[0] + MedialVoxelLowestBit(rest), row.first[1], row.first[2] } }, *wall++);
    }
  }
}

} // end namespace itk

#endif
