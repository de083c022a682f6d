// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The program's reader of one format; FUZZ_FILE_NAME has its extension.

#include "FuzzVolume.h"

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const MedialVoxelFuzz::InputFile file(FUZZ_FILE_NAME);
  file.Write(data, size);
  MedialVoxelFuzz::ReadVolume(file);
  return 0;
}
