// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BufferedOutput.h"

#include <array>
#include <charconv>

namespace medialvoxel
{
namespace
{

constexpr size_t BufferBytes = size_t{ 1 } << 20;

/** The number as std::to_chars writes it. */
template <typename TNumber, typename TUse>
void
WithText(TNumber value, TUse use)
{
  std::array<char, 32> text;
  const auto           result = std::to_chars(text.data(), text.data() + text.size(), value);
  use(std::string_view(text.data(), static_cast<size_t>(result.ptr - text.data())));
}

} // namespace

std::string
FormatFloat(float value)
{
  std::string result;
  WithText(value, [&result](std::string_view text) { result = text; });
  return result;
}

std::string
FormatFloat(double value)
{
  std::string result;
  WithText(value, [&result](std::string_view text) { result = text; });
  return result;
}

BufferedOutput &
BufferedOutput::Text(std::string_view text)
{
  m_Buffer += text;
  this->FlushWhenFull();
  return *this;
}

BufferedOutput &
BufferedOutput::Integer(std::uint64_t value)
{
  WithText(value, [this](std::string_view text) { this->Text(text); });
  return *this;
}

BufferedOutput &
BufferedOutput::Float(float value)
{
  WithText(value, [this](std::string_view text) { this->Text(text); });
  return *this;
}

BufferedOutput &
BufferedOutput::Float(double value)
{
  WithText(value, [this](std::string_view text) { this->Text(text); });
  return *this;
}

void
BufferedOutput::FlushWhenFull()
{
  if (m_Buffer.size() >= BufferBytes)
  {
    this->Flush();
  }
}

void
BufferedOutput::Flush()
{
  m_File.WriteAt(m_Offset, m_Buffer.data(), m_Buffer.size());
  m_Offset += m_Buffer.size();
  m_Buffer.clear();
}

void
BufferedOutput::Finish()
{
  this->Flush();
  m_File.AcceptSize();
  m_File.Finish();
}

} // end namespace medialvoxel
