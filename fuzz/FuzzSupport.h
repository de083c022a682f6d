// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzSupport_h
#define FuzzSupport_h

#include "TemporaryFolder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

namespace MedialVoxelFuzz
{

/** Ends the process, which libFuzzer takes for a finding, unless \a isTrue. */
inline void
Require(bool isTrue, const std::string & what)
{
  if (!isTrue)
  {
    std::cerr << "fuzz: " << what << std::endl;
    std::abort();
  }
}

/** \class InputFile
 * \brief The bytes at hand as a file, beside files of voxels that a header may name. */
class InputFile
{
public:
  static constexpr std::size_t BytesOfVoxels = 4096;

  explicit InputFile(const std::string & name, const std::string & content = "")
    : m_Path(m_Folder / name)
  {
    m_Folder.Write(name, content);
    m_Folder.Write("voxels.img", std::string(BytesOfVoxels, '\1'));
    m_Folder.Write("voxels.vol", std::string(BytesOfVoxels, '\1'));
  }

  void
  Write(const std::uint8_t * data, std::size_t size) const
  {
    std::ofstream(m_Path, std::ios::binary).write(reinterpret_cast<const char *>(data), std::streamsize(size));
  }

  const std::filesystem::path &
  GetPath() const
  {
    return m_Path;
  }

  /** An error names the file, or another one beside it, in one line of text that a terminal can show. */
  void
  RequireClearError(const std::string & message) const
  {
    Require(message.find(m_Path.parent_path().string()) != std::string::npos, "no file in the error: " + message);
    Require(std::none_of(message.begin(), message.end(), [](unsigned char byte) { return byte < 32 || byte == 127; }),
            "control characters in the error: " + message);
  }

private:
  medialvoxel::TemporaryFolder m_Folder;
  std::filesystem::path        m_Path;
};

} // namespace MedialVoxelFuzz

#endif
