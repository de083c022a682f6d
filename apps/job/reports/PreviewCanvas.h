// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelPreviewCanvas_h
#define medialvoxelPreviewCanvas_h

#include "ColorMap.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace medialvoxel
{

struct Rectangle
{
  unsigned int x;
  unsigned int y;
  unsigned int width;
  unsigned int height;
};

constexpr unsigned int TextHeight = 14;  ///< pixels of a capital letter
constexpr unsigned int TextDepth = 4;    ///< pixels below the line, for letters like g
constexpr unsigned int TextAdvance = 12; ///< pixels from one character to the next

/** \class Canvas
 * \brief A picture in memory, black at first; x to the right, y downwards. */
class Canvas
{
public:
  Canvas(unsigned int width, unsigned int height);

  unsigned int
  GetWidth() const
  {
    return m_Width;
  }

  unsigned int
  GetHeight() const
  {
    return m_Height;
  }

  /** The color of a point in the picture. */
  Color
  GetPixel(unsigned int x, unsigned int y) const;

  void
  SetPixel(unsigned int x, unsigned int y, const Color & color)
  {
    if (x < m_Width && y < m_Height)
    {
      std::uint8_t * const pixel = &m_Pixels[std::size_t{ 3 } * (std::size_t{ y } * m_Width + x)];
      pixel[0] = color[0];
      pixel[1] = color[1];
      pixel[2] = color[2];
    }
  }

  void
  FillRectangle(const Rectangle & area, const Color & color);

  /** A line of one pixel around the area. */
  void
  DrawFrame(const Rectangle & area, const Color & color);

  /** A line of text whose capital letters have their upper left corner at a point; see MakeGlyphs(). */
  void
  DrawText(unsigned int x, unsigned int y, const std::string & text, const Color & color);

  /** Another picture, with its corner at a point. */
  void
  DrawCanvas(unsigned int x, unsigned int y, const Canvas & other);

  /** The bytes of a PNG file. Not by way of ITK's writer, which closes its file twice when a disk is full. */
  std::string
  EncodePng() const;

private:
  unsigned int              m_Width;
  unsigned int              m_Height;
  std::vector<std::uint8_t> m_Pixels;
};

/** Pixels from the first character of a line to where the next text may begin. */
unsigned int
GetTextWidth(const std::string & text);

/** Both pictures beside each other, or below when the first one is wider than high. */
Canvas
JoinCanvases(const Canvas & first, const Canvas & second);

} // end namespace medialvoxel

#endif
