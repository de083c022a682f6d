// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSystemFile_h
#define medialvoxelSystemFile_h

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

// Files of the system and their names. Functions that return a bool are false on failure, with errno.

namespace medialvoxel
{

/** The system's data about a file or folder. */
struct FileStatus
{
  bool          isFile{ false }; ///< a regular one
  bool          isFolder{ false };
  bool          isOfThisUser{ false };
  std::uint64_t numberOfBytes{ 0 };
  std::uint64_t numberOfNames{ 0 };
  std::uint64_t disk{ 0 };
  std::uint64_t number{ 0 };   ///< each file on a disk has another one
  std::int64_t  modified{ 0 }; ///< in nanoseconds since 1970
};

/** Nothing on failure, with errno. \param followsLinks false: of a symbolic link itself */
std::optional<FileStatus>
GetFileStatus(const std::filesystem::path & name, bool followsLinks = true);

/** The fate of a file or folder that has the new name already. */
enum class TakenName
{
  Stays,    ///< the failure is EEXIST
  IsLost,   ///< for files only
  Exchanges ///< it gets the old name; the failure is ENOSYS where the system cannot
};

bool
Rename(const std::filesystem::path & from, const std::filesystem::path & to, TakenName taken);

/** Gives a file a second name; the failure is EEXIST when something has it. */
bool
AddName(const std::filesystem::path & file, const std::filesystem::path & name);

/** Takes a name from a file; errors are ignored. */
void
RemoveName(const std::filesystem::path & name);

/** The failure is EEXIST when something has the name. */
bool
MakeFolder(const std::filesystem::path & name);

/** A file to read, for libraries in C; nullptr on failure. */
std::FILE *
OpenStream(const std::filesystem::path & name);

/** How a file is opened. */
enum class FileAccess
{
  Read, ///< of a folder, too; does not wait for the other end of a pipe
  Write,
  WriteUncached, ///< past the page cache, where the file system can
  Change,        ///< read and write, as the rest
  Make,          ///< makes a file where there is none
  MakeEmpty,     ///< empties a file that is there
  MakeNew,       ///< the failure is EEXIST when something has the name
  MakeLog        ///< as Make; Append() writes to its end, and a terminal does not get hold of the process
};

/** \class SystemFile
 * \brief An open file, closed at its end. */
class SystemFile
{
public:
  SystemFile() = default;

  /** IsOpen() is false on failure, with errno. */
  SystemFile(const std::filesystem::path & name, FileAccess access);

  ~SystemFile();
  SystemFile(SystemFile && other) noexcept
    : m_Descriptor(std::exchange(other.m_Descriptor, -1))
  {}
  SystemFile &
  operator=(SystemFile && other) noexcept
  {
    std::swap(m_Descriptor, other.m_Descriptor);
    return *this;
  }

  /** A new file that no folder lists and that can get a name. It vanishes with the process however that ends. Not open
   * where the file system has none of these. */
  static SystemFile
  MakeNameless(const std::filesystem::path & folder);

  /** The same for this user alone, on any file system; it gets no name. */
  static SystemFile
  MakeScratch(const std::filesystem::path & folder);

  /** What holds the turn to replace an existing file: its end gives the turn back to all others that wait in this
   * function. Without their order where the file system has no locks or the file must not be written. */
  static SystemFile
  OpenInTurn(const std::filesystem::path & name);

  bool
  IsOpen() const
  {
    return m_Descriptor != -1;
  }

  /** The failure concerns bytes that seemed to be written and were lost; file systems of a network may report it
   * late. */
  bool
  Close();

  std::optional<FileStatus>
  GetStatus() const;

  /** 0 where the system does not tell. */
  std::uint64_t
  GetSize() const;

  /** The name by which this process opens the file again. */
  std::filesystem::path
  GetOwnName() const;

  /** Gives a file without a name one; the failure is EEXIST when something has it. */
  bool
  GiveName(const std::filesystem::path & name) const;

  /** Reads all bytes; the failure is ENODATA when the file ends before. */
  bool
  ReadAt(std::uint64_t offset, char * data, std::uint64_t numberOfBytes) const;

  bool
  WriteAt(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes);

  /** By one call of the system, so that no other process writes between these bytes. */
  bool
  Append(const char * data, std::uint64_t numberOfBytes);

  /** Cuts the file, or lengthens it by zeros. */
  bool
  SetSize(std::uint64_t numberOfBytes);

  /** Takes the space from the disk at once. A file system that cannot reserve, as some of networks, is asked again with
   * every write. */
  bool
  Reserve(std::uint64_t numberOfBytes);

  /** Brings the file to the disk, as far as reading its bytes takes it. */
  bool
  SyncData() const;

  /** The same with its times. */
  bool
  Sync() const;

  /** Starts to bring bytes to the disk, so that a later wait for them is short. */
  void
  StartSync(std::uint64_t offset, std::uint64_t numberOfBytes) const;

  /** Locks one byte, which may lie behind the end, for this open file, without waiting. The system gives it back when
   * the process ends. The failure is EAGAIN when another one has it, ENOLCK where the file system has no locks. */
  bool
  LockByte(std::uint64_t position);

  void
  UnlockByte(std::uint64_t position);

  /** True when another open file has the lock. */
  bool
  IsByteLocked(std::uint64_t position) const;

private:
#ifdef _WIN32
  using Descriptor = std::intptr_t; ///< a handle
#else
  using Descriptor = int;
#endif

  friend std::optional<FileStatus>
  GetFileStatus(const std::filesystem::path & name, bool followsLinks);

  explicit SystemFile(Descriptor descriptor)
    : m_Descriptor(descriptor)
  {}

  Descriptor m_Descriptor{ -1 };
};

} // end namespace medialvoxel

#endif
