// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeFormat.h"

#include "Errors.h"
#include "InflateReader.h"
#include "RawImageIO.h"

namespace medialvoxel
{

VolumeInput
MakePlainInput(VolumeHeader (*readHeader)(const std::filesystem::path &), DataSizeCheck sizeCheck)
{
  return { readHeader, sizeCheck, OpenInflatedStream, MakeRawImageIO };
}

void
RefuseMissingFormat(const std::filesystem::path & fileName, const std::string & format, const std::string & remedy)
{
  Fail(ExitStatus::Usage,
       fileName.string(),
       ": this program was built without ",
       format,
       "; to have it, build the program with ",
       remedy);
}

} // end namespace medialvoxel
