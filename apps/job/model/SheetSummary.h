// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSheetSummary_h
#define medialvoxelSheetSummary_h

#include "MeshQuality.h"
#include "Options.h"

#include "itkMedialVoxelRemeshedSheet.h"

#include <cstdint>
#include <optional>

namespace medialvoxel
{

/** Components of a sheet that are not written, as they are small. */
struct PiecesLeftOut
{
  std::uint64_t number{ 0 };
  double        area{ 0 }; ///< physical units squared
};

/** The medial mesh in a report. */
struct SheetSummary
{
  std::uint64_t vertices{ 0 };
  std::uint64_t faces{ 0 };
  double        area{ 0 }; ///< physical units squared

  ElementSize elementSize; ///< of its faces

  std::optional<PiecesLeftOut>                    pieces;    ///< where small ones are looked for
  std::optional<itk::MedialVoxelRemeshingSummary> remeshing; ///< unless they have that of a voxel
  std::optional<MeshQuality>                      quality;   ///< of its faces, likewise
  double                                          remeshingSeconds{ 0 };
  double                                          wallSeconds{ 0 }; ///< to find the walls of faces
};

} // end namespace medialvoxel

#endif
