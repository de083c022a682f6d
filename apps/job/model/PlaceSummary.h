// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPlaceSummary_h
#define medialvoxelPlaceSummary_h

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** Why a place is listed. */
enum class PlaceKind
{
  Thin,
  Thick
};

constexpr const char *
GetName(PlaceKind kind)
{
  return kind == PlaceKind::Thin ? "thin" : "thick";
}

/** Walls that are beyond a limit, the cells around them that are beyond a second one, and how many of them count. */
struct PlaceLimits
{
  double                limit{ 0.0 }; ///< length > 0; each place has a cell beyond it
  std::optional<double> growLimit{}; ///< all cells are beyond it; unset: an eighth of the limit on the other side of it
  std::optional<double> leastArea{}; ///< of cells beyond the limit; unset: that of ten faces of voxels

  double
  GetGrowLimit(PlaceKind kind) const
  {
    return growLimit.value_or(limit * (kind == PlaceKind::Thin ? 1.125 : 0.875));
  }
};

/** The wall at a medial cell. Points are in physical space, indices count cells; axes that the image lacks are 0. */
struct WallLocation
{
  using Point = std::array<double, 3>;
  using Index = std::array<std::int64_t, 3>;

  std::optional<double> uncertainty;       ///< of its thickness: half of the 95 % interval; unset where it is not known
  Point                 center{};          ///< of the cell
  Index                 index{};           ///< of the cell
  Point                 sideA{};           ///< center of the boundary voxel on one side of the wall
  Point                 sideB{};           ///< of that on the other side
  bool                  isAtEdge{ false }; ///< a voxel of the cell or of the sides is an outermost one of the volume
};

/** Connected medial cells whose walls are too thin or too thick; where the thinnest, or the thickest one is. */
struct WallPlace : WallLocation
{
  std::uint64_t cells{ 0 };
  double        area{ 0.0 };       ///< of the mid-surface, in squared units of the job's lengths; 2-D: a length
  double        areaBeyond{ 0.0 }; ///< of the cells beyond the limit
  double        minimum{ 0.0 };
  double        mean{ 0.0 }; ///< every cell counts the same
  double        maximum{ 0.0 };
  Index         first{}; ///< smallest index of the cells along each axis
  Index         last{};  ///< largest one
};

/** All places of a kind. */
struct PlaceSummary
{
  PlaceKind              kind{ PlaceKind::Thin };
  unsigned int           dimension{ 3 };
  double                 limit{ 0.0 };
  double                 growLimit{ 0.0 };
  double                 minimumPlaceArea{ 0.0 };
  std::uint64_t          number{ 0 };       ///< of places, with the unlisted ones
  std::uint64_t          cells{ 0 };        ///< of all of them
  double                 area{ 0.0 };       ///< of all of them
  double                 areaBeyond{ 0.0 }; ///< of their cells beyond the limit
  std::uint64_t          smaller{ 0 };      ///< places that are left out, as their area beyond the limit is smaller
  std::vector<WallPlace> places;            ///< largest area beyond the limit first, then by z, y, x of the index
};

} // end namespace medialvoxel

#endif
