// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "OutputVolume.h"

#include "DataFile.h"
#include "TemporaryFolder.h"

#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkMetaImageIO.h"
#include "itkNrrdImageIO.h"
#include "itkVector.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace medialvoxel;

namespace
{

VolumeGeometry
MakeGeometry()
{
  VolumeGeometry geometry;
  geometry.size = { 5, 4, 3 };
  geometry.spacing = { 0.1, 0.9570312, 1.0 / 3.0 };
  geometry.origin = { -1.05, 1e-7, 12345.678 };
  geometry.direction = { { 0, 1, 0 }, { -0.6, 0, 0.8 }, { 0.8, 0, 0.6 } };
  return geometry;
}

template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
ReadWithItk(const std::filesystem::path & fileName, bool isMetaImage)
{
  auto reader = itk::ImageFileReader<itk::Image<TPixel, 3>>::New();
  if (isMetaImage)
  {
    reader->SetImageIO(itk::MetaImageIO::New());
  }
  else
  {
    reader->SetImageIO(itk::NrrdImageIO::New());
  }
  reader->SetFileName(fileName.string());
  reader->Update();
  return reader->GetOutput();
}

/** Writes increasing numbers, in two parts, and compares ITK's reading. */
template <typename TPixel>
void
ExpectItkReadsTheSame(const VoxelLayout & layout, const std::vector<float> & values)
{
  const VolumeGeometry geometry = MakeGeometry();
  for (const char * const name : { "a.mha", "a.mhd", "a.nrrd", "b.nhdr" })
  {
    const TemporaryFolder folder;
    OutputVolume          volume(folder / name, false, false);
    volume.Create(geometry, layout);
    volume.Write(20, 40, values.data() + 20 * layout.components);
    volume.Write(0, 20, values.data());
    volume.Finish();
    volume.Publish();

    const auto image = ReadWithItk<TPixel>(folder / name, std::string(name).find(".m") != std::string::npos);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(image->GetLargestPossibleRegion().GetSize(axis), geometry.size[axis]);
      EXPECT_DOUBLE_EQ(image->GetSpacing()[axis], geometry.spacing[axis]) << name;
      EXPECT_DOUBLE_EQ(image->GetOrigin()[axis], geometry.origin[axis]) << name;
      for (unsigned int row = 0; row < 3; ++row)
      {
        EXPECT_NEAR(image->GetDirection()[row][axis], geometry.direction[axis][row], 1e-15) << name;
      }
    }
    const auto * const read = reinterpret_cast<const float *>(image->GetBufferPointer());
    EXPECT_EQ(std::vector<float>(read, read + values.size()), values) << name;
  }
}

} // namespace

TEST(OutputVolume, ItkReadsScalars)
{
  std::vector<float> values(60);
  std::iota(values.begin(), values.end(), 0.5f);
  ExpectItkReadsTheSame<float>({ PixelType::Float32, 1 }, values);
}

TEST(OutputVolume, ItkReadsVectors)
{
  std::vector<float> values(180);
  std::iota(values.begin(), values.end(), -7.25f);
  ExpectItkReadsTheSame<itk::Vector<float, 3>>({ PixelType::Float32, 3 }, values);
}

TEST(OutputVolume, PartsCanBeReadBackBeforeTheEnd)
{
  const TemporaryFolder           folder;
  const std::vector<std::uint8_t> labels{ 9, 8, 7, 6 };
  for (const char * const name : { "a.mha", "a.mhd" })
  {
    OutputVolume volume(folder / name, false, true);
    volume.Create(MakeGeometry(), { PixelType::UInt8, 1 });
    volume.Write(30, labels.size(), labels.data());
    std::vector<std::uint8_t> read(6);
    volume.Read(29, read.size(), read.data());
    EXPECT_EQ(read, (std::vector<std::uint8_t>{ 0, 9, 8, 7, 6, 0 }));
  }
  EXPECT_EQ(folder.GetNumberOfFiles(), 0);
}

/** Two that replace, or make, the same volume: one header stays, and the voxels it names. */
TEST(OutputVolume, TwoAtOnceLeaveTheVoxelsOfOne)
{
  for (const char * const name : { "a.mhd", "a.nhdr" })
  {
    for (const bool overwrites : { false, true })
    {
      for (const bool exists : { false, overwrites })
      {
        const TemporaryFolder folder;
        const auto            write = [&](std::uint8_t label, OutputVolume & volume) {
          volume.Create(MakeGeometry(), { PixelType::UInt8, 1 });
          volume.Write(0, 1, &label);
          volume.Finish();
        };
        if (exists)
        {
          OutputVolume old(folder / name, false, false);
          write(7, old);
          old.Publish();
        }
        {
          OutputVolume first(folder / name, overwrites, false);
          OutputVolume second(folder / name, overwrites, false);
          write(8, first);
          write(9, second);
          first.Publish();
          if (overwrites)
          {
            second.Publish();
          }
          else
          {
            EXPECT_THROW(second.Publish(), JobError);
          }
        }
        EXPECT_EQ(folder.GetNumberOfFiles(), 2) << name << overwrites << exists;
        std::ifstream voxels(FindDataFile(folder / name), std::ios::binary);
        EXPECT_EQ(voxels.get(), overwrites ? 9 : 8);
      }
    }
  }
}

TEST(OutputVolume, FindsTheDataFileOfAHeader)
{
  const TemporaryFolder folder;
  folder.Write("a.mhd", "NDims = 3\nElementDataFile = voxels one.raw\n");
  folder.Write("a.nhdr", "NRRD0004\ntype: short\ndata file: ../v.raw\n\n");
  folder.Write("b.mhd", std::string("\0\1\2", 3));
  folder.Write("a.mha", "ElementDataFile = x.raw\n");
  EXPECT_EQ(FindDataFile(folder / "a.mhd"), folder / "voxels one.raw");
  EXPECT_EQ(FindDataFile(folder / "a.nhdr"), folder / "../v.raw");
  for (const char * const name : { "b.mhd", "a.mha", "none.mhd" })
  {
    EXPECT_TRUE(FindDataFile(folder / name).empty()) << name;
  }
}
