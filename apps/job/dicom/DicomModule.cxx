// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "DicomModule.h"

#include "DicomTexts.h"
#include "FileStart.h"
#include "PixelType.h"

#include <gdcmImageHelper.h>
#include <gdcmImageReader.h>
#include <gdcmRescaler.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <istream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef _WIN32
#  define MEDIALVOXEL_MODULE_EXPORT __declspec(dllexport)
#else
#  define MEDIALVOXEL_MODULE_EXPORT __attribute__((visibility("default")))
#endif

namespace
{

using medialvoxel::PixelType;

using TypePair = std::pair<gdcm::PixelFormat::ScalarType, PixelType>;

constexpr std::array<TypePair, 8> Types{ { { gdcm::PixelFormat::UINT8, PixelType::UInt8 },
                                           { gdcm::PixelFormat::INT8, PixelType::Int8 },
                                           { gdcm::PixelFormat::UINT16, PixelType::UInt16 },
                                           { gdcm::PixelFormat::INT16, PixelType::Int16 },
                                           { gdcm::PixelFormat::UINT32, PixelType::UInt32 },
                                           { gdcm::PixelFormat::INT32, PixelType::Int32 },
                                           { gdcm::PixelFormat::FLOAT32, PixelType::Float32 },
                                           { gdcm::PixelFormat::FLOAT64, PixelType::Float64 } } };

/** The values of every modality are the rescaled ones, as ITK has it; messages are the program's. */
void
PrepareGdcm()
{
  static const bool isPrepared = [] {
    gdcm::ImageHelper::SetForceRescaleInterceptSlope(true);
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    return true;
  }();
  (void)isPrepared;
}

/** Text of an element without the padding; empty when there is none. */
std::string
GetText(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  const gdcm::ByteValue * const bytes = data.FindDataElement(tag) ? data.GetDataElement(tag).GetByteValue() : nullptr;
  if (bytes == nullptr)
  {
    return "";
  }
  const std::string text(bytes->GetPointer(), bytes->GetLength());
  return text.substr(0, text.find_last_not_of(std::string(" \0", 2)) + 1);
}

template <std::size_t VSize>
void
CopyText(const std::string & text, char (&target)[VSize])
{
  const std::size_t length = std::min(text.size(), VSize - 1);
  std::memcpy(target, text.data(), length);
  target[length] = '\0';
}

/** A number of 16 bits, of the element that GDCM takes. */
unsigned int
GetNumber(const gdcm::DataSet & data, const gdcm::Tag & tag, unsigned int otherwise)
{
  const gdcm::ByteValue * const bytes = data.FindDataElement(tag) ? data.GetDataElement(tag).GetByteValue() : nullptr;
  std::uint16_t                 number = 0;
  if (bytes == nullptr || bytes->GetLength() != sizeof(number))
  {
    return otherwise;
  }
  std::memcpy(&number, bytes->GetPointer(), sizeof(number));
  return number;
}

/** GDCM ends the process when it is asked for a format whose numbers contradict each other. */
gdcm::PixelFormat
GetPixelFormat(const gdcm::File & file)
{
  const gdcm::DataSet & data = file.GetDataSet();
  const unsigned int    bits = GetNumber(data, gdcm::Tag(0x0028, 0x0100), 0);
  const unsigned int    storedBits = GetNumber(data, gdcm::Tag(0x0028, 0x0101), bits);
  const unsigned int    highBit = GetNumber(data, gdcm::Tag(0x0028, 0x0102), storedBits - 1);
  const unsigned int    representation = GetNumber(data, gdcm::Tag(0x0028, 0x0103), 0);
  const bool            isWhole = bits == 8 || bits == 16 || bits == 32;
  if (!isWhole || storedBits == 0 || storedBits > bits || highBit + 1 != storedBits || representation > 1)
  {
    throw std::runtime_error("its voxels have " + std::to_string(bits) + " bits, of which " +
                             std::to_string(storedBits) + " are stored up to bit " + std::to_string(highBit) +
                             ", in representation " + std::to_string(representation) +
                             "; 8, 16 or 32 bits are read, of which the lowest are stored, and representation 0 or 1");
  }
  return gdcm::ImageHelper::GetPixelFormatValue(file);
}

gdcm::Rescaler
MakeRescaler(const gdcm::PixelFormat & format, double intercept, double slope)
{
  gdcm::Rescaler rescaler;
  rescaler.SetIntercept(intercept);
  rescaler.SetSlope(slope);
  rescaler.SetPixelFormat(format);
  return rescaler;
}

gdcm::Rescaler
MakeRescaler(const gdcm::File & file)
{
  const std::vector<double> scale = gdcm::ImageHelper::GetRescaleInterceptSlopeValue(file);
  return MakeRescaler(GetPixelFormat(file), scale.at(0), scale.at(1));
}

PixelType
GetValueType(const gdcm::PixelFormat & stored, gdcm::Rescaler rescaler)
{
  if (stored.GetScalarType() == gdcm::PixelFormat::UNKNOWN)
  {
    throw std::runtime_error("GDCM does not know the type of its voxels");
  }
  const auto scalar = rescaler.ComputeInterceptSlopePixelType();
  const auto type =
    std::find_if(Types.begin(), Types.end(), [scalar](const TypePair & pair) { return pair.first == scalar; });
  if (type == Types.end())
  {
    throw std::runtime_error("its voxels have " + std::to_string(stored.GetBitsAllocated()) +
                             " bits; 8, 16 and 32 are read");
  }
  return type->second;
}

void
CheckGray(const gdcm::File & file)
{
  const auto samples = GetPixelFormat(file).GetSamplesPerPixel();
  const auto meaning = gdcm::ImageHelper::GetPhotometricInterpretationValue(file);
  if (samples != 1 || (meaning != gdcm::PhotometricInterpretation::MONOCHROME2 &&
                       meaning != gdcm::PhotometricInterpretation::MONOCHROME1))
  {
    throw std::runtime_error("it is a color image (" + std::string(meaning.GetString()) + ", " +
                             std::to_string(samples) + " values per voxel); only gray values are read");
  }
}

MedialVoxelDicomHeader
GetHeader(const gdcm::File & file)
{
  CheckGray(file);
  MedialVoxelDicomHeader          header{};
  const gdcm::DataSet &           data = file.GetDataSet();
  const std::vector<unsigned int> size = gdcm::ImageHelper::GetDimensionsValue(file);
  header.columns = size.at(0);
  header.rows = size.at(1);
  header.pixelType = static_cast<std::uint32_t>(GetValueType(GetPixelFormat(file), MakeRescaler(file)));
  const std::vector<double> scale = gdcm::ImageHelper::GetRescaleInterceptSlopeValue(file);
  header.intercept = scale.at(0);
  header.slope = scale.at(1);
  const std::vector<double> spacing = gdcm::ImageHelper::GetSpacingValue(file);
  const std::vector<double> origin = gdcm::ImageHelper::GetOriginValue(file);
  const std::vector<double> directions = gdcm::ImageHelper::GetDirectionCosinesValue(file);
  std::copy_n(spacing.begin(), std::min<std::size_t>(spacing.size(), 2), header.spacing);
  std::copy_n(origin.begin(), std::min<std::size_t>(origin.size(), 3), header.origin);
  std::copy_n(directions.begin(), std::min<std::size_t>(directions.size(), 6), header.directions);
  const gdcm::Tag position(0x0020, 0x0032);
  const gdcm::Tag orientation(0x0020, 0x0037);
  header.hasPosition = !GetText(data, position).empty() && !GetText(data, orientation).empty() ? 1 : 0;
  header.rounding = medialvoxel::GetDicomRounding(GetText(data, position));
  header.hasSpacing = medialvoxel::ParseDicomSpacing(GetText(data, gdcm::Tag(0x0028, 0x0030))).empty() ? 0 : 1;
  const std::vector<double> number = medialvoxel::ParseDicomNumbers(GetText(data, gdcm::Tag(0x0020, 0x0013)));
  header.hasNumber = number.size() == 1 ? 1 : 0;
  header.number = number.size() == 1 ? static_cast<std::int64_t>(std::clamp(number.front(), -1e15, 1e15)) : 0;
  CopyText(GetText(data, gdcm::Tag(0x0020, 0x000e)), header.series);
  CopyText(GetText(data, gdcm::Tag(0x0008, 0x103e)), header.description);
  CopyText(medialvoxel::JoinDicomAcquisition(GetText(data, gdcm::Tag(0x0020, 0x0012)),
                                             GetText(data, gdcm::Tag(0x0020, 0x0100))),
           header.acquisition);
  return header;
}

template <typename TNumber>
void
RestoreValues(TNumber * numbers, std::size_t count, unsigned int storedBits)
{
  const auto unused = static_cast<unsigned int>(8 * sizeof(TNumber)) - storedBits;
  for (std::size_t i = 0; i < count; ++i)
  {
    using Bits = std::make_unsigned_t<TNumber>;
    // Shifting back fills with the sign, or with zeros.
    numbers[i] = static_cast<TNumber>(static_cast<TNumber>(static_cast<Bits>(numbers[i]) << unused) >> unused);
  }
}

/** Some codecs know no sign, and leave bits beyond the stored ones as they are. */
void
RestoreStoredBits(std::vector<char> & stored, const gdcm::PixelFormat & format, std::size_t bytes)
{
  const unsigned int storedBits = format.GetBitsStored();
  const std::size_t  count = stored.size() / bytes;
  if (storedBits >= 8 * bytes || format.GetBitsAllocated() != 8 * bytes)
  {
    return;
  }
  const bool isSigned = format.GetPixelRepresentation() == 1;
  const auto restore = [&](auto zero) {
    using Number = decltype(zero);
    using Signed = std::make_signed_t<Number>;
    isSigned ? RestoreValues(reinterpret_cast<Signed *>(stored.data()), count, storedBits)
             : RestoreValues(reinterpret_cast<Number *>(stored.data()), count, storedBits);
  };
  switch (bytes)
  {
    case 1:
      return restore(std::uint8_t{});
    case 2:
      return restore(std::uint16_t{});
    default:
      return restore(std::uint32_t{});
  }
}

void
Rescale(const std::vector<char> & stored, gdcm::Rescaler rescaler, void * voxels)
{
  if (!rescaler.Rescale(static_cast<char *>(voxels), stored.data(), stored.size()))
  {
    throw std::runtime_error("its voxels cannot be rescaled");
  }
}

void
ReadImage(const gdcm::Image &       image,
          const gdcm::PixelFormat & format,
          const gdcm::Rescaler &    rescaler,
          std::size_t               numberOfVoxels,
          void *                    voxels)
{
  std::vector<char> stored(image.GetBufferLength());
  const std::size_t storedBytes = image.GetPixelFormat().GetPixelSize();
  if (stored.size() != numberOfVoxels * storedBytes)
  {
    throw std::runtime_error("it has " + std::to_string(stored.size()) + " bytes of voxels; its size needs " +
                             std::to_string(numberOfVoxels * storedBytes));
  }
  if (!image.GetBuffer(stored.data()))
  {
    throw std::runtime_error("its voxels are damaged or end early, or their compression is unknown to GDCM");
  }
  RestoreStoredBits(stored, format, storedBytes);
  Rescale(stored, rescaler, voxels);
}

void
ReadVoxels(const char * fileName, std::uint64_t end, const MedialVoxelDicomHeader & expected, void * voxels)
{
  medialvoxel::FileStart file(fileName, end);
  std::istream           stream(&file);
  gdcm::ImageReader      reader;
  reader.SetStream(stream);
  if (!reader.Read())
  {
    throw std::runtime_error("GDCM cannot read its voxels");
  }
  const MedialVoxelDicomHeader header = GetHeader(reader.GetFile());
  if (header.columns != expected.columns || header.rows != expected.rows || header.pixelType != expected.pixelType)
  {
    throw std::runtime_error("it changed its size or type while it was read");
  }
  const gdcm::Image & image = reader.GetImage();
  ReadImage(image,
            GetPixelFormat(reader.GetFile()),
            MakeRescaler(reader.GetFile()),
            std::size_t{ header.columns } * header.rows,
            voxels);
}

/** A frame as an image of its own, which GDCM unpacks without the other frames. */
gdcm::Image
MakeImage(const MedialVoxelDicomFrame & frame, const gdcm::PixelFormat & format)
{
  const auto                                    length = static_cast<std::uint32_t>(frame.length);
  gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
  gdcm::Fragment                                fragment;
  fragment.SetByteValue(frame.bytes, gdcm::VL(length));
  fragments->AddFragment(fragment);
  gdcm::DataElement voxels(gdcm::Tag(0x7fe0, 0x0010));
  voxels.SetVR(gdcm::VR::OB);
  voxels.SetValue(*fragments);

  gdcm::Image image;
  image.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(frame.syntax));
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, frame.columns);
  image.SetDimension(1, frame.rows);
  image.SetPixelFormat(format);
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetDataElement(voxels);
  return image;
}

void
ReadFrame(const MedialVoxelDicomFrame & frame, std::uint32_t & pixelType, void * voxels)
{
  const auto              bits = [](std::uint32_t number) { return static_cast<unsigned short>(number); };
  const gdcm::PixelFormat format(
    1, bits(frame.bits), bits(frame.storedBits), bits(frame.storedBits - 1), bits(frame.isSigned));
  const gdcm::Rescaler rescaler = MakeRescaler(format, frame.intercept, frame.slope);
  pixelType = static_cast<std::uint32_t>(GetValueType(format, rescaler));
  if (frame.bytes == nullptr)
  {
    return;
  }
  if (frame.isPacked != 0)
  {
    ReadImage(MakeImage(frame, format), format, rescaler, std::size_t{ frame.columns } * frame.rows, voxels);
    return;
  }
  std::vector<char> stored(frame.bytes, frame.bytes + frame.length);
  RestoreStoredBits(stored, format, frame.bits / 8);
  Rescale(stored, rescaler, voxels);
}

/** Exceptions do not leave the module. */
template <typename TFunction>
const char *
Guard(TFunction && function)
{
  thread_local std::string message;
  try
  {
    PrepareGdcm();
    function();
    return nullptr;
  }
  catch (const std::exception & error)
  {
    message = error.what();
  }
  catch (...)
  {
    message = "GDCM fails";
  }
  return message.c_str();
}

} // namespace

extern "C"
{
  MEDIALVOXEL_MODULE_EXPORT const char *
  MedialVoxelModuleReadDicomHeader(const char * fileName, MedialVoxelDicomHeader * header)
  {
    return Guard([&] {
      gdcm::Reader reader;
      reader.SetFileName(fileName);
      const gdcm::Tag voxels(0x7fe0, 0x0010);
      if (!reader.ReadUpToTag(voxels))
      {
        throw std::runtime_error("GDCM cannot read its header");
      }
      *header = GetHeader(reader.GetFile());
    });
  }

  MEDIALVOXEL_MODULE_EXPORT const char *
  MedialVoxelModuleReadDicomVoxels(const char *                   fileName,
                                   std::uint64_t                  end,
                                   const MedialVoxelDicomHeader * header,
                                   void *                         voxels)
  {
    return Guard([&] { ReadVoxels(fileName, end, *header, voxels); });
  }

  MEDIALVOXEL_MODULE_EXPORT const char *
  MedialVoxelModuleReadDicomFrame(const MedialVoxelDicomFrame * frame, std::uint32_t * pixelType, void * voxels)
  {
    return Guard([&] { ReadFrame(*frame, *pixelType, voxels); });
  }
}
