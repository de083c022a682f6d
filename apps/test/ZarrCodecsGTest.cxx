// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Crc32c.h"
#include "MemoryPacking.h"
#include "ZarrCodecs.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

using namespace medialvoxel;

/** The examples of RFC 3720, B.4. */
TEST(Crc32c, IsThatOfTheStandard)
{
  EXPECT_EQ(GetCrc32c(std::string(32, '\0')), 0x8A9136AAu);
  EXPECT_EQ(GetCrc32c(std::string(32, '\xFF')), 0x62A8AB43u);
  std::string ascending(32, '\0');
  std::iota(ascending.begin(), ascending.end(), '\0');
  EXPECT_EQ(GetCrc32c(ascending), 0x46DD794Eu);
}

TEST(Crc32c, IsComparedAndLeftOut)
{
  const std::string bytes(32, '\0');
  EXPECT_EQ(CheckCrc32c(bytes + "\xAA\x36\x91\x8A"), bytes);
  EXPECT_FALSE(CheckCrc32c(bytes + "\xAA\x36\x91\x8B"));
  EXPECT_FALSE(CheckCrc32c("abc"));
}

TEST(MemoryPacking, AnyPartIsThere)
{
  std::vector<char> values(300000);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<char>(i % 7000 < 200 ? i * i : 3);
  }
  std::vector<char>       workspace;
  const std::vector<char> packed = PackInMemory(values, 4, workspace);
  std::vector<char>       part(4 * 20001);
  UnpackFromMemory(packed, 4, 31234, 20001, part.data());
  EXPECT_TRUE(std::equal(part.begin(), part.end(), values.begin() + 4 * 31234));
}

TEST(ZarrCodecs, UnpackWhatTheyPacked)
{
  std::vector<char> chunk(100000);
  std::iota(chunk.begin(), chunk.end(), '\0');
  for (const ZarrCompression compression : { ZarrCompression::Gzip, ZarrCompression::BloscZstd })
  {
    const ZarrCodec * const codec = GetZarrCodec(compression);
    ASSERT_TRUE(codec);
    if (codec->pack == nullptr)
    {
      continue; // built without the library
    }
    ZarrUnpacker unpacker({ codec }, chunk.size());
    unpacker.GetPacked().resize(unpacker.GetMaximumSize());
    const auto bytes =
      codec->pack({ chunk.data(), chunk.size() }, 2, unpacker.GetPacked().data(), unpacker.GetPacked().size());
    ASSERT_TRUE(bytes);
    unpacker.GetPacked().resize(*bytes);
    std::vector<char> again;
    EXPECT_TRUE(unpacker.Unpack(again));
    EXPECT_EQ(again, chunk);
    // To a smaller chunk they do not fit.
    ZarrUnpacker smaller({ codec }, chunk.size() - 1);
    EXPECT_FALSE(smaller.Unpack(again));
  }
}
