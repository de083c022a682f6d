// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPartSurface_h
#define medialvoxelPartSurface_h

#include "InputVolume.h"
#include "PartMeasures.h"
#include "ProductFootprint.h"
#include "VertexValues.h"
#include "MeshFormat.h"
#include "MeshSpool.h"
#include "VoxelOutput.h"

#include "itkMedialVoxelIsosurface.h"
#include "itkMedialVoxelSurfaceConsumer.h"
#include "itkMedialVoxelWallRay.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class PartSurface
 * \brief The surface of the part in a volume, built while a map of its thickness is computed, and kept in scratch files
 * until it is written.
 *
 * It takes the map slice by slice, whatever its definition, and reads object and values itself, for rays as far ahead
 * as they may go. A vertex has the thickness of the voxel of the object beside it. */
class PartSurface : private itk::MedialVoxelIsosurfaceConsumer
{
public:
  /** \param input must outlive it */
  PartSurface(const PartOptions & options, const VolumeHeader & header, itk::MedialVoxelObjectSource & input);
  ~PartSurface() override;

  /** Has vertices placed by gray values; to be called before the first slice of the map. */
  void
  UseGrayValues()
  {
    m_Facts.usesGrayValues = true;
  }

  /** Where the map of the thickness is written to, from its first slice to its last: float, 0 is unknown. */
  VoxelOutput &
  GetMap();

  /** Writes the surface after the last slice of the map, and finishes the file. Returns its measures. \a progress may
   * throw to stop. */
  Json
  Write(OutputFile & file, const std::function<void(double)> & progress);

  /** Beside the map. Scratch files are of a surface that has a vertex for each 32 voxels; larger ones take more. */
  static ProductFootprint
  GetFootprint(const PartOptions & options, const VolumeHeader & header);

private:
  class Map;

  void
  AddSlice(std::int64_t z, const float * thickness);

  /** Reads object and margins up to this slice. */
  void
  ReadSlices(std::int64_t last);
  void
  ReadSlice(std::int64_t z);

  /** Sets the margins of a slice, whose object is known. */
  void
  SetMargins(std::int64_t z, const itk::MedialVoxelBits & object);

  void
  AddVertices(std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceVertex> & vertices) override;
  void
  AddTriangles(std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceTriangle> & triangles) override;

  void
  CountRay(itk::MedialVoxelRayEnd end);

  void
  AddRays(std::uint64_t first, const std::vector<itk::MedialVoxelIsosurfaceVertex> & vertices);

  PartOptions                      m_Options;
  VolumeHeader                     m_Header;
  itk::MedialVoxelObjectSource &   m_Input;
  itk::MedialVoxelIndex            m_Size;
  itk::MedialVoxelSurfacePlacement m_Placement;
  bool                             m_IsMirrored; ///< the axes of the image are left-handed
  double                           m_MaximumRay;
  std::int64_t                     m_Halo; ///< slices that are read ahead
  itk::MedialVoxelMargins          m_Margins;
  itk::MedialVoxelWallRay          m_Ray;
  itk::MedialVoxelIsosurface       m_Isosurface;
  std::unique_ptr<Map>             m_Map;
  itk::MedialVoxelGray             m_Gray;    ///< of the slice that is read
  std::deque<itk::MedialVoxelBits> m_Objects; ///< of slices that are read and wait for their thickness
  std::int64_t                     m_SlicesRead{ 0 };
  std::int64_t                     m_Z{ 0 };         ///< of the slice that came last
  const float *                    m_Now{ nullptr }; ///< its thickness
  std::vector<float>               m_Before;         ///< thickness of the slice before it
  MeshSpool                        m_Spool;
  std::optional<VertexValues>      m_RayThickness;
  std::mutex                       m_Mutex; ///< of the facts
  PartFacts                        m_Facts;
};

} // end namespace medialvoxel

#endif
