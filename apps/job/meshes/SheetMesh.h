// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetMesh_h
#define medialvoxelSheetMesh_h

#include "Options.h"
#include "ProductFootprint.h"
#include "SheetCleaning.h"
#include "MeshFormat.h"
#include "SheetPasses.h"
#include "MeshSpool.h"
#include "SheetSummary.h"

#include "itkMedialVoxelSurfaceObserver.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** \class SheetMesh
 * \brief The medial surface of a job, built while its pieces run, and kept in scratch files until it is written.
 *
 * The scratch files are in the scratch folder of the options, without one in the folder of the mesh. */
class SheetMesh : private itk::MedialVoxelSurfaceConsumer
{
public:
  using RunTasks = itk::MedialVoxelSurfaceBuilder::RunTasks;

  /** \param grid     the image in the units of the options
   * \param surplus  for cells that wait until their piece is done, beside the memory of GetFootprint()
   * \param run      tasks of several slices in threads; none: the slices are done one by one */
  SheetMesh(const ExtractOptions &       options,
            const VolumeGeometry &       geometry,
            const itk::MedialVoxelGrid & grid,
            std::uint64_t                surplus,
            RunTasks                     run = {});

  /** Sees the tiles of the pieces; may ask for more sites. */
  itk::MedialVoxelTileObserver &
  GetObserver()
  {
    return m_Passes ? static_cast<itk::MedialVoxelTileObserver &>(*m_Passes) : *m_Observer;
  }

  /** The number of the object that a cell belongs to in the current pass, from 1 on. */
  using FindObject = std::function<std::uint16_t(const itk::MedialVoxelIndex & cell)>;

  /** Sets how objects of a label map are found, before the first piece. */
  void
  FindObjectsWith(FindObject find)
  {
    m_FindObject = std::move(find);
  }

  /** Sets the rays that extend rims, before the sheet is written; otherwise they end half a thickness further on. */
  void
  FindEdgesWith(itk::MedialVoxelMeasureRimRays measure)
  {
    m_MeasureRimRays = std::move(measure);
  }

  /** The pass over a label map that the tiles from now on belong to. */
  void
  BeginPass(unsigned int pass)
  {
    m_Passes->BeginPass(pass);
  }

  /** Gives another consumer the sheet too, as it is before it is cleaned. Before the first piece, not of a label map.
   */
  void
  AlsoGiveTo(itk::MedialVoxelSurfaceConsumer & other)
  {
    m_Others.push_back(&other);
  }

  /** After the last piece: all consumers have all of the sheet. Finish() does it otherwise. */
  void
  CompleteSheet();

  /** Sets the walls of the points of the sheet: a face gets the wall of the point that is nearest to the mean of its
   * corners. Before the sheet is finished. */
  void
  SetWalls(std::vector<itk::MedialVoxelVector3> points, std::vector<std::uint32_t> wallOf)
  {
    m_Walls = { std::move(points), std::move(wallOf) };
  }

  /** The labels of the objects of a label map, by number, before the surface is written. */
  void
  SetObjectLabels(std::vector<std::int64_t> labels)
  {
    m_ObjectLabels = std::move(labels);
  }

  /** Writes the sheet after the last piece, and finishes the file. \a progress may throw to stop.
   * \param memoryLimit beside the memory of GetFootprint()
   * \throw JobError as CleanSheet() and WriteMesh() */
  SheetSummary
  Write(OutputFile &                        file,
        std::uint64_t                       memoryLimit,
        unsigned int                        threads,
        const std::function<void(double)> & progress);

  /** Finishes the sheet after the last piece, as Write() does: sorted, without short branches and small components. */
  const MeshSpool &
  Finish(std::uint64_t memoryLimit, unsigned int threads, const std::function<void(double)> & progress);

  /** Whether faces get the size of elements at the end. */
  static bool
  IsRemeshed(const ExtractOptions & options)
  {
    return options.elementSize.kind != ElementSize::Kind::Voxel;
  }

  /** Memory of a run over a part with thin walls. Scratch files are planned for a vertex and a face for each 64
   * voxels; denser sheets take more. */
  static ProductFootprint
  GetFootprint(const ExtractOptions & options, const VolumeGeometry & geometry, const itk::MedialVoxelGrid & grid);

private:
  struct NumberedPoints
  {
    std::vector<itk::MedialVoxelVector3> points;
    std::vector<std::uint32_t>           wallOf;
  };

  void
  AddVertices(const std::vector<itk::MedialVoxelSurfaceVertex> & vertices) override;
  void
  AddQuads(const std::vector<itk::MedialVoxelSurfaceQuad> & quads) override;

  std::unique_ptr<itk::MedialVoxelSurfaceObserver>
  MakeObserver(itk::MedialVoxelSurfaceConsumer & consumer) const;

  void
  Remesh(std::uint64_t memoryLimit, unsigned int threads, const std::function<void(double)> & progress);

  void
  NumberFaces(unsigned int threads, const std::function<void(double)> & progress);

  void
  AddTriangles(const itk::MedialVoxelSurfaceQuad & quad);

  ExtractOptions                                  m_Options;
  VolumeGeometry                                  m_Geometry;
  itk::MedialVoxelGrid                            m_Grid;
  std::uint64_t                                   m_Surplus;
  SheetCleaning                                   m_Cleaning;
  RunTasks                                        m_RunTasks;
  std::unique_ptr<MeshSpool>                      m_Spool;
  std::vector<MeshVertex>                         m_Vertices; // of one slice, for the spool
  std::vector<MeshFace>                           m_Faces;
  double                                          m_Area{ 0 };
  std::optional<PiecesLeftOut>                    m_Pieces;
  std::optional<itk::MedialVoxelRemeshingSummary> m_Remeshing;
  double                                          m_RemeshingSeconds{ 0 };
  FindObject                                      m_FindObject;
  itk::MedialVoxelMeasureRimRays                  m_MeasureRimRays;
  std::vector<std::int64_t>                       m_ObjectLabels;
  NumberedPoints                                  m_Walls;
  double                                          m_WallSeconds{ 0 };
  bool                                            m_IsComplete{ false };

  std::vector<itk::MedialVoxelSurfaceConsumer *> m_Others;

  // One of them.
  std::unique_ptr<itk::MedialVoxelSurfaceObserver> m_Observer;
  std::unique_ptr<SheetPasses>                     m_Passes; ///< of a label map
};

} // end namespace medialvoxel

#endif
