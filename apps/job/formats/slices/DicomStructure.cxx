// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "DicomStructure.h"

#include "DicomElements.h"
#include "DicomTags.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t    PreambleSize = 128;
constexpr std::string_view Signature = "DICM";

constexpr unsigned int DeepestSequence = 16;

// Tags, as group * 65536 + element.
constexpr std::uint32_t TransferSyntax = 0x00020010;
constexpr std::uint32_t Samples = 0x00280002;
constexpr std::uint32_t Rows = 0x00280010;
constexpr std::uint32_t Columns = 0x00280011;
constexpr std::uint32_t BitsAllocated = 0x00280100;
constexpr std::uint32_t BitsStored = 0x00280101;
constexpr std::uint32_t HighBit = 0x00280102;
constexpr std::uint32_t PixelRepresentation = 0x00280103;
constexpr std::uint32_t PixelData = 0x7fe00010;
constexpr std::uint32_t SharedGroups = 0x52009229;
constexpr std::uint32_t GroupsOfFrames = 0x52009230;

/** Sequences that lead to texts of frames: implicit encodings do not tell that they are some. */
constexpr std::array<std::uint32_t, 7> SequencesOfFrames{
  SharedGroups, GroupsOfFrames,
  0x00209111, // content
  0x00209113, // position
  0x00209116, // orientation
  0x00289110, // spacing
  0x00289145, // slope and intercept
};

void
DropPadding(std::string & text)
{
  text.erase(text.find_last_not_of(std::string_view(" \0", 2)) + 1);
}

/** \class Walker : private DicomElements
 * \brief Steps from element to element. */
class Walker : private DicomElements
{
public:
  explicit Walker(const std::filesystem::path & fileName)
    : DicomElements(fileName)
  {}

  DicomStructure
  Walk()
  {
    this->MoveTo(PreambleSize);
    if (m_Size < PreambleSize + Signature.size() || this->ReadText(Signature.size()) != Signature)
    {
      RefuseHeader(m_FileName, "it is not DICOM: bytes 128 to 131 are not DICM");
    }
    m_Encoding = this->ReadMetaInformation();
    m_Structure.isBigEndian = m_Encoding.isBigEndian;
    m_Structure.beginOfData = m_Position;
    if (m_Structure.isDeflated)
    {
      this->BeginDeflated();
    }
    this->WalkElements(m_Size, 0);
    this->CountFrames();
    return m_Structure;
  }

private:
  void
  CountFrames()
  {
    const std::string text = m_Structure.texts[DicomTag::NumberOfFrames];
    const auto        isDigit = [](char character) { return character >= '0' && character <= '9'; };
    const bool        isNumber = text.size() <= 10 && std::all_of(text.begin(), text.end(), isDigit);
    m_Structure.frames = isNumber && !text.empty() ? std::max<std::uint64_t>(1, std::stoull(text)) : 1;
    if (!isNumber || m_Structure.frames > MostDicomFrames)
    {
      this->Refuse("its NumberOfFrames is '" + itk::MedialVoxelText::MakePrintable(text) + "'; it must be 1 to " +
                   std::to_string(MostDicomFrames));
    }
  }

  /** The elements at the begin, which are always in the same encoding, tell that of the others. */
  Encoding
  ReadMetaInformation()
  {
    constexpr std::uint32_t metaGroup = 2;
    std::string &           syntax = m_Structure.syntax;
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
        DropPadding(syntax);
      }
      else
      {
        this->MoveTo(m_Position + element.length);
      }
    }
    constexpr std::string_view standard = "1.2.840.10008.1.2";
    if (syntax.compare(0, standard.size(), standard) != 0)
    {
      this->Refuse("its transfer syntax '" + itk::MedialVoxelText::MakePrintable(syntax) + "' is not read",
                   HeaderError::Kind::Unsupported);
    }
    const std::string name(standard);
    m_Structure.isDeflated = syntax == name + ".1.99";
    return { syntax != name, syntax == name + ".2", syntax == name + ".5" };
  }

  /** Elements up to \a end, or up to the end of an item whose length is not told. */
  void
  WalkElements(std::uint64_t end, unsigned int depth)
  {
    // Bytes behind the image are ignored: padding, or leftovers of a transfer.
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
      m_Structure.dataSize = m_Position - begin;
      m_Structure.beginOfVoxels = begin;
      m_Structure.endOfVoxels = m_Position;
    }
    else if (this->IsSequence(element))
    {
      this->WalkSequence(element, isUndefined ? end : m_Position + element.length, depth);
    }
    else if (this->TakeText(element) || (depth == 0 && this->TakeNumber(element)))
    {
      return;
    }
    else
    {
      this->MoveTo(m_Position + element.length);
    }
  }

  static bool
  IsSequence(const Element & element)
  {
    const bool isUnknown = element.representation.empty() || element.representation == "UN";
    const auto known = std::find(SequencesOfFrames.begin(), SequencesOfFrames.end(), element.tag);
    return element.representation == "SQ" || element.length == UndefinedLength ||
           (isUnknown && known != SequencesOfFrames.end());
  }

  /** Where texts of elements are kept: of the file, or of frames; null: nowhere. */
  DicomTexts *
  FindTexts()
  {
    if (m_Path.empty())
    {
      return &m_Structure.texts;
    }
    constexpr std::size_t depthOfGroups = 2;
    if (m_Path.size() != depthOfGroups || m_Path.back().item > 0)
    {
      return nullptr;
    }
    const auto [sequence, item] = m_Path.front();
    if (sequence == SharedGroups && item == 0)
    {
      return &m_Structure.textsOfFrames;
    }
    if (sequence != GroupsOfFrames)
    {
      return nullptr;
    }
    m_Structure.textsOfOneFrame.resize(std::max(m_Structure.textsOfOneFrame.size(), item + 1));
    return &m_Structure.textsOfOneFrame[item];
  }

  /** True for one of the texts that are wanted. */
  bool
  TakeText(const Element & element)
  {
    constexpr std::uint32_t longest = std::uint32_t{ 1 } << 20;
    DicomTexts * const      texts = this->FindTexts();
    if (!texts || std::find(DicomTag::Texts.begin(), DicomTag::Texts.end(), element.tag) == DicomTag::Texts.end() ||
        element.length > longest)
    {
      return false;
    }
    std::string text = this->ReadText(element.length);
    if (std::find(DicomTag::Numbers.begin(), DicomTag::Numbers.end(), element.tag) != DicomTag::Numbers.end())
    {
      text = text.size() == 2   ? std::to_string(this->ToNumber<std::uint16_t>(text))
             : text.size() == 4 ? std::to_string(this->ToNumber<std::uint32_t>(text))
                                : "";
    }
    DropPadding(text);
    texts->emplace(element.tag, text.substr(std::min(text.size(), text.find_first_not_of(' '))));
    return true;
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
    m_Path.push_back({ sequence.tag, 0 });
    for (; m_Position < end; ++m_Path.back().item)
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
      if (m_Path.back().sequence == GroupsOfFrames && m_Path.back().item >= MostDicomFrames)
      {
        this->Refuse("it tells of more than " + std::to_string(MostDicomFrames) + " frames");
      }
      if (item.length != UndefinedLength)
      {
        this->RequireRoom(item.length, end);
      }
      this->WalkElements(item.length == UndefinedLength ? end : m_Position + item.length, depth + 1);
    }
    m_Path.pop_back();
    m_Encoding = outer;
  }

  void
  WalkFragments(std::uint64_t end)
  {
    bool isTable = true; // the first one has places of others
    for (;;)
    {
      const std::uint64_t mark = m_Position;
      const Element       fragment = this->ReadElement();
      if (fragment.tag == EndOfSequence)
      {
        return;
      }
      if (fragment.tag != Item)
      {
        this->Refuse("its packed voxels are not in fragments");
      }
      this->RequireRoom(fragment.length, end);
      const std::uint64_t begin = m_Position;
      const std::uint64_t next = begin + fragment.length;
      if (isTable)
      {
        this->ReadMarks(fragment.length);
      }
      else
      {
        m_Structure.fragments.push_back({ mark, begin, fragment.length });
      }
      if (m_Encoding.isRunLength && !isTable)
      {
        this->CheckRunLengthSegments(fragment.length);
      }
      this->MoveTo(next);
      isTable = false;
    }
  }

  void
  ReadMarks(std::uint64_t length)
  {
    if (length > MostDicomFrames * sizeof(std::uint32_t))
    {
      this->Refuse("the table of its frames has " + std::to_string(length) + " bytes");
    }
    for (std::uint64_t i = 0; i < length / sizeof(std::uint32_t); ++i)
    {
      m_Structure.marks.push_back(this->ReadNumber<std::uint32_t>());
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

  /** A sequence that is walked through. */
  struct Step
  {
    std::uint32_t sequence; ///< tag
    std::size_t   item;
  };

  std::set<std::uint32_t> m_Taken; ///< tags of numbers
  std::vector<Step>       m_Path;  ///< from the file to the current element
  DicomStructure          m_Structure;
};

} // namespace

bool
IsDicomFile(const std::filesystem::path & fileName)
{
  std::ifstream                      file(fileName, std::ios::binary);
  std::array<char, Signature.size()> bytes{};
  file.seekg(PreambleSize);
  return file.read(bytes.data(), bytes.size()) && std::equal(bytes.begin(), bytes.end(), Signature.begin());
}

DicomStructure
CheckDicomStructure(const std::filesystem::path & fileName)
{
  return Walker(fileName).Walk();
}

} // end namespace medialvoxel
