// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelZarrValues_h
#define medialvoxelZarrValues_h

#include "ValueReader.h"
#include "ZarrMetadata.h"

namespace medialvoxel
{

/** Reads boxes of a Zarr array chunk by chunk. Chunks that are not packed are read in rows.
 * \param bytesToKeep of unpacked chunks whose further slices are needed later */
std::unique_ptr<ValueReader>
MakeZarrValues(const VolumeHeader & header, std::uint64_t bytesToKeep);

/** Memory of a thread that reads an array, and of all threads together for the indices of shards. */
std::uint64_t
GetZarrThreadMemory(const ZarrArray & array);

} // end namespace medialvoxel

#endif
