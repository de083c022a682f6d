// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "DicomModule.h"

#include "PixelType.h"

#include <gdcmImage.h>
#include <gdcmRescaler.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <array>
#include <cstring>
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

bool
BeQuiet()
{
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  return true;
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
  const std::size_t storedSize = image.GetPixelFormat().GetPixelSize();
  if (stored.size() != numberOfVoxels * storedSize)
  {
    throw std::runtime_error("it has " + std::to_string(stored.size()) + " bytes of voxels; its size needs " +
                             std::to_string(numberOfVoxels * storedSize));
  }
  if (!image.GetBuffer(stored.data()))
  {
    throw std::runtime_error("its voxels are damaged or end early, or their compression is unknown to GDCM");
  }
  RestoreStoredBits(stored, format, storedSize);
  Rescale(stored, rescaler, voxels);
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

} // namespace

extern "C"
{
  /** Exceptions do not leave the module. */
  MEDIALVOXEL_MODULE_EXPORT const char *
  MedialVoxelModuleReadDicomFrame(const MedialVoxelDicomFrame * frame, std::uint32_t * pixelType, void * voxels)
  {
    thread_local std::string message;
    try
    {
      static const bool isQuiet = BeQuiet(); // messages are the program's
      (void)isQuiet;
      ReadFrame(*frame, *pixelType, voxels);
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
}
