// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelLabelMapRun_h
#define medialvoxelLabelMapRun_h

#include "ObjectSurvey.h"
#include "PassCells.h"
#include "PieceLoop.h"
#include "SheetMesh.h"

#include "itkMedialVoxelObjectUnion.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace medialvoxel
{

/** \class LabelMapRun
 * \brief Runs an engine over each piece of a label map once for every pass, and writes the results together. */
class LabelMapRun
{
public:
  /** \param map the input of the engine; map and survey must outlive it
   * \param maximumPoreSize of the extraction */
  LabelMapRun(itk::MedialVoxelObjectMap & map,
              const VolumeGeometry &      geometry,
              std::uint64_t               maximumPoreSize,
              const Survey &              survey);

  /** Memory that is planned for objects before the map is read. */
  static std::uint64_t
  GetPlannedMemory(const LabelSelection & selection);

  /** Their additional memory when their number is known. */
  static std::uint64_t
  GetUnplannedMemory(const LabelSelection & selection, std::size_t numberOfObjects);

  /** Add it to the engine. */
  itk::MedialVoxelTileObserver &
  GetObserver()
  {
    return m_Survey;
  }

  /** A volume of labels, of their objects, or of further results. */
  void
  AddVolume(const VolumeRequest & request, VoxelOutput & volume);

  /** Keep the cells of all passes, and what they found together, instead of volumes for the labels and objects. */
  void
  KeepCells(PassCells & cells)
  {
    m_Cells = &cells;
  }

  /** A mesh that sees the tiles of the engine, and is to tell the objects apart. */
  void
  AddMesh(SheetMesh & mesh);

  /** Ask when the map is prepared. */
  unsigned int
  GetNumberOfPasses() const
  {
    return m_Map.GetNumberOfPasses();
  }

  /** The same. */
  std::size_t
  GetNumberOfObjects() const
  {
    return m_Map.GetTable().GetNumberOfObjects();
  }

  /** \return sums over all objects; throws as PieceLoop::Run() */
  itk::MedialVoxelSums
  Run(PieceLoop & loop, PieceEngine & engine, const SliceRange & piece, WriteBehind & writer);

  /** The passes and all objects, for a report. */
  Json
  Summarize() const;

private:
  /** A volume, and its part of a piece beside labels and objects. */
  struct Volume
  {
    VolumeRequest          request;
    VoxelOutput *          output;
    std::vector<std::byte> voxels;
  };

  bool
  IsOfLabels(const Volume & volume) const
  {
    return volume.request.role == "labels";
  }

  std::vector<itk::MedialVoxelObjectUnion::Values>
  MakeValues(const itk::MedialVoxelBox & region, const PieceEngine & engine);

  void
  Write(const Volume & volume, std::uint64_t firstVoxel) const;

  itk::MedialVoxelObjectMap & m_Map;
  VolumeGeometry              m_Geometry;
  itk::MedialVoxelObjectUnion m_Union;
  ObjectSurvey                m_Survey;
  std::vector<Volume>         m_Volumes;
  SheetMesh *                 m_Mesh{ nullptr };
  PassCells *                 m_Cells{ nullptr }; ///< for the topology
  std::uint64_t               m_SharedCells{ 0 };
};

} // end namespace medialvoxel

#endif
