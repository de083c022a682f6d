// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ZarrVolume.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>

using namespace medialvoxel;

namespace
{

VolumeGeometry
MakeGeometry(const std::vector<std::uint64_t> & size)
{
  VolumeGeometry geometry;
  geometry.size = size;
  geometry.spacing.assign(size.size(), 0.5);
  geometry.origin.assign(size.size(), -3.25);
  geometry.SetIdentityDirection();
  return geometry;
}

/** Values that are zero in long stretches, so that some chunks have nothing else. */
std::vector<float>
MakeValues(const VolumeGeometry & geometry, unsigned int components)
{
  std::mt19937       random(7);
  std::vector<float> values(geometry.GetNumberOfVoxels() * components);
  const size_t       begin = values.size() / 3;
  for (size_t i = begin; i < begin + values.size() / 3; i += 1 + random() % 50)
  {
    values[i] = static_cast<float>(i + 1);
  }
  return values;
}

/** Names and contents of all files in a folder. */
std::map<std::string, std::string>
ReadFolder(const TemporaryFolder & folder, const std::string & name)
{
  std::map<std::string, std::string> contents;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(folder / name))
  {
    if (entry.is_regular_file())
    {
      const std::string file = std::filesystem::relative(entry.path(), folder / name).generic_string();
      contents[file] = folder.Read(name + "/" + file);
    }
  }
  return contents;
}

struct WriteSettings
{
  bool            sparse{ false };
  ZarrCompression compression{ ZarrCompression::None };
  std::uint64_t   slicesAtOnce{ 1 };
  std::uint64_t   rowsAtOnce{ 0 }; ///< 0: whole slices
};

/** The same rows of several slices, which follow each other. */
std::vector<float>
TakeRows(const std::vector<float> & values, const VolumeGeometry & geometry, const SliceRange & slices, RowRange rows)
{
  const std::size_t  valuesPerRow = values.size() / (geometry.size[1] * geometry.size[2]);
  std::vector<float> taken;
  for (std::uint64_t slice = slices.begin; slice < slices.end; ++slice)
  {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(slice * geometry.size[1] * valuesPerRow);
    taken.insert(taken.end(),
                 first + static_cast<std::ptrdiff_t>(rows.begin * valuesPerRow),
                 first + static_cast<std::ptrdiff_t>(rows.end * valuesPerRow));
  }
  return taken;
}

void
WriteInRows(ZarrVolume &               volume,
            const VolumeGeometry &     geometry,
            const std::vector<float> & values,
            const SliceRange &         slices,
            std::uint64_t              rowsAtOnce)
{
  for (std::uint64_t row = 0; row < geometry.size[1]; row += rowsAtOnce)
  {
    const RowRange           rows{ row, std::min(row + rowsAtOnce, geometry.size[1]) };
    const std::vector<float> taken = TakeRows(values, geometry, slices, rows);
    volume.WriteRows(slices, rows, taken.data());
  }
}

std::map<std::string, std::string>
WriteFloats(const VolumeGeometry & geometry, unsigned int components, const WriteSettings & settings)
{
  const TemporaryFolder    folder;
  const std::vector<float> values = MakeValues(geometry, components);
  ZarrVolume               volume(folder / "a.zarr", false, settings.sparse, settings.compression);
  volume.Create(geometry, { PixelType::Float32, components });
  const std::uint64_t perSlice = geometry.GetVoxelsPerSlice();
  for (std::uint64_t slice = 0; slice < geometry.size.back(); slice += settings.slicesAtOnce)
  {
    const std::uint64_t slices = std::min(settings.slicesAtOnce, geometry.size.back() - slice);
    if (settings.rowsAtOnce > 0)
    {
      WriteInRows(volume, geometry, values, { slice, slice + slices }, settings.rowsAtOnce);
      continue;
    }
    volume.Write(slice * perSlice, slices * perSlice, values.data() + slice * perSlice * components);
  }
  volume.Finish();
  std::vector<float> read(values.size());
  volume.Read(0, geometry.GetNumberOfVoxels(), read.data());
  EXPECT_EQ(read, values);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.zarr"));
  volume.Publish();
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  return ReadFolder(folder, "a.zarr");
}

constexpr const char * Suffix = ".job.partial";

/** Opens the volume of a job as a process does that writes clusters of it. */
std::unique_ptr<ZarrVolume>
OpenWorker(const TemporaryFolder & folder, const VolumeGeometry & geometry, ZarrCompression compression)
{
  auto volume = std::make_unique<ZarrVolume>(folder / "a.zarr", false, false, compression);
  volume->OpenShared(geometry, { PixelType::Float32, 1 }, Suffix);
  return volume;
}

/** Writes slices, some at once. */
void
WriteSlices(ZarrVolume & volume, const VolumeGeometry & geometry, const std::array<std::uint64_t, 3> & beginEndStep)
{
  const std::vector<float> values = MakeValues(geometry, 1);
  const std::uint64_t      perSlice = geometry.GetVoxelsPerSlice();
  const auto [begin, end, step] = beginEndStep;
  for (std::uint64_t slice = begin; slice < end; slice += step)
  {
    const std::uint64_t slices = std::min(step, end - slice);
    volume.Write(slice * perSlice, slices * perSlice, values.data() + slice * perSlice);
  }
}

void
Publish(const TemporaryFolder & folder, const VolumeGeometry & geometry, ZarrCompression compression, bool hasBegun)
{
  ZarrVolume last(folder / "a.zarr", true, false, compression);
  last.OpenToPublish(geometry, { PixelType::Float32, 1 }, Suffix, { "", hasBegun });
  last.Finish();
  last.Publish();
}

} // namespace

TEST(ZarrGrid, ChunksLeaveLittleOutside)
{
  const ZarrGrid grid = ZarrGrid::ForVolume(MakeGeometry({ 1500, 300, 668 }), {});
  EXPECT_EQ(grid.chunk, (ZarrIndex{ { 250, 150, 32 } }));
  EXPECT_EQ(grid.GetNumberOfAllChunks(), 6u * 2u * 21u);
  EXPECT_EQ(grid.GetChunkName(0, { 5, 1, 20 }), "20/1/5");
  const ZarrBox last = grid.GetBox({ 5, 1, 20 });
  EXPECT_EQ(last.size, (ZarrIndex{ { 250, 150, 28 } }));
}

TEST(ZarrGrid, SmallVolumesAreOneChunk)
{
  const ZarrGrid grid = ZarrGrid::ForVolume(MakeGeometry({ 7, 5 }), { PixelType::Float32, 2 });
  EXPECT_EQ(grid.chunk, (ZarrIndex{ { 7, 1, 5 } }));
  EXPECT_EQ(grid.GetChunkName(1, { 0, 0, 0 }), "1/0/0");
}

TEST(ZarrVolume, AnyDivisionGivesTheSameFiles)
{
  const VolumeGeometry geometry = MakeGeometry({ 300, 9, 70 });
  for (const unsigned int components : { 1u, 3u })
  {
    for (const bool sparse : { false, true })
    {
      for (const ZarrCompression compression : { ZarrCompression::None, ZarrCompression::Gzip })
      {
        const auto expected = WriteFloats(geometry, components, { sparse, compression, 70 });
        EXPECT_EQ(expected.size() == 3 + components * 6, !sparse) << expected.size();
        for (const std::uint64_t slicesAtOnce : { 5, 69 })
        {
          EXPECT_EQ(WriteFloats(geometry, components, { sparse, compression, slicesAtOnce }), expected) << slicesAtOnce;
        }
      }
    }
  }
}

TEST(ZarrVolume, RowsGiveTheSameFilesAsSlices)
{
  const VolumeGeometry geometry = MakeGeometry({ 20, 600, 70 });
  const std::uint64_t  rows = ZarrGrid::ForVolume(geometry, {}).chunk[1];
  ASSERT_EQ(rows, 200u);
  for (const unsigned int components : { 1u, 3u })
  {
    for (const bool sparse : { false, true })
    {
      for (const ZarrCompression compression : { ZarrCompression::None, ZarrCompression::Gzip })
      {
        const auto expected = WriteFloats(geometry, components, { sparse, compression, 70 });
        // Parts of a layer, whole ones, and pieces that begin and end within layers.
        for (const std::uint64_t slicesAtOnce : { 24, 41 })
        {
          for (const std::uint64_t rowsAtOnce : { rows, 2 * rows })
          {
            EXPECT_EQ(WriteFloats(geometry, components, { sparse, compression, slicesAtOnce, rowsAtOnce }), expected)
              << slicesAtOnce << " slices of " << rowsAtOnce << " rows";
          }
        }
      }
    }
  }
}

TEST(ZarrVolume, ImagesOfTwoDimensions)
{
  const VolumeGeometry geometry = MakeGeometry({ 1500, 1100 });
  const auto           expected = WriteFloats(geometry, 1, { false, ZarrCompression::None, 1100 });
  EXPECT_EQ(WriteFloats(geometry, 1, { false, ZarrCompression::None, 100 }), expected);
  EXPECT_EQ(expected.count("0/1/1"), 1u);
  EXPECT_EQ(expected.size(), 3u + 4u);
}

TEST(ZarrVolume, PlanesCanBeReadBack)
{
  const TemporaryFolder      folder;
  const VolumeGeometry       geometry = MakeGeometry({ 40, 30, 50 });
  std::vector<std::uint16_t> values(geometry.GetNumberOfVoxels());
  std::iota(values.begin(), values.end(), std::uint16_t{ 1 });
  ZarrVolume volume(folder / "a.zarr", false, true, ZarrCompression::Gzip);
  volume.Create(geometry, { PixelType::UInt16, 1 });
  volume.Write(0, values.size(), values.data());
  volume.Finish();
  std::vector<std::uint16_t> plane(30 * 50);
  EXPECT_TRUE(volume.ReadPlane(0, 17, plane.data()));
  EXPECT_EQ(plane[2 * 30 + 3], values[(2 * 30 + 3) * 40 + 17]);
  EXPECT_EQ(plane[49 * 30 + 29], values[(49 * 30 + 29) * 40 + 17]);
  plane.resize(40 * 50);
  EXPECT_TRUE(volume.ReadPlane(1, 29, plane.data()));
  EXPECT_EQ(plane[49 * 40 + 7], values[(49 * 30 + 29) * 40 + 7]);
}

TEST(ZarrVolume, ReplacesAFolderOnlyAtTheEnd)
{
  const TemporaryFolder folder;
  const VolumeGeometry  geometry = MakeGeometry({ 4, 3, 2 });
  std::filesystem::create_directory(folder / "a.zarr");
  folder.Write("a.zarr/.zgroup", "old");
  folder.Write("a.zarr/old", "old");
  std::vector<std::uint8_t> values(24, 1);
  {
    ZarrVolume volume(folder / "a.zarr", true, false, ZarrCompression::None);
    volume.Create(geometry, {});
    volume.Write(0, 24, values.data());
  }
  EXPECT_EQ(ReadFolder(folder, "a.zarr").size(), 2u);
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  {
    ZarrVolume volume(folder / "a.zarr", true, false, ZarrCompression::None);
    volume.Create(geometry, {});
    volume.Write(0, 24, values.data());
    volume.Finish();
    volume.Publish();
  }
  EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  EXPECT_EQ(ReadFolder(folder, "a.zarr").count("old"), 0u);
  EXPECT_EQ(folder.Read("a.zarr/0/0/0/0"), std::string(24, '\1'));
}

TEST(ZarrVolume, RefusesWhatItMustNotReplace)
{
  const TemporaryFolder folder;
  const VolumeGeometry  geometry = MakeGeometry({ 4, 3, 2 });
  for (const bool overwrite : { false, true })
  {
    std::vector<std::uint8_t> values(24, 1);
    ZarrVolume                volume(folder / "a.zarr", overwrite, false, ZarrCompression::None);
    volume.Create(geometry, {});
    volume.Write(0, 24, values.data());
    volume.Finish();
    std::filesystem::create_directories(folder / "a.zarr/precious");
    if (!overwrite)
    {
      folder.Write("a.zarr/.zgroup", "");
    }
    EXPECT_THROW(volume.Publish(), JobError);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.zarr/precious"));
    std::filesystem::remove_all(folder / "a.zarr");
  }
}

TEST(ZarrVolume, MissesChunksThatAreGone)
{
  const TemporaryFolder     folder;
  const VolumeGeometry      geometry = MakeGeometry({ 4, 3, 40 });
  std::vector<std::uint8_t> values(480, 1);
  ZarrVolume                volume(folder / "a.zarr", false, false, ZarrCompression::None);
  volume.Create(geometry, {});
  volume.Write(0, 120, values.data());
  EXPECT_THROW(volume.Finish(), JobError);
  EXPECT_THROW(volume.Write(5, 12, values.data()), JobError);
}

TEST(ZarrVolume, IsWrittenByManyAndPublishedByOne)
{
  const VolumeGeometry geometry = MakeGeometry({ 300, 9, 70 }); // layers of 24 slices
  for (const ZarrCompression compression : { ZarrCompression::None, ZarrCompression::Gzip })
  {
    const TemporaryFolder folder;
    ZarrVolume(folder / "a.zarr", false, false, compression).CreateShared(geometry, { PixelType::Float32, 1 }, Suffix);
    std::map<std::uint64_t, std::uint32_t> checksums;
    for (const std::uint64_t begin : { 48, 0, 24 })
    {
      const auto worker = OpenWorker(folder, geometry, compression);
      // One that is given up leaves nothing behind.
      worker->StartCluster();
      WriteSlices(*worker, geometry, { 28, 33, 5 });
      worker->StartCluster();
      WriteSlices(*worker, geometry, { begin, std::min<std::uint64_t>(begin + 24, 70), begin / 8 + 5 });
      worker->Sync();
      checksums[begin] = worker->GetChecksum();
      EXPECT_EQ(worker->ReadChecksum(begin * 2700, (std::min<std::uint64_t>(begin + 24, 70) - begin) * 2700),
                checksums[begin]);
    }
    EXPECT_NE(checksums[24], checksums[48]);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.zarr"));
    Publish(folder, geometry, compression, false);
    EXPECT_EQ(ReadFolder(folder, "a.zarr"), WriteFloats(geometry, 1, { false, compression, 70 }));
    EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  }
}

TEST(ZarrVolume, DoesNotComeBackForOneWhoWritesAfterItsPublication)
{
  const VolumeGeometry geometry = MakeGeometry({ 300, 9, 70 });
  for (const std::uint64_t slicesAtOnce : { 24, 5 })
  {
    const TemporaryFolder folder;
    const auto            compression = ZarrCompression::Gzip;
    ZarrVolume(folder / "a.zarr", false, false, compression).CreateShared(geometry, { PixelType::Float32, 1 }, Suffix);
    const auto worker = OpenWorker(folder, geometry, compression);
    WriteSlices(*worker, geometry, { 0, 70, 70 });
    const auto late = OpenWorker(folder, geometry, compression);
    Publish(folder, geometry, compression, false);
    EXPECT_THROW(WriteSlices(*late, geometry, { 24, 48, slicesAtOnce }), JobError);
    EXPECT_EQ(folder.GetNumberOfFiles(), 1);
  }
}

TEST(ZarrVolume, PublicationThatWasInterruptedIsEnded)
{
  const VolumeGeometry geometry = MakeGeometry({ 300, 9, 70 });
  const auto           compression = ZarrCompression::Gzip;
  const auto           expected = WriteFloats(geometry, 1, { false, compression, 70 });
  for (const bool isExchanged : { true, false })
  {
    const TemporaryFolder       folder;
    const std::filesystem::path name = folder / "a.zarr";
    const std::filesystem::path temporary = name.string() + Suffix;
    const std::filesystem::path old = temporary.string() + ".old";
    ZarrVolume(name, false, false, compression).CreateShared(geometry, { PixelType::Float32, 1 }, Suffix);
    const auto worker = OpenWorker(folder, geometry, compression);
    worker->StartCluster();
    WriteSlices(*worker, geometry, { 0, 70, 70 });
    std::filesystem::create_directory(old);
    std::ofstream(old / ".zgroup") << "what is to be replaced";
    if (isExchanged)
    {
      std::filesystem::rename(temporary, name);
      std::filesystem::rename(old, temporary);
      EXPECT_THROW(Publish(folder, geometry, compression, false), JobError);
    }
    Publish(folder, geometry, compression, true);
    EXPECT_EQ(ReadFolder(folder, "a.zarr"), expected) << isExchanged;
    EXPECT_EQ(folder.GetNumberOfFiles(), 1) << isExchanged;
    Publish(folder, geometry, compression, true);
    EXPECT_EQ(ReadFolder(folder, "a.zarr"), expected) << isExchanged;
  }
}
