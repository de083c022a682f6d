// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BitStore.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace medialvoxel
{
namespace
{

class MemoryBitStore : public BitStore
{
public:
  explicit MemoryBitStore(std::uint64_t numberOfVoxels)
  {
    m_Words.reserve(GetBitStoreBytes(numberOfVoxels) / sizeof(WordType));
  }

  void
  Append(const std::vector<WordType> & words) override
  {
    m_Words.insert(m_Words.end(), words.begin(), words.end());
  }

  void
  Read(std::uint64_t firstWord, std::uint64_t numberOfWords, WordType * words) const override
  {
    std::copy_n(m_Words.data() + firstWord, numberOfWords, words);
  }

private:
  std::vector<WordType> m_Words;
};

/** A new file that no folder lists. */
int
OpenNamelessFile(const std::filesystem::path & folder)
{
#ifdef O_TMPFILE
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR))
  {
    return descriptor;
  }
#endif
  std::string name = (folder / "medialvoxel-XXXXXX").string();
  const int   named = mkstemp(name.data());
  if (named >= 0)
  {
    unlink(name.c_str());
  }
  return named;
}

class FileBitStore : public BitStore
{
public:
  FileBitStore(const std::filesystem::path & folder, std::uint64_t numberOfVoxels)
    : m_Descriptor(OpenNamelessFile(folder))
    , m_Folder(folder)
  {
    if (m_Descriptor < 0)
    {
      Fail(ExitStatus::Refused, "cannot create a scratch file in ", folder.string(), ": ", std::strerror(errno));
    }
    const std::uint64_t bytes = GetBitStoreBytes(numberOfVoxels);
    const int           error = posix_fallocate(m_Descriptor, 0, static_cast<off_t>(bytes));
    // A file system that cannot reserve is asked again with every write.
    if (error != 0 && error != EOPNOTSUPP && error != EINVAL)
    {
      close(m_Descriptor);
      Fail(ExitStatus::Refused,
           "cannot reserve ",
           FormatBytes(bytes),
           " for the scratch file in ",
           folder.string(),
           ": ",
           std::strerror(error));
    }
  }

  ~FileBitStore() override { close(m_Descriptor); }

  FileBitStore(const FileBitStore &) = delete;
  FileBitStore &
  operator=(const FileBitStore &) = delete;

  void
  Append(const std::vector<WordType> & words) override
  {
    Transfer(
      words.size(), m_AppendedWords, reinterpret_cast<const char *>(words.data()), "write", [&](auto... arguments) {
        return pwrite(m_Descriptor, arguments...);
      });
    m_AppendedWords += words.size();
  }

  void
  Read(std::uint64_t firstWord, std::uint64_t numberOfWords, WordType * words) const override
  {
    Transfer(numberOfWords, firstWord, reinterpret_cast<char *>(words), "read", [&](auto... arguments) {
      return pread(m_Descriptor, arguments...);
    });
  }

private:
  /** Repeats a call of the system until all bytes are through. */
  template <typename TByte, typename TCall>
  void
  Transfer(std::uint64_t numberOfWords, std::uint64_t firstWord, TByte * data, const char * action, TCall call) const
  {
    const std::uint64_t bytes = numberOfWords * sizeof(WordType);
    const std::uint64_t offset = firstWord * sizeof(WordType);
    for (std::uint64_t done = 0; done < bytes;)
    {
      const ssize_t count = call(data + done, bytes - done, static_cast<off_t>(offset + done));
      if (count > 0)
      {
        done += static_cast<std::uint64_t>(count);
      }
      else if (count == 0 || errno != EINTR)
      {
        Fail(ExitStatus::Failure,
             "cannot ",
             action,
             " the scratch file in ",
             m_Folder.string(),
             ": ",
             count == 0 ? "it ends early" : std::strerror(errno));
      }
    }
  }

  int                   m_Descriptor;
  std::filesystem::path m_Folder;
  std::uint64_t         m_AppendedWords{ 0 };
};

} // namespace

std::unique_ptr<BitStore>
MakeBitStoreInMemory(std::uint64_t numberOfVoxels)
{
  return std::make_unique<MemoryBitStore>(numberOfVoxels);
}

std::unique_ptr<BitStore>
MakeBitStoreInFile(const std::filesystem::path & folder, std::uint64_t numberOfVoxels)
{
  return std::make_unique<FileBitStore>(folder, numberOfVoxels);
}

} // end namespace medialvoxel
