// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "AbortNotice.h"
#include "DicomFrames.h"
#include "DicomModule.h"
#include "DicomTags.h"
#include "Errors.h"
#include "HeaderParsing.h"
#include "ProcessIdentity.h"
#include "SliceFormats.h"
#include "Text.h"

#include <itksys/DynamicLoader.hxx>
#include <itksys/SystemTools.hxx>

#include <algorithm>
#include <cstdlib>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t MiB = std::uint64_t{ 1 } << 20;

/** No way of packing makes one byte out of more than this many, but for small images of one value. */
constexpr std::uint64_t MaximumRatio = 4096;
constexpr std::uint64_t SmallImageSize = 16 * MiB;

/** Measured: GDCM and its tables. */
constexpr std::uint64_t GdcmMemory = 12 * MiB;

/** In place of the module's usual places. */
constexpr const char * ModuleVariable = "MEDIALVOXEL_DICOM_MODULE";

/** Where the module may be: where it is installed, and beside the program, as it is built. */
std::vector<std::filesystem::path>
ListModulePlaces()
{
  if (const char * const place = std::getenv(ModuleVariable))
  {
    return { place };
  }
  const std::filesystem::path folder = GetProgramFile().parent_path();
  const std::filesystem::path name = std::string("MedialVoxelDicom") + itksys::DynamicLoader::LibExtension();
  return { (folder / MEDIALVOXEL_MODULE_FOLDER / name).lexically_normal(), folder / name };
}

/** Null where there is no module, or one that cannot be loaded. */
MedialVoxelReadDicomFrame
LoadModule()
{
  for (const std::filesystem::path & place : ListModulePlaces())
  {
    std::error_code error;
    if (std::filesystem::exists(place, error))
    {
      const auto module = itksys::DynamicLoader::OpenLibrary(place.string());
      return module ? reinterpret_cast<MedialVoxelReadDicomFrame>(
                        itksys::DynamicLoader::GetSymbolAddress(module, MedialVoxelReadDicomFrameName))
                    : nullptr;
    }
  }
  return nullptr;
}

MedialVoxelReadDicomFrame
GetModule(const std::filesystem::path & fileName)
{
  static const MedialVoxelReadDicomFrame readFrame = LoadModule();
  if (!readFrame)
  {
    RefuseHeader(fileName,
                 "DICOM is read by a module that is not at " +
                   Join(ListModulePlaces(), " or ", [](const auto & place) { return place.string(); }) +
                   "; build it with an ITK that has GDCM",
                 HeaderError::Kind::Unsupported);
  }
  return readFrame;
}

/** Preconditions of GDCM. */
void
CheckVoxels(const std::filesystem::path & fileName, const DicomStructure & structure)
{
  if (structure.samples != 1)
  {
    RefuseHeader(fileName,
                 "it is a color image (" + std::to_string(structure.samples) +
                   " values per voxel); only gray values are read",
                 HeaderError::Kind::Unsupported);
  }
  const auto interpretation = structure.texts.find(DicomTag::Interpretation);
  if (interpretation != structure.texts.end() && interpretation->second.rfind("MONOCHROME", 0) != 0)
  {
    RefuseHeader(fileName,
                 "it is a color image (" + itk::MedialVoxelText::MakePrintable(interpretation->second) +
                   "); only gray values are read",
                 HeaderError::Kind::Unsupported);
  }
  const bool isWhole = structure.bits == 8 || structure.bits == 16 || structure.bits == 32;
  if (!isWhole || structure.storedBits == 0 || structure.storedBits > structure.bits ||
      structure.highBit + 1 != structure.storedBits || structure.isSigned > 1)
  {
    RefuseHeader(fileName,
                 "its voxels have " + std::to_string(structure.bits) + " bits, of which " +
                   std::to_string(structure.storedBits) + " are stored up to bit " + std::to_string(structure.highBit) +
                   ", and the representation " + std::to_string(structure.isSigned) +
                   "; 8, 16 or 32 bits are read, of which the lowest are stored, and representation 0 or 1",
                 HeaderError::Kind::Unsupported);
  }
}

/** Before GDCM allocates anything. */
void
CheckSize(const std::filesystem::path & fileName, const DicomStructure & structure)
{
  // Factors of 16 bits do not overflow.
  CheckVoxels(fileName, structure);
  const std::uint64_t bytes =
    structure.columns * structure.rows * structure.samples * ((structure.bits + 7) / 8) * structure.frames;
  const bool fits = structure.isPacked ? bytes <= std::max(SmallImageSize, MaximumRatio * structure.dataSize)
                                       : bytes <= structure.dataSize;
  if (bytes == 0 || !fits)
  {
    RefuseHeader(fileName,
                 "its " +
                   (structure.frames > 1 ? FormatSize({ structure.columns, structure.rows, structure.frames })
                                         : FormatSize({ structure.columns, structure.rows })) +
                   " voxels of " + std::to_string(structure.samples) + " x " + std::to_string(structure.bits) +
                   " bits cannot be in " + std::to_string(structure.dataSize) + " bytes");
  }
}

MedialVoxelDicomFrame
DescribeFrame(const DicomFrame & frame)
{
  const auto             number = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
  const DicomStructure & file = *frame.file;
  return { nullptr,
           0,
           file.syntax.c_str(),
           number(file.isPacked),
           number(file.columns),
           number(file.rows),
           number(file.bits),
           number(file.storedBits),
           number(file.isSigned),
           frame.slope,
           frame.intercept };
}

void
CallReadFrame(const SliceHeader & slice, const MedialVoxelDicomFrame & frame, std::uint32_t & pixelType, void * voxels)
{
  // GDCM checks some of its input by assertions.
  const AbortNotice notice(static_cast<int>(ExitStatus::CorruptInput),
                           slice.fileName.string() + " is damaged: GDCM cannot decode it");
  if (const char * const problem = GetModule(slice.fileName)(&frame, &pixelType, voxels))
  {
    RefuseHeader(slice.fileName,
                 (slice.frameNumber > 0 ? "frame " + std::to_string(slice.frameNumber) + ": " : "") + problem);
  }
}

std::vector<SliceHeader>
ReadHeaders(const std::filesystem::path & fileName)
{
  const DicomStructure structure = CheckDicomStructure(fileName);
  if (structure.dataSize == 0)
  {
    return {};
  }
  CheckSize(fileName, structure);
  std::vector<SliceHeader> slices = ListDicomFrames(fileName, structure);
  for (SliceHeader & slice : slices)
  {
    std::uint32_t pixelType = 0;
    CallReadFrame(slice, DescribeFrame(*slice.frame), pixelType, nullptr);
    slice.pixelType = static_cast<PixelType>(pixelType);
    slice.storedType = slice.pixelType;
    slice.decoderMemory += (structure.isPacked ? 3 : 1) * slice.GetDataSize(); // some codecs have more of it
  }
  return slices;
}

/** Slices whose values are of different types share one that holds all of them. */
void
ConvertValues(PixelType from, const void * values, const SliceHeader & slice, void * voxels)
{
  const std::size_t count = slice.size[0] * slice.size[1];
  DispatchPixelType(from, [&](auto zeroFrom) {
    DispatchPixelType(slice.pixelType, [&](auto zeroTo) {
      const auto * const first = static_cast<const decltype(zeroFrom) *>(values);
      std::transform(first, first + count, static_cast<decltype(zeroTo) *>(voxels), [](auto value) {
        return static_cast<decltype(zeroTo)>(value);
      });
    });
  });
}

void
ReadVoxels(const SliceHeader & expected, void * voxels)
{
  const std::vector<char> bytes = ReadDicomFrame(expected);
  MedialVoxelDicomFrame   frame = DescribeFrame(*expected.frame);
  frame.bytes = bytes.data();
  frame.length = bytes.size();
  const bool        isOther = *expected.storedType != expected.pixelType;
  std::vector<char> stored(isOther ? expected.size[0] * expected.size[1] * GetTraits(*expected.storedType).bytes : 0);
  std::uint32_t     pixelType = 0;
  CallReadFrame(expected, frame, pixelType, isOther ? stored.data() : voxels);
  if (isOther)
  {
    ConvertValues(*expected.storedType, stored.data(), expected, voxels);
  }
}

} // namespace

SliceFormat
MakeDicomSliceFormat()
{
  return { "DICOM", { ".dcm", ".dicom", ".ima" }, true, IsDicomFile, ReadHeaders, ReadVoxels, GdcmMemory };
}

} // end namespace medialvoxel
