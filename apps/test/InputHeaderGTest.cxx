// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeHeader.h"

#include "TemporaryFolder.h"
#include "TiffCodecs.h"
#include "VoxelStream.h"

#ifdef MEDIALVOXEL_TEST_WITH_NIFTI
#  include "itkNiftiImageIO.h"
#endif
#ifdef MEDIALVOXEL_TEST_WITH_TIFF
#  include "itkTIFFImageIO.h"
#endif

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>

using namespace medialvoxel;

namespace
{

/** A NIfTI file of 4 x 3 x 2 voxels of type int16, without any placement. */
class NiftiText
{
public:
  NiftiText()
  {
    this->Set<std::int32_t>(0, { 348 });
    this->Set<std::int16_t>(40, { 3, 4, 3, 2, 1, 1, 1, 1 });
    this->Set<std::int16_t>(70, { 4, 16 });
    this->Set<float>(76, { 1, 0.5F, 0.25F, 2, 1, 1, 1, 1 });
    this->Set<float>(108, { 352 });
    m_Text.replace(344, 4, std::string("n+1", 4));
  }

  template <typename TNumber>
  NiftiText &
  Set(size_t offset, const std::vector<TNumber> & numbers)
  {
    std::memcpy(&m_Text[offset], numbers.data(), numbers.size() * sizeof(TNumber));
    return *this;
  }

  const std::string &
  Get() const
  {
    return m_Text;
  }

private:
  std::string m_Text = std::string(352 + 48, '\0');
};

void
AppendNumber(std::string & text, std::uint64_t number, unsigned int bytes)
{
  for (unsigned int byte = 0; byte < bytes; ++byte)
  {
    text += static_cast<char>(number >> (8 * byte));
  }
}

/** A TIFF file, in little endian, of slices of 4 x 3 voxels of type uint16 in one strip each. */
std::string
MakeTiffText(unsigned int slices)
{
  constexpr std::uint32_t bytesOfDirectory = 2 + 8 * 12 + 4;
  std::string             text = "II*";
  AppendNumber(text, 0, 1);
  AppendNumber(text, 8, 4);
  const auto offsetOfVoxels = static_cast<std::uint32_t>(text.size() + slices * bytesOfDirectory);
  for (unsigned int slice = 0; slice < slices; ++slice)
  {
    const std::uint32_t voxels = offsetOfVoxels + slice * 24;
    AppendNumber(text, 8, 2);
    for (const auto & [tag, value] : std::vector<std::pair<unsigned int, std::uint32_t>>{
           { 256, 4 }, { 257, 3 }, { 258, 16 }, { 259, 1 }, { 262, 1 }, { 273, voxels }, { 278, 3 }, { 279, 24 } })
    {
      AppendNumber(text, tag, 2);
      AppendNumber(text, 4, 2);
      AppendNumber(text, 1, 4);
      AppendNumber(text, value, 4);
    }
    AppendNumber(text, slice + 1 < slices ? text.size() + 4 : 0, 4);
  }
  return text + std::string(24 * slices, '\1');
}

/** Damages bytes in one of the ways in which files get damaged, or attacked. */
std::string
Damage(std::string text, std::mt19937 & random)
{
  const size_t at = random() % text.size();
  switch (random() % 4)
  {
    case 0:
      text[at] = static_cast<char>(random());
      break;
    case 1:
      text.resize(at);
      break;
    case 2:
      text.replace(
        at, std::min<size_t>(4, text.size() - at), std::string(4, static_cast<char>(random() % 2 ? 255 : 127)));
      break;
    default:
      text.replace(at, std::min<size_t>(8, text.size() - at), std::string(8, '\0'));
      break;
  }
  return text;
}

/** Reads damaged files: what is not refused has its voxels in the file. */
void
ExpectReadOrRefused(const std::string & name, const std::string & text, size_t bytesThatMatter)
{
  const TemporaryFolder folder;
  std::mt19937          random(1);
  int                   refused = 0;
  constexpr int         rounds = 500;
  for (int round = 0; round < rounds; ++round)
  {
    const std::string damaged = Damage(text.substr(0, bytesThatMatter), random);
    folder.Write(name, damaged + (damaged.size() < bytesThatMatter ? "" : text.substr(bytesThatMatter)));
    try
    {
      const VolumeHeader header = ReadVolumeHeader(folder / name, std::nullopt);
      ASSERT_LE(header.GetVoxelBytes(), std::uint64_t{ 2048 } * header.dataFileSize);
      for (const itk::MedialVoxelFileSegment & segment : header.segments)
      {
        ASSERT_LE(segment.offset + segment.numberOfBytes, header.dataFileSize);
      }
    }
    catch (const JobError & error)
    {
      ++refused;
      ASSERT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      ASSERT_TRUE(error.GetStatus() == ExitStatus::CorruptInput) << error.what();
    }
  }
  EXPECT_GT(refused, rounds / 4);
  EXPECT_LT(refused, rounds);
}

#if defined(MEDIALVOXEL_TEST_WITH_NIFTI) || defined(MEDIALVOXEL_TEST_WITH_TIFF)
/** ITK reads the same size, type, spacing and placement. */
void
ExpectSameAsItk(const std::filesystem::path & fileName, itk::ImageIOBase & io)
{
  const VolumeHeader header = ReadVolumeHeader(fileName, std::nullopt);
  io.SetFileName(fileName.string());
  io.ReadImageInformation();
  ASSERT_EQ(header.geometry.GetDimension(), io.GetNumberOfDimensions());
  EXPECT_EQ(GetTraits(header.pixelType).bytes, io.GetComponentSize());
  for (unsigned int axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
  {
    EXPECT_EQ(header.geometry.size[axis], io.GetDimensions(axis));
    EXPECT_DOUBLE_EQ(header.geometry.spacing[axis], io.GetSpacing(axis));
    EXPECT_NEAR(header.geometry.origin[axis], io.GetOrigin(axis), 1e-4);
    for (unsigned int row = 0; row < io.GetNumberOfDimensions(); ++row)
    {
      EXPECT_NEAR(header.geometry.direction[axis][row], io.GetDirection(axis)[row], 1e-6) << axis << ' ' << row;
    }
  }
}
#endif

} // namespace

TEST(InputHeader, DamagedNiftiIsReadOrRefused)
{
  ExpectReadOrRefused("a.nii", NiftiText().Get(), 130);
}

TEST(InputHeader, DamagedTiffIsReadOrRefused)
{
  ExpectReadOrRefused("a.tif", MakeTiffText(3), 8 + 3 * 102);
}

TEST(InputHeader, DamagedPackingIsUnpackedOrRefused)
{
  using Unpack = bool (*)(const std::vector<unsigned char> &, std::vector<unsigned char> &);
  std::mt19937 random(1);
  for (const Unpack unpack :
       { static_cast<Unpack>(UnpackLzw), static_cast<Unpack>(UnpackPackBits), static_cast<Unpack>(UnpackDeflate) })
  {
    for (int round = 0; round < 3000; ++round)
    {
      std::vector<unsigned char> packed(random() % 400);
      std::generate(packed.begin(), packed.end(), [&random] { return static_cast<unsigned char>(random()); });
      std::vector<unsigned char> unpacked(random() % 5000);
      const size_t               size = unpacked.size();
      unpack(packed, unpacked);
      ASSERT_EQ(unpacked.size(), size);
    }
  }
}

#ifdef MEDIALVOXEL_TEST_WITH_NIFTI
TEST(InputHeader, NiftiGeometryIsTheOneThatItkReads)
{
  const TemporaryFolder    folder;
  const std::vector<float> turn{ 0.1F, 0.5F, -0.2F };
  const std::vector<float> rows{ 0, 0.25F, 0, 10, -0.5F, 0, 0, 20, 0, 0, 2, 30 };
  const std::vector<float> skewed{ 0.4F, 0.25F, 0, 10, -0.5F, 0.1F, 0, 20, 0, 0, 2, 30 };
  std::vector<NiftiText>   texts(9);
  constexpr size_t         unit = 123;
  constexpr size_t         codes = 252;
  constexpr size_t         quaternion = 256;
  constexpr size_t         offset = 268;
  constexpr size_t         matrix = 280;
  const std::vector<float> place{ 1, -2, 3.5F };
  texts[1].Set<unsigned char>(unit, { 3 });
  texts[2].Set<std::int16_t>(codes, { 1, 0 }).Set(quaternion, turn).Set(offset, place);
  texts[3].Set<std::int16_t>(codes, { 2, 0 }).Set(quaternion, turn).Set(offset, place).Set<float>(76, { -1 });
  texts[4].Set<std::int16_t>(codes, { 0, 1 }).Set(matrix, rows);
  texts[5].Set<std::int16_t>(codes, { 1, 1 }).Set(quaternion, turn).Set(offset, place).Set(matrix, rows);
  texts[6].Set<std::int16_t>(codes, { 1, 2 }).Set(quaternion, turn).Set(offset, place).Set(matrix, rows);
  texts[7].Set<std::int16_t>(codes, { 1, 1 }).Set(quaternion, turn).Set(offset, place).Set(matrix, skewed);
  texts[8].Set<std::int16_t>(codes, { 1, 0 }).Set<float>(quaternion, { 0, 0, 1 }).Set<unsigned char>(unit, { 1 });
  for (const NiftiText & text : texts)
  {
    SCOPED_TRACE(&text - texts.data());
    folder.Write("a.nii", text.Get());
    ExpectSameAsItk(folder / "a.nii", *itk::NiftiImageIO::New());
  }
}
#endif

#ifdef MEDIALVOXEL_TEST_WITH_TIFF
TEST(InputHeader, TiffIsTheOneThatItkReads)
{
  const TemporaryFolder folder;
  for (const unsigned int slices : { 1, 5 })
  {
    folder.Write("a.tif", MakeTiffText(slices));
    ExpectSameAsItk(folder / "a.tif", *itk::TIFFImageIO::New());
  }
}

TEST(InputHeader, TiffThatItkPacksIsUnpacked)
{
  const TemporaryFolder      folder;
  std::mt19937               random(1);
  constexpr unsigned int     edges[3] = { 301, 97, 4 };
  std::vector<std::uint16_t> voxels(edges[0] * edges[1] * edges[2]);
  for (size_t voxel = 0; voxel < voxels.size(); ++voxel)
  {
    voxels[voxel] = static_cast<std::uint16_t>(voxel / 500 * 100 + (voxel % 7 == 0 ? random() % 3 : 0));
  }
  for (const char * const packing : { "NOCOMPRESSION", "PACKBITS", "LZW", "DEFLATE" })
  {
    SCOPED_TRACE(packing);
    const auto         io = itk::TIFFImageIO::New();
    itk::ImageIORegion region(3);
    io->SetNumberOfDimensions(3);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      io->SetDimensions(axis, edges[axis]);
      io->SetSpacing(axis, axis == 2 ? 1.0 : 0.25);
      region.SetSize(axis, edges[axis]);
    }
    io->SetComponentType(itk::IOComponentEnum::USHORT);
    io->SetNumberOfComponents(1);
    io->SetPixelType(itk::IOPixelEnum::SCALAR);
    io->SetUseCompression(std::string(packing) != "NOCOMPRESSION");
    io->SetCompressor(packing);
    io->SetIORegion(region);
    io->SetFileName((folder / "a.tif").string());
    io->Write(voxels.data());

    ExpectSameAsItk(folder / "a.tif", *itk::TIFFImageIO::New());
    const VolumeHeader         header = ReadVolumeHeader(folder / "a.tif", std::nullopt);
    std::vector<std::uint16_t> read(voxels.size());
    EXPECT_EQ(header.compressed, std::string(packing) != "NOCOMPRESSION");
    if (header.compressed)
    {
      OpenVoxelStream(header)->Read(read.data(), read.size() * sizeof(std::uint16_t));
    }
    else
    {
      const std::uint64_t bytes = read.size() * sizeof(std::uint16_t);
      itk::MedialVoxelFileRegion({ bytes }, { 0 }, { bytes }, 1).Read(header.segments, read.data());
    }
    EXPECT_EQ(read, voxels);
  }
}
#endif
