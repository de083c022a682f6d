// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetInMemory_h
#define medialvoxelSheetInMemory_h

#include "VolumeHeader.h"

#include "itkMedialVoxelSheet.h"
#include "itkMedialVoxelSurfaceConsumer.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace medialvoxel
{

/** \class SheetInMemory
 * \brief The sheet of a job with the cell of each point. */
class SheetInMemory : public itk::MedialVoxelSurfaceConsumer
{
public:
  /** \param memory that it may take, and what is found on it */
  explicit SheetInMemory(std::uint64_t memory);

  /** \throw JobError Refused when it takes more */
  void
  AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices) override;

  void
  AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads) override;

  /** Calls write(slice) for all slices of a volume, with a number of each cell: the smallest of its points, 0 without.
   * \param numbers of the points, above 0 or 0 for none */
  template <typename TWrite>
  void
  ForEachSlice(const VolumeGeometry & geometry, const std::vector<std::uint32_t> & numbers, TWrite && write) const
  {
    const std::uint64_t        perSlice = geometry.GetVoxelsPerSlice();
    std::vector<std::uint32_t> slice(perSlice);
    std::size_t                next = 0;
    for (std::uint64_t z = 0; z < geometry.GetNumberOfVoxels() / perSlice; ++z)
    {
      std::fill(slice.begin(), slice.end(), 0u);
      for (; next < numbers.size() && static_cast<std::uint64_t>(cells[next][2]) == z; ++next)
      {
        const auto &    cell = cells[next];
        std::uint32_t & value =
          slice[static_cast<std::uint64_t>(cell[1]) * geometry.size[0] + static_cast<std::uint64_t>(cell[0])];
        value = value == 0 ? numbers[next] : std::min(value, numbers[next]);
      }
      write(slice);
    }
  }

  itk::MedialVoxelSheet                    sheet;
  std::vector<std::array<std::int32_t, 3>> cells; ///< of the points, by z, y, x

private:
  std::uint64_t m_Most;
};

} // end namespace medialvoxel

#endif
