// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "JsonFile.h"

#include "Errors.h"
#include "TemporaryFolder.h"

#include "itkMedialVoxelHeaderText.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

using namespace medialvoxel;

namespace
{

/** Exit status and message of the failure to read the text of a file. */
std::pair<ExitStatus, std::string>
FailToRead(const TemporaryFolder & folder, const std::string & content)
{
  folder.Write("a.json", content);
  try
  {
    ReadJsonFile(folder / "a.json", 1 << 20);
  }
  catch (const JobError & error)
  {
    return { error.GetStatus(), error.what() };
  }
  return { ExitStatus::Done, "" };
}

} // namespace

TEST(JsonFile, ReadsOneValue)
{
  const TemporaryFolder folder;
  folder.Write("a.json", " {\"b\": [1, 0.25, null]}\n");
  const nlohmann::json value = ReadJsonFile(folder / "a.json", 24);
  EXPECT_EQ(value.at("b").at(1).get<double>(), 0.25);
}

TEST(JsonFile, RefusesWhatIsNotJson)
{
  const TemporaryFolder folder;
  for (const char * const content : { "", "{", "{} {}", "{\"a\": 01}", "[1, 2", "\xff\xfe", "{\"a\": NaN}" })
  {
    const auto [status, message] = FailToRead(folder, content);
    EXPECT_EQ(status, ExitStatus::CorruptInput) << content;
    EXPECT_NE(message.find("a.json is not JSON"), std::string::npos) << message;
  }
}

TEST(JsonFile, DoesNotQuoteWhatIsNotJson)
{
  const TemporaryFolder folder;
  const std::string     digits(100000, '1');
  for (const std::string & content :
       { std::string("\x7f"), std::string("\xc2\x85"), '"' + digits + '\n', digits + "e999" })
  {
    const std::string message = FailToRead(folder, content).second;
    EXPECT_EQ(message, itk::MedialVoxelText::MakePrintable(message));
    EXPECT_NE(message.find("a.json is not JSON"), std::string::npos);
    EXPECT_LT(message.size(), 400u);
  }
}

TEST(JsonFile, RefusesDeepNestingAndLongFilesWithoutHarm)
{
  const TemporaryFolder folder;
  EXPECT_EQ(FailToRead(folder, std::string(1 << 20, '[')).first, ExitStatus::CorruptInput);
  const auto [status, message] = FailToRead(folder, std::string((1 << 20) + 1, ' '));
  EXPECT_EQ(status, ExitStatus::CorruptInput);
  EXPECT_NE(message.find("more than the 1048576 bytes"), std::string::npos) << message;
}

TEST(JsonFile, RefusesWhatWouldTakeStackOrMemory)
{
  const TemporaryFolder folder;
  const auto            nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(FailToRead(folder, nested(64)).first, ExitStatus::Done);
  for (const std::size_t depth : { 65, 100000 })
  {
    const auto [status, message] = FailToRead(folder, nested(depth));
    EXPECT_EQ(status, ExitStatus::CorruptInput);
    EXPECT_NE(message.find("more than 64 values within each other"), std::string::npos) << message;
  }
  std::string many = "[0";
  for (int i = 0; i < 100000; ++i)
  {
    many += ",0";
  }
  const auto [status, message] = FailToRead(folder, many + "]");
  EXPECT_EQ(status, ExitStatus::CorruptInput);
  EXPECT_NE(message.find("more than 100000 values"), std::string::npos) << message;
}

TEST(JsonFile, RefusesNumbersOutOfRange)
{
  const auto [status, message] = FailToRead(TemporaryFolder(), "1e999");
  EXPECT_EQ(status, ExitStatus::CorruptInput);
  EXPECT_NE(message.find("a.json is not JSON"), std::string::npos) << message;
}

TEST(JsonFile, TellsWhatCannotBeRead)
{
  const TemporaryFolder folder;
  for (const auto & name : { folder / "missing.json", folder / "" })
  {
    try
    {
      ReadJsonFile(name, 10);
      ADD_FAILURE();
    }
    catch (const JobError & error)
    {
      EXPECT_EQ(error.GetStatus(), ExitStatus::Failure);
    }
  }
}
