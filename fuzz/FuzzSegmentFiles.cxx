// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Tables of names and colors; the first byte chooses the extension.

#include "FuzzSupport.h"

#include "Errors.h"
#include "SegmentFiles.h"

#include <cctype>

namespace
{

using namespace MedialVoxelFuzz;
using namespace medialvoxel;

void
CheckSegment(const Segment & segment)
{
  Require(segment.label != 0, "the background has a name");
  for (const char character : segment.name)
  {
    Require(std::iscntrl(static_cast<unsigned char>(character)) == 0, "a name has control characters");
  }
  if (segment.color)
  {
    for (const double shade : *segment.color)
    {
      Require(shade >= 0.0 && shade <= 1.0, "a color is not from 0 to 1");
    }
  }
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const InputFile files[]{ InputFile("in.ctbl"), InputFile("in.csv"), InputFile("in.tsv") };
  if (size == 0)
  {
    return 0;
  }
  const InputFile & file = files[data[0] % 3];
  file.Write(data + 1, size - 1);
  try
  {
    const SegmentTable table = ReadSegments(file.GetPath());
    for (const Segment & segment : table.GetSegments())
    {
      CheckSegment(segment);
    }
  }
  catch (const JobError & error)
  {
    Require(error.GetStatus() == ExitStatus::CorruptInput, "an unexpected status");
    file.RequireClearError(error.what());
  }
  return 0;
}
