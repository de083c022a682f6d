// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PreviewCanvas.h"
#include "PreviewFont.h"

#include <gtest/gtest.h>

#include <set>

using namespace medialvoxel;

namespace
{

constexpr Color White{ 255, 255, 255 };
constexpr Color Black{ 0, 0, 0 };

/** All characters of ASCII that leave ink. */
std::string
ListInked()
{
  std::string text;
  for (char character = '!'; character <= '~'; ++character)
  {
    text += character;
  }
  return text;
}

Canvas
DrawLine(const std::string & text)
{
  Canvas canvas(GetTextWidth(text), TextHeight + TextDepth);
  canvas.DrawText(0, 0, text, White);
  return canvas;
}

} // namespace

TEST(PreviewFont, EachCharacterHasAGlyphOfItsOwn)
{
  const std::string text = ListInked();
  EXPECT_EQ(text.size(), 94u);
  std::vector<Glyph> glyphs = MakeGlyphs(text);
  glyphs.push_back(MakeGlyphs("\t").front()); // that of all others
  const std::set<Glyph> different(glyphs.begin(), glyphs.end());
  EXPECT_EQ(different.size(), 95u);
  EXPECT_EQ(different.count(MakeGlyphs(" ").front()), 0u) << "one is blank";
  EXPECT_EQ(MakeGlyphs(" ").front(), Glyph{});
}

TEST(PreviewFont, OtherCharactersAreSeen)
{
  const Glyph replacement = MakeGlyphs("\t").front();
  for (const char * const one : { "\xc2\xb5", "\xe2\x80\xa6", "\xf0\x9f\x98\x80", "\x7f", "\x80", "\xff", "\xc2" })
  {
    EXPECT_EQ(MakeGlyphs(one), std::vector<Glyph>{ replacement }) << one;
  }
  const std::vector<Glyph> glyphs = MakeGlyphs("5 \xc2\xb5m");
  ASSERT_EQ(glyphs.size(), 4u);
  EXPECT_EQ(glyphs[2], replacement);
  EXPECT_EQ(glyphs[3], MakeGlyphs("m").front());
  EXPECT_EQ(MakeGlyphs("\xc2m"), (std::vector<Glyph>{ replacement, glyphs[3] })) << "of a character that is cut";
}

TEST(PreviewCanvas, TextIsDrawnWhole)
{
  for (const std::string & text : { std::string("5e-05"), std::string("1.25e+06 units"), ListInked() })
  {
    const Canvas line = DrawLine(text);
    ASSERT_EQ(line.GetWidth(), text.size() * TextAdvance);
    for (unsigned int i = 0; i < text.size(); ++i)
    {
      const Canvas character = DrawLine(text.substr(i, 1));
      unsigned int ink = 0;
      for (unsigned int y = 0; y < line.GetHeight(); ++y)
      {
        for (unsigned int x = 0; x < TextAdvance; ++x)
        {
          EXPECT_EQ(line.GetPixel(i * TextAdvance + x, y), character.GetPixel(x, y)) << text[i];
          ink += character.GetPixel(x, y) == Black ? 0 : 1;
        }
      }
      EXPECT_EQ(ink > 0, text[i] != ' ') << text[i];
    }
  }
}
