// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// BMP as ITK reads them. ITK's reader trusts their headers, and misses the end of cut files.

#include "BinaryHeader.h"
#include "HeaderParsing.h"
#include "SliceFormats.h"

#include "itkMedialVoxelFileRegion.h"

#include "itkBMPImageIO.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace medialvoxel
{
namespace
{

/** No way of packing that these formats have makes one byte out of more than this many. */
constexpr std::uint64_t MaximumRatio = 4096;

/** Rows and tables of the libraries. */
constexpr std::uint64_t BytesOfDecoding = std::uint64_t{ 1 } << 20;

/** \a count bytes from an offset on, or less at the end of the file. */
std::vector<unsigned char>
ReadBytes(const std::filesystem::path & fileName, std::uint64_t offset, std::size_t count)
{
  std::ifstream              file = OpenRegularFile(fileName);
  std::vector<unsigned char> bytes(count);
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

void
RequireSignature(const std::filesystem::path & fileName, std::string_view signature, const char * format)
{
  const std::vector<unsigned char> bytes = ReadBytes(fileName, 0, signature.size());
  if (!std::equal(bytes.begin(), bytes.end(), signature.begin(), signature.end(), [](unsigned char a, char b) {
        return a == static_cast<unsigned char>(b);
      }))
  {
    RefuseHeader(fileName, std::string("it does not begin as a ") + format + " file does");
  }
}

/** Its size and what ITK's reader would not check: rows without packing, all of them in the file. */
void
CheckBmp(const std::filesystem::path & fileName)
try
{
  RequireSignature(fileName, "BM", "BMP");
  constexpr std::size_t   bytesOfHeader = 54;
  constexpr std::uint32_t bytesOfInformation = 40;
  constexpr std::uint64_t largest = std::uint64_t{ 1 } << 20;
  const BinaryHeader      header(ReadBytes(fileName, 0, bytesOfHeader), false);
  const auto              columns = header.Get<std::int32_t>(18);
  const std::int64_t      rows = header.Get<std::int32_t>(22);
  const auto              bits = header.Get<std::uint16_t>(28);
  const auto              compression = header.Get<std::uint32_t>(30);
  const auto              width = static_cast<std::uint64_t>(std::max(columns, 0));
  const auto              height = static_cast<std::uint64_t>(std::abs(rows));
  if (header.Get<std::uint32_t>(14) != bytesOfInformation || bits != 8 || compression != 0)
  {
    RefuseHeader(fileName,
                 "only BMP with a header of 40 bytes, 8 bits per voxel and no compression is read; it has " +
                   std::to_string(header.Get<std::uint32_t>(14)) + " bytes, " + std::to_string(bits) +
                   " bits and the compression " + std::to_string(compression),
                 HeaderError::Kind::Unsupported);
  }
  if (width == 0 || height == 0 || width > largest || height > largest)
  {
    RefuseHeader(fileName,
                 "its size is " + std::to_string(columns) + " x " + std::to_string(rows) + "; 1 to " +
                   std::to_string(largest) + " are read");
  }
  const std::uint64_t needed = header.Get<std::uint32_t>(10) + (width + 3) / 4 * 4 * height;
  const std::uint64_t available = GetDataFileSize(fileName, fileName);
  if (needed > available)
  {
    RefuseHeader(fileName, "it has " + std::to_string(available) + " bytes; its size needs " + std::to_string(needed));
  }
}
catch (const std::out_of_range &)
{
  RefuseHeader(fileName, "it ends in its header");
}

/** Gray BMP have a palette, whose colors must be the numbers of the voxels. */
void
CheckPalette(const itk::BMPImageIO & imageIO, const std::filesystem::path & fileName)
{
  const auto palette = imageIO.GetColorPalette();
  for (std::size_t i = 0; i < palette.size(); ++i)
  {
    const auto & color = palette[i];
    if (color.GetRed() != i || color.GetGreen() != i || color.GetBlue() != i)
    {
      RefuseHeader(fileName,
                   "it is a color image: color " + std::to_string(i) + " of its palette is not the gray value " +
                     std::to_string(i),
                   HeaderError::Kind::Unsupported);
    }
  }
}

PixelType
GetPixelType(const itk::ImageIOBase & imageIO, const std::filesystem::path & fileName)
{
  if (imageIO.GetNumberOfComponents() != 1)
  {
    RefuseHeader(fileName,
                 "it is a color image (" + std::to_string(imageIO.GetNumberOfComponents()) +
                   " values per voxel); only gray values are read",
                 HeaderError::Kind::Unsupported);
  }
  switch (imageIO.GetComponentType())
  {
    case itk::IOComponentEnum::UCHAR:
      return PixelType::UInt8;
    case itk::IOComponentEnum::USHORT:
      return PixelType::UInt16;
    default:
      RefuseHeader(fileName,
                   "its voxels are of the type " +
                     itk::ImageIOBase::GetComponentTypeAsString(imageIO.GetComponentType()) +
                     "; 8 and 16 bits are read",
                   HeaderError::Kind::Unsupported);
  }
}

/** A row of the table; \a VCheck looks at what ITK's reader trusts. */
template <typename TImageIO, void (*VCheck)(const std::filesystem::path &)>
struct Picture
{
  static typename TImageIO::Pointer
  Open(const std::filesystem::path & fileName)
  {
    VCheck(fileName);
    const auto imageIO = TImageIO::New();
    imageIO->SetFileName(fileName.string());
    imageIO->SetExpandRGBPalette(false);
    imageIO->ReadImageInformation();
    CheckPalette(*imageIO, fileName);
    return imageIO;
  }

  static SliceHeader
  MakeHeader(const TImageIO & imageIO, const std::filesystem::path & fileName)
  {
    SliceHeader header;
    header.fileName = fileName;
    header.size = { { imageIO.GetDimensions(0), imageIO.GetDimensions(1) } };
    header.pixelType = GetPixelType(imageIO, fileName);
    header.decodeBytes = BytesOfDecoding;
    CheckSliceSize(header, GetDataFileSize(fileName, fileName), MaximumRatio);
    return header;
  }

  static std::vector<SliceHeader>
  ReadHeaders(const std::filesystem::path & fileName)
  {
    return { WithoutItkErrors(fileName, [&] { return MakeHeader(*Open(fileName), fileName); }) };
  }

  static void
  ReadVoxels(const SliceHeader & expected, void * voxels)
  {
    WithoutItkErrors(expected.fileName, [&] {
      const auto imageIO = Open(expected.fileName);
      RequireSameSlice(expected, MakeHeader(*imageIO, expected.fileName));
      imageIO->Read(voxels);
    });
  }

private:
  template <typename TFunction>
  static auto
  WithoutItkErrors(const std::filesystem::path & fileName, TFunction && function)
  try
  {
    return function();
  }
  catch (const itk::ExceptionObject &)
  {
    RefuseHeader(fileName, "the image is damaged, ends early, or is of a kind that is not read");
  }
};

template <typename TPicture>
SliceFormat
MakeFormat(const char * name, const std::vector<const char *> & extensions)
{
  return { name, extensions, false, nullptr, TPicture::ReadHeaders, TPicture::ReadVoxels, 0 };
}

} // namespace

SliceFormat
MakeBmpSliceFormat()
{
  return MakeFormat<Picture<itk::BMPImageIO, CheckBmp>>("BMP", { ".bmp" });
}

} // end namespace medialvoxel
