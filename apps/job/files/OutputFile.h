// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOutputFile_h
#define medialvoxelOutputFile_h

#include "SystemFile.h"
#include "UncachedWriter.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace medialvoxel
{

/** \class OutputFile
 * \brief A file that appears under its name only when it is complete.
 *
 * It is written without a name, or under a temporary one in the same folder where the file system needs one. Then it
 * is brought to the disk, its size is checked, and it gets its name. Until then an existing file of that name stays
 * as it is. The destructor removes the temporary file; the system removes one without a name. A symbolic link is
 * followed: its target is replaced. */
class OutputFile
{
public:
  OutputFile(const std::filesystem::path & fileName, bool overwrite);
  ~OutputFile();
  OutputFile(const OutputFile &) = delete;
  OutputFile &
  operator=(const OutputFile &) = delete;

  /** Creates a file without a name, with a size of \a numberOfBytes zeros.
   * With \a reserve the space for them is taken from the disk at once.
   * \throw JobError Refused when the folder cannot be written or has no space. */
  void
  Create(std::uint64_t numberOfBytes, bool reserve);

  /** The same under a temporary name, for folders that several machines share.
   * \param suffix end of its name, behind the final name and the number of the process */
  void
  CreateNamed(std::uint64_t numberOfBytes, bool reserve, const std::string & suffix = ".partial");

  /** Removes the files that killed processes left of CreateNamed() with this suffix. */
  void
  RemoveLeftovers(const std::string & suffix) const;

  /** As CreateNamed() with its space reserved, under a temporary name that other processes know. The file stays after
   * this object. \throw JobError Refused, also when the file exists. */
  void
  CreateShared(const std::filesystem::path & temporaryName, std::uint64_t numberOfBytes);

  /** Opens the file of CreateShared(), for writing only or for reading only: a file system of a network then sends
   * other machines no more than the written bytes.
   * \throw JobError Failure when it is not there or has another size. */
  void
  OpenShared(const std::filesystem::path & temporaryName, std::uint64_t numberOfBytes, bool forWriting);

  /** Opens a file that another process has published, for reading. \throw JobError Failure, as OpenShared() */
  void
  OpenPublished(std::uint64_t numberOfBytes);

  /** Brings the bytes written so far to the disk. \throw JobError Failure */
  void
  Sync();

  /** Lets WriteAt() go past the page cache from now on, where the file system can. */
  void
  BypassPageCache();

  /** \throw JobError Failure. */
  void
  WriteAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes);

  /** As WriteAt, but leaves aligned blocks of zeros as holes. Only for bytes not written before. */
  void
  WriteSparseAt(std::uint64_t offset, const void * data, std::uint64_t numberOfBytes);

  void
  ReadAt(std::uint64_t offset, void * data, std::uint64_t numberOfBytes) const;

  /** Cuts the file, or lengthens it by zeros. \throw JobError Refused */
  void
  SetSize(std::uint64_t numberOfBytes, bool reserve);

  /** For files that a library writes: the present size is the one to keep. */
  void
  AcceptSize();

  /** Brings all bytes to the disk and compares the size. \throw JobError Failure. */
  void
  Finish();

  /** Gives the finished file its name, unless it has it. \throw JobError Refused when a file of that name has come up
   * meanwhile. */
  void
  Publish();

  /** As Publish() with overwriting, but a file that had the name is kept under GetTemporaryName() until KeepName(). The
   * names are to be brought to the disk after this, and after PublishForNow(), by SyncFolder().
   * \return whether there was one; always false where the file system cannot exchange names. */
  bool
  PublishByExchange();

  /** Gives the finished file its name. Without KeepName() it loses the name again; RemoveLeftovers() removes it when
   * the process was killed between the two. \return false when a file has the name. */
  bool
  PublishForNow();

  /** Ends PublishForNow() or PublishByExchange(). */
  void
  KeepName();

  /** Lets the temporary name tell another file than the final one: a header, of its voxels. */
  void
  SetBelongsTo(const std::filesystem::path & fileName)
  {
    m_BelongsTo = fileName;
  }

  /** Renames the target of Publish(); the folder stays the same. */
  void
  SetFileName(const std::filesystem::path & fileName);

  const std::filesystem::path &
  GetFileName() const
  {
    return m_FileName;
  }

  /** Bytes that the finished file must have. */
  std::uint64_t
  GetSize() const
  {
    return m_Size;
  }

  /** Empty while the file has no name. */
  const std::filesystem::path &
  GetTemporaryName() const
  {
    return m_TemporaryName;
  }

private:
  using NameMaker = std::function<std::filesystem::path(int attempt)>;

  void
  CheckLengthOfName() const;

  void
  OpenUnder(const NameMaker & makeName);

  /** The name that Create() and Publish() use. */
  NameMaker
  GetNameMaker() const;

  /** Gives a file without a name a temporary one. */
  void
  TakeTemporaryName();

  void
  CopyToTemporaryName();

  bool
  TakeFreeName();

  void
  Replace();

  bool
  LinkFreeName();

  bool
  ExchangeWithFile();

  bool
  ReplaceLinkedFile();

  void
  SyncNamesWithoutOrder() const;

  void
  Reserve(std::uint64_t numberOfBytes);

  bool
  SyncUncached() const;

  void
  OpenExisting(const std::filesystem::path & name, std::uint64_t numberOfBytes, FileAccess access);

  void
  WriteCachedAt(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes);

  /** False when the file system cannot after all, which is not tried again. */
  bool
  WriteUncachedAt(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes);

  std::filesystem::path m_FileName;
  std::filesystem::path m_BelongsTo; ///< stands before the rest of the temporary name
  std::filesystem::path m_TemporaryName;
  bool                  m_Overwrite;
  bool                  m_IsNameless{ false };
  bool                  m_KeepsOrder{ false };
  bool                  m_IsForNow{ false }; ///< the final name is to be lost again
  bool                  m_IsShared{ false }; ///< the temporary file stays for other processes
  SystemFile            m_File;
  std::uint64_t         m_Size{ 0 };

  std::unique_ptr<UncachedWriter> m_Uncached;
};

/** Fills a created file with text alone and finishes it. */
void
WriteText(OutputFile & file, std::string_view text);

/** Makes a file of text, which is on the disk when it appears. \throw JobError as OutputFile */
void
WriteTextFile(const std::filesystem::path & fileName, std::string_view text, bool overwrite);

} // end namespace medialvoxel

#endif
