// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "PackedNumbers.h"

#include "Errors.h"

#include "itk_zlib.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

/** Deflated bytes never become more; so a few of them do not take much memory before they are found to be damaged. */
constexpr std::uint64_t MostRatio = 1040;

} // namespace

void
NumberWriter::Add(std::uint64_t number)
{
  for (; number >= 128; number >>= 7)
  {
    m_Bytes.push_back(static_cast<char>(number | 128));
  }
  m_Bytes.push_back(static_cast<char>(number));
}

void
NumberWriter::AddSigned(std::int64_t number)
{
  this->Add(static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63));
}

void
NumberWriter::Exchange(const LengthHistogram & histogram)
{
  this->Add(histogram.GetNumbers().size());
  for (const std::uint64_t number : histogram.GetNumbers())
  {
    this->Add(number);
  }
}

std::string
NumberWriter::Pack() const
{
  uLongf      length = compressBound(m_Bytes.size());
  std::string packed(8 + length, '\0');
  for (unsigned int i = 0; i < 8; ++i)
  {
    packed[i] = static_cast<char>(std::uint64_t{ m_Bytes.size() } >> (8 * i));
  }
  compress2(reinterpret_cast<Bytef *>(&packed[8]),
            &length,
            reinterpret_cast<const Bytef *>(m_Bytes.data()),
            m_Bytes.size(),
            Z_BEST_SPEED);
  packed.resize(8 + length);
  return packed;
}

void
RefuseSaved()
{
  throw JobError(ExitStatus::Failure, "a part of the survey is damaged or of another job");
}

NumberReader::NumberReader(const std::string & packed, std::uint64_t maximumSize)
{
  std::uint64_t size = 0;
  for (unsigned int i = 0; i < 8 && packed.size() > 8; ++i)
  {
    size |= std::uint64_t{ static_cast<std::uint8_t>(packed[i]) } << (8 * i);
  }
  if (size == 0 || size > maximumSize || size > MostRatio * packed.size())
  {
    RefuseSaved();
  }
  m_Bytes.resize(size);
  uLongf length = m_Bytes.size();
  if (uncompress(reinterpret_cast<Bytef *>(m_Bytes.data()),
                 &length,
                 reinterpret_cast<const Bytef *>(packed.data() + 8),
                 packed.size() - 8) != Z_OK ||
      length != m_Bytes.size())
  {
    RefuseSaved();
  }
}

std::uint64_t
NumberReader::Get()
{
  std::uint64_t number = 0;
  for (unsigned int shift = 0; m_Position < m_Bytes.size() && shift < 64; shift += 7)
  {
    const auto byte = static_cast<std::uint8_t>(m_Bytes[m_Position++]);
    number |= std::uint64_t{ byte & 127u } << shift;
    if (byte < 128)
    {
      return number;
    }
  }
  RefuseSaved();
}

std::int64_t
NumberReader::GetSigned()
{
  const std::uint64_t number = this->Get();
  return static_cast<std::int64_t>(number >> 1 ^ (0 - (number & 1)));
}

std::size_t
NumberReader::GetLength()
{
  const std::uint64_t length = this->Get();
  if (length > m_Bytes.size() - m_Position)
  {
    RefuseSaved();
  }
  return static_cast<std::size_t>(length);
}

void
NumberReader::Exchange(LengthHistogram & histogram)
{
  const std::uint64_t size = this->GetLength();
  for (std::uint64_t bin = 0; bin < size; ++bin)
  {
    const std::uint64_t number = this->Get();
    if (number > 0)
    {
      histogram.Add(bin, number);
    }
  }
}

void
NumberReader::ExchangeSize(const std::size_t size)
{
  if (this->Get() != size)
  {
    RefuseSaved();
  }
}

void
NumberReader::CheckEnd() const
{
  if (m_Position != m_Bytes.size())
  {
    RefuseSaved();
  }
}

} // end namespace medialvoxel
