// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SliceCache.h"
#include "SliceNames.h"

#include "Errors.h"
#include "ReadVolumeHeader.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#ifdef MEDIALVOXEL_TEST_WITH_GDCM
#  include "itkGDCMImageIO.h"
#  include "itkGDCMSeriesFileNames.h"
#  include "itkImageFileWriter.h"
#  include "itkImageSeriesReader.h"
#  include "itkMetaDataObject.h"
#endif

#include <algorithm>
#include <atomic>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace
{

using namespace medialvoxel;

SliceCache::Slice
MakeSlice(char value)
{
  return std::make_shared<const std::vector<char>>(1, value);
}

} // namespace

TEST(SliceCache, DecodesASliceOnceForAllThreads)
{
  SliceCache               cache;
  std::atomic<int>         decoded{ 0 };
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread)
  {
    threads.emplace_back([&] {
      for (char number = 0; number < 20; ++number)
      {
        const auto slice = cache.Get(static_cast<std::uint64_t>(number), 20, [&] {
          ++decoded;
          std::this_thread::yield();
          return MakeSlice(number);
        });
        EXPECT_EQ(slice->front(), number);
      }
    });
  }
  for (std::thread & thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(decoded, 20);
}

TEST(SliceCache, DropsTheSliceThatWasUsedTheLongestAgo)
{
  SliceCache cache;
  int        decoded = 0;
  const auto get = [&](std::uint64_t number) {
    cache.Get(number, 2, [&] {
      ++decoded;
      return MakeSlice(0);
    });
  };
  for (const std::uint64_t number : { 0, 1, 0, 2, 0 })
  {
    get(number);
  }
  EXPECT_EQ(decoded, 3);
  get(1);
  EXPECT_EQ(decoded, 4);
}

TEST(SliceCache, TriesAgainAfterAFailure)
{
  SliceCache cache;
  EXPECT_THROW(cache.Get(7, 2, []() -> SliceCache::Slice { throw std::runtime_error("damaged"); }), std::runtime_error);
  EXPECT_EQ(cache.Get(7, 2, [] { return MakeSlice(3); })->front(), 3);
}

TEST(SliceNames, AreInNaturalOrder)
{
  std::vector<std::filesystem::path> names{ "a10.png", "a9.png", "b1.png", "a9b.png", "a010.png", "a.png", "A2.png" };
  std::sort(names.begin(), names.end(), IsBefore);
  const std::vector<std::filesystem::path> expected{ "A2.png",  "a9.png", "a9b.png", "a010.png",
                                                     "a10.png", "a.png",  "b1.png" };
  EXPECT_EQ(names, expected);
}

TEST(SliceNames, ArePatternsOnlyWhereNoFileHasTheName)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(NamesSlices((folder / "a").parent_path()));
  for (const char * const pattern : { "*.png", "a?.png", "a%d.png", "a%04d.png" })
  {
    EXPECT_TRUE(NamesSlices(folder / pattern)) << pattern;
    // Windows has no files of some of these names.
    const bool isFile = static_cast<bool>(std::ofstream(folder / pattern) << "a file");
    EXPECT_EQ(NamesSlices(folder / pattern), !isFile) << pattern;
  }
  for (const char * const name : { "a.png", "a%.png", "a%s.png", "a%d%d.png", "a%n.png", "a%1000d.png" })
  {
    EXPECT_FALSE(NamesSlices(folder / name)) << name;
  }
}

#ifdef MEDIALVOXEL_TEST_WITH_GDCM
namespace
{

using ImageType = itk::Image<short, 3>;

/** Writes slices, the last one first, that lie in space as ITK sees it. */
void
WriteSeries(const std::filesystem::path & folder, const ImageType::DirectionType & direction, unsigned int slices)
{
  for (unsigned int slice = 0; slice < slices; ++slice)
  {
    const auto image = ImageType::New();
    image->SetRegions(ImageType::SizeType{ { 7, 5, 1 } });
    image->Allocate();
    image->FillBuffer(static_cast<short>(slice));
    const double spacing[] = { 0.75, 0.5, 1.25 };
    image->SetSpacing(spacing);
    image->SetDirection(direction);
    ImageType::PointType origin;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      origin[axis] = 10.0 * (axis + 1) + direction[axis][2] * spacing[2] * slice;
    }
    image->SetOrigin(origin);
    itk::MetaDataDictionary & values = image->GetMetaDataDictionary();
    itk::EncapsulateMetaData<std::string>(values, "0008|0060", "CT");
    itk::EncapsulateMetaData<std::string>(values, "0008|0016", "1.2.840.10008.5.1.4.1.1.2");
    itk::EncapsulateMetaData<std::string>(values, "0020|000d", "1.2.3");
    itk::EncapsulateMetaData<std::string>(values, "0020|000e", "1.2.3.4");
    const auto imageIO = itk::GDCMImageIO::New();
    imageIO->KeepOriginalUIDOn();
    const auto writer = itk::ImageFileWriter<ImageType>::New();
    writer->SetInput(image);
    writer->SetImageIO(imageIO);
    writer->SetFileName((folder / (std::to_string(slices - slice) + ".dcm")).string());
    writer->Update();
  }
}

ImageType::Pointer
ReadWithItk(const std::filesystem::path & folder)
{
  const auto names = itk::GDCMSeriesFileNames::New();
  names->SetDirectory(folder.string());
  const auto reader = itk::ImageSeriesReader<ImageType>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(names->GetInputFileNames());
  reader->Update();
  return reader->GetOutput();
}

} // namespace

TEST(SeriesHeader, HasTheGeometryOfItk)
{
  ImageType::DirectionType identity;
  identity.SetIdentity();
  ImageType::DirectionType flipped = identity; // the normal points to negative z
  flipped[1][1] = -1;
  flipped[2][2] = -1;
  ImageType::DirectionType oblique; // columns are turned by 36.87 degrees about x
  oblique.SetIdentity();
  oblique[1][1] = oblique[2][2] = 0.8;
  oblique[2][1] = 0.6;
  oblique[1][2] = -0.6;
  ImageType::DirectionType sagittal;
  sagittal.Fill(0);
  sagittal[1][0] = 1;
  sagittal[2][1] = -1;
  sagittal[0][2] = -1;
  for (const ImageType::DirectionType & direction : { identity, flipped, oblique, sagittal })
  {
    const TemporaryFolder       temporary;
    const std::filesystem::path folder = temporary / "series";
    std::filesystem::create_directory(folder);
    WriteSeries(folder, direction, 6);
    const ImageType::Pointer image = ReadWithItk(folder);
    const VolumeHeader       header = ReadVolumeHeader(folder, std::nullopt);
    ASSERT_EQ(header.geometry.GetDimension(), 3u);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(header.geometry.size[axis], image->GetLargestPossibleRegion().GetSize(axis));
      EXPECT_NEAR(header.geometry.spacing[axis], image->GetSpacing()[axis], 1e-6);
      EXPECT_NEAR(header.geometry.origin[axis], image->GetOrigin()[axis], 1e-6);
      for (unsigned int row = 0; row < 3; ++row)
      {
        EXPECT_NEAR(header.geometry.direction[axis][row], image->GetDirection()[row][axis], 1e-6) << direction;
      }
    }
    EXPECT_EQ(header.pixelType, PixelType::Int16);
  }
}
#endif
