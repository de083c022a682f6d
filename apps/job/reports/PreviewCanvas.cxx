// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PreviewCanvas.h"

#include "Errors.h"
#include "PreviewFont.h"

#include "itk_zlib.h"

#include <algorithm>
#include <string_view>

namespace medialvoxel
{
namespace
{

constexpr unsigned int GlyphScale = TextHeight / GlyphAscent;

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

Color
Canvas::GetPixel(unsigned int x, unsigned int y) const
{
  const std::uint8_t * const pixel = &m_Pixels[3 * (size_t{ y } * m_Width + x)];
  return { pixel[0], pixel[1], pixel[2] };
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
  for (const Glyph & glyph : MakeGlyphs(text))
  {
    for (unsigned int row = 0; row < GlyphHeight; ++row)
    {
      for (unsigned int column = 0; column < GlyphWidth; ++column)
      {
        if (glyph[row][column])
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
      this->SetPixel(x + column, y + row, other.GetPixel(column, row));
    }
  }
}

unsigned int
GetTextWidth(const std::string & text)
{
  return static_cast<unsigned int>(MakeGlyphs(text).size()) * TextAdvance;
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
  const std::size_t          rowSize = std::size_t{ 3 } * m_Width;
  std::string                rows;
  rows.reserve((rowSize + 1) * m_Height);
  for (std::size_t y = 0; y < m_Height; ++y)
  {
    rows += '\0'; // no filter
    rows.append(reinterpret_cast<const char *>(m_Pixels.data() + y * rowSize), rowSize);
  }
  return std::string(signature) + MakeChunk("IHDR", ToBytes(m_Width) + ToBytes(m_Height) + std::string(format)) +
         MakeChunk("IDAT", Compress(rows)) + MakeChunk("IEND", "");
}

} // end namespace medialvoxel
