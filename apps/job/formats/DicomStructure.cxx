// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "DicomStructure.h"

#include "HeaderParsing.h"

#include "itkMedialVoxelFileRegion.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t    BytesOfPreamble = 128;
constexpr std::string_view Signature = "DICM";

/** More are not believed: GDCM keeps each in memory. */
constexpr std::uint64_t MostElements = std::uint64_t{ 1 } << 17;
constexpr unsigned int  DeepestSequence = 16;

constexpr std::uint32_t UndefinedLength = 0xffffffff;

// Tags, as group * 65536 + element.
constexpr std::uint32_t TransferSyntax = 0x00020010;
constexpr std::uint32_t Samples = 0x00280002;
constexpr std::uint32_t Interpretation = 0x00280004;
constexpr std::uint32_t Rows = 0x00280010;
constexpr std::uint32_t Columns = 0x00280011;
constexpr std::uint32_t BitsAllocated = 0x00280100;
constexpr std::uint32_t BitsStored = 0x00280101;
constexpr std::uint32_t HighBit = 0x00280102;
constexpr std::uint32_t PixelRepresentation = 0x00280103;
constexpr std::uint32_t PixelData = 0x7fe00010;
constexpr std::uint32_t Item = 0xfffee000;
constexpr std::uint32_t EndOfItem = 0xfffee00d;
constexpr std::uint32_t EndOfSequence = 0xfffee0dd;

/** Value representations by the bytes of their length. */
constexpr std::string_view ShortRepresentations = "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US";
constexpr std::string_view LongRepresentations = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";

/** What numbers of voxels mean: names that GDCM knows; it ends the program for others. */
constexpr std::array<std::string_view, 12> Interpretations{ "MONOCHROME1", "MONOCHROME2", "PALETTE COLOR",
                                                            "RGB",         "HSV",         "ARGB",
                                                            "CMYK",        "YBR_FULL",    "YBR_FULL_422",
                                                            "YBR_ICT",     "YBR_RCT",     "YBR_PARTIAL_420" };

/** Elements that GDCM takes numbers of a slice from; it ends the program when they are written as something else. */
constexpr std::array<std::pair<std::uint32_t, std::string_view>, 17> Representations{ {
  { 0x00180050, "DS" }, // slice thickness
  { 0x00180088, "DS" }, // spacing between slices
  { 0x00181114, "DS" }, // magnification
  { 0x00181164, "DS" }, // spacing at the detector
  { 0x00200032, "DS" }, // position
  { 0x00200037, "DS" }, // orientation
  { Samples, "US" },
  { 0x00280006, "US" }, // planes
  { 0x00280008, "IS" }, // frames
  { Rows, "US" },
  { Columns, "US" },
  { 0x00280030, "DS" }, // spacing
  { BitsAllocated, "US" },
  { BitsStored, "US" },
  { HighBit, "US" },
  { 0x00281052, "DS" }, // intercept
  { 0x00281053, "DS" }, // slope
} };

/** How elements are written. */
struct Encoding
{
  bool isExplicit{ true }; ///< with the value representation
  bool isBigEndian{ false };
  bool isRunLength{ false };
};

struct Element
{
  std::uint32_t tag{ 0 };
  std::string   representation; ///< empty: not written
  std::uint32_t length{ 0 };
};

/** \class Walker
 * \brief Steps from element to element. */
class Walker
{
public:
  explicit Walker(const std::filesystem::path & fileName)
    : m_FileName(fileName)
    , m_File(OpenRegularFile(fileName))
    , m_Size(GetDataFileSize(fileName, fileName))
  {}

  DicomStructure
  Walk()
  {
    this->MoveTo(BytesOfPreamble);
    if (m_Size < BytesOfPreamble + Signature.size() || this->ReadText(Signature.size()) != Signature)
    {
      RefuseHeader(m_FileName, "it is not DICOM: bytes 128 to 131 are not DICM");
    }
    m_Encoding = this->ReadMetaInformation();
    this->WalkElements(m_Size, 0);
    return m_Structure;
  }

private:
  [[noreturn]] void
  Refuse(const std::string & what, HeaderError::Kind kind = HeaderError::Kind::Corrupt) const
  {
    RefuseHeader(m_FileName, what + " (at byte " + std::to_string(m_Position) + ")", kind);
  }

  std::string
  ReadText(std::uint64_t count)
  {
    if (count > m_Size - std::min(m_Size, m_Position))
    {
      this->Refuse("the file ends within an element");
    }
    std::string text(count, '\0');
    if (!m_File.read(text.data(), static_cast<std::streamsize>(count)))
    {
      this->Refuse("the file ends within an element");
    }
    m_Position += count;
    return text;
  }

  /** A seek drops what was read ahead, so that short ways are read through. */
  void
  MoveTo(std::uint64_t position)
  {
    constexpr std::uint64_t shortWay = 4096;
    if (position < m_Position || position - m_Position > shortWay)
    {
      m_File.seekg(static_cast<std::streamoff>(position));
    }
    else
    {
      m_File.ignore(static_cast<std::streamsize>(position - m_Position));
    }
    m_Position = position;
  }

  template <typename TNumber>
  TNumber
  ReadNumber()
  {
    const std::string bytes = this->ReadText(sizeof(TNumber));
    TNumber           number{};
    std::memcpy(&number, bytes.data(), sizeof(number));
    if (m_Encoding.isBigEndian != itk::MachineIsBigEndian())
    {
      itk::SwapComponentBytes(&number, sizeof(number), sizeof(number));
    }
    return number;
  }

  std::uint32_t
  ReadTag()
  {
    const auto group = this->ReadNumber<std::uint16_t>();
    return std::uint32_t{ group } << 16 | this->ReadNumber<std::uint16_t>();
  }

  Element
  ReadElement()
  {
    if (++m_Elements > MostElements)
    {
      this->Refuse("it has more than " + std::to_string(MostElements) + " elements");
    }
    if (m_Elements % 1024 == 0)
    {
      itk::MedialVoxelPoll();
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

  static bool
  Contains(std::string_view representations, const std::string & text)
  {
    return text.find(' ') == std::string::npos && representations.find(text) != std::string_view::npos;
  }

  /** The bytes of an element are within what is around it. */
  void
  RequireRoom(std::uint64_t length, std::uint64_t end) const
  {
    if (m_Position > end || length > end - m_Position)
    {
      this->Refuse("an element has " + std::to_string(length) + " bytes where " +
                   std::to_string(end - std::min(end, m_Position)) + " are left");
    }
  }

  /** The elements at the begin, which are always in the same encoding, tell that of the others. */
  Encoding
  ReadMetaInformation()
  {
    constexpr std::uint32_t metaGroup = 2;
    std::string             syntax;
    for (std::uint64_t begin = m_Position; begin < m_Size; begin = m_Position)
    {
      const std::uint32_t group = this->ReadTag() >> 16;
      this->MoveTo(begin);
      if (group != metaGroup)
      {
        break;
      }
      const Element element = this->ReadElement();
      this->RequireRoom(element.length, m_Size);
      if (element.tag == TransferSyntax && element.length <= 64)
      {
        syntax = this->ReadText(element.length);
        syntax.erase(syntax.find_last_not_of(std::string_view(" \0", 2)) + 1);
      }
      else
      {
        this->MoveTo(m_Position + element.length);
      }
    }
    constexpr std::string_view standard = "1.2.840.10008.1.2";
    if (syntax == std::string(standard) + ".1.99" || syntax.compare(0, standard.size(), standard) != 0)
    {
      this->Refuse("its transfer syntax '" + itk::MedialVoxelText::MakePrintable(syntax) + "' is not read",
                   HeaderError::Kind::Unsupported);
    }
    const std::string name(standard);
    return { syntax != name, syntax == name + ".2", syntax == name + ".5" };
  }

  /** Elements up to \a end, or up to the end of an item whose length is not told. */
  void
  WalkElements(std::uint64_t end, unsigned int depth)
  {
    // What follows the image is not looked at, by GDCM neither: padding, or what a transfer left there.
    while (m_Position < end && (depth > 0 || m_Structure.endOfVoxels == 0))
    {
      const Element element = this->ReadElement();
      if (element.tag == EndOfItem)
      {
        return;
      }
      this->WalkValue(element, end, depth);
    }
  }

  void
  WalkValue(const Element & element, std::uint64_t end, unsigned int depth)
  {
    const bool isUndefined = element.length == UndefinedLength;
    if (!isUndefined)
    {
      this->RequireRoom(element.length, end);
    }
    this->CheckRepresentation(element);
    if (depth == 0 && element.tag == PixelData)
    {
      m_Structure.isPacked = isUndefined;
      const std::uint64_t begin = m_Position;
      if (isUndefined)
      {
        this->WalkFragments(end);
      }
      else
      {
        this->MoveTo(m_Position + element.length);
      }
      m_Structure.voxelBytes = m_Position - begin;
      m_Structure.endOfVoxels = m_Position;
    }
    else if (element.representation == "SQ" || isUndefined)
    {
      this->WalkSequence(element, isUndefined ? end : m_Position + element.length, depth);
    }
    else if (element.tag == Interpretation)
    {
      this->CheckInterpretation(element);
    }
    else if (depth == 0 && this->TakeNumber(element))
    {
      return;
    }
    else
    {
      this->MoveTo(m_Position + element.length);
    }
  }

  void
  CheckRepresentation(const Element & element) const
  {
    const auto isOfElement = [&element](const auto & row) { return row.first == element.tag; };
    const auto expected = std::find_if(Representations.begin(), Representations.end(), isOfElement);
    if (m_Encoding.isExplicit && expected != Representations.end() && expected->second != element.representation)
    {
      this->Refuse("an element has the value representation " + element.representation + "; it must have " +
                   std::string(expected->second));
    }
  }

  void
  CheckInterpretation(const Element & element)
  {
    constexpr std::uint32_t longestName = 16;
    std::string             name = this->ReadText(std::min(element.length, longestName));
    name.erase(name.find_last_not_of(std::string_view(" \0", 2)) + 1);
    const bool isKnown = std::find(Interpretations.begin(), Interpretations.end(), name) != Interpretations.end();
    if (element.length > longestName || !isKnown)
    {
      this->Refuse("its photometric interpretation '" + itk::MedialVoxelText::MakePrintable(name) + "' is not known",
                   HeaderError::Kind::Unsupported);
    }
  }

  /** True for one of the numbers that are wanted. */
  bool
  TakeNumber(const Element & element)
  {
    const std::array<std::pair<std::uint32_t, std::uint64_t *>, 7> wanted{ { { Samples, &m_Structure.samples },
                                                                             { Rows, &m_Structure.rows },
                                                                             { Columns, &m_Structure.columns },
                                                                             { BitsAllocated, &m_Structure.bits },
                                                                             { BitsStored, &m_Structure.storedBits },
                                                                             { HighBit, &m_Structure.highBit },
                                                                             { PixelRepresentation,
                                                                               &m_Structure.isSigned } } };
    const auto                                                     found = std::find_if(
      wanted.begin(), wanted.end(), [&element](const auto & number) { return number.first == element.tag; });
    if (found == wanted.end())
    {
      return false;
    }
    const bool isNumber = element.representation.empty() || element.representation == "US";
    if (element.length != sizeof(std::uint16_t) || !isNumber || !m_Taken.insert(element.tag).second)
    {
      this->Refuse("what describes its voxels is not one whole number, or there twice");
    }
    *found->second = this->ReadNumber<std::uint16_t>();
    return true;
  }

  void
  WalkSequence(const Element & sequence, std::uint64_t end, unsigned int depth)
  {
    if (depth == DeepestSequence)
    {
      this->Refuse("its sequences are more than " + std::to_string(DeepestSequence) + " deep");
    }
    const Encoding outer = m_Encoding;
    if (sequence.representation == "UN")
    {
      m_Encoding = { false, false }; // as the standard has it for sequences of unknown representation
    }
    while (m_Position < end)
    {
      const Element item = this->ReadElement();
      if (item.tag == EndOfSequence)
      {
        break;
      }
      if (item.tag != Item)
      {
        this->Refuse("a sequence has something else than items");
      }
      if (item.length != UndefinedLength)
      {
        this->RequireRoom(item.length, end);
      }
      this->WalkElements(item.length == UndefinedLength ? end : m_Position + item.length, depth + 1);
    }
    m_Encoding = outer;
  }

  void
  WalkFragments(std::uint64_t end)
  {
    bool isTable = true; // the first one has places of others
    for (;;)
    {
      const Element fragment = this->ReadElement();
      if (fragment.tag == EndOfSequence)
      {
        return;
      }
      if (fragment.tag != Item)
      {
        this->Refuse("its packed voxels are not in fragments");
      }
      this->RequireRoom(fragment.length, end);
      const std::uint64_t next = m_Position + fragment.length;
      if (m_Encoding.isRunLength && !isTable)
      {
        this->CheckRunLengthSegments(fragment.length);
      }
      this->MoveTo(next);
      isTable = false;
    }
  }

  /** The begin of a slice that is packed by run lengths: how many segments it has, and where 15 of them begin. GDCM
   * believes both. */
  void
  CheckRunLengthSegments(std::uint64_t length)
  {
    constexpr std::size_t   most = 15;
    constexpr std::uint64_t bytesOfHeader = (most + 1) * sizeof(std::uint32_t);
    if (length < bytesOfHeader)
    {
      this->Refuse("a fragment of run lengths has " + std::to_string(length) + " bytes; it needs " +
                   std::to_string(bytesOfHeader));
    }
    const auto segments = this->ReadNumber<std::uint32_t>();
    if (segments != m_Structure.samples * m_Structure.bits / 8 || segments > most)
    {
      this->Refuse("its run lengths have " + std::to_string(segments) + " segments; its voxels have " +
                   std::to_string(m_Structure.samples * m_Structure.bits / 8) + " bytes");
    }
    std::uint64_t least = bytesOfHeader;
    for (std::uint32_t segment = 0; segment < segments; ++segment)
    {
      const auto begin = this->ReadNumber<std::uint32_t>();
      if (begin < least || begin >= length || (segment == 0 && begin != bytesOfHeader))
      {
        this->Refuse("a segment of its run lengths begins at byte " + std::to_string(begin) + " of " +
                     std::to_string(length));
      }
      least = begin + std::uint64_t{ 1 };
    }
  }

  std::filesystem::path   m_FileName;
  std::ifstream           m_File;
  std::uint64_t           m_Size;
  std::uint64_t           m_Position{ 0 };
  std::uint64_t           m_Elements{ 0 };
  Encoding                m_Encoding;
  std::set<std::uint32_t> m_Taken; ///< tags of numbers
  DicomStructure          m_Structure;
};

} // namespace

bool
IsDicomFile(const std::filesystem::path & fileName)
{
  std::ifstream                      file(fileName, std::ios::binary);
  std::array<char, Signature.size()> bytes{};
  file.seekg(BytesOfPreamble);
  return file.read(bytes.data(), bytes.size()) && std::equal(bytes.begin(), bytes.end(), Signature.begin());
}

DicomStructure
CheckDicomStructure(const std::filesystem::path & fileName)
{
  return Walker(fileName).Walk();
}

} // end namespace medialvoxel
