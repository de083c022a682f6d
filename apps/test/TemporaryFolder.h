// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelTemporaryFolder_h
#define medialvoxelTemporaryFolder_h

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace medialvoxel
{

/** A folder for the files of one test, removed with it. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::random_device source;
    do
    {
      m_Path = std::filesystem::temp_directory_path() / ("medialvoxel-" + std::to_string(source()));
    } while (!std::filesystem::create_directory(m_Path));
  }

  ~TemporaryFolder()
  {
    std::error_code error;
    std::filesystem::remove_all(m_Path, error);
  }

  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;

  std::filesystem::path
  operator/(const std::string & name) const
  {
    return m_Path / name;
  }

  void
  Write(const std::string & name, const std::string & content) const
  {
    std::ofstream(m_Path / name, std::ios::binary) << content;
  }

  std::string
  Read(const std::string & name) const
  {
    std::ifstream file(m_Path / name, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  }

  std::ptrdiff_t
  GetNumberOfFiles() const
  {
    return std::distance(std::filesystem::directory_iterator(m_Path), std::filesystem::directory_iterator());
  }

private:
  std::filesystem::path m_Path;
};

} // end namespace medialvoxel

#endif
