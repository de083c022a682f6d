// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkStreamingRawImageIO.h"

#include "itkByteSwapper.h"
#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkImageRegionConstIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace
{

using ImageType = itk::Image<std::uint16_t, 3>;
using ReaderType = itk::ImageFileReader<ImageType>;

constexpr itk::SizeValueType SizeX = 7;
constexpr itk::SizeValueType SizeY = 5;
constexpr itk::SizeValueType SizeZ = 6;
constexpr std::streamoff     HeaderSize = 11;

/** Value of a voxel of the files that the tests write. */
std::uint16_t
ValueAt(const ImageType::IndexType & index)
{
  return static_cast<std::uint16_t>(index[0] + 300 * index[1] + 3000 * index[2]);
}

class StreamingRawImageIO : public ::testing::Test
{
protected:
  void
  TearDown() override
  {
    std::remove(m_FileName.c_str());
  }

  void
  WriteFile(bool bigEndian)
  {
    std::ofstream file(m_FileName, std::ios::binary);
    file << std::string(HeaderSize, 'h');
    const ImageType::RegionType region({ { 0, 0, 0 } }, { { SizeX, SizeY, SizeZ } });
    const auto                  image = ImageType::New();
    image->SetRegions(region);
    image->Allocate();
    for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
    {
      std::uint16_t value = ValueAt(it.GetIndex());
      if (bigEndian)
      {
        itk::ByteSwapper<std::uint16_t>::SwapFromSystemToBigEndian(&value);
      }
      else
      {
        itk::ByteSwapper<std::uint16_t>::SwapFromSystemToLittleEndian(&value);
      }
      file.write(reinterpret_cast<const char *>(&value), sizeof(value));
    }
  }

  itk::StreamingRawImageIO::Pointer
  MakeIO(bool bigEndian) const
  {
    auto io = itk::StreamingRawImageIO::New();
    io->SetNumberOfDimensions(3);
    io->SetDimensions(0, SizeX);
    io->SetDimensions(1, SizeY);
    io->SetDimensions(2, SizeZ);
    io->SetSpacing(2, 2.5);
    io->SetOrigin(1, -4.0);
    io->SetComponentType(itk::IOComponentEnum::USHORT);
    io->SetHeaderSize(HeaderSize);
    io->SetByteOrder(bigEndian ? itk::IOByteOrderEnum::BigEndian : itk::IOByteOrderEnum::LittleEndian);
    return io;
  }

  ReaderType::Pointer
  MakeReader(itk::ImageIOBase * io) const
  {
    auto reader = ReaderType::New();
    reader->SetImageIO(io);
    reader->SetFileName(m_FileName);
    return reader;
  }

  const std::string m_FileName = "itkStreamingRawImageIOGTest-" + std::to_string(std::random_device()()) + ".raw";
};

void
ExpectRegion(const ImageType & image, const ImageType::RegionType & region)
{
  ASSERT_EQ(image.GetBufferedRegion(), region);
  for (itk::ImageRegionConstIteratorWithIndex<ImageType> it(&image, region); !it.IsAtEnd(); ++it)
  {
    ASSERT_EQ(it.Get(), ValueAt(it.GetIndex())) << it.GetIndex();
  }
}

} // namespace

TEST_F(StreamingRawImageIO, ReadsAnyRegionAndNothingElse)
{
  for (const bool bigEndian : { false, true })
  {
    this->WriteFile(bigEndian);
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round)
    {
      ImageType::RegionType    region;
      const itk::SizeValueType sizes[] = { SizeX, SizeY, SizeZ };
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        // Whole axes come up often: they decide which voxels are read in one go.
        const bool whole = random() % 2 == 0;
        const auto index = whole ? 0 : random() % sizes[axis];
        region.SetIndex(axis, static_cast<itk::IndexValueType>(index));
        region.SetSize(axis, whole ? sizes[axis] : 1 + random() % (sizes[axis] - index));
      }
      const auto io = this->MakeIO(bigEndian);
      const auto reader = this->MakeReader(io);
      reader->GetOutput()->UpdateOutputInformation();
      reader->GetOutput()->SetRequestedRegion(region);
      reader->GetOutput()->Update();
      ExpectRegion(*reader->GetOutput(), region);
      EXPECT_EQ(io->GetNumberOfBytesRead(), region.GetNumberOfPixels() * sizeof(std::uint16_t));
    }
  }
}

TEST_F(StreamingRawImageIO, ReadsVoxelsThatLieInSeveralPlaces)
{
  constexpr std::uint64_t sliceBytes = SizeX * SizeY * sizeof(std::uint16_t);
  this->WriteFile(false);
  const std::string lastSlices = m_FileName + ".last";
  {
    std::ifstream whole(m_FileName, std::ios::binary);
    whole.seekg(HeaderSize + 4 * static_cast<std::streamoff>(sliceBytes));
    std::ofstream(lastSlices, std::ios::binary) << "four" << whole.rdbuf();
  }
  std::vector<itk::MedialVoxelFileSegment> segments{ { m_FileName, HeaderSize, sliceBytes },
                                                     { m_FileName, HeaderSize + sliceBytes, 3 * sliceBytes },
                                                     { lastSlices, 4, 2 * sliceBytes } };
  const auto                               read = [&] {
    const auto io = this->MakeIO(false);
    io->SetHeaderSize(0);
    io->SetSegments(segments);
    const auto reader = this->MakeReader(io);
    reader->Update();
    ExpectRegion(*reader->GetOutput(), reader->GetOutput()->GetLargestPossibleRegion());
  };
  read();
  segments.back().numberOfBytes += 2;
  EXPECT_THROW(read(), itk::ExceptionObject) << "more than the file has";
  segments.back().numberOfBytes = sliceBytes;
  EXPECT_THROW(read(), itk::ExceptionObject) << "fewer than the voxels need";
  segments.back().numberOfBytes = 2 * sliceBytes;
  std::remove(lastSlices.c_str());
  EXPECT_THROW(read(), itk::ExceptionObject) << "missing";
}

TEST_F(StreamingRawImageIO, HandsOnTheGeometry)
{
  this->WriteFile(false);
  const auto reader = this->MakeReader(this->MakeIO(false));
  reader->UpdateOutputInformation();
  EXPECT_EQ(reader->GetOutput()->GetSpacing()[2], 2.5);
  EXPECT_EQ(reader->GetOutput()->GetOrigin()[1], -4.0);
}

TEST_F(StreamingRawImageIO, StreamsForReadingOnly)
{
  const auto io = this->MakeIO(false);
  EXPECT_TRUE(io->CanStreamRead());
  EXPECT_FALSE(io->CanStreamWrite());
  EXPECT_FALSE(io->CanReadFile(m_FileName.c_str()));
  EXPECT_FALSE(io->CanWriteFile(m_FileName.c_str()));
  EXPECT_TRUE(io->SupportsDimension(3));
  EXPECT_THROW(io->WriteImageInformation(), itk::ExceptionObject);
  EXPECT_THROW(io->Write(nullptr), itk::ExceptionObject);
}

TEST_F(StreamingRawImageIO, ComparesTheSizeOfTheFile)
{
  this->WriteFile(false);
  const auto information = [this](itk::StreamingRawImageIO * io) { this->MakeReader(io)->UpdateOutputInformation(); };
  const auto io = this->MakeIO(false);
  EXPECT_TRUE(io->GetRefuseTrailingBytes());
  EXPECT_NO_THROW(information(io));
  io->SetHeaderSize(HeaderSize - 1);
  EXPECT_THROW(information(io), itk::ExceptionObject);
  io->RefuseTrailingBytesOff();
  EXPECT_NO_THROW(information(io));
  io->SetHeaderSize(HeaderSize + 1);
  EXPECT_THROW(information(io), itk::ExceptionObject);
  EXPECT_THROW(io->SetHeaderSize(-1), itk::ExceptionObject);
}

TEST_F(StreamingRawImageIO, RefusesDescriptionsThatMakeNoSense)
{
  this->WriteFile(false);
  const auto information = [this](itk::StreamingRawImageIO * io) {
    io->SetFileName(m_FileName);
    io->ReadImageInformation();
  };
  auto io = this->MakeIO(false);
  io->SetDimensions(1, 0);
  EXPECT_THROW(information(io), itk::ExceptionObject);
  io = this->MakeIO(false);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    io->SetDimensions(axis, itk::SizeValueType{ 1 } << 31);
  }
  EXPECT_THROW(information(io), itk::ExceptionObject);
  io = this->MakeIO(false);
  io->SetComponentType(itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE);
  EXPECT_THROW(information(io), itk::ExceptionObject);
}

TEST_F(StreamingRawImageIO, NoticesAFileThatIsMissingOrBecameShorter)
{
  const auto missing = this->MakeReader(this->MakeIO(false));
  EXPECT_THROW(missing->UpdateOutputInformation(), itk::ExceptionObject);
  this->WriteFile(false);
  const auto reader = this->MakeReader(this->MakeIO(false));
  reader->UpdateOutputInformation();
  std::ofstream(m_FileName, std::ios::binary) << "short";
  EXPECT_THROW(reader->Update(), itk::ExceptionObject);
}

TEST_F(StreamingRawImageIO, ReadsBeyondFourGigabytes)
{
  // Two slices of 2^32 voxels each; the file is a hole but for its last bytes.
  constexpr itk::SizeValueType size = itk::SizeValueType{ 1 } << 16;
  {
    std::ofstream file(m_FileName, std::ios::binary);
    file.seekp(static_cast<std::streamoff>(2 * size * size - 3));
    file << "xyz";
  }
  using ByteImageType = itk::Image<unsigned char, 3>;
  const auto io = itk::StreamingRawImageIO::New();
  io->SetNumberOfDimensions(3);
  io->SetDimensions(0, size);
  io->SetDimensions(1, size);
  io->SetDimensions(2, 2);
  io->SetComponentType(itk::IOComponentEnum::UCHAR);
  const auto reader = itk::ImageFileReader<ByteImageType>::New();
  reader->SetImageIO(io);
  reader->SetFileName(m_FileName);
  reader->GetOutput()->UpdateOutputInformation();
  ByteImageType::RegionType region;
  region.SetIndex({ { size - 4, size - 1, 1 } });
  region.SetSize({ { 4, 1, 1 } });
  reader->GetOutput()->SetRequestedRegion(region);
  reader->GetOutput()->Update();
  const unsigned char * const voxels = reader->GetOutput()->GetBufferPointer();
  EXPECT_EQ(std::vector<unsigned char>(voxels, voxels + 4), (std::vector<unsigned char>{ 0, 'x', 'y', 'z' }));
}

TEST_F(StreamingRawImageIO, PrintsItsState)
{
  std::ostringstream text;
  this->MakeIO(true)->Print(text);
  for (const char * const part : { "HeaderSize: 11", "RefuseTrailingBytes: 1", "NumberOfBytesRead: 0" })
  {
    EXPECT_NE(text.str().find(part), std::string::npos) << part;
  }
}
