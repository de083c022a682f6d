// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "MedialVoxelTestKernels.h"

#include "itkMedialVoxelEngine.h"
#include "itkMedialVoxelLengthTask.h"

#include <gtest/gtest.h>

#include <cstring>

namespace
{
using namespace MedialVoxelTest;

/** Keeps the distances of a volume, by one thread. */
class DistanceClient
  : public itk::MedialVoxelEngineClient
  , public itk::MedialVoxelObjectSource
{
public:
  DistanceClient(const Volume & volume, itk::MedialVoxelEngineSettings settings, bool findsDisplacements)
    : m_Volume(volume)
    , m_Distances(volume.object.size(), -7.0f)
  {
    itk::MedialVoxelDistanceMap task;
    task.findsDisplacements = findsDisplacements;
    settings.task = task;
    itk::MedialVoxelEngine engine(GridOf(volume), settings);
    engine.Run(GridOf(volume).GetVoxelBox(), *this, *this);
  }

  void
  Fill(const itk::MedialVoxelBox & box, const itk::MedialVoxelTargets & targets) override
  {
    ForEachVoxel(box, [&](const itk::MedialVoxelIndex & v) {
      if (m_Volume.IsObject(OracleIndex(v)))
      {
        targets.object->Set(v);
      }
    });
  }

  void
  RunWorkers(const unsigned int, const std::function<void()> & work) override
  {
    work();
  }

  void
  TakeTile(const itk::MedialVoxelTileResult & tile) override
  {
    const auto size = KernelIndex(m_Volume.size);
    tile.WriteDistances({ m_Volume.spacing },
                        m_Distances.data() + m_Volume.Offset(OracleIndex(tile.box.lower)),
                        { { 1, size[0], size[0] * size[1] } });
    m_NumberOfLengths += tile.squaredLengths != nullptr ? 1 : 0;
    m_NumberOfDisplacements += tile.displacements != nullptr ? 1 : 0;
  }

  const Volume &     m_Volume;
  std::vector<float> m_Distances;
  int                m_NumberOfLengths{ 0 };
  int                m_NumberOfDisplacements{ 0 };
};

bool
HaveSameBits(const std::vector<float> & a, const std::vector<float> & b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}
} // namespace

TEST(MedialVoxelLengthTask, GivesTheBitsOfDisplacements)
{
  for (const double spacing : { 1.0, 0.5, 0.1, 0.0371, 3.0 })
  {
    for (const Volume & volume : { RandomBoxes({ { 90, 70, 60 } }, { { spacing, spacing, spacing } }, 9, 31),
                                   RandomVolume({ { 70, 50, 1 } }, { { spacing, spacing, 7.0 } }, 0.01, 32),
                                   RandomVolume({ { 40, 30, 20 } }, { { spacing, spacing, spacing } }, 0.0, 33) })
    {
      const DistanceClient expected(volume, {}, true);
      for (const std::int64_t tileSize : { 0, 16 })
      {
        itk::MedialVoxelEngineSettings settings;
        settings.tileSize = tileSize;
        settings.slabThickness = tileSize;
        const DistanceClient actual(volume, settings, false);
        EXPECT_TRUE(HaveSameBits(actual.m_Distances, expected.m_Distances)) << spacing << " " << tileSize;
        EXPECT_GT(actual.m_NumberOfLengths, 0);
      }
    }
  }
}

/** With spacings for which a length of three voxels lies in the middle between two floats, or next to it. */
TEST(MedialVoxelLengthTask, DoubtfulLengthsAreThoseOfTheDisplacements)
{
  int displacements = 0;
  for (int k = 0; k < 40; ++k)
  {
    const double spacing = (1.0 + (2 * k + 1.0) / (1 << 24)) / 3.0;
    const Volume volume = RandomVolume({ { 40, 30, 30 } }, { { spacing, spacing, spacing } }, 0.004, 50 + k);

    const DistanceClient expected(volume, {}, true);
    const DistanceClient actual(volume, {}, false);
    EXPECT_TRUE(HaveSameBits(actual.m_Distances, expected.m_Distances)) << spacing;
    displacements += actual.m_NumberOfDisplacements;
  }
  EXPECT_GT(displacements, 0);
}

TEST(MedialVoxelLengthTask, LeavesToOthersWhatItCannotDo)
{
  const itk::MedialVoxelGrid  equal({ { 20, 20, 20 } }, { { 0.1, 0.1, 0.1 } });
  const itk::MedialVoxelGrid  unequal({ { 20, 20, 20 } }, { { 0.1, 0.1, 0.2 } });
  itk::MedialVoxelDistanceMap task;
  EXPECT_FALSE(itk::MedialVoxelLengthTask::CanDo(equal, task));
  task.findsDisplacements = false;
  EXPECT_TRUE(itk::MedialVoxelLengthTask::CanDo(equal, task));
  EXPECT_FALSE(itk::MedialVoxelLengthTask::CanDo(unequal, task));
  task.region = itk::MedialVoxelRegion::Inside;
  EXPECT_FALSE(itk::MedialVoxelLengthTask::CanDo(equal, task));
  task = {};
  task.findsDisplacements = false;
  task.maximumDistance = 3.0;
  EXPECT_FALSE(itk::MedialVoxelLengthTask::CanDo(equal, task));
}
