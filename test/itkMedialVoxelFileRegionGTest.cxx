// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelFileRegion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

constexpr std::uint64_t FileBytes = std::uint64_t{ 1 } << 22;

/** \class MedialVoxelFileRegionTest
 * \brief A file of holes, data between them, and a hole at its end; beside it the bytes that it must read as. */
class MedialVoxelFileRegionTest : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    std::ofstream(m_Name, std::ios::binary).close();
    std::filesystem::resize_file(m_Name, FileBytes);
    this->Put(1 << 20, 5000);
    this->Put((1 << 20) + 300000, 1);
    this->Put((2 << 20) + 12345, 700000);
  }

  void
  TearDown() override
  {
    std::filesystem::remove(m_Name);
  }

  std::vector<char>
  Read(std::uint64_t begin, std::uint64_t count) const
  {
    std::vector<char> bytes(count, 'x');
    itk::MedialVoxelFileRegion({ FileBytes }, { begin }, { count }, 1).Read({ { m_Name, 0, FileBytes } }, bytes.data());
    return bytes;
  }

  void
  ExpectSame(std::uint64_t begin, std::uint64_t count) const
  {
    const auto first = m_Bytes.begin() + static_cast<std::ptrdiff_t>(begin);
    ASSERT_EQ(this->Read(begin, count), std::vector<char>(first, first + static_cast<std::ptrdiff_t>(count)))
      << begin << ' ' << count;
  }

  const std::string m_Name = "itkMedialVoxelFileRegionGTest-" + std::to_string(std::random_device()()) + ".img";
  std::vector<char> m_Bytes = std::vector<char>(FileBytes, '\0');

private:
  void
  Put(std::uint64_t offset, std::uint64_t count)
  {
    std::fstream file(m_Name, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(offset));
    for (std::uint64_t i = 0; i < count; ++i)
    {
      m_Bytes[offset + i] = static_cast<char>(1 + i % 100);
      file.put(m_Bytes[offset + i]);
    }
  }
};

} // namespace

TEST_F(MedialVoxelFileRegionTest, HolesReadAsZeros)
{
  this->ExpectSame(0, FileBytes);
  this->ExpectSame(FileBytes - 200000, 200000);
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round)
  {
    const std::uint64_t begin = random() % FileBytes;
    this->ExpectSame(begin, 1 + random() % (FileBytes - begin));
  }
}

TEST_F(MedialVoxelFileRegionTest, AFileThatEndsInItsHoleIsRefused)
{
  for (const std::uint64_t size : { std::uint64_t{ 0 }, std::uint64_t{ 100000 }, FileBytes - 1 })
  {
    std::filesystem::resize_file(m_Name, size);
    EXPECT_THROW(this->Read(0, FileBytes), std::runtime_error) << size;
    EXPECT_THROW(this->Read(FileBytes - 100000, 100000), std::runtime_error) << size;
    EXPECT_THROW(this->Read(FileBytes - 10, 10), std::runtime_error) << size;
  }
}

TEST_F(MedialVoxelFileRegionTest, SegmentsFollowEachOther)
{
  const std::vector<itk::MedialVoxelFileSegment> segments{ { m_Name, (2 << 20) + 12345, 100 },
                                                           { m_Name, 1 << 20, 7 },
                                                           { m_Name, 0, 200000 } };
  std::vector<char>                              expected;
  for (const itk::MedialVoxelFileSegment & segment : segments)
  {
    const auto first = m_Bytes.begin() + static_cast<std::ptrdiff_t>(segment.offset);
    expected.insert(expected.end(), first, first + static_cast<std::ptrdiff_t>(segment.numberOfBytes));
  }
  std::vector<char> bytes(expected.size());
  itk::MedialVoxelFileRegion({ bytes.size() }, { 0 }, { bytes.size() }, 1).Read(segments, bytes.data());
  EXPECT_EQ(bytes, expected);
}
