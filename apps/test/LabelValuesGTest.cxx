// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LabelValues.h"

#include <gtest/gtest.h>

using namespace medialvoxel;

namespace
{

/** The label of a text in the types of voxels, all of which have zero. */
template <typename TValue>
std::optional<TValue>
Convert(const std::string & text)
{
  return ConvertLabel<TValue>(ParseLabel(text).value());
}

} // namespace

TEST(LabelValues, ComeBackAsTheyWere)
{
  for (const char * const text : { "0",
                                   "-1",
                                   "100000",
                                   "1000000000000000",
                                   "9007199254740993",
                                   "-9007199254740993",
                                   "9223372036854775807",
                                   "9223372036854775808",
                                   "-9223372036854775808",
                                   "18446744073709551615" })
  {
    ASSERT_TRUE(ParseLabel(text)) << text;
    EXPECT_EQ(FormatLabel(*ParseLabel(text)), text);
  }
  EXPECT_EQ(FormatLabel(ParseLabel("-0").value()), "0");
  EXPECT_EQ(FormatLabel(ParseLabel("0012").value()), "12");
}

TEST(LabelValues, OtherTexts)
{
  for (const char * const text : { "",
                                   "-",
                                   "--1",
                                   "+1",
                                   " 1",
                                   "1 ",
                                   "1.0",
                                   "1e3",
                                   "0x1",
                                   "nan",
                                   "18446744073709551616",
                                   "-9223372036854775809",
                                   "100000000000000000000000" })
  {
    EXPECT_FALSE(ParseLabel(text)) << text;
  }
}

TEST(LabelValues, TypesHaveThemOrNot)
{
  EXPECT_EQ(Convert<std::uint8_t>("255"), std::uint8_t{ 255 });
  EXPECT_FALSE(Convert<std::uint8_t>("256"));
  EXPECT_FALSE(Convert<std::uint8_t>("-1"));
  EXPECT_EQ(Convert<std::int8_t>("-128"), std::int8_t{ -128 });
  EXPECT_FALSE(Convert<std::int8_t>("-129"));
  EXPECT_EQ(Convert<std::int64_t>("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_FALSE(Convert<std::int64_t>("9223372036854775808"));
  EXPECT_EQ(Convert<std::uint64_t>("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(Convert<float>("-16777216"), -16777216.0F);
  EXPECT_FALSE(Convert<float>("16777217"));
  EXPECT_EQ(Convert<double>("9007199254740992"), 9007199254740992.0);
  EXPECT_FALSE(Convert<double>("9007199254740993"));
  EXPECT_EQ(Convert<double>("9223372036854775808"), 9223372036854775808.0);
  EXPECT_FALSE(Convert<double>("18446744073709551615"));
}
