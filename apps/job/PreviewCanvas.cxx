// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PreviewCanvas.h"

#include "Errors.h"

#include "itkPNGImageIO.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr unsigned int GlyphWidth = 5;
constexpr unsigned int GlyphHeight = 7;
constexpr unsigned int GlyphScale = TextHeight / GlyphHeight;

/** Seven rows of five pixels, the leftmost in the highest of the five bits. */
using Glyph = std::array<std::uint8_t, GlyphHeight>;

constexpr std::array<std::pair<char, Glyph>, 31> Glyphs{ {
  { 'A', { 0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001 } },
  { 'B', { 0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110 } },
  { 'C', { 0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110 } },
  { 'D', { 0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110 } },
  { 'E', { 0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111 } },
  { 'G', { 0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01110 } },
  { 'I', { 0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110 } },
  { 'J', { 0b00111, 0b00010, 0b00010, 0b00010, 0b00010, 0b10010, 0b01100 } },
  { 'L', { 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111 } },
  { 'M', { 0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001 } },
  { 'N', { 0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001 } },
  { 'O', { 0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110 } },
  { 'S', { 0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110 } },
  { 'T', { 0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100 } },
  { 'U', { 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110 } },
  { 'X', { 0b10001, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001, 0b10001 } },
  { 'Y', { 0b10001, 0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b00100 } },
  { 'Z', { 0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b11111 } },
  { '0', { 0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110 } },
  { '1', { 0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110 } },
  { '2', { 0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111 } },
  { '3', { 0b11110, 0b00001, 0b00001, 0b01110, 0b00001, 0b00001, 0b11110 } },
  { '4', { 0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010 } },
  { '5', { 0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110 } },
  { '6', { 0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110 } },
  { '7', { 0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000 } },
  { '8', { 0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110 } },
  { '9', { 0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100 } },
  { '=', { 0b00000, 0b00000, 0b11111, 0b00000, 0b11111, 0b00000, 0b00000 } },
  { '.', { 0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100 } },
  { '-', { 0b00000, 0b00000, 0b00000, 0b01110, 0b00000, 0b00000, 0b00000 } },
} };

/** The last chunk of a PNG file: length 0, name and checksum. */
constexpr std::string_view EndChunk{ "\0\0\0\0IEND\xAE\x42\x60\x82", 12 };

/** The library that writes the file may not notice a full disk. */
void
CheckEnd(const OutputFile & file, std::uint64_t size)
{
  std::array<char, EndChunk.size()> end{};
  if (size >= end.size())
  {
    file.ReadAt(size - end.size(), end.data(), end.size());
  }
  if (std::string_view(end.data(), end.size()) != EndChunk)
  {
    Fail(ExitStatus::Failure, "cannot write ", file.GetFileName().string(), ": the picture is incomplete");
  }
}

} // namespace

Canvas::Canvas(unsigned int width, unsigned int height)
  : m_Width(width)
  , m_Height(height)
  , m_Pixels(size_t{ 3 } * width * height, 0)
{}

void
Canvas::SetPixel(unsigned int x, unsigned int y, const Color & color)
{
  if (x < m_Width && y < m_Height)
  {
    std::copy(color.begin(), color.end(), m_Pixels.begin() + 3 * (size_t{ y } * m_Width + x));
  }
}

void
Canvas::FillRectangle(const Rectangle & area, const Color & color)
{
  for (unsigned int y = area.y; y < area.y + area.height; ++y)
  {
    for (unsigned int x = area.x; x < area.x + area.width; ++x)
    {
      this->SetPixel(x, y, color);
    }
  }
}

void
Canvas::DrawFrame(const Rectangle & area, const Color & color)
{
  this->FillRectangle({ area.x - 1, area.y - 1, area.width + 2, 1 }, color);
  this->FillRectangle({ area.x - 1, area.y + area.height, area.width + 2, 1 }, color);
  this->FillRectangle({ area.x - 1, area.y, 1, area.height }, color);
  this->FillRectangle({ area.x + area.width, area.y, 1, area.height }, color);
}

void
Canvas::DrawText(unsigned int x, unsigned int y, const std::string & text, const Color & color)
{
  for (const char character : text)
  {
    const auto found =
      std::find_if(Glyphs.begin(), Glyphs.end(), [character](const auto & entry) { return entry.first == character; });
    for (unsigned int row = 0; found != Glyphs.end() && row < GlyphHeight; ++row)
    {
      for (unsigned int column = 0; column < GlyphWidth; ++column)
      {
        if ((found->second[row] >> (GlyphWidth - 1 - column)) & 1)
        {
          this->FillRectangle({ x + column * GlyphScale, y + row * GlyphScale, GlyphScale, GlyphScale }, color);
        }
      }
    }
    x += TextAdvance;
  }
}

void
Canvas::WritePng(OutputFile & file) const
{
  const auto io = itk::PNGImageIO::New();
  io->SetFileName(file.GetTemporaryName().string());
  io->SetNumberOfDimensions(2);
  io->SetDimensions(0, m_Width);
  io->SetDimensions(1, m_Height);
  io->SetPixelType(itk::IOPixelEnum::RGB);
  io->SetComponentType(itk::IOComponentEnum::UCHAR);
  io->SetNumberOfComponents(3);
  io->SetUseCompression(true);
  itk::ImageIORegion region(2);
  region.SetSize(0, m_Width);
  region.SetSize(1, m_Height);
  io->SetIORegion(region);
  try
  {
    io->Write(m_Pixels.data());
  }
  catch (const itk::ExceptionObject & error)
  {
    Fail(ExitStatus::Failure, "cannot write ", file.GetFileName().string(), ": ", error.GetDescription());
  }
  file.AcceptSize();
  CheckEnd(file, file.GetSize());
  file.Finish();
}

} // end namespace medialvoxel
