// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelSequentialReader.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#ifdef __linux__
#  include <fcntl.h>
#  include <sys/mman.h>
#  include <unistd.h>
#endif

namespace
{

constexpr std::uint64_t Slice = std::uint64_t{ 1 } << 16;

/** \class MedialVoxelSequentialReaderTest
 * \brief A volume of slices of 64 KiB in two files. */
class MedialVoxelSequentialReaderTest : public ::testing::Test
{
protected:
  static constexpr std::uint64_t NumberOfSlices = 2048;

  void
  SetUp() override
  {
    std::vector<char> slice(Slice);
    std::ofstream     first(m_First, std::ios::binary);
    std::ofstream     second(m_Second, std::ios::binary);
    for (std::uint64_t z = 0; z < NumberOfSlices; ++z)
    {
      std::fill(slice.begin(), slice.end(), static_cast<char>(z % 127));
      (z < NumberOfSlices / 2 ? first : second).write(slice.data(), static_cast<std::streamsize>(Slice));
    }
  }

  void
  TearDown() override
  {
    std::filesystem::remove(m_First);
    std::filesystem::remove(m_Second);
  }

  void
  Read(std::uint64_t first, std::uint64_t count)
  {
    std::vector<char> voxels(count * Slice);
    m_Reader.Read(itk::MedialVoxelFileRegion({ Slice, NumberOfSlices }, { 0, first }, { Slice, count }, 1),
                  { { m_First, 0, NumberOfSlices / 2 * Slice }, { m_Second, 0, NumberOfSlices / 2 * Slice } },
                  voxels.data());
    for (std::uint64_t z = 0; z < count; ++z)
    {
      ASSERT_EQ(voxels[z * Slice], static_cast<char>((first + z) % 127)) << first + z;
    }
  }

#ifdef __linux__
  /** Takes the file out of the cache of the system; false where that cannot be done, as on file systems in memory. */
  static bool
  DropFromCache(const std::string & name)
  {
    const int descriptor = open(name.c_str(), O_RDWR);
    fsync(descriptor);
    posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
    close(descriptor);
    return !IsCached(name, 0);
  }

  /** True when a slice of a file is in the cache of the system. */
  static bool
  IsCached(const std::string & name, std::uint64_t slice)
  {
    const int    descriptor = open(name.c_str(), O_RDWR);
    void * const map = mmap(nullptr, Slice, PROT_READ, MAP_SHARED, descriptor, static_cast<off_t>(slice * Slice));
    std::vector<unsigned char> pages(Slice / static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + 1);
    mincore(map, Slice, pages.data());
    munmap(map, Slice);
    close(descriptor);
    return (pages.front() & 1) != 0;
  }

  /** Reading ahead goes on while the program does something else. */
  static bool
  BecomesCached(const std::string & name, std::uint64_t slice)
  {
    for (int i = 0; i < 500 && !IsCached(name, slice); ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return IsCached(name, slice);
  }
#endif

  const std::string m_First = "itkMedialVoxelSequentialReaderGTest-" + std::to_string(std::random_device()()) + ".a";
  const std::string m_Second = m_First + "b";
  itk::MedialVoxelSequentialReader m_Reader;
};

} // namespace

TEST_F(MedialVoxelSequentialReaderTest, ReadsInAnyOrder)
{
  this->Read(0, 10);
  this->Read(10, 500);
  this->Read(510, 100);
  this->Read(900, 124);
  this->Read(3, 1);
  this->Read(4, 1);
  EXPECT_EQ(m_Reader.GetNumberOfBytesRead(), 736 * Slice);
}

#ifdef __linux__
TEST_F(MedialVoxelSequentialReaderTest, BringsWhatFollowsIntoTheCache)
{
  if (!DropFromCache(m_First) || !DropFromCache(m_Second))
  {
    GTEST_SKIP() << "the file system of this folder keeps files in memory";
  }
  // Far more than the system reads ahead by itself; the end of it lies in the second file.
  this->Read(0, 680);
  EXPECT_TRUE(BecomesCached(m_First, 1023));
  EXPECT_TRUE(BecomesCached(m_Second, 680 + 679 - 1024));
  EXPECT_FALSE(IsCached(m_Second, 1023));
}

TEST_F(MedialVoxelSequentialReaderTest, BringsNothingForJumps)
{
  if (!DropFromCache(m_First) || !DropFromCache(m_Second))
  {
    GTEST_SKIP() << "the file system of this folder keeps files in memory";
  }
  this->Read(1, 400);
  EXPECT_FALSE(IsCached(m_First, 790));
  // The jump ends where the next one begins.
  this->Read(401, 10);
  EXPECT_TRUE(BecomesCached(m_First, 420));
  EXPECT_FALSE(IsCached(m_First, 790));
}
#endif
