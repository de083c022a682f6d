// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// PNG through libpng itself: ITK's reader of headers ends the process when one is damaged.

#include "HeaderParsing.h"
#include "SliceFormats.h"
#include "SystemFile.h"

#include "itkMedialVoxelFileRegion.h"

#include <csetjmp>
#include <cstdio>
#include <png.h>

namespace medialvoxel
{
namespace
{

/** Deflate packs at most this many bytes into one; filters add nothing. */
constexpr std::uint64_t MaximumRatio = 1032;

/** Rows and tables of libpng. */
constexpr std::uint64_t DecoderMemory = std::uint64_t{ 1 } << 20;

/** Back to where setjmp() was called, without a word on the terminal. */
[[noreturn]] void
Jump(png_structp png, png_const_charp)
{
  png_longjmp(png, 1);
}

void
IgnoreWarning(png_structp, png_const_charp)
{}

// Functions in which libpng may jump have no objects that would have to be destroyed.

bool
TryReadHeader(png_structp png, png_infop info)
{
  if (setjmp(png_jmpbuf(png)) != 0)
  {
    return false;
  }
  png_read_info(png, info);
  return true;
}

bool
TryReadRows(png_structp png, png_infop info, png_bytepp rows, std::size_t bytesPerRow)
{
  if (setjmp(png_jmpbuf(png)) != 0)
  {
    return false;
  }
  png_set_expand_gray_1_2_4_to_8(png);
  if (!itk::MachineIsBigEndian())
  {
    png_set_swap(png);
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != bytesPerRow)
  {
    return false;
  }
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

/** \class PngFile
 * \brief An opened file whose header was read. */
class PngFile
{
public:
  explicit PngFile(const std::filesystem::path & fileName)
    : m_FileName(fileName)
  {
    OpenRegularFile(fileName);
    m_File = OpenStream(fileName);
    m_Png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, Jump, IgnoreWarning);
    m_Info = m_Png ? png_create_info_struct(m_Png) : nullptr;
    if (!m_File || !m_Info)
    {
      this->Close();
      RefuseHeader(fileName, "cannot be opened", HeaderError::Kind::Unreadable);
    }
    png_init_io(m_Png, m_File);
    if (!TryReadHeader(m_Png, m_Info))
    {
      this->Close();
      RefuseHeader(fileName, "its header is damaged or is not that of a PNG file");
    }
  }

  ~PngFile() { this->Close(); }

  PngFile(const PngFile &) = delete;
  PngFile &
  operator=(const PngFile &) = delete;

  SliceHeader
  GetHeader() const
  {
    const auto bits = png_get_bit_depth(m_Png, m_Info);
    if (png_get_color_type(m_Png, m_Info) != PNG_COLOR_TYPE_GRAY)
    {
      RefuseHeader(m_FileName,
                   "it is a color image or has transparency (color type " +
                     std::to_string(png_get_color_type(m_Png, m_Info)) + "); only gray values are read",
                   HeaderError::Kind::Unsupported);
    }
    SliceHeader header;
    header.fileName = m_FileName;
    header.size = { { png_get_image_width(m_Png, m_Info), png_get_image_height(m_Png, m_Info) } };
    header.pixelType = bits == 16 ? PixelType::UInt16 : PixelType::UInt8;
    header.decoderMemory = DecoderMemory + header.size[1] * sizeof(png_bytep);
    // Bits that are expanded to bytes come on top.
    CheckSliceSize(header, GetDataFileSize(m_FileName, m_FileName), MaximumRatio * (bits < 8 ? 8 / bits : 1));
    return header;
  }

  void
  ReadVoxels(const SliceHeader & header, void * voxels)
  {
    const std::size_t      bytesPerRow = header.GetDataSize() / header.size[1];
    std::vector<png_bytep> rows(header.size[1]);
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      rows[row] = static_cast<png_bytep>(voxels) + row * bytesPerRow;
    }
    if (!TryReadRows(m_Png, m_Info, rows.data(), bytesPerRow))
    {
      RefuseHeader(m_FileName, "its voxels are damaged or end early");
    }
  }

private:
  void
  Close()
  {
    png_destroy_read_struct(&m_Png, &m_Info, nullptr);
    if (m_File)
    {
      std::fclose(m_File);
    }
  }

  std::filesystem::path m_FileName;
  std::FILE *           m_File{ nullptr };
  png_structp           m_Png{ nullptr };
  png_infop             m_Info{ nullptr };
};

} // namespace

SliceFormat
MakePngSliceFormat()
{
  return MakeSliceFormat<PngFile>("PNG", { ".png" });
}

} // end namespace medialvoxel
