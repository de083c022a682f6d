// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FillIn.h"
#include "MeshJson.h"
#include "ResultViews.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace medialvoxel;

namespace
{

const Json Result = Json::parse(R"({
  "input": { "file": "/a/<b>.mha", "unit": null, "spacing": [1, 0.5] }, "parameters": {},
  "size": [7, 8, 9], "length": 0.123456, "none": null, "no": false, "zero": 0, "word": "", "count": 3, "all": 4,
  "points": [[1.5, 2], [3, 4, 5]], "list": [{ "name": "a", "x": 1 }, { "x": 2 }, { "name": null, "x": 3 }],
  "kinds": { "thin": { "x": 5 }, "thick": null } })");

std::string
Fill(const std::string & text)
{
  return FillIn(text, Result);
}

} // namespace

TEST(FillIn, ValuesInFormats)
{
  EXPECT_EQ(Fill("no place"), "no place");
  EXPECT_EQ(Fill("{count} of {all}"), "3 of 4");
  EXPECT_EQ(Fill("{length} {short length} {fixed length} {percent length}"), "0.123456 0.1235 0.12 12.35 %");
  EXPECT_EQ(Fill("{short count length all}"), "4");
  EXPECT_EQ(Fill("{percent count all} {percent count all all} {percent count zero} {rough length} {rough count}"),
            "75.00 % 18.75 % - 0.123 3");
  EXPECT_EQ(Fill("{count count all} {share count all}"), "3 (75.00 %) 75.00 %");
  EXPECT_EQ(Fill("{count count zero zero} {share zero zero}"), "3 -");
  EXPECT_EQ(Fill("{size size}: {times size}, {list size}"), "3: 7 x 8 x 9, 7, 8, 9");
  EXPECT_EQ(Fill("{points points.0 points.1}; {position points.0}; {lengths points.0}"),
            "1.5 2 0 3 4 5; 1.5, 2, 0; 1.5, 2");
  EXPECT_EQ(Fill("{name input.file} in {unit}"), "<b>.mha in units of the spacing");
  EXPECT_EQ(Fill("{contrast count all zero}"), "75.0 %");
  EXPECT_EQ(Fill("{none} {not.there} {short none} {points.7}"), "- - - -");
}

TEST(FillIn, ConditionsLeaveTextOut)
{
  EXPECT_EQ(Fill("[length?a][none?b][no?c][word?d][zero?e][not.there?f]"), "ae");
  EXPECT_EQ(Fill("[!none?a][zero>0?b][count>0?c][count=3?d][input.unit=mm?e][!all=3?f]"), "acdf");
  EXPECT_EQ(Fill("[count&none?a][count&length?b][none|no?c][none|count&all?d]"), "bd");
  EXPECT_EQ(Fill("[count?a[none?b[all?c]]{all}[all?d]]"), "a4d");
}

TEST(FillIn, ListsHaveATextForEachMember)
{
  EXPECT_EQ(Fill("[list:{#}{x}[name?{name}] of {all};]"), "11a of 4;22 of 4;33 of 4;");
  EXPECT_EQ(Fill("[list*2:{x}]"), "12");
  EXPECT_EQ(Fill("[kinds:{@}[.?={x}] ]"), "thin=5 thick ");
  EXPECT_EQ(Fill("[kinds:[list*1:{@}{x}]]"), "thin1thick1");
  EXPECT_EQ(Fill("[size:{.},][none:a]"), "7,8,9,");
}

TEST(FillIn, HtmlIsEscapedAndHasParts)
{
  const PageParts parts = [](const std::string & name, std::string & page) { page += "<" + name + ">"; };
  EXPECT_EQ(FillInHtml("<i>{name input.file}</i>{part view}", Result, parts), "<i>&lt;b&gt;.mha</i><view>");
}

TEST(FillIn, WrongTextsAreRefused)
{
  EXPECT_THROW(Fill("{long count}"), std::invalid_argument);
  EXPECT_THROW(Fill("{count"), std::invalid_argument);
  EXPECT_THROW(Fill("[count?a"), std::invalid_argument);
  EXPECT_THROW(Fill("[count]"), std::invalid_argument);
}

TEST(FillIn, LimitsOfMeshes)
{
  const auto text = [](const char * limit) { return FillIn(MeshLimitText, Json::parse(limit)); };
  EXPECT_EQ(text(R"({ "value": 0.41, "least": 0.3, "holds": true })"), "0.41, at least 0.3");
  EXPECT_EQ(text(R"({ "value": 0.2, "least": 0.3, "holds": false })"), "0.2, less than 0.3");
  EXPECT_EQ(text(R"({ "value": 0, "most": 0, "holds": true })"), "0, at most 0");
  EXPECT_EQ(text(R"({ "value": 6, "most": 5, "holds": false })"), "6, more than 5");
}
