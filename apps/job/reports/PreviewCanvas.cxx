// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PreviewCanvas.h"

#include "Errors.h"

#include "itk_zlib.h"

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

constexpr std::array<std::pair<char, Glyph>, 34> Glyphs{ {
  { 'A', { 0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001 } },
  { 'B', { 0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110 } },
  { 'C', { 0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110 } },
  { 'D', { 0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110 } },
  { 'E', { 0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111 } },
  { 'G', { 0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01110 } },
  { 'H', { 0b10001, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001 } },
  { 'I', { 0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110 } },
  { 'J', { 0b00111, 0b00010, 0b00010, 0b00010, 0b00010, 0b10010, 0b01100 } },
  { 'K', { 0b10001, 0b10010, 0b10100, 0b11000, 0b10100, 0b10010, 0b10001 } },
  { 'L', { 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111 } },
  { 'M', { 0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001 } },
  { 'N', { 0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001 } },
  { 'O', { 0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110 } },
  { 'S', { 0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110 } },
  { 'T', { 0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100 } },
  { 'U', { 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110 } },
  { 'V', { 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01010, 0b00100 } },
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

/** Four bytes, the most significant first. */
std::string
ToBytes(std::uint32_t value)
{
  return { static_cast<char>(value >> 24),
           static_cast<char>(value >> 16 & 255),
           static_cast<char>(value >> 8 & 255),
           static_cast<char>(value & 255) };
}

/** A chunk of a PNG file: length, name, contents, checksum. */
std::string
MakeChunk(const std::string & name, const std::string & contents)
{
  const std::string named = name + contents;
  const uLong       checksum = crc32(0, reinterpret_cast<const Bytef *>(named.data()), static_cast<uInt>(named.size()));
  return ToBytes(static_cast<std::uint32_t>(contents.size())) + named + ToBytes(static_cast<std::uint32_t>(checksum));
}

std::string
Compress(const std::string & bytes)
{
  uLongf      size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  if (compress(reinterpret_cast<Bytef *>(packed.data()),
               &size,
               reinterpret_cast<const Bytef *>(bytes.data()),
               static_cast<uLong>(bytes.size())) != Z_OK)
  {
    Fail(ExitStatus::Failure, "the picture cannot be compressed");
  }
  packed.resize(size);
  return packed;
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
Canvas::DrawCanvas(unsigned int x, unsigned int y, const Canvas & other)
{
  for (unsigned int row = 0; row < other.m_Height; ++row)
  {
    for (unsigned int column = 0; column < other.m_Width; ++column)
    {
      const std::uint8_t * const pixel = &other.m_Pixels[3 * (size_t{ row } * other.m_Width + column)];
      this->SetPixel(x + column, y + row, { pixel[0], pixel[1], pixel[2] });
    }
  }
}

Canvas
JoinCanvases(const Canvas & first, const Canvas & second)
{
  const bool isBelow = first.GetWidth() > first.GetHeight();
  const auto x = isBelow ? 0 : first.GetWidth();
  const auto y = isBelow ? first.GetHeight() : 0;
  Canvas joined(std::max(first.GetWidth(), x + second.GetWidth()), std::max(first.GetHeight(), y + second.GetHeight()));
  joined.DrawCanvas(0, 0, first);
  joined.DrawCanvas(x, y, second);
  return joined;
}

std::string
Canvas::EncodePng() const
{
  constexpr std::string_view signature{ "\x89PNG\r\n\x1A\n" };
  constexpr std::string_view format{ "\x08\x02\0\0\0", 5 }; // eight bits of red, green, blue
  const std::size_t          rowBytes = std::size_t{ 3 } * m_Width;
  std::string                rows;
  rows.reserve((rowBytes + 1) * m_Height);
  for (std::size_t y = 0; y < m_Height; ++y)
  {
    rows += '\0'; // no filter
    rows.append(reinterpret_cast<const char *>(m_Pixels.data() + y * rowBytes), rowBytes);
  }
  return std::string(signature) + MakeChunk("IHDR", ToBytes(m_Width) + ToBytes(m_Height) + std::string(format)) +
         MakeChunk("IDAT", Compress(rows)) + MakeChunk("IEND", "");
}

} // end namespace medialvoxel
