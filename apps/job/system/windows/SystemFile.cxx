// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SystemFile.h"

#include "WindowsError.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

namespace medialvoxel
{
namespace
{

/** Transferred at a time: a fraction of a second, after which the work can stop. */
constexpr std::uint64_t BlockSize = std::uint64_t{ 1 } << 23;

/** Others may not read or write what is locked, so locks lie where no file has bytes. */
constexpr std::uint64_t FirstLock = std::uint64_t{ 1 } << 62;

constexpr DWORD ShareAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

constexpr std::intptr_t Unopened = -1;

/** Letters of a name in a folder, on all file systems of Windows. */
constexpr std::size_t LongestName = 255;

HANDLE
ToHandle(std::intptr_t descriptor)
{
  return reinterpret_cast<HANDLE>(descriptor);
}

std::intptr_t
Open(const std::filesystem::path & name, DWORD access, DWORD way, DWORD attributes)
{
  // The system says the same of names with wrong letters.
  if (name.filename().native().size() > LongestName)
  {
    errno = ENAMETOOLONG;
    return Unopened;
  }
  const HANDLE handle = CreateFileW(name.c_str(), access, ShareAll, nullptr, way, attributes, nullptr);
  if (handle == INVALID_HANDLE_VALUE)
  {
    FailWithWindowsError();
  }
  return reinterpret_cast<std::intptr_t>(handle);
}

std::intptr_t
Open(const std::filesystem::path & name, FileAccess access)
{
  constexpr DWORD normal = FILE_ATTRIBUTE_NORMAL;
  constexpr DWORD change = GENERIC_READ | GENERIC_WRITE;
  switch (access)
  {
    case FileAccess::Read:
      return Open(name, GENERIC_READ, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
    case FileAccess::Write:
      return Open(name, GENERIC_WRITE | FILE_READ_ATTRIBUTES, OPEN_EXISTING, normal);
    case FileAccess::WriteUncached:
      break;
    case FileAccess::Change:
      return Open(name, change, OPEN_EXISTING, normal);
    case FileAccess::Make:
      return Open(name, change, OPEN_ALWAYS, normal);
    case FileAccess::MakeEmpty:
      return Open(name, change, CREATE_ALWAYS, normal);
    case FileAccess::MakeNew:
      return Open(name, change, CREATE_NEW, normal);
    case FileAccess::MakeLog:
      return Open(name, GENERIC_READ | FILE_APPEND_DATA, OPEN_ALWAYS, normal);
  }
  errno = ENOTSUP;
  return Unopened;
}

std::vector<char>
CopyIdentity(PSID identity)
{
  const auto * const first = static_cast<const char *>(identity);
  return { first, first + GetLengthSid(identity) };
}

/** The user, or whom new files of the user belong to; empty on failure. */
std::vector<char>
ReadIdentity(TOKEN_INFORMATION_CLASS kind)
{
  HANDLE token = nullptr;
  if (OpenProcessToken(GetCurrentProcess(), TOKEN_QUERY, &token) == 0)
  {
    return {};
  }
  const WindowsHandle closed(token);
  DWORD               size = 0;
  GetTokenInformation(token, kind, nullptr, 0, &size);
  std::vector<char> buffer(size);
  // TOKEN_USER and TOKEN_OWNER begin with an identity, which points into the buffer.
  return GetTokenInformation(token, kind, buffer.data(), size, &size) != 0
           ? CopyIdentity(*reinterpret_cast<const PSID *>(buffer.data()))
           : std::vector<char>();
}

bool
IsOfThisUser(HANDLE handle)
{
  static const std::vector<char> identities[] = { ReadIdentity(TokenUser), ReadIdentity(TokenOwner) };
  DWORD                          size = 0;
  GetKernelObjectSecurity(handle, OWNER_SECURITY_INFORMATION, nullptr, 0, &size);
  std::vector<char> security(size);
  PSID              owner = nullptr;
  BOOL              isDefault = FALSE;
  if (GetKernelObjectSecurity(handle, OWNER_SECURITY_INFORMATION, security.data(), size, &size) == 0 ||
      GetSecurityDescriptorOwner(security.data(), &owner, &isDefault) == 0 || owner == nullptr)
  {
    return false;
  }
  const std::vector<char> identity = CopyIdentity(owner);
  return std::find(std::begin(identities), std::end(identities), identity) != std::end(identities);
}

std::optional<FileStatus>
GetStatusOf(HANDLE handle)
{
  const auto                 join = [](DWORD high, DWORD low) { return std::uint64_t{ high } << 32 | low; };
  BY_HANDLE_FILE_INFORMATION status = {};
  FileStatus                 result;
  if (GetFileType(handle) != FILE_TYPE_DISK)
  {
    // A pipe, or a device
    return handle == INVALID_HANDLE_VALUE ? (errno = EBADF, std::nullopt) : std::optional(result);
  }
  if (!Check(GetFileInformationByHandle(handle, &status)))
  {
    return std::nullopt;
  }
  constexpr std::int64_t ticksTo1970 = 116444736000000000;
  result.isFolder = (status.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  result.isFile = (status.dwFileAttributes & (FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_REPARSE_POINT)) == 0;
  result.isOfThisUser = IsOfThisUser(handle);
  result.numberOfBytes = join(status.nFileSizeHigh, status.nFileSizeLow);
  result.numberOfNames = status.nNumberOfLinks;
  result.disk = status.dwVolumeSerialNumber;
  result.number = join(status.nFileIndexHigh, status.nFileIndexLow);
  const auto time =
    static_cast<std::int64_t>(join(status.ftLastWriteTime.dwHighDateTime, status.ftLastWriteTime.dwLowDateTime));
  result.modified = (time - ticksTo1970) * 100;
  return result;
}

OVERLAPPED
MakePlace(std::uint64_t offset)
{
  OVERLAPPED place = {};
  place.Offset = static_cast<DWORD>(offset);
  place.OffsetHigh = static_cast<DWORD>(offset >> 32);
  return place;
}

/** Repeats a call of the system until all bytes are through. */
template <typename TByte, typename TCall>
bool
Transfer(HANDLE handle, std::uint64_t offset, TByte * data, std::uint64_t numberOfBytes, TCall call)
{
  for (std::uint64_t done = 0; done < numberOfBytes;)
  {
    if (done > 0)
    {
      itk::MedialVoxelCheckAbort();
    }
    const auto wanted = static_cast<DWORD>(std::min(numberOfBytes - done, BlockSize));
    OVERLAPPED place = MakePlace(offset + done);
    DWORD      count = 0;
    if (!Check(call(handle, data + done, wanted, &count, &place)))
    {
      return false;
    }
    if (count == 0)
    {
      errno = ENODATA;
      return false;
    }
    done += count;
  }
  return true;
}

/** Also replaces a file that is open, as MoveFileEx() does not; false where the file system cannot. */
bool
ReplaceOpenFile(const std::filesystem::path & from, const std::filesystem::path & to)
{
  const WindowsHandle file(CreateFileW(
    from.c_str(), DELETE | SYNCHRONIZE, ShareAll, nullptr, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
  if (file.get() == INVALID_HANDLE_VALUE)
  {
    return false;
  }
  // FileRenameInfoEx, which not all headers name
  constexpr auto     renameInfoEx = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22);
  const std::wstring name = std::filesystem::absolute(to).make_preferred().wstring();
  const std::size_t  size = name.size() * sizeof(wchar_t);
  // The structure ends with the first letter of the name.
  std::vector<std::max_align_t> memory((sizeof(FILE_RENAME_INFO) + size) / sizeof(std::max_align_t) + 1);
  auto * const                  rename = reinterpret_cast<FILE_RENAME_INFO *>(memory.data());
  rename->Flags = FILE_RENAME_FLAG_REPLACE_IF_EXISTS | FILE_RENAME_FLAG_POSIX_SEMANTICS;
  rename->FileNameLength = static_cast<DWORD>(size);
  std::memcpy(rename->FileName, name.data(), size);
  return SetFileInformationByHandle(
           file.get(), renameInfoEx, rename, static_cast<DWORD>(sizeof(FILE_RENAME_INFO) + size)) != 0;
}

/** Without waiting, unless \a waits. */
bool
Lock(std::intptr_t descriptor, std::uint64_t position, bool waits)
{
  const DWORD flags = LOCKFILE_EXCLUSIVE_LOCK | (waits ? 0 : LOCKFILE_FAIL_IMMEDIATELY);
  OVERLAPPED  place = MakePlace(position);
  return Check(LockFileEx(ToHandle(descriptor), flags, 0, 1, 0, &place));
}

void
Unlock(std::intptr_t descriptor, std::uint64_t position)
{
  OVERLAPPED place = MakePlace(position);
  UnlockFileEx(ToHandle(descriptor), 0, 1, 0, &place);
}

} // namespace

std::optional<FileStatus>
GetFileStatus(const std::filesystem::path & name, bool followsLinks)
{
  const DWORD      flags = FILE_FLAG_BACKUP_SEMANTICS | (followsLinks ? 0 : FILE_FLAG_OPEN_REPARSE_POINT);
  const SystemFile file(Open(name, FILE_READ_ATTRIBUTES | READ_CONTROL, OPEN_EXISTING, flags));
  return file.IsOpen() ? file.GetStatus() : std::nullopt;
}

bool
Rename(const std::filesystem::path & from, const std::filesystem::path & to, TakenName taken)
{
  if (taken == TakenName::Exchanges)
  {
    errno = ENOSYS;
    return false;
  }
  const bool replaces = taken == TakenName::IsLost;
  return (replaces && ReplaceOpenFile(from, to)) ||
         Check(MoveFileExW(from.c_str(), to.c_str(), replaces ? MOVEFILE_REPLACE_EXISTING : 0));
}

bool
AddName(const std::filesystem::path & file, const std::filesystem::path & name)
{
  return Check(CreateHardLinkW(name.c_str(), file.c_str(), nullptr));
}

void
RemoveName(const std::filesystem::path & name)
{
  DeleteFileW(name.c_str());
}

bool
MakeFolder(const std::filesystem::path & name)
{
  return Check(CreateDirectoryW(name.c_str(), nullptr));
}

std::FILE *
OpenStream(const std::filesystem::path & name)
{
  return _wfopen(name.c_str(), L"rb");
}

SystemFile::SystemFile(const std::filesystem::path & name, FileAccess access)
  : m_Descriptor(Open(name, access))
{}

SystemFile::~SystemFile()
{
  const int error = errno;
  this->Close();
  errno = error;
}

SystemFile
SystemFile::MakeNameless(const std::filesystem::path &)
{
  errno = EOPNOTSUPP;
  return {};
}

SystemFile
SystemFile::MakeScratch(const std::filesystem::path & folder)
{
  constexpr DWORD flags = FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE;
  constexpr int   mostAttempts = 1000;
  SystemFile      file;
  for (int attempt = 0; attempt < mostAttempts; ++attempt)
  {
    const std::string name =
      "medialvoxel-" + std::to_string(GetCurrentProcessId()) + "-" + std::to_string(GetTickCount64() + attempt);
    file = SystemFile(Open(folder / name, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW, flags));
    if (file.IsOpen() || errno != EEXIST)
    {
      break;
    }
  }
  return file;
}

SystemFile
SystemFile::OpenInTurn(const std::filesystem::path & name)
{
  // A file that is open cannot be replaced everywhere, so the turns of all files are bytes of one file of the user.
  std::error_code error;
  const auto      folder = std::filesystem::temp_directory_path(error);
  const auto      whole = std::filesystem::weakly_canonical(name, error);
  SystemFile      turns(folder / "medialvoxel-turns", FileAccess::Make);
  if (turns.IsOpen())
  {
    Lock(turns.m_Descriptor, FirstLock + std::filesystem::hash_value(whole) / 4, true);
  }
  return turns;
}

bool
SystemFile::Close()
{
  const std::intptr_t descriptor = std::exchange(m_Descriptor, Unopened);
  return descriptor == Unopened || Check(CloseHandle(ToHandle(descriptor)));
}

std::optional<FileStatus>
SystemFile::GetStatus() const
{
  return GetStatusOf(ToHandle(m_Descriptor));
}

std::uint64_t
SystemFile::GetSize() const
{
  return this->GetStatus().value_or(FileStatus{}).numberOfBytes;
}

std::filesystem::path
SystemFile::GetOwnName() const
{
  std::wstring name(GetFinalPathNameByHandleW(ToHandle(m_Descriptor), nullptr, 0, 0), L'\0');
  name.resize(GetFinalPathNameByHandleW(ToHandle(m_Descriptor), name.data(), static_cast<DWORD>(name.size()), 0));
  return name;
}

bool
SystemFile::GiveName(const std::filesystem::path &) const
{
  errno = ENOSYS;
  return false;
}

bool
SystemFile::ReadAt(std::uint64_t offset, char * data, std::uint64_t numberOfBytes) const
{
  return Transfer(ToHandle(m_Descriptor), offset, data, numberOfBytes, ReadFile);
}

bool
SystemFile::WriteAt(std::uint64_t offset, const char * data, std::uint64_t numberOfBytes)
{
  return Transfer(ToHandle(m_Descriptor), offset, data, numberOfBytes, WriteFile);
}

bool
SystemFile::Append(const char * data, std::uint64_t numberOfBytes)
{
  DWORD count = 0;
  return Check(WriteFile(ToHandle(m_Descriptor), data, static_cast<DWORD>(numberOfBytes), &count, nullptr)) &&
         count == numberOfBytes;
}

bool
SystemFile::SetSize(std::uint64_t numberOfBytes)
{
  FILE_END_OF_FILE_INFO end = {};
  end.EndOfFile.QuadPart = static_cast<LONGLONG>(numberOfBytes);
  return Check(SetFileInformationByHandle(ToHandle(m_Descriptor), FileEndOfFileInfo, &end, sizeof(end)));
}

bool
SystemFile::Reserve(std::uint64_t numberOfBytes)
{
  // A file has the space of its length, unless it was made a sparse one.
  return this->GetSize() >= numberOfBytes || this->SetSize(numberOfBytes);
}

bool
SystemFile::SyncData() const
{
  return this->Sync();
}

bool
SystemFile::Sync() const
{
  if (m_Descriptor == Unopened)
  {
    return false;
  }
  if (FlushFileBuffers(ToHandle(m_Descriptor)) != 0)
  {
    return true;
  }
  // It asks for the right to write. Folders have nothing to bring to the disk.
  const auto       status = this->GetStatus();
  const SystemFile writable(this->GetOwnName(), FileAccess::Write);
  return (status && status->isFolder) ||
         (writable.IsOpen() && Check(FlushFileBuffers(ToHandle(writable.m_Descriptor))));
}

void
SystemFile::StartSync(std::uint64_t, std::uint64_t) const
{}

bool
SystemFile::LockByte(std::uint64_t position)
{
  const bool isLocked = Lock(m_Descriptor, FirstLock + position, false);
  if (!isLocked && errno == ENOSYS)
  {
    errno = ENOLCK;
  }
  return isLocked;
}

void
SystemFile::UnlockByte(std::uint64_t position)
{
  Unlock(m_Descriptor, FirstLock + position);
}

bool
SystemFile::IsByteLocked(std::uint64_t position) const
{
  // The system does not tell; for a moment, others cannot lock it.
  if (Lock(m_Descriptor, FirstLock + position, false))
  {
    Unlock(m_Descriptor, FirstLock + position);
    return false;
  }
  return errno == EAGAIN;
}

} // end namespace medialvoxel
