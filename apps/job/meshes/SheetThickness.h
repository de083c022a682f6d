// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetThickness_h
#define medialvoxelSheetThickness_h

#include "MeshReader.h"

#include <functional>
#include <optional>

namespace medialvoxel
{

/** Sums over faces or corners, in the order of the file, so that they have the same bits in every run. */
struct ThicknessSums
{
  std::uint64_t number{ 0 };
  double        area{ 0 };
  double        areaTimesThickness{ 0 };
  double        thickness{ 0 };

  void
  Add(double addedArea, double addedThickness);

  /** Weighted by area, or, where there is none, the plain mean. */
  double
  GetMean() const;
};

/** \class SheetEdges
 * \brief The vertices at rims and at junctions: two bits for each vertex. */
class SheetEdges
{
public:
  static constexpr std::uint64_t VerticesPerByte = 4;

  /** Walks over all faces once. */
  explicit SheetEdges(MeshReader & reader);

  const std::vector<bool> &
  GetRims() const
  {
    return m_Rims;
  }
  const std::vector<bool> &
  GetJunctions() const
  {
    return m_Junctions;
  }

  /** How much of the wall a vertex shows. At a rim the nearest boundary points lie on the end of the wall, at a
   * junction in its fork. */
  enum Level : std::uint8_t
  {
    Inside,
    AtJunction,
    AtRim
  };
  Level
  GetLevel(std::uint64_t vertex) const
  {
    return m_Rims[vertex] ? AtRim : m_Junctions[vertex] ? AtJunction : Inside;
  }

private:
  std::vector<bool> m_Rims;
  std::vector<bool> m_Junctions;
};

/** The mean over the corners of the best level that have a known thickness, nothing when none has. */
std::optional<double>
GetFaceThickness(MeshReader & reader, const SheetEdges & edges, const MeshFace & face);

/** The thickness of the wall at a corner: its own one inside of the wall, elsewhere that of the face. */
std::optional<double>
GetCornerThickness(MeshReader & reader, const SheetEdges & edges, const MeshFace & face, unsigned int corner);

/** Calls function(number, thickness) for all vertices in their order, with the thickness of the wall: their own one
 * inside of it, elsewhere the mean by area of their faces, as far as these know better. Nothing where that is unknown.
 * \param keptNumbers as in MeshWriteOptions; walks over all faces once for each quarter as many vertices */
void
ForEachNodeThickness(MeshReader &                                                                       reader,
                     const SheetEdges &                                                                 edges,
                     std::uint64_t                                                                      keptNumbers,
                     const std::function<void(std::uint64_t number, std::optional<double> thickness)> & function);

/** How often that walks over all faces. */
std::uint64_t
CountNodePasses(std::uint64_t numberOfVertices, std::uint64_t keptNumbers);

} // end namespace medialvoxel

#endif
