// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "DicomFrames.h"

#include "DicomTags.h"
#include "HeaderParsing.h"
#include "InflateReader.h"
#include "Text.h"

#include "itkMedialVoxelFileRegion.h"
#include "itkMedialVoxelVector3.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

std::string
Find(const DicomTexts & texts, std::uint32_t tag)
{
  const auto found = texts.find(tag);
  return found == texts.end() ? "" : found->second;
}

/** Numbers of a text, which backslashes separate; nothing where one is none. */
std::vector<double>
ParseNumbers(const std::string & text)
{
  std::vector<double> numbers;
  std::size_t         begin = 0;
  do
  {
    const std::size_t  end = std::min(text.find('\\', begin), text.size());
    std::istringstream part(text.substr(begin, end - begin));
    part.imbue(std::locale::classic());
    double number = 0.0;
    if (!(part >> number) || !(part >> std::ws).eof() || !std::isfinite(number))
    {
      return {};
    }
    numbers.push_back(number);
    begin = end + 1;
  } while (begin <= text.size());
  return numbers;
}

/** Half of the last digit behind the point, the least of all numbers of a text; 0 where none has a point. */
double
GetRounding(const std::string & text)
{
  constexpr std::size_t mostDigits = 300;
  std::size_t           most = 0;
  for (std::size_t point = text.find('.'); point != std::string::npos; point = text.find('.', point + 1))
  {
    most = std::max(most, std::min(text.find_first_not_of("0123456789", point + 1), text.size()) - point - 1);
  }
  return most == 0 || text.find_first_of("eE") != std::string::npos
           ? 0.0
           : 0.5 * GetPowerOfTen(-static_cast<int>(std::min(most, mostDigits)));
}

/** Distances of rows and of columns; nothing for an empty text. \throw std::runtime_error for anything else */
std::vector<double>
ParseSpacing(const std::string & text)
{
  const std::vector<double> numbers = ParseNumbers(text);
  if (!text.empty() && (numbers.size() != 2 || !(numbers[0] > 0.0) || !(numbers[1] > 0.0)))
  {
    throw std::runtime_error("its PixelSpacing is '" + text +
                             "'; it must be two numbers greater than 0, as in 0.5\\0.5");
  }
  return numbers;
}

/** \throw std::runtime_error for another number of numbers */
std::vector<double>
ParseExactly(const char * name, const std::string & text, std::size_t count)
{
  std::vector<double> numbers = ParseNumbers(text);
  if (numbers.size() != count)
  {
    throw std::runtime_error(std::string("its ") + name + " is '" + itk::MedialVoxelText::MakePrintable(text) +
                             "'; it must have " + std::to_string(count) + (count == 1 ? " number" : " numbers"));
  }
  return numbers;
}

double
ParseNumber(const char * name, const std::string & text, double otherwise)
{
  return text.empty() ? otherwise : ParseExactly(name, text, 1).front();
}

/** \class FrameReader
 * \brief The frames of a file. */
class FrameReader
{
public:
  explicit FrameReader(DicomStructure structure)
    : m_Structure(std::move(structure))
  {
    if (m_Structure.textsOfOneFrame.size() > m_Structure.frames)
    {
      throw std::runtime_error("it has " + std::to_string(m_Structure.frames) + " frames and tells of " +
                               std::to_string(m_Structure.textsOfOneFrame.size()));
    }
    m_Structure.textsOfOneFrame.resize(m_Structure.frames);
    this->ReadOffsets();
  }

  /** The text of a frame itself, of all frames, or of the file. */
  std::string
  GetText(std::uint64_t frame, std::uint32_t tag) const
  {
    for (const DicomTexts * const texts :
         { &m_Structure.textsOfOneFrame[frame], &m_Structure.textsOfFrames, &m_Structure.texts })
    {
      if (const std::string text = Find(*texts, tag); !text.empty())
      {
        return text;
      }
    }
    return "";
  }

  SliceHeader
  MakeHeader(std::uint64_t frame) const
  {
    SliceHeader header;
    header.size = { { m_Structure.columns, m_Structure.rows } };
    header.frameNumber = m_Structure.frames > 1 ? frame + 1 : 0;
    const std::vector<double> spacing = ParseSpacing(this->GetText(frame, DicomTag::PixelSpacing));
    header.isSpacingKnown = !spacing.empty();
    header.inMillimeters = header.isSpacingKnown;
    if (header.isSpacingKnown)
    {
      header.spacing = { { spacing[1], spacing[0] } }; // of rows first
    }
    header.place = this->MakePlace(frame);
    header.isDistanceKnown = m_Structure.frames == 1 || this->HasOwnPlace(frame) || !m_Offsets.empty();
    const std::vector<double> number = ParseNumbers(this->GetText(frame, DicomTag::InstanceNumber));
    if (number.size() == 1)
    {
      header.number = static_cast<std::int64_t>(std::clamp(number.front(), -1e15, 1e15));
    }
    header.series = itk::MedialVoxelText::MakePrintable(Find(m_Structure.texts, DicomTag::SeriesInstance));
    header.description = itk::MedialVoxelText::MakePrintable(Find(m_Structure.texts, DicomTag::SeriesDescription));
    header.acquisition = itk::MedialVoxelText::MakePrintable(this->DescribeAcquisition(frame));
    return header;
  }

  DicomFrame
  MakeFrame(std::uint64_t number) const
  {
    DicomFrame frame;
    frame.number = number;
    frame.intercept = ParseNumber("RescaleIntercept", this->GetText(number, DicomTag::RescaleIntercept), 0.0);
    frame.slope = ParseNumber("DoseGridScaling", Find(m_Structure.texts, DicomTag::DoseGridScaling), 1.0);
    frame.slope = ParseNumber("RescaleSlope", this->GetText(number, DicomTag::RescaleSlope), frame.slope);
    frame.slope = frame.slope == 0.0 ? 1.0 : frame.slope; // as GDCM takes it
    if (m_Structure.isPacked)
    {
      std::tie(frame.beginOfFragments, frame.endOfFragments) = this->FindFragments(number);
    }
    return frame;
  }

  /** From and to, of values that the file declares to be no measurement; nothing without them. */
  std::optional<std::array<double, 2>>
  GetPadding(const DicomFrame & frame) const
  {
    // The sign is that of the voxels, whatever the numbers of the padding are written as.
    const auto parse = [&](const std::string & text) {
      const auto number = static_cast<std::uint16_t>(std::stoul(text));
      return frame.slope * (m_Structure.isSigned ? static_cast<std::int16_t>(number) : number) + frame.intercept;
    };
    const std::string padding = Find(m_Structure.texts, DicomTag::PixelPadding);
    const std::string limit = Find(m_Structure.texts, DicomTag::PixelPaddingLimit);
    if (padding.empty())
    {
      return std::nullopt;
    }
    const double from = parse(padding);
    const double to = limit.empty() ? from : parse(limit);
    return std::array<double, 2>{ { std::min(from, to), std::max(from, to) } };
  }

private:
  /** Distances of the frames to the first one, of files whose frames have no places of their own. */
  void
  ReadOffsets()
  {
    const std::string text = Find(m_Structure.texts, DicomTag::GridFrameOffsets);
    if (!text.empty())
    {
      m_Offsets = ParseExactly("GridFrameOffsetVector", text, m_Structure.frames);
      const double first = m_Offsets.front();
      std::transform(
        m_Offsets.begin(), m_Offsets.end(), m_Offsets.begin(), [first](double place) { return place - first; });
      return;
    }
    const double distance = ParseNumber("SpacingBetweenSlices", this->GetText(0, DicomTag::SpacingBetweenSlices), 0.0);
    for (std::uint64_t frame = 0; frame < (distance == 0.0 ? 0 : m_Structure.frames); ++frame)
    {
      m_Offsets.push_back(distance * static_cast<double>(frame));
    }
  }

  bool
  HasOwnPlace(std::uint64_t frame) const
  {
    return !Find(m_Structure.textsOfOneFrame[frame], DicomTag::ImagePosition).empty() &&
           !this->GetText(frame, DicomTag::ImageOrientation).empty();
  }

  std::optional<SlicePlace>
  MakePlace(std::uint64_t frame) const
  {
    const std::string position = this->GetText(frame, DicomTag::ImagePosition);
    const std::string orientation = this->GetText(frame, DicomTag::ImageOrientation);
    const bool        isPlaced = !position.empty() && !orientation.empty();
    if (!isPlaced && m_Structure.frames == 1)
    {
      return std::nullopt;
    }
    SlicePlace place{ { { 0.0, 0.0, 0.0 } }, { { 1.0, 0.0, 0.0 } }, { { 0.0, 1.0, 0.0 } } };
    if (isPlaced)
    {
      const std::vector<double> origin = ParseExactly("ImagePositionPatient", position, 3);
      const std::vector<double> axes = ParseExactly("ImageOrientationPatient", orientation, 6);
      std::copy_n(origin.begin(), 3, place.origin.begin());
      std::copy_n(axes.begin(), 3, place.rowAxis.begin());
      std::copy_n(axes.begin() + 3, 3, place.columnAxis.begin());
      place.rounding = GetRounding(position);
    }
    if (m_Structure.frames > 1 && !this->HasOwnPlace(frame))
    {
      const double offset = m_Offsets.empty() ? static_cast<double>(frame) : m_Offsets[frame];
      const auto   normal = itk::MedialVoxelCross(place.rowAxis, place.columnAxis);
      std::transform(
        normal.begin(), normal.end(), place.origin.begin(), place.origin.begin(), [offset](double n, double o) {
          return o + offset * n;
        });
    }
    return place;
  }

  /** Scans of one series differ in the number of the acquisition, or in the place in time. */
  std::string
  DescribeAcquisition(std::uint64_t frame) const
  {
    const std::string number = this->GetText(frame, DicomTag::FrameAcquisitionNumber);
    const std::string ownTime = this->GetText(frame, DicomTag::FrameTemporalPosition);
    const std::string stack = this->GetText(frame, DicomTag::StackId);
    const std::string time = ownTime.empty() ? this->GetText(frame, DicomTag::TemporalPosition) : ownTime;
    return (number.empty() ? this->GetText(frame, DicomTag::AcquisitionNumber) : number) +
           (time.empty() ? "" : " at time " + time) + (stack.empty() ? "" : " of stack " + stack);
  }

  /** A frame has one fragment, the fragments of the table of marks, or all of the file. */
  std::pair<std::size_t, std::size_t>
  FindFragments(std::uint64_t frame) const
  {
    const std::vector<DicomFragment> & fragments = m_Structure.fragments;
    const std::vector<std::uint32_t> & marks = m_Structure.marks;
    if (m_Structure.frames == 1 || fragments.size() == m_Structure.frames)
    {
      return { m_Structure.frames == 1 ? 0 : frame, m_Structure.frames == 1 ? fragments.size() : frame + 1 };
    }
    const auto findFragment = [&](std::uint64_t mark) {
      const auto found = std::lower_bound(
        fragments.begin(), fragments.end(), mark, [](const DicomFragment & a, std::uint64_t b) { return a.mark < b; });
      return static_cast<std::size_t>(found - fragments.begin());
    };
    if (marks.size() != m_Structure.frames || fragments.empty())
    {
      throw std::runtime_error("its " + std::to_string(m_Structure.frames) + " frames are in " +
                               std::to_string(fragments.size()) + " fragments, and no table tells which");
    }
    const std::uint64_t base = fragments.front().mark;
    const std::size_t   begin = findFragment(base + marks[frame]);
    const std::size_t   end = frame + 1 < marks.size() ? findFragment(base + marks[frame + 1]) : fragments.size();
    if (begin >= end)
    {
      throw std::runtime_error("the table of its frames is damaged at frame " + std::to_string(frame + 1));
    }
    return { begin, end };
  }

  DicomStructure      m_Structure;
  std::vector<double> m_Offsets;
};

std::uint64_t
GetFrameSize(const DicomStructure & file)
{
  return file.columns * file.rows * (file.bits / 8);
}

/** \throw HeaderError when the file is another one than it was */
void
RequireSameFile(const SliceHeader & slice)
{
  std::error_code error;
  if (std::filesystem::file_size(slice.fileName, error) != slice.frame->fileSize ||
      std::filesystem::last_write_time(slice.fileName, error) != slice.frame->lastWrite || error)
  {
    RefuseHeader(slice.fileName, "it changed while it was read");
  }
}

} // namespace

std::vector<SliceHeader>
ListDicomFrames(const std::filesystem::path & fileName, DicomStructure structure)
{
  DicomFrame sample;
  sample.fileSize = GetDataFileSize(fileName, fileName);
  sample.lastWrite = std::filesystem::last_write_time(fileName);
  std::vector<SliceHeader> slices;
  try
  {
    const FrameReader reader(structure);
    // Many files are in memory together.
    structure.texts.clear();
    structure.textsOfFrames.clear();
    structure.textsOfOneFrame = {};
    const auto file = std::make_shared<const DicomStructure>(std::move(structure));
    for (std::uint64_t number = 0; number < file->frames; ++number)
    {
      DicomFrame frame = reader.MakeFrame(number);
      frame.file = file;
      frame.fileSize = sample.fileSize;
      frame.lastWrite = sample.lastWrite;
      std::uint64_t bytes = file->isPacked ? 0 : GetFrameSize(*file);
      for (std::size_t i = frame.beginOfFragments; i < frame.endOfFragments; ++i)
      {
        bytes += file->fragments[i].length;
      }
      SliceHeader slice = reader.MakeHeader(number);
      slice.fileName = fileName;
      slice.padding = reader.GetPadding(frame);
      slice.frame = std::make_shared<const DicomFrame>(std::move(frame));
      slice.decoderMemory = 2 * bytes + 2 * MiB; // of the file, in GDCM too, and of the decoder
      slices.push_back(std::move(slice));
    }
  }
  catch (const HeaderError &)
  {
    throw;
  }
  catch (const std::runtime_error & error)
  {
    RefuseHeader(fileName, error.what());
  }
  return slices;
}

std::vector<char>
ReadDicomFrame(const SliceHeader & slice)
{
  RequireSameFile(slice);
  const DicomFrame &     frame = *slice.frame;
  const DicomStructure & file = *frame.file;
  const std::uint64_t    bytes = GetFrameSize(file);
  const std::uint64_t    begin = file.beginOfVoxels + frame.number * bytes;
  std::vector<char>      stored;
  if (file.isDeflated)
  {
    stored.resize(bytes);
    InflateReader reader(slice.fileName, file.beginOfData, true);
    reader.Skip(begin - file.beginOfData);
    reader.Read(stored.data(), bytes);
    return stored;
  }
  std::vector<DicomFragment> pieces{ { begin, begin, bytes } };
  if (file.isPacked)
  {
    pieces.assign(file.fragments.begin() + static_cast<std::ptrdiff_t>(frame.beginOfFragments),
                  file.fragments.begin() + static_cast<std::ptrdiff_t>(frame.endOfFragments));
  }
  std::ifstream input = OpenRegularFile(slice.fileName);
  for (const DicomFragment & piece : pieces)
  {
    const std::size_t old = stored.size();
    stored.resize(old + piece.length);
    input.seekg(static_cast<std::streamoff>(piece.begin));
    if (!input.read(stored.data() + old, static_cast<std::streamsize>(piece.length)))
    {
      RefuseHeader(slice.fileName, "its voxels end early");
    }
  }
  if (stored.empty())
  {
    RefuseHeader(slice.fileName, "frame " + std::to_string(frame.number + 1) + " has no voxels");
  }
  if (!file.isPacked && file.isBigEndian != itk::MachineIsBigEndian())
  {
    itk::SwapComponentBytes(stored.data(), stored.size(), static_cast<unsigned int>(file.bits / 8));
  }
  return stored;
}

} // end namespace medialvoxel
