// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurfaceMesh_h
#define medialvoxelSurfaceMesh_h

#include "Options.h"
#include "JobPlan.h"
#include "SurfaceCleaning.h"
#include "SurfaceFormat.h"
#include "SurfaceSpool.h"
#include "SurfaceSummary.h"

#include "itkMedialVoxelSurfaceObserver.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** \class SurfaceMesh
 * \brief The medial surface of a job, built while its pieces run, and kept in scratch files until it is written.
 *
 * The scratch files are in the scratch folder of the options, without one in the folder of the mesh. */
class SurfaceMesh : private itk::MedialVoxelSurfaceConsumer
{
public:
  /** Bytes that cells of the surface take until their piece is done, for each voxel of the piece: one cell for each 8
   * voxels is more than there are, one for 64 is planned for. */
  static constexpr std::uint64_t MostBytesPerVoxel = 8;
  static constexpr std::uint64_t PlannedBytesPerVoxel = 1;

  /** \param grid          the image in the units of the options
   * \param surplusBytes  for cells that wait until their piece is done, beside GetBytes() */
  SurfaceMesh(const ExtractOptions &       options,
              const VolumeGeometry &       geometry,
              const itk::MedialVoxelGrid & grid,
              std::uint64_t                surplusBytes);

  /** Sees the tiles of the pieces; may ask for more sites. */
  itk::MedialVoxelTileObserver &
  GetObserver()
  {
    return m_Observer;
  }

  /** Writes the surface after the last piece, and finishes the file. \a progress may throw to stop.
   * \param memoryBytes what may be taken beside GetBytes()
   * \throw JobError as CleanSurface() and WriteSurface() */
  SurfaceSummary
  Write(OutputFile & file, std::uint64_t memoryBytes, const std::function<void(double)> & progress);

  /** Memory of a surface of thin walls that is built, beside that of the workers. */
  static std::uint64_t
  GetBytes(const ExtractOptions & options, const VolumeGeometry & geometry);

  /** Space for the scratch files of a surface that has a vertex and a face for each 64 voxels. Denser ones take more.
   */
  static ScratchSpace
  GetScratchSpace(const ExtractOptions & options, const VolumeGeometry & geometry);

private:
  void
  AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices) override;
  void
  AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads) override;

  void
  AddTriangles(const itk::MedialVoxelSurfaceQuad & quad);

  SurfaceFormat                   m_Format;
  bool                            m_AsTriangles;
  double                          m_SectionWidth;
  SurfaceCleaning                 m_Cleaning;
  std::unique_ptr<SurfaceSpool>   m_Spool;
  std::vector<SurfaceVertex>      m_Vertices; // of one slice, for the spool
  std::vector<SurfaceFace>        m_Faces;
  double                          m_Area{ 0 };
  itk::MedialVoxelSurfaceObserver m_Observer;
};

/** \throw JobError Usage for a volume that is not 3-D, which has no surface, or for a format without the precision that
 * its coordinates need. */
void
CheckSurfaceInput(const VolumeHeader & header, const std::string & meshFile);

} // end namespace medialvoxel

#endif
