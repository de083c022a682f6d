// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "DicomElements.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <string_view>

namespace medialvoxel
{
namespace
{

/** Deflate packs at most this many bytes into one. */
constexpr std::uint64_t MaximumDeflateRatio = 1032;

/** Value representations by the bytes of their length. */
constexpr std::string_view ShortRepresentations = "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US";
constexpr std::string_view LongRepresentations = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";

bool
Contains(std::string_view representations, const std::string & text)
{
  return text.find(' ') == std::string::npos && representations.find(text) != std::string_view::npos;
}

} // namespace

DicomElements::DicomElements(const std::filesystem::path & fileName)
  : m_FileName(fileName)
  , m_File(OpenRegularFile(fileName))
{
  m_Size = GetDataFileSize(fileName, fileName);
}

void
DicomElements::Refuse(const std::string & what, HeaderError::Kind kind) const
{
  RefuseHeader(m_FileName, what + " (at byte " + std::to_string(m_Position) + ")", kind);
}

std::string
DicomElements::ReadText(std::uint64_t count)
{
  if (count > m_Size - std::min(m_Size, m_Position))
  {
    this->Refuse("the file ends within an element");
  }
  std::string text(count, '\0');
  if (m_Inflated)
  {
    m_Inflated->Read(text.data(), count);
  }
  else if (!m_File.read(text.data(), static_cast<std::streamsize>(count)))
  {
    this->Refuse("the file ends within an element");
  }
  m_Position += count;
  return text;
}

void
DicomElements::MoveTo(std::uint64_t position)
{
  // A seek drops the read-ahead, so short distances are read through.
  constexpr std::uint64_t shortWay = 4096;
  if (m_Inflated)
  {
    m_Inflated->Skip(position - m_Position);
  }
  else if (position < m_Position || position - m_Position > shortWay)
  {
    m_File.seekg(static_cast<std::streamoff>(position));
  }
  else
  {
    m_File.ignore(static_cast<std::streamsize>(position - m_Position));
  }
  m_Position = position;
}

std::uint32_t
DicomElements::ReadTag()
{
  const auto group = this->ReadNumber<std::uint16_t>();
  return std::uint32_t{ group } << 16 | this->ReadNumber<std::uint16_t>();
}

DicomElements::Element
DicomElements::ReadElement()
{
  if (++m_Elements % 1024 == 0)
  {
    itk::MedialVoxelCheckAbort();
  }
  Element element;
  element.tag = this->ReadTag();
  const bool isMark = element.tag == Item || element.tag == EndOfItem || element.tag == EndOfSequence;
  if (!m_Encoding.isExplicit || isMark)
  {
    element.length = this->ReadNumber<std::uint32_t>();
    if (isMark && element.tag != Item && element.length != 0)
    {
      this->Refuse("the end of a sequence has " + std::to_string(element.length) + " bytes; it must have none");
    }
    return element;
  }
  element.representation = this->ReadText(2);
  if (Contains(ShortRepresentations, element.representation))
  {
    element.length = this->ReadNumber<std::uint16_t>();
  }
  else if (Contains(LongRepresentations, element.representation))
  {
    this->ReadText(2);
    element.length = this->ReadNumber<std::uint32_t>();
  }
  else
  {
    this->Refuse("an element has the unknown value representation '" +
                 itk::MedialVoxelText::MakePrintable(element.representation) + "'");
  }
  return element;
}

void
DicomElements::RequireRoom(std::uint64_t length, std::uint64_t end) const
{
  if (m_Position > end || length > end - m_Position)
  {
    this->Refuse("an element has " + std::to_string(length) + " bytes where " +
                 std::to_string(end - std::min(end, m_Position)) + " are left");
  }
}

void
DicomElements::BeginDeflated()
{
  m_Inflated = std::make_unique<InflateReader>(m_FileName, m_Position, true);
  m_Size = m_Position + (m_Size - m_Position) * MaximumDeflateRatio;
}

} // end namespace medialvoxel
