// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPartMeasures_h
#define medialvoxelPartMeasures_h

#include "Json.h"
#include "VertexValues.h"
#include "MeshSpool.h"
#include "VolumeHeader.h"

#include <cstdint>
#include <functional>

namespace medialvoxel
{

/** Rays without an answer, by the reason. */
struct UnansweredRays
{
  std::uint64_t leaveVolume{ 0 }; ///< or start outside of it, at a cap
  std::uint64_t tooLong{ 0 };
  std::uint64_t unknown{ 0 }; ///< no direction, or values that are not a number

  std::uint64_t
  GetTotal() const
  {
    return leaveVolume + tooLong + unknown;
  }
};

/** Measures of the surface of a part. */
struct PartFacts
{
  bool           usesGrayValues{ false }; ///< to place the vertices; otherwise they are in the middle between voxels
  bool           isOpen{ false };         ///< it encloses no volume
  std::uint64_t  unknownVertices{ 0 };    ///< at which the thickness is not known
  UnansweredRays unansweredRays;
};

/** Area, volume and thickness of the surface of a part, in the order of its faces. A third of a triangle counts for
 * each of its corners.
 * \param rays null: they were not measured \param progress as in MeshWriteOptions */
Json
MeasurePart(const MeshSpool &                   surface,
            const VertexValues *                rays,
            const VolumeGeometry &              geometry,
            const PartFacts &                   facts,
            const std::function<void(double)> & progress);

} // end namespace medialvoxel

#endif
