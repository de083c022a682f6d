// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "BufferedOutput.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace medialvoxel
{
namespace
{

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
  while (!text.empty())
  {
    if (m_Used == m_Buffer.size())
    {
      this->Flush();
    }
    const size_t length = std::min(text.size(), m_Buffer.size() - m_Used);
    std::memcpy(m_Buffer.data() + m_Used, text.data(), length);
    m_Used += length;
    text.remove_prefix(length);
  }
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
BufferedOutput::Flush()
{
  m_File.WriteAt(m_Offset, m_Buffer.data(), m_Used);
  m_Offset += m_Used;
  m_Used = 0;
}

void
BufferedOutput::Finish()
{
  this->Flush();
  m_File.AcceptSize();
  m_File.Finish();
}

} // end namespace medialvoxel
