// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PageText.h"

#include "PageFiles.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>

namespace medialvoxel
{
namespace
{

auto
FindPageFile(std::string_view name)
{
  return std::find_if(PageFiles.begin(), PageFiles.end(), [name](const PageFile & file) { return file.name == name; });
}

std::uint64_t
GetLength(const PageFile & file)
{
  return std::accumulate(file.pieces.begin(),
                         file.pieces.end(),
                         std::uint64_t{ 0 },
                         [](std::uint64_t length, std::string_view piece) { return length + piece.size(); });
}

} // namespace

std::string
EncodeBase64(std::string_view bytes)
{
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string                text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    const auto byteAt = [&](std::size_t at) -> std::uint32_t {
      return at < bytes.size() ? static_cast<std::uint8_t>(bytes[at]) : 0;
    };
    const std::uint32_t group = byteAt(i) << 16 | byteAt(i + 1) << 8 | byteAt(i + 2);
    text += digits[group >> 18 & 63];
    text += digits[group >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[group >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[group & 63] : '=';
  }
  return text;
}

bool
HasPageFile(std::string_view name)
{
  return FindPageFile(name) != PageFiles.end();
}

void
AddPageFile(std::string & page, std::string_view name)
{
  const auto found = FindPageFile(name);
  if (found == PageFiles.end())
  {
    throw std::out_of_range("the program has no file " + std::string(name));
  }
  for (const std::string_view piece : found->pieces)
  {
    page += piece;
  }
}

std::string
GetPageFile(std::string_view name)
{
  std::string text;
  AddPageFile(text, name);
  return text;
}

std::uint64_t
GetPageFileSize()
{
  return std::accumulate(PageFiles.begin(),
                         PageFiles.end(),
                         std::uint64_t{ 0 },
                         [](std::uint64_t bytes, const PageFile & file) { return bytes + GetLength(file); });
}

} // end namespace medialvoxel
