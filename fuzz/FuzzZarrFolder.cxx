// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// A Zarr folder. A line of @ and a name begins a file of it; only names that readers look for are written.

#include "FuzzVolume.h"

#include <array>
#include <string_view>
#include <utility>

namespace
{

using namespace MedialVoxelFuzz;

constexpr std::array<std::string_view, 20> Names{ { ".zattrs", ".zarray",     "0/.zarray", "0/0.0.0",   "0/0.0.1",
                                                    "0/1.0.0", "0/0.0",       "0/0.0.0.0", "0/0/0/0",   "0/0/0/1",
                                                    "0.0.0",   "0.0",         "zarr.json", "c/0/0/0",   "c/0/0/1",
                                                    "c/0/0",   "0/zarr.json", "0/c/0/0/0", "0/c/0/0/1", "0/c/1/0/0" } };

/** Takes a file from the front of the text: its name, which may be none of ours, and its bytes. */
std::pair<std::string_view, std::string_view>
TakeFile(std::string_view & text)
{
  const std::size_t      endOfName = std::min(text.find('\n'), text.size());
  const std::string_view name = text.substr(0, endOfName);
  text.remove_prefix(std::min(endOfName + 1, text.size()));
  const std::size_t      endOfFile = std::min(text.find("\n@"), text.size());
  const std::string_view bytes = text.substr(0, endOfFile);
  text.remove_prefix(std::min(endOfFile + 2, text.size()));
  return { name, bytes };
}

void
WriteFolder(const std::filesystem::path & folder, std::string_view text)
{
  std::filesystem::remove_all(folder);
  for (const char * const name : { "0/0/0", "c/0/0", "0/c/0/0", "0/c/1/0" })
  {
    std::filesystem::create_directories(folder / name);
  }
  std::ofstream(folder / ".zgroup") << "{}";
  text.remove_prefix(std::min<std::size_t>(1, text.size()));
  while (!text.empty())
  {
    const auto [name, bytes] = TakeFile(text);
    if (std::find(Names.begin(), Names.end(), name) != Names.end())
    {
      std::ofstream(folder / name, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    }
  }
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const InputFile folder("in.zarr");
  WriteFolder(folder.GetPath(), { reinterpret_cast<const char *>(data), size });
  ReadVolume(folder);
  return 0;
}
