// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetCoarsening_h
#define medialvoxelSheetCoarsening_h

#include "SheetRemeshing.h"
#include "MeshSorting.h"

namespace medialvoxel
{

/** \class SheetCoarsening
 * \brief Larger triangles for a surface of any size: parts of it are read, coarsened in threads, and put together.
 *
 * Points at the boundaries of parts stay as they are. */
class SheetCoarsening
{
public:
  SheetCoarsening(std::unique_ptr<MeshSpool> surface, const SheetRemeshing & remeshing);

  /** The surface with triangles that elements are made of, and the walls that none of them is left of. */
  std::unique_ptr<MeshSpool>
  Coarsen(std::vector<itk::MedialVoxelWallLeftOut> & wallsLeftOut) const;

  /** Adds the distances between the surface and a coarse one to its summary. */
  void
  MeasureDistances(const itk::MedialVoxelRemeshedSheet & coarse, itk::MedialVoxelRemeshingSummary & summary) const;

  /** Moves nodes of a coarse surface to where this one is in the mean. */
  void
  FitWalls(itk::MedialVoxelRemeshedSheet & coarse, double noise, const itk::MedialVoxelRunTasks & runTasks) const;

  /** Memory that it takes, for a number of threads. */
  static std::uint64_t
  GetBytes(unsigned int threads);

private:
  struct Part;

  std::uint64_t
  GetNumberOfParts() const
  {
    return m_Grouped.firstFace.size() - 1;
  }

  void
  FindShared();

  Part
  ReadPart(std::uint64_t number) const;

  SheetRemeshing             m_Remeshing;
  GroupedMesh                m_Grouped;
  std::vector<std::uint64_t> m_Shared; ///< vertices that several parts have, by number
};

} // end namespace medialvoxel

#endif
