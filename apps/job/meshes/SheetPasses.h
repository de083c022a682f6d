// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetPasses_h
#define medialvoxelSheetPasses_h

#include "itkMedialVoxelSurfaceObserver.h"

#include <functional>
#include <memory>
#include <vector>

namespace medialvoxel
{

/** \class SheetPasses
 * \brief Builds a surface for each pass over a label map, while each piece comes once for every pass.
 *
 * The consumer gets the vertices of all passes as they come, numbered in that order. */
class SheetPasses : public itk::MedialVoxelTileObserver
{
public:
  /** Makes the builder of a pass; all passes have the same settings. */
  using MakeObserver =
    std::function<std::unique_ptr<itk::MedialVoxelSurfaceObserver>(itk::MedialVoxelSurfaceConsumer & consumer)>;

  SheetPasses(MakeObserver makeObserver, itk::MedialVoxelSurfaceConsumer & consumer);
  ~SheetPasses() override;

  /** The pass that the tiles from now on belong to, from 0 on; the first time in this order. */
  void
  BeginPass(unsigned int pass);

  /** After the last piece. */
  void
  Finish();

  std::uint64_t
  GetBytesPerVoxel() const override;

  std::unique_ptr<Workspace>
  MakeWorkspace() const override;

  bool
  LooksAround() const override
  {
    return true;
  }

  void
  Begin() override;

  itk::MedialVoxelBox
  Examine(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) const override;

  void
  Observe(const itk::MedialVoxelClassifiedTile & tile, Workspace * workspace) override;

  void
  Commit() override;

private:
  class Pass;

  MakeObserver                       m_MakeObserver;
  itk::MedialVoxelSurfaceConsumer &  m_Consumer;
  std::vector<std::unique_ptr<Pass>> m_Passes; ///< at least one
  unsigned int                       m_Current{ 0 };
  std::uint64_t                      m_NumberOfVertices{ 0 }; ///< that the consumer got
};

} // end namespace medialvoxel

#endif
