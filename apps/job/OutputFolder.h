// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputFolder_h
#define medialvoxelOutputFolder_h

#include <filesystem>

namespace medialvoxel
{

/** \class OutputFolder
 * \brief A folder that appears under its name only when all files in it are complete.
 *
 * It is filled under a temporary name beside the final one, and renamed. Until then an existing folder of that name
 * stays as it is, and the destructor removes the temporary one. A symbolic link is followed: the folder it points to is
 * the one replaced. */
class OutputFolder
{
public:
  OutputFolder(const std::filesystem::path & name, bool overwrite);
  ~OutputFolder();
  OutputFolder(const OutputFolder &) = delete;
  OutputFolder &
  operator=(const OutputFolder &) = delete;

  /** Makes the temporary folder. \throw JobError Refused. */
  void
  Create();

  /** Brings all files and names in the folder to the disk. \throw JobError Failure. */
  void
  Finish();

  /** Gives the finished folder its name and removes the one that had it.
   * \throw JobError Refused when one has come up meanwhile that must not be replaced. */
  void
  Publish();

  const std::filesystem::path &
  GetName() const
  {
    return m_Name;
  }

  const std::filesystem::path &
  GetTemporaryName() const
  {
    return m_TemporaryName;
  }

private:
  void
  Replace();

  std::filesystem::path m_Name;
  std::filesystem::path m_TemporaryName;
  bool                  m_Overwrite;
};

} // end namespace medialvoxel

#endif
