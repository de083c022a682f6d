// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MedialVoxelTestNrrd_h
#define MedialVoxelTestNrrd_h

#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkNrrdImageIO.h"
#include "itkStreamingNrrdImageIO.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>

namespace MedialVoxelTest
{

using ShortImage = itk::Image<std::int16_t, 3>;

constexpr std::uint64_t SizeX = 7;
constexpr std::uint64_t SizeY = 5;
constexpr std::uint64_t SizeZ = 6;
constexpr std::uint64_t NumberOfVoxels = SizeX * SizeY * SizeZ;

inline const std::string Geometry =
  "space: left-posterior-superior\nspace directions: (0,0.5,0) (-0.25,0,0.25) (0,0.1,2)\n"
  "space origin: (1,-2,3.5)\n";
inline const std::string ShortFields = "type: short\ndimension: 3\nsizes: 7 5 6\nendian: little\nencoding: raw\n";

/** Bytes that differ from each other over the length of any run. */
inline std::string
SomeBytes(std::uint64_t count)
{
  std::mt19937 random(7);
  std::string  bytes(count, '\0');
  for (char & byte : bytes)
  {
    byte = static_cast<char>(random() % 256);
  }
  return bytes;
}

/** \class NrrdFiles
 * \brief A folder for the files of one test. */
class NrrdFiles : public ::testing::Test
{
protected:
  NrrdFiles() { std::filesystem::create_directory(m_Folder); }
  ~NrrdFiles() override { std::filesystem::remove_all(m_Folder); }

  std::string
  Path(const std::string & name) const
  {
    return (m_Folder / name).string();
  }

  std::string
  Write(const std::string & name, const std::string & content) const
  {
    std::ofstream(Path(name), std::ios::binary) << content;
    return Path(name);
  }

  /** An attached file of 16-bit voxels. */
  std::string
  WriteShorts(const std::string & name = "short.nrrd") const
  {
    return this->Write(name, "NRRD0004\n" + ShortFields + Geometry + "\n" + SomeBytes(2 * NumberOfVoxels));
  }

  const std::filesystem::path m_Folder =
    std::filesystem::temp_directory_path() / ("itkStreamingNrrdImageIOGTest-" + std::to_string(std::random_device()()));
};

template <typename TImage>
typename TImage::Pointer
ReadWith(itk::ImageIOBase * io, const std::string & fileName)
{
  const auto reader = itk::ImageFileReader<TImage>::New();
  reader->SetImageIO(io);
  reader->SetFileName(fileName);
  reader->Update();
  return reader->GetOutput();
}

template <typename TImage>
void
ExpectSameImage(const TImage & image, const TImage & expected)
{
  ASSERT_EQ(image.GetBufferedRegion(), expected.GetBufferedRegion());
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    EXPECT_DOUBLE_EQ(image.GetSpacing()[axis], expected.GetSpacing()[axis]);
    EXPECT_DOUBLE_EQ(image.GetOrigin()[axis], expected.GetOrigin()[axis]);
    for (unsigned int row = 0; row < TImage::ImageDimension; ++row)
    {
      EXPECT_NEAR(image.GetDirection()[row][axis], expected.GetDirection()[row][axis], 1e-15);
    }
  }
  const auto count = expected.GetBufferedRegion().GetNumberOfPixels();
  EXPECT_TRUE(std::equal(expected.GetBufferPointer(), expected.GetBufferPointer() + count, image.GetBufferPointer()));
}

/** Both classes read a file alike. */
template <typename TImage>
void
ExpectAsNrrdImageIO(const std::string & fileName)
{
  SCOPED_TRACE(fileName);
  const auto io = itk::StreamingNrrdImageIO::New();
  const auto stock = itk::NrrdImageIO::New();
  ASSERT_TRUE(io->CanReadFile(fileName.c_str()));
  const auto image = ReadWith<TImage>(io, fileName);
  const auto expected = ReadWith<TImage>(stock, fileName);
  ExpectSameImage<TImage>(*image, *expected);
  EXPECT_EQ(io->GetPixelType(), stock->GetPixelType());
  EXPECT_EQ(io->GetComponentType(), stock->GetComponentType());
  EXPECT_EQ(io->GetNumberOfComponents(), stock->GetNumberOfComponents());
  EXPECT_TRUE(io->GetComponentSize() == 1 || io->GetByteOrder() == stock->GetByteOrder());
}

/** What the exception says that reading raises; empty without one. */
inline std::string
ErrorOf(const std::function<void()> & action)
{
  try
  {
    action();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return {};
}

inline bool
Contains(const std::string & text, const std::string & part)
{
  return text.find(part) != std::string::npos;
}

} // namespace MedialVoxelTest

#endif
