// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// JPEG through libjpeg itself: ITK's reader ends the process for some damaged files.

#include "HeaderParsing.h"
#include "SliceFormats.h"
#include "SystemFile.h"

#include "itkMedialVoxelFileRegion.h"

#include <csetjmp>
#include <cstdio>
#include <jpeglib.h>

namespace medialvoxel
{
namespace
{

/** A block of 64 voxels takes one bit at least with the codes of Huffman, and little less with arithmetic ones. */
constexpr std::uint64_t MaximumRatio = 1024;

/** Rows and tables of libjpeg; a progressive file also keeps two bytes for each voxel of whole blocks. */
constexpr std::uint64_t DecoderMemory = std::uint64_t{ 1 } << 20;
constexpr std::uint64_t BytesPerVoxel = 2;
constexpr std::uint64_t BlockEdge = 8;

/** More come from files that are made to take long. */
constexpr int MostScans = 100;

/** \class JpegDecoder
 * \brief The state of libjpeg, whose errors jump back to where setjmp() was called, without a word on the terminal. */
struct JpegDecoder
{
  jpeg_decompress_struct state;
  jpeg_error_mgr         errors;
  jpeg_progress_mgr      progress;
  std::jmp_buf           jump;
};

[[noreturn]] void
Jump(j_common_ptr state)
{
  std::longjmp(static_cast<JpegDecoder *>(state->client_data)->jump, 1);
}

void
JumpAfterTooManyScans(j_common_ptr state)
{
  if (static_cast<JpegDecoder *>(state->client_data)->state.input_scan_number > MostScans)
  {
    Jump(state);
  }
}

void
SayNothing(j_common_ptr)
{}

// Functions in which libjpeg may jump have no objects that would have to be destroyed.

bool
TryReadHeader(JpegDecoder & decoder, std::FILE * file)
{
  decoder.state.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = Jump;
  decoder.errors.output_message = SayNothing;
  decoder.state.client_data = &decoder;
  if (setjmp(decoder.jump) != 0)
  {
    return false;
  }
  jpeg_create_decompress(&decoder.state);
  decoder.state.client_data = &decoder;
  decoder.progress = {};
  decoder.progress.progress_monitor = JumpAfterTooManyScans;
  decoder.state.progress = &decoder.progress;
  jpeg_stdio_src(&decoder.state, file);
  return jpeg_read_header(&decoder.state, TRUE) == JPEG_HEADER_OK;
}

/** Voxels that end early are a warning of libjpeg, which goes on with gray. */
bool
TryReadRows(JpegDecoder & decoder, unsigned char * voxels, std::size_t bytesPerRow)
{
  if (setjmp(decoder.jump) != 0)
  {
    return false;
  }
  if (!jpeg_start_decompress(&decoder.state) || decoder.state.output_components != 1 ||
      decoder.state.output_width != bytesPerRow)
  {
    return false;
  }
  while (decoder.state.output_scanline < decoder.state.output_height)
  {
    JSAMPROW row = voxels + decoder.state.output_scanline * bytesPerRow;
    jpeg_read_scanlines(&decoder.state, &row, 1);
  }
  return jpeg_finish_decompress(&decoder.state) && decoder.errors.num_warnings == 0;
}

/** \class JpegFile
 * \brief An opened file whose header was read. */
class JpegFile
{
public:
  explicit JpegFile(const std::filesystem::path & fileName)
    : m_FileName(fileName)
  {
    OpenRegularFile(fileName);
    m_File = OpenStream(fileName);
    if (!m_File)
    {
      RefuseHeader(fileName, "cannot be opened", HeaderError::Kind::Unreadable);
    }
    if (!TryReadHeader(m_Decoder, m_File))
    {
      this->Close();
      RefuseHeader(fileName, "its header is damaged or is not that of a JPEG file");
    }
  }

  ~JpegFile() { this->Close(); }

  JpegFile(const JpegFile &) = delete;
  JpegFile &
  operator=(const JpegFile &) = delete;

  SliceHeader
  GetHeader() const
  {
    const jpeg_decompress_struct & state = m_Decoder.state;
    if (state.num_components != 1)
    {
      RefuseHeader(m_FileName,
                   "it is a color image (" + std::to_string(state.num_components) +
                     " values per voxel); only gray values are read",
                   HeaderError::Kind::Unsupported);
    }
    SliceHeader header;
    header.fileName = m_FileName;
    header.size = { { state.image_width, state.image_height } };
    header.pixelType = PixelType::UInt8;
    header.decoderMemory = DecoderMemory + BytesPerVoxel * (header.size[0] + BlockEdge) * (header.size[1] + BlockEdge);
    CheckSliceSize(header, GetDataFileSize(m_FileName, m_FileName), MaximumRatio);
    return header;
  }

  void
  ReadVoxels(const SliceHeader & header, void * voxels)
  {
    if (!TryReadRows(m_Decoder, static_cast<unsigned char *>(voxels), header.size[0]))
    {
      RefuseHeader(m_FileName, "its voxels are damaged or end early");
    }
  }

private:
  void
  Close()
  {
    jpeg_destroy_decompress(&m_Decoder.state);
    std::fclose(m_File);
  }

  std::filesystem::path m_FileName;
  std::FILE *           m_File{ nullptr };
  JpegDecoder           m_Decoder{};
};

} // namespace

SliceFormat
MakeJpegSliceFormat()
{
  return MakeSliceFormat<JpegFile>("JPEG", { ".jpg", ".jpeg" });
}

} // end namespace medialvoxel
