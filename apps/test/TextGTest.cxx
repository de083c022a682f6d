// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace medialvoxel;

TEST(Text, ShortNumbersHaveNoExponentUpToABillion)
{
  EXPECT_EQ(FormatShort(0.123456), "0.1235");
  EXPECT_EQ(FormatShort(9999.4), "9999");
  EXPECT_EQ(FormatShort(9999.6), "10000");
  EXPECT_EQ(FormatShort(-85273.4), "-85273");
  EXPECT_EQ(FormatShort(2e9), "2e+09");
  EXPECT_EQ(FormatShort(26.6094, 3), "26.6");
  EXPECT_EQ(FormatShort(1234.5, 3), "1234");
}

TEST(Text, NumbersAreTheWholeText)
{
  for (const auto Parse : { ParseDouble, itk::MedialVoxelText::ParseStreamedDouble })
  {
    EXPECT_EQ(Parse("72.5"), 72.5);
    EXPECT_EQ(Parse("+3"), 3.0);
    EXPECT_EQ(Parse("-1e-3"), -1e-3);
    EXPECT_EQ(Parse(".5"), Parse("5.E-1"));
    EXPECT_TRUE(std::signbit(Parse("-0").value()));
    EXPECT_TRUE(std::isnan(Parse("-NaN").value()));
    EXPECT_EQ(Parse("-inf"), -Parse("Infinity").value());
    EXPECT_EQ(Parse("2.2250738585072014e-308"), std::numeric_limits<double>::min());
    EXPECT_EQ(Parse("9007199254740993"), 9007199254740992.0); // between two numbers: the even one
    for (const char * const text :
         { "",   "3x",  "x3",    " 3",    "3 ", "+-3", "++3",   "--3", "0x10", "1,5", "1.2.3", ".",   "e3",
           "1e", "1e+", "1e999", "nan 1", "-",  "+",   "0x1p3", "3\n", "\t3",  "1f",  "in",    "infi" })
    {
      EXPECT_FALSE(Parse(text)) << text;
    }
  }
}

TEST(Text, StreamsReadNumbersAsFromChars)
{
  const std::string letters = "0123456789+-.eEinfa x";
  std::mt19937      random(7);
  int               numbers = 0;
  for (int i = 0; i < 200000; ++i)
  {
    std::string text(1 + random() % 6, ' ');
    std::generate(text.begin(), text.end(), [&] { return letters[random() % letters.size()]; });
    const auto number = ParseDouble(text);
    const bool isTiny = number && *number != 0 && std::abs(*number) < std::numeric_limits<double>::min();
    const auto streamed = itk::MedialVoxelText::ParseStreamedDouble(text);
    ASSERT_EQ(streamed.has_value(), number && !isTiny) << text;
    ASSERT_EQ(FormatNumber(streamed.value_or(0)), FormatNumber(isTiny ? 0 : number.value_or(0))) << text;
    numbers += number.has_value();
  }
  EXPECT_GT(numbers, 10000);
  for (int i = 0; i < 100000; ++i)
  {
    const std::string text =
      FormatNumber(std::ldexp(random() * 1e-3 + random(), static_cast<int>(random() % 1900) - 950));
    ASSERT_EQ(itk::MedialVoxelText::ParseStreamedDouble(text), ParseDouble(text)) << text;
  }
}

TEST(Text, IntegersAreTheWholeText)
{
  EXPECT_EQ(ParseInteger("-12"), -12);
  for (const char * const text : { "", "3.0", "1e3", "9223372036854775808" })
  {
    EXPECT_FALSE(ParseInteger(text)) << text;
  }
}

TEST(Text, ByteSizesTakeUnits)
{
  EXPECT_EQ(ParseByteSize("17"), 17u);
  EXPECT_EQ(ParseByteSize("2K"), 2048u);
  EXPECT_EQ(ParseByteSize("1.5m"), 1536u * 1024u);
  EXPECT_EQ(ParseByteSize("8G"), std::uint64_t{ 8 } << 30);
  EXPECT_EQ(ParseByteSize("4T"), std::uint64_t{ 4 } << 40);
  for (const char * const text : { "2G", "2g", "2GB", "2GiB", "2gib", "2048MB", "2097152KiB", "0.001953125TB" })
  {
    EXPECT_EQ(ParseByteSize(text), std::uint64_t{ 2 } << 30) << text;
  }
  for (const char * const text :
       { "", "K", "-1K", "1KX", "1Bi", "1iB", "2GG", "2GBB", "2GiBx", "GiB", "x", "nan", "inf", "1e30", "99999999T" })
  {
    EXPECT_FALSE(ParseByteSize(text)) << text;
  }
}

TEST(Text, SizesAreShortToRead)
{
  EXPECT_EQ(FormatBytes(0), "0 B");
  EXPECT_EQ(FormatBytes(1023), "1023 B");
  EXPECT_EQ(FormatBytes(1536), "1.5 KiB");
  EXPECT_EQ(FormatBytes(std::uint64_t{ 3 } << 40), "3.0 TiB");
}

TEST(Text, NumbersReadBackExactly)
{
  for (const double value : { 0.1, 0.9570312, 1.0 / 3.0, 1e-300, 123456789.125, -0.5 })
  {
    EXPECT_EQ(ParseDouble(FormatNumber(value)), value);
  }
}

TEST(Text, ErrorsDoNotTellWhereObjectsAre)
{
  EXPECT_EQ(RemoveOrigin("ITK ERROR: StreamingRawImageIO(0x56303e870920): Cannot read: a(0x1): b"),
            "Cannot read: a(0x1): b");
  EXPECT_EQ(RemoveOrigin("out of luck, ITK ERROR: A(0x1): "), "out of luck, ITK ERROR: A(0x1): ");
  EXPECT_EQ(RemoveOrigin(""), "");
}

TEST(Text, SplitsAndTrims)
{
  EXPECT_EQ(SplitAtBlanks("  a\tbc  d\r"), (std::vector<std::string>{ "a", "bc", "d" }));
  EXPECT_TRUE(SplitAtBlanks(" \t ").empty());
  EXPECT_EQ(Trim(" \ta b\r"), "a b");
  EXPECT_EQ(FormatSize({ 256, 256, 110 }), "256 x 256 x 110");
}
