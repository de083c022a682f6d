// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputFolder_h
#define medialvoxelOutputFolder_h

#include <filesystem>
#include <string>

namespace medialvoxel
{

/** \class OutputFolder
 * \brief A folder that appears under its name only when all files in it are complete.
 *
 * It is filled under a temporary name beside the final one, and renamed. Until then an existing folder of that name
 * stays as it is. The destructor removes the temporary folder unless it is shared. A symbolic link is followed: its
 * target is replaced.
 *
 * A shared folder has a temporary name that other processes know, the final one with a suffix. Until it is published
 * it has an empty file named as the suffix, which distinguishes it from a folder that it changed names with. */
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

  /** The same for other processes to open. \throw JobError Refused. */
  void
  CreateShared(const std::string & suffix);

  /** Removes the folder of CreateShared(), if it exists. */
  void
  RemoveShared(const std::string & suffix) const;

  /** Opens the folder of CreateShared(). \throw JobError Failure when it is not there. */
  void
  OpenShared(const std::string & suffix);

  /** The same to publish it, or to end a publication that was interrupted. \param hasBegun it may have its name
   * already */
  void
  OpenToPublish(const std::string & suffix, bool hasBegun);

  /** Brings all files and names in the folder to the disk. \throw JobError Failure. */
  void
  Finish();

  /** Gives the finished folder its name, unless it has it, and removes the one that had it.
   * \throw JobError Refused when one has come up meanwhile that must not be replaced. */
  void
  Publish();

  /** The final name. */
  const std::filesystem::path &
  GetName() const
  {
    return m_Name;
  }

  /** Where the folder is now. */
  const std::filesystem::path &
  GetPath() const
  {
    return m_IsPublished ? m_Name : m_TemporaryName;
  }

private:
  std::filesystem::path
  GetSharedName(const std::string & suffix) const;

  /** Where Replace() puts the replaced folder when names cannot be exchanged. */
  std::filesystem::path
  GetNameAside() const;

  void
  GiveName();

  void
  Replace();

  std::filesystem::path m_Name;
  std::filesystem::path m_TemporaryName;
  std::string           m_Suffix; ///< of a shared folder
  bool                  m_Overwrite;
  bool                  m_IsPublished{ false };
  bool                  m_RemovesReplaced{ false };
};

} // end namespace medialvoxel

#endif
