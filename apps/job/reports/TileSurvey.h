// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTileSurvey_h
#define medialvoxelTileSurvey_h

#include "itkMedialVoxelTileObserver.h"

#include <string>

namespace medialvoxel
{

/** \class TileSurvey
 * \brief Finds something in the tiles of a run that one process can save for another. */
class TileSurvey : public itk::MedialVoxelTileObserver
{
public:
  /** Forgets all tiles. */
  virtual void
  Clear() = 0;

  /** All that was found, as bytes that any machine reads. */
  virtual std::string
  Save() const = 0;

  /** Merges the saved results of another survey with the same arguments, of the slices that follow. \throw JobError
   * Failure when the bytes do not fit */
  virtual void
  Merge(const std::string & bytes) = 0;
};

} // end namespace medialvoxel

#endif
