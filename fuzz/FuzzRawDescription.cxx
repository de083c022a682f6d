// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// A headerless file: the lines are the values of --raw-size and --raw-type.

#include "Errors.h"
#include "FuzzArguments.h"
#include "FuzzVolume.h"
#include "OptionChecks.h"
#include "VolumeHeader.h"

namespace
{

using namespace MedialVoxelFuzz;
using namespace medialvoxel;

void
ReadRaw(const InputFile & file, const RawDescription & raw)
{
  try
  {
    CheckOptions(raw);
  }
  catch (const JobError & error)
  {
    Require(error.GetStatus() == ExitStatus::Usage, "a description is refused with another status");
    return;
  }
  ReadVolume(file, raw);
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const InputFile         file("in.raw", std::string(InputFile::BytesOfVoxels, '\1'));
  const std::vector<std::string> values = SplitIntoLines(data, size);
  const std::vector<std::string> names{ "--raw-size", "--raw-type" };
  std::vector<std::string>       arguments{ "info", file.GetPath().string() };
  for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i)
  {
    if (!values[i].empty())
    {
      // As one word, so that a value cannot become another option.
      arguments.push_back(names[i] + "=" + values[i]);
    }
  }
  const CommandLine * const line = ParseArguments(arguments);
  if (line != nullptr && line->infoOptions.raw)
  {
    ReadRaw(file, *line->infoOptions.raw);
  }
  return 0;
}
