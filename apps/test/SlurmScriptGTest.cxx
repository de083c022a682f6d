// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SlurmScript.h"

#include <gtest/gtest.h>

using namespace medialvoxel;

namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

SlurmArray
MakeArray(std::uint64_t clusters, std::uint64_t clustersPerTask)
{
  SlurmArray array;
  array.jobFolder = "/data/job";
  array.script = array.jobFolder / SlurmScriptName;
  array.clusters = clusters;
  array.clustersPerTask = clustersPerTask;
  array.threads = 8;
  array.memoryLimit = 1024 * MiB;
  return array;
}

bool
HasLine(const std::string & script, const std::string & line)
{
  return script.find("\n" + line + "\n") != std::string::npos;
}

} // namespace

TEST(SlurmScript, TasksCoverAllClusters)
{
  for (std::uint64_t clusters = 1; clusters < 40; ++clusters)
  {
    for (std::uint64_t perTask = 1; perTask <= clusters; ++perTask)
    {
      const std::uint64_t tasks = MakeArray(clusters, perTask).GetTasks();
      EXPECT_GE(tasks * perTask, clusters);
      EXPECT_LT((tasks - 1) * perTask, clusters);
    }
  }
}

TEST(SlurmScript, TheNinthOfTheSystemLeavesTheProcessItsMemory)
{
  for (std::uint64_t megabytes = 1; megabytes < 5000; ++megabytes)
  {
    SlurmArray array = MakeArray(1, 1);
    array.memoryLimit = megabytes * MiB - 1;
    EXPECT_GE(array.GetMegabytes() * 8 / 9, megabytes);
    EXPECT_LE(array.GetMegabytes() * 8 / 9, megabytes + 1);
  }
}

TEST(SlurmScript, TellsSlurmWhatATaskNeeds)
{
  SlurmArray        array = MakeArray(17, 4);
  const std::string script = MakeSlurmScript(array);
  EXPECT_EQ(script.rfind("#!/bin/sh\n", 0), 0u);
  EXPECT_TRUE(HasLine(script, "#SBATCH --array=0-4"));
  EXPECT_TRUE(HasLine(script, "#SBATCH --cpus-per-task=8"));
  EXPECT_TRUE(HasLine(script, "#SBATCH --mem=1152M"));
  EXPECT_TRUE(HasLine(script, "job=/data/job"));
  EXPECT_TRUE(HasLine(script, "clusters=17"));
  EXPECT_TRUE(HasLine(script, "per_task=4"));
  EXPECT_EQ(script.find('@'), std::string::npos);
  array.tasksAtOnce = 3;
  EXPECT_TRUE(HasLine(MakeSlurmScript(array), "#SBATCH --array=0-4%3"));
}

TEST(SlurmScript, AnyNameOfAFolderStaysAName)
{
  SlurmArray array = MakeArray(2, 1);
  array.jobFolder = "/data/it's $(rm) @TASKS@\n#SBATCH --mem=1";
  const std::string script = MakeSlurmScript(array);
  EXPECT_NE(script.find("job='/data/it'\\''s $(rm) @TASKS@\n#SBATCH --mem=1'\n"), std::string::npos);
  EXPECT_LT(script.find("--mem=1152M"), script.find("it'"));
}

TEST(SlurmScript, ReadsClustersAndTasks)
{
  SlurmOptions options;
  EXPECT_TRUE(ParseSlurmClusters("4", options));
  EXPECT_EQ(options.clustersPerTask, 4u);
  EXPECT_FALSE(options.tasksAtOnce);
  EXPECT_TRUE(ParseSlurmClusters("12%8", options));
  EXPECT_EQ(options.clustersPerTask, 12u);
  EXPECT_EQ(options.tasksAtOnce, 8u);
  for (const char * const text : { "", "0", "-1", "x", "4%", "%4", "4%0", "4%8%2", "4.5", "4 8" })
  {
    EXPECT_FALSE(ParseSlurmClusters(text, options)) << text;
  }
}
