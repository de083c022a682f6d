// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ReadVolumeHeader.h"
#include "VolumeHeader.h"

#include "TemporaryFolder.h"
#include "VoxelSource.h"

#ifdef MEDIALVOXEL_TEST_WITH_NIFTI
#  include "itkNiftiImageIO.h"
#endif
#ifdef MEDIALVOXEL_TEST_WITH_TIFF
#  include "itkTIFFImageIO.h"
#endif

#include <gtest/gtest.h>

#ifdef MEDIALVOXEL_WITH_TIFF
#  include <tiffio.h>
#endif

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

#ifdef MEDIALVOXEL_WITH_TIFF
constexpr std::uint32_t TiffWidth = 31;
constexpr std::uint32_t TiffHeight = 17;

/** How libtiff is asked to write. */
struct TiffVariant
{
  const char *  mode{ "wl" };
  std::uint16_t compression{ COMPRESSION_NONE };
  std::uint16_t predictor{ PREDICTOR_NONE };
  std::uint32_t rowsPerStrip{ TiffHeight };
};

/** Writes slices of TiffWidth x TiffHeight voxels. */
template <typename TPixel>
void
WriteTiff(const std::filesystem::path & fileName, std::vector<TPixel> voxels, const TiffVariant & variant)
{
  constexpr bool                                    isReal = std::is_floating_point_v<TPixel>;
  constexpr std::size_t                             voxelsPerSlice = TiffWidth * TiffHeight;
  const std::unique_ptr<TIFF, decltype(&TIFFClose)> file(TIFFOpen(fileName.string().c_str(), variant.mode), TIFFClose);
  ASSERT_NE(file, nullptr);
  for (std::size_t begin = 0; begin < voxels.size(); begin += voxelsPerSlice)
  {
    TIFFSetField(file.get(), TIFFTAG_IMAGEWIDTH, TiffWidth);
    TIFFSetField(file.get(), TIFFTAG_IMAGELENGTH, TiffHeight);
    TIFFSetField(file.get(), TIFFTAG_BITSPERSAMPLE, 8 * sizeof(TPixel));
    TIFFSetField(file.get(),
                 TIFFTAG_SAMPLEFORMAT,
                 isReal                     ? SAMPLEFORMAT_IEEEFP
                 : std::is_signed_v<TPixel> ? SAMPLEFORMAT_INT
                                            : SAMPLEFORMAT_UINT);
    TIFFSetField(file.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(file.get(), TIFFTAG_COMPRESSION, variant.compression);
    if (variant.predictor != PREDICTOR_NONE)
    {
      TIFFSetField(file.get(), TIFFTAG_PREDICTOR, variant.predictor);
    }
    TIFFSetField(file.get(), TIFFTAG_ROWSPERSTRIP, variant.rowsPerStrip);
    for (std::uint32_t row = 0; row < TiffHeight; ++row)
    {
      ASSERT_EQ(TIFFWriteScanline(file.get(), &voxels[begin + row * TiffWidth], row), 1);
    }
    ASSERT_EQ(TIFFWriteDirectory(file.get()), 1);
  }
}

/** Voxels of runs and of noise, so that packing has something to do. */
template <typename TPixel>
std::vector<TPixel>
MakeVoxels(unsigned int slices)
{
  std::mt19937        random(1);
  std::vector<TPixel> voxels(std::size_t{ TiffWidth } * TiffHeight * slices);
  std::size_t         number = 0;
  for (TPixel & voxel : voxels)
  {
    voxel = static_cast<TPixel>(number / 50 * 3 + (number % 7 == 0 ? random() % 3 : 0));
    ++number;
  }
  return voxels;
}

/** Reads all voxels as the program does, into the order of the machine. */
template <typename TPixel>
std::vector<TPixel>
ReadVoxels(const VolumeHeader & header)
{
  std::vector<TPixel> voxels(header.geometry.GetNumberOfVoxels());
  const std::uint64_t bytes = header.GetDataSize();
  if (header.compressed)
  {
    OpenVoxelSource(header)->Read(0, voxels.data(), bytes);
    return voxels;
  }
  itk::MedialVoxelFileRegion({ bytes }, { 0 }, { bytes }, 1).Read(header.segments, voxels.data());
  if (header.bigEndian != itk::MachineIsBigEndian())
  {
    itk::SwapComponentBytes(voxels.data(), bytes, sizeof(TPixel));
  }
  return voxels;
}

/** Files of libtiff are read, voxel by voxel. */
template <typename TPixel>
void
ExpectTiffIsRead(const TiffVariant & variant)
{
  const TemporaryFolder folder;
  const auto            voxels = MakeVoxels<TPixel>(3);
  WriteTiff(folder / "a.tif", voxels, variant);
  const VolumeHeader header = ReadVolumeHeader(folder / "a.tif", std::nullopt);
  EXPECT_EQ(header.compressed, variant.compression != COMPRESSION_NONE);
  EXPECT_EQ(header.geometry.size, (std::vector<std::uint64_t>{ TiffWidth, TiffHeight, 3 }));
  EXPECT_EQ(ReadVoxels<TPixel>(header), voxels)
    << variant.mode << ' ' << variant.compression << ' ' << variant.predictor << ' ' << variant.rowsPerStrip;
}

std::string
MakeTiffText(const TiffVariant & variant)
{
  const TemporaryFolder folder;
  WriteTiff(folder / "a.tif", MakeVoxels<std::uint16_t>(3), variant);
  std::ifstream      file(folder / "a.tif", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}
#endif

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

/** Reads damaged files: an accepted file has its voxels, or fails to unpack. */
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
      ASSERT_LE(header.GetDataSize(), std::uint64_t{ 4096 } * header.dataFileSize);
      for (const itk::MedialVoxelFileSegment & segment : header.segments)
      {
        ASSERT_LE(segment.offset + segment.numberOfBytes, header.dataFileSize);
      }
      if (header.compressed)
      {
        std::vector<unsigned char> voxels(header.GetDataSize());
        OpenVoxelSource(header)->Read(0, voxels.data(), voxels.size());
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

#ifdef MEDIALVOXEL_WITH_TIFF
TEST(InputHeader, DamagedTiffIsReadOrRefused)
{
  for (const char * const mode : { "wl", "wb", "w8" })
  {
    for (const std::uint16_t compression :
         { COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS })
    {
      const std::string text = MakeTiffText({ mode, compression, PREDICTOR_NONE, 5 });
      ExpectReadOrRefused("a.tif", text, text.size());
    }
  }
}

TEST(InputHeader, TiffThatLibtiffWritesIsRead)
{
  for (const char * const mode : { "wl", "wb", "w8l", "w8b" })
  {
    for (const std::uint32_t rows : { 1u, 5u, TiffHeight })
    {
      ExpectTiffIsRead<std::uint16_t>({ mode, COMPRESSION_NONE, PREDICTOR_NONE, rows });
      ExpectTiffIsRead<std::int32_t>({ mode, COMPRESSION_PACKBITS, PREDICTOR_NONE, rows });
      for (const std::uint16_t compression : { COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE })
      {
        ExpectTiffIsRead<std::uint8_t>({ mode, compression, PREDICTOR_HORIZONTAL, rows });
        ExpectTiffIsRead<std::int16_t>({ mode, compression, PREDICTOR_HORIZONTAL, rows });
        ExpectTiffIsRead<std::uint64_t>({ mode, compression, PREDICTOR_NONE, rows });
        ExpectTiffIsRead<float>({ mode, compression, PREDICTOR_NONE, rows });
        ExpectTiffIsRead<double>({ mode, compression, PREDICTOR_NONE, rows });
      }
    }
  }
  // In big endian libtiff 4.5 writes this predictor wrongly.
  ExpectTiffIsRead<float>({ "wl", COMPRESSION_LZW, PREDICTOR_FLOATINGPOINT, 5 });
  ExpectTiffIsRead<double>({ "w8l", COMPRESSION_ADOBE_DEFLATE, PREDICTOR_FLOATINGPOINT, 5 });
}
#endif

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
  texts[6].Set<std::int16_t>(codes, { 0, 2 }).Set(quaternion, turn).Set(offset, place).Set(matrix, rows);
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
    WriteTiff(folder / "a.tif", MakeVoxels<std::uint16_t>(slices), {});
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
    const VolumeHeader header = ReadVolumeHeader(folder / "a.tif", std::nullopt);
    EXPECT_EQ(header.compressed, std::string(packing) != "NOCOMPRESSION");
    EXPECT_EQ(ReadVoxels<std::uint16_t>(header), voxels);
  }
}
#endif
