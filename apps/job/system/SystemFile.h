// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelFileTransfer_h
#define medialvoxelFileTransfer_h

#include <cstdint>

namespace medialvoxel
{

/** Writes all bytes, in as many calls of the system as it takes; false on failure, with errno. */
bool
WriteFully(int descriptor, std::uint64_t offset, const char * data, std::uint64_t numberOfBytes);

/** Reads all bytes; false on failure, with errno, which is ENODATA when the file ends before. */
bool
ReadFully(int descriptor, std::uint64_t offset, char * data, std::uint64_t numberOfBytes);

/** Takes the space from the disk at once; false when there is none, with errno. A file system that cannot reserve, as
 * some of networks, is asked again with every write. */
bool
ReserveSpace(int descriptor, std::uint64_t numberOfBytes);

/** Starts the transfer of what was written to the disk, so that the final wait for it is short. */
void
StartWriteBack(int descriptor, std::uint64_t offset, std::uint64_t numberOfBytes);

} // end namespace medialvoxel

#endif
