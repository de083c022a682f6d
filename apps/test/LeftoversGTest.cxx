// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Leftovers.h"

#include "TemporaryFolder.h"
#include "TemporaryName.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

using namespace medialvoxel;

namespace
{

/** The number of no process: more than systems give. */
constexpr int DeadProcess = 999999999;

std::string
MakeName(const std::string & fileName, const ProcessIdentity & process)
{
  return fileName + "." + process.host + "-" + std::to_string(process.number) + "-" +
         std::to_string(process.startTime) + "-0.partial";
}

class LeftoversTest : public testing::Test
{
protected:
  void
  SetUp() override
  {
    if (GetThisProcess().host.empty())
    {
      GTEST_SKIP() << "the system does not tell processes apart";
    }
    m_Dead = GetThisProcess();
    m_Dead.number = DeadProcess;
  }

  std::string
  MakeDeadName(const std::string & fileName) const
  {
    return MakeName(fileName, m_Dead);
  }

  std::set<std::string>
  ListNames() const
  {
    std::set<std::string> names;
    for (const auto & entry : std::filesystem::directory_iterator(m_Folder / ""))
    {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  void
  RemoveAll() const
  {
    RemoveLeftovers((m_Folder / "").parent_path());
  }

  TemporaryFolder m_Folder;
  ProcessIdentity m_Dead;
};

} // namespace

TEST_F(LeftoversTest, OfDeadProcessesAreRemoved)
{
  m_Folder.Write(MakeDeadName("a.mha"), "half");
  m_Folder.Write(MakeDeadName("b (1).mha"), "half");
  std::filesystem::create_directories(m_Folder / (MakeDeadName("c.zarr") + "/0/1"));
  m_Folder.Write(MakeDeadName("c.zarr") + "/0/1/2", "half");
  ProcessIdentity former = GetThisProcess(); // of the same number, before this one
  --former.startTime;
  m_Folder.Write(MakeName("d.mha", former), "half");
  this->RemoveAll();
  EXPECT_EQ(this->ListNames(), std::set<std::string>());
}

TEST_F(LeftoversTest, HostIsTwelveDigits)
{
  const std::string & host = m_Dead.host;
  EXPECT_EQ(host.size(), 12u);
  EXPECT_EQ(host.find_first_not_of("0123456789abcdef"), std::string::npos) << host;
}

TEST_F(LeftoversTest, OfOthersStay)
{
  ProcessIdentity elsewhere = m_Dead;
  elsewhere.host.back() = elsewhere.host.back() == '0' ? '1' : '0';
  const std::set<std::string> names{ MakeName("a.mha", GetThisProcess()),
                                     MakeName("b.mha", elsewhere),
                                     "a.mha",
                                     "a.mha.partial",
                                     "a.mha." + std::to_string(m_Dead.number) + "-0.partial",
                                     "a.mha.0123456789abcdef.partial",
                                     this->MakeDeadName("a.mha") + ".old",
                                     this->MakeDeadName("a.mha") + "~",
                                     this->MakeDeadName("").substr(1) };
  for (const std::string & name : names)
  {
    m_Folder.Write(name, "whole");
  }
  this->RemoveAll();
  EXPECT_EQ(this->ListNames(), names);
}

TEST_F(LeftoversTest, ALinkIsNotFollowed)
{
  m_Folder.Write("precious", "whole");
  std::filesystem::create_symlink(m_Folder / "precious", m_Folder / this->MakeDeadName("a.mha"));
  this->RemoveAll();
  EXPECT_EQ(m_Folder.Read("precious"), "whole");
}

/** Killed between the names of the voxels and of the header. */
TEST_F(LeftoversTest, VoxelsWithoutAHeaderAreRemoved)
{
  m_Folder.Write("a-7.raw", "voxels");
  std::filesystem::create_hard_link(m_Folder / "a-7.raw", m_Folder / this->MakeDeadName("a.mhd"));
  m_Folder.Write("a.raw", "voxels");
  m_Folder.Write("a.mhd", "ElementDataFile = a.raw\n");
  this->RemoveAll();
  EXPECT_EQ(this->ListNames(), (std::set<std::string>{ "a.mhd", "a.raw" }));
}

TEST_F(LeftoversTest, VoxelsWithAHeaderStay)
{
  m_Folder.Write("a-7.raw", "voxels");
  std::filesystem::create_hard_link(m_Folder / "a-7.raw", m_Folder / this->MakeDeadName("a.nhdr"));
  m_Folder.Write("a.nhdr", "data file: a-7.raw\n");
  m_Folder.Write("b.raw", "voxels");
  std::filesystem::create_hard_link(m_Folder / "b.raw", m_Folder / this->MakeDeadName("c.mhd"));
  this->RemoveAll();
  EXPECT_EQ(this->ListNames(), (std::set<std::string>{ "a-7.raw", "a.nhdr", "b.raw" }));
}

/** Killed when its header had replaced another one, whose voxels were still there. */
TEST_F(LeftoversTest, VoxelsOfAReplacedHeaderAreRemoved)
{
  m_Folder.Write("a.raw", "old voxels");
  m_Folder.Write("a-1.raw", "voxels");
  m_Folder.Write("a.mhd", "ElementDataFile = a-1.raw\n");
  m_Folder.Write(this->MakeDeadName("a.mhd"), "ElementDataFile = a.raw\n");
  this->RemoveAll();
  EXPECT_EQ(this->ListNames(), (std::set<std::string>{ "a.mhd", "a-1.raw" }));
}

TEST_F(LeftoversTest, VoxelsThatAHeaderOfADeadProcessNamesButOthersHaveStay)
{
  m_Folder.Write("a.raw", "of a process that runs");
  const std::string atWork = MakeName("a.mhd", GetThisProcess());
  std::filesystem::create_hard_link(m_Folder / "a.raw", m_Folder / atWork);
  m_Folder.Write(this->MakeDeadName("a.mhd"), "ElementDataFile = a.raw\n");
  m_Folder.Write("other.raw", "of another header");
  m_Folder.Write(MakeName("a.mhd", { m_Dead.host, m_Dead.number, 1 }), "ElementDataFile = other.raw\n");
  this->RemoveAll();
  EXPECT_EQ(this->ListNames(), (std::set<std::string>{ "a.raw", atWork, "other.raw" }));
}

TEST(TemporaryName, TellsItsProcess)
{
  const auto path = MakeTemporaryName("/folder/a.mha", 3);
  EXPECT_EQ(path.parent_path(), "/folder");
  const auto name = ParseTemporaryName(path.filename().string());
  ASSERT_TRUE(name);
  EXPECT_EQ(name->fileName, "a.mha");
  EXPECT_EQ(name->process.number, GetThisProcess().number);
  EXPECT_EQ(name->process.startTime, GetThisProcess().startTime);
  EXPECT_FALSE(HasEnded(name->process));
}

TEST(TemporaryName, IsCutBetweenCharacters)
{
  for (std::size_t blanks = 0; blanks < 4; ++blanks)
  {
    std::string longName(blanks, ' ');
    while (longName.size() < 250)
    {
      longName += "\u20ac";
    }
    const std::string name = MakeTemporaryName(longName, 999).filename().string();
    EXPECT_LE(name.size(), 255u);
    const auto parsed = ParseTemporaryName(name);
    ASSERT_TRUE(parsed);
    EXPECT_EQ((parsed->fileName.size() - blanks) % 3, 0u);
  }
}
