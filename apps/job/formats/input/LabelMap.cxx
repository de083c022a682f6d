// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "LabelMap.h"

#include "BitStore.h"
#include "Errors.h"
#include "ReaderPool.h"
#include "Text.h"
#include "ValueStream.h"

#include "itkMedialVoxelEngineClient.h"
#include "itkMedialVoxelObjectPredicate.h"
#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>

namespace medialvoxel
{
namespace
{

/** 1 along unused axes. */
/** In the order of the voxels: slices, or rows of large slices. */
std::vector<itk::MedialVoxelBox>
CutIntoParts(const itk::MedialVoxelBox & box, const VolumeHeader & header)
{
  const std::size_t bytesPerVoxel = std::max(sizeof(ObjectNumber), std::size_t{ GetTraits(header.pixelType).bytes });
  const auto        bytesPerSlice = static_cast<std::uint64_t>(box.Extent(0) * box.Extent(1)) * bytesPerVoxel;
  if (bytesPerSlice <= InputVolume::BytesPerPart)
  {
    return itk::MedialVoxelEngineClient::CutForPull(box, bytesPerVoxel);
  }
  std::vector<itk::MedialVoxelBox> parts;
  for (itk::MedialVoxelBox slice = box; slice.lower[2] < box.upper[2]; ++slice.lower[2])
  {
    slice.upper[2] = slice.lower[2] + 1;
    const auto rows = itk::MedialVoxelEngineClient::CutForPull(slice, bytesPerVoxel);
    parts.insert(parts.end(), rows.begin(), rows.end());
  }
  return parts;
}

} // namespace

/** \class LabelMap::Source
 * \brief Where the objects of a box come from. */
class LabelMap::Source
{
public:
  virtual ~Source() = default;

  /** Shows all values to a survey, once. */
  virtual void
  Show(itk::MedialVoxelLabelSurvey & survey, const ReadObserver & observer) = 0;

  /** Learns the objects before the first box. */
  virtual void
  Learn(const itk::MedialVoxelLabelSurvey::Result & found) = 0;

  virtual void
  Read(const itk::MedialVoxelBox & part, ObjectNumber * objects) = 0;

  virtual itk::MedialVoxelSourceThreads
  GetThreads() const = 0;

  virtual std::uint64_t
  GetNumberOfBytesRead() const = 0;
};

/** \class LabelMap::StreamedSource
 * \brief Reads values and looks their objects up. */
class LabelMap::StreamedSource : public Source
{
public:
  StreamedSource(const VolumeHeader & header, std::uint64_t bytesToKeep)
    : m_Header(header)
    , m_Readers(header, Interpolation::Nearest, bytesToKeep)
  {}

  void
  Show(itk::MedialVoxelLabelSurvey & survey, const ReadObserver & observer) override
  {
    itk::MedialVoxelBox all;
    all.upper = m_Header.geometry.GetVoxelBox().upper;
    const auto parts = CutIntoParts(all, m_Header);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      observer(static_cast<double>(i) / static_cast<double>(parts.size()));
      this->WithValues(parts[i], [&](const auto * values, std::size_t count) { survey.Add(values, count); });
    }
  }

  void
  Learn(const itk::MedialVoxelLabelSurvey::Result & found) override
  {
    m_Table = itk::MedialVoxelLabelTable(found.values);
  }

  void
  Read(const itk::MedialVoxelBox & part, ObjectNumber * objects) override
  {
    this->WithValues(part, [&](const auto * values, std::size_t count) { m_Table.Translate(values, count, objects); });
  }

  itk::MedialVoxelSourceThreads
  GetThreads() const override
  {
    return InputVolume::IsReadInParallel(m_Header) ? itk::MedialVoxelSourceThreads::Several
                                                   : itk::MedialVoxelSourceThreads::Calling;
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_Readers.GetNumberOfBytesRead();
  }

private:
  template <typename TFunction>
  void
  WithValues(const itk::MedialVoxelBox & part, TFunction && function)
  {
    const auto             count = static_cast<std::size_t>(part.NumberOfVoxels());
    std::vector<std::byte> bytes(count * GetTraits(m_Header.pixelType).bytes);
    m_Readers.With([&](ValueReader & reader) { reader.Read(part, bytes.data()); });
    DispatchPixelType(m_Header.pixelType,
                      [&](auto zero) { function(reinterpret_cast<const decltype(zero) *>(bytes.data()), count); });
  }

  VolumeHeader               m_Header;
  ReaderPool                 m_Readers;
  itk::MedialVoxelLabelTable m_Table;
};

/** \class LabelMap::UnpackedSource
 * \brief Unpacks the volume once, to a number per voxel. */
class LabelMap::UnpackedSource : public Source
{
public:
  /** \param keepsVoxels whether Read() is to be called */
  UnpackedSource(const VolumeHeader & header, const std::filesystem::path & scratchFolder, bool keepsVoxels)
    : m_Header(header)
    , m_Size(header.geometry.GetVoxelBox().upper)
  {
    const std::uint64_t bits = UnpackedBits * header.geometry.GetNumberOfVoxels();
    if (keepsVoxels)
    {
      m_Store = scratchFolder.empty() ? MakeBitStoreInMemory(bits) : MakeBitStoreInFile(scratchFolder, bits);
    }
  }

  void
  Show(itk::MedialVoxelLabelSurvey & survey, const ReadObserver & observer) override
  {
    DispatchValueType(m_Header.GetStored(), [&](auto zero) {
      using ValueType = decltype(zero);
      const auto add = [&](const auto * values, std::size_t count) { this->Store(survey.Add(values, count)); };
      if (!m_Header.stored)
      {
        m_BytesRead = StreamValues<ValueType>(
          m_Header, observer, [&](const std::vector<ValueType> & values) { add(values.data(), values.size()); });
        return;
      }
      SliceResampler resampler(
        m_Header, Interpolation::Nearest, [&](const double * row, std::uint64_t count) { add(row, count); });
      m_BytesRead = StreamValues<ValueType>(
        m_Header.GetStored(), observer, [&](const std::vector<ValueType> & values) { resampler.Append(values); });
    });
    m_Pending.resize((m_Pending.size() + NumbersPerWord - 1) / NumbersPerWord * NumbersPerWord, 0);
    this->Store({});
  }

  void
  Learn(const itk::MedialVoxelLabelSurvey::Result & found) override
  {
    m_Numbers = found.numbers;
  }

  void
  Read(const itk::MedialVoxelBox & part, ObjectNumber * objects) override
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    const auto                        width = static_cast<std::size_t>(part.Extent(0));
    for (std::int64_t z = part.lower[2]; z < part.upper[2]; ++z)
    {
      for (std::int64_t y = part.lower[1]; y < part.upper[1]; ++y, objects += width)
      {
        this->ReadRow(static_cast<std::uint64_t>((z * m_Size[1] + y) * m_Size[0] + part.lower[0]), width, objects);
      }
    }
  }

  itk::MedialVoxelSourceThreads
  GetThreads() const override
  {
    return itk::MedialVoxelSourceThreads::OneAtATime;
  }

  std::uint64_t
  GetNumberOfBytesRead() const override
  {
    return m_BytesRead;
  }

private:
  static constexpr std::size_t NumbersPerWord = sizeof(BitStore::WordType) / sizeof(ObjectNumber);

  /** Keeps numbers as they came; those that fill no word yet wait. */
  void
  Store(const std::vector<ObjectNumber> & objects)
  {
    if (!m_Store)
    {
      return;
    }
    m_Pending.insert(m_Pending.end(), objects.begin(), objects.end());
    if (m_Pending.size() < (objects.empty() ? 1 : VoxelsPerChunk))
    {
      return;
    }
    m_Words.resize(m_Pending.size() / NumbersPerWord);
    std::memcpy(m_Words.data(), m_Pending.data(), m_Words.size() * sizeof(BitStore::WordType));
    m_Pending.erase(m_Pending.begin(),
                    m_Pending.begin() + static_cast<std::ptrdiff_t>(m_Words.size() * NumbersPerWord));
    m_Store->Append(m_Words);
  }

  void
  ReadRow(std::uint64_t firstVoxel, std::size_t width, ObjectNumber * objects)
  {
    const std::uint64_t firstWord = firstVoxel / NumbersPerWord;
    const std::uint64_t lastWord = (firstVoxel + width - 1) / NumbersPerWord;
    m_Words.resize(lastWord - firstWord + 1);
    m_Store->Read(firstWord, m_Words.size(), m_Words.data());
    const auto * const numbers = reinterpret_cast<const ObjectNumber *>(m_Words.data()) + firstVoxel % NumbersPerWord;
    std::transform(numbers, numbers + width, objects, [this](ObjectNumber came) { return m_Numbers[came]; });
  }

  VolumeHeader                    m_Header;
  itk::MedialVoxelIndex           m_Size;
  std::unique_ptr<BitStore>       m_Store; ///< null: nothing is kept
  std::mutex                      m_Mutex; ///< of the words
  std::vector<BitStore::WordType> m_Words;
  std::vector<ObjectNumber>       m_Pending;
  std::vector<ObjectNumber>       m_Numbers; ///< of the objects, by the numbers that are stored
  std::uint64_t                   m_BytesRead{ 0 };
};

LabelMap::LabelMap(const VolumeHeader &          header,
                   const LabelSelection &        selection,
                   std::uint64_t                 maximumPoreSize,
                   const std::filesystem::path & scratchFolder,
                   std::uint64_t                 bytesToKeep,
                   bool                          keepsVoxels)
  : m_Header(header)
  , m_Selection(selection)
  , m_MaximumPoreSize(maximumPoreSize)
{
  if (header.CanStream())
  {
    m_Source = std::make_unique<StreamedSource>(header, bytesToKeep);
  }
  else
  {
    m_Source = std::make_unique<UnpackedSource>(header, scratchFolder, keepsVoxels);
  }
}

LabelMap::~LabelMap() = default;

std::string
LabelMap::Prepare(const ReadObserver & observer)
{
  itk::MedialVoxelLabelSurvey survey(m_Selection.all ? std::vector<std::int64_t>{} : m_Selection.values,
                                     m_Header.geometry.GetVoxelBox().upper,
                                     m_MaximumPoreSize);
  itk::MedialVoxelLabelSurvey::Result found;
  try
  {
    this->MeasureReading([&] { m_Source->Show(survey, observer); });
    found = survey.Finish();
  }
  catch (const itk::MedialVoxelLabelError & error)
  {
    Fail(ExitStatus::CorruptInput, m_Header.fileName.string(), ": ", error.what());
  }
  const std::string resampled =
    m_Header.stored ? ", when it is resampled to " + FormatSize(m_Header.geometry.size) + " voxels" : "";
  if (!found.missing.empty())
  {
    Fail(ExitStatus::Usage, m_Header.fileName.string(), ": no voxel has the label ", found.missing.front(), resampled);
  }
  if (found.values.empty())
  {
    Fail(ExitStatus::Usage, m_Header.fileName.string(), ": all voxels are 0", resampled, "; there is no object");
  }
  m_Source->Learn(found);
  this->Learn(found);
  m_NotANumberVoxels = survey.GetNotANumberVoxels();
  if (m_Header.CanStream())
  {
    return {};
  }
  const std::uint64_t unpacked = GetBitStoreBytes(UnpackedBits * m_Header.geometry.GetNumberOfVoxels());
  return m_Header.fileName.string() +
         (m_Header.compressed ? " is compressed and was unpacked once: " : " has scaled values and was read once: ") +
         FormatBytes(this->GetNumberOfBytesRead()) + " read, " + FormatBytes(unpacked) + " of labels, " +
         FormatSeconds(this->GetReadSeconds());
}

void
LabelMap::ReadObjects(const itk::MedialVoxelBox & box, ObjectNumber * objects)
{
  for (const itk::MedialVoxelBox & part : CutIntoParts(box, m_Header))
  {
    this->MeasureReading([&] { m_Source->Read(part, objects); });
    objects += part.NumberOfVoxels();
  }
}

itk::MedialVoxelSourceThreads
LabelMap::GetSourceThreads() const
{
  return m_Source->GetThreads();
}

std::uint64_t
LabelMap::GetNumberOfBytesRead() const
{
  return m_Source->GetNumberOfBytesRead();
}

void
LabelMap::Fill(const itk::MedialVoxelBox & box, const VoxelTargets & targets)
{
  if (targets.object == nullptr)
  {
    return;
  }
  for (const itk::MedialVoxelBox & part : CutIntoParts(box, m_Header))
  {
    itk::MedialVoxelPoll();
    this->FillPart(part, *targets.object);
  }
}

void
LabelMap::FillPart(const itk::MedialVoxelBox & part, itk::MedialVoxelBits & bits)
{
  std::vector<ObjectNumber> objects(static_cast<std::size_t>(part.NumberOfVoxels()));
  this->MeasureReading([&] { m_Source->Read(part, objects.data()); });
  const itk::MedialVoxelStrides strides{ 1, part.Extent(0), part.Extent(0) * part.Extent(1) };
  const auto                    isShown = [this](ObjectNumber object) { return this->IsShown(object); };
  itk::MedialVoxelPackBox(objects.data(), strides, part, isShown, bits);
}

} // end namespace medialvoxel
