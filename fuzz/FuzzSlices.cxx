// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// A folder with one slice; FUZZ_FILE_NAME has its extension.

#include "FuzzVolume.h"

#include <cstdlib>

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const MedialVoxelFuzz::InputFile folder("slices");
  static const bool                       isPrepared = [] {
    std::filesystem::remove(folder.GetPath()); // a file, as others need it
    std::filesystem::create_directory(folder.GetPath());
#ifdef FUZZ_DICOM_MODULE
    setenv("MEDIALVOXEL_DICOM_MODULE", FUZZ_DICOM_MODULE, 0);
#endif
    return true;
  }();
  (void)isPrepared;
  std::ofstream(folder.GetPath() / FUZZ_FILE_NAME, std::ios::binary)
    .write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  MedialVoxelFuzz::ReadVolume(folder);
  return 0;
}
