// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeFormats.h"

#include "HeaderParsing.h"
#include "NiftiText.h"
#include "OutputVolume.h"
#include "PackedVolume.h"
#include "RawImageIO.h"
#include "SeriesImageIO.h"
#include "SliceFormats.h"
#include "SliceNames.h"
#include "Text.h"
#include "VolumeText.h"
#include "VoxelStream.h"
#include "ZarrValues.h"
#include "ZarrVolume.h"
#ifdef MEDIALVOXEL_WITH_TIFF
#  include "TiffImageIO.h"
#  include "TiffStream.h"
#endif

#include <algorithm>

namespace medialvoxel
{
namespace
{

constexpr const char * DetachedRemedy = "its voxels are in a file of their own; .mha and .nrrd can be packed";

std::unique_ptr<SharedVolume>
MakeFile(const std::filesystem::path & fileName, const JobOptions & options)
{
  return std::make_unique<OutputVolume>(fileName, options.overwrite, options.sparse);
}

std::unique_ptr<SharedVolume>
MakeZarrFolder(const std::filesystem::path & folder, const JobOptions & options)
{
  return std::make_unique<ZarrVolume>(folder, options.overwrite, options.sparse, options.zarrCompression);
}

VolumeFormat
MakeMetaImageRow()
{
  VolumeWriter writer;
  writer.make = MakeFile;
  writer.makeHeader = MakeMetaImageText;
  writer.packsAsZlib = true;
  return { "MetaImage",
           { { ".mha", false, false, true }, { ".mhd", true, false, false, DetachedRemedy } },
           { ReadMetaImageHeader, DataSizeCheck::AtLeast, OpenInflatedStream, MakeRawImageIO },
           writer };
}

VolumeFormat
MakeNrrdRow()
{
  VolumeWriter writer;
  writer.make = MakeFile;
  writer.makeHeader = MakeNrrdText;
  return { "NRRD",
           { { ".nrrd", false, false, true }, { ".nhdr", true, false, false, DetachedRemedy } },
           { ReadNrrdHeader, DataSizeCheck::AtLeast, OpenInflatedStream, MakeRawImageIO },
           writer };
}

VolumeFormat
MakeNiftiRow()
{
  VolumeWriter writer;
  writer.make = MakeFile;
  writer.makeHeader = [](const VolumeGeometry & geometry,
                         const VoxelLayout &    layout,
                         const std::string &,
                         const std::optional<std::uint64_t> &) { return MakeNiftiHeader(geometry, layout); };
  writer.packsHeader = true;
  writer.hasComponents = false;
  writer.largestSize = LargestNiftiSize;
  return { "NIfTI",
           { { ".nii", false, false, false, "name it .nii.gz" }, { ".nii.gz", false, true, true } },
           { ReadNiftiHeader, DataSizeCheck::AtLeast, OpenInflatedStream, MakeRawImageIO },
           writer };
}

/** Headers whose voxels are in a file of their own are only read. */
VolumeFormat
MakeNiftiPairRow()
{
  return { "NIfTI",
           { { ".hdr" } },
           { ReadNiftiHeader, DataSizeCheck::AtLeast, OpenInflatedStream, MakeRawImageIO },
           std::nullopt };
}

VolumeFormat
MakeZarrRow()
{
  VolumeWriter writer;
  writer.make = MakeZarrFolder;
  writer.packsChunks = true;
  writer.getMemory = [](const VolumeGeometry & geometry, const VoxelLayout & layout, const JobOptions & options) {
    return ZarrVolume::GetMemoryBytes(geometry, layout, options.zarrCompression);
  };
  writer.getSlicesOfLayer = [](const VolumeGeometry & geometry, const VoxelLayout & layout) {
    return ZarrGrid::ForVolume(geometry, layout).chunk[2];
  };
  writer.getRowsOfLayer = [](const VolumeGeometry & geometry, const VoxelLayout & layout) {
    return geometry.GetDimension() == 3 ? ZarrGrid::ForVolume(geometry, layout).chunk[1] : 0;
  };
  writer.getFurtherBytes = ZarrVolume::GetBytesOfSmallerLevels;
  VolumeInput input;
  input.readHeader = [](const std::filesystem::path & folder) { return ReadZarrHeader(folder, 0); };
  input.sizeCheck = DataSizeCheck::ByReader;
  input.makeChunkReader = MakeZarrValues;
  input.readLevel = ReadZarrHeader;
  input.isFolder = IsZarrFolder;
  return { "Zarr", { { ".zarr" } }, input, writer };
}

VolumeFormat
MakeMrcRow()
{
  return { "MRC",
           { { ".mrc" }, { ".map" }, { ".rec" } },
           { ReadMrcHeader, DataSizeCheck::AtLeast, OpenInflatedStream, MakeRawImageIO },
           std::nullopt };
}

VolumeFormat
MakeKeyedRow()
{
  std::vector<VolumeExtension> extensions;
  for (const char * const extension : ListKeyedExtensions())
  {
    extensions.push_back({ extension });
  }
  return {
    "VOL", extensions, { ReadKeyedHeader, DataSizeCheck::Exactly, OpenInflatedStream, MakeRawImageIO }, std::nullopt
  };
}

/** The one place that knows all formats, in the order in which messages list them. */
const std::vector<VolumeFormat> &
GetFormats()
{
  static const std::vector<VolumeFormat> formats{
    MakeMetaImageRow(),
    MakeNrrdRow(),
    MakeNiftiRow(),
    MakeNiftiPairRow(),
    MakeZarrRow(),
#ifdef MEDIALVOXEL_WITH_TIFF
    { "TIFF",
      { { ".tif" }, { ".tiff" } },
      { ReadTiffHeader, DataSizeCheck::ByReader, OpenTiffStream, MakeTiffImageIO },
      std::nullopt },
#endif
    MakeMrcRow(),
    MakeKeyedRow(),
  };
  return formats;
}

/** Null when the name has none of the extensions of the format. */
const VolumeExtension *
FindExtension(const VolumeFormat & format, const std::filesystem::path & fileName)
{
  const std::string name = ToLower(fileName.filename().string());
  const auto        found =
    std::find_if(format.extensions.begin(), format.extensions.end(), [&name](const VolumeExtension & extension) {
      const std::string end = extension.text;
      return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    });
  return found == format.extensions.end() ? nullptr : &*found;
}

/** Fails with what the name lacks; \a remedy is what it could be. */
[[noreturn]] void
RefuseExtension(const std::filesystem::path & fileName, const std::string & remedy)
{
  const std::string extension = ToLower(fileName.extension().string());
  Fail(ExitStatus::Usage,
       fileName.string(),
       ": unknown format",
       extension.empty() ? ", its name has no extension" : " '" + extension + "'",
       "; ",
       remedy);
}

std::string
JoinExtensions(const std::vector<std::string> & extensions, const char * separator)
{
  return Join(extensions, separator, [](const std::string & extension) { return extension; });
}

} // namespace

const VolumeFormat &
GetRawFormat()
{
  static const VolumeFormat raw{
    "raw", {}, { nullptr, DataSizeCheck::Exactly, nullptr, MakeRawImageIO }, std::nullopt
  };
  return raw;
}

const VolumeFormat &
GetSeriesFormat()
{
  static const VolumeFormat series = [] {
    VolumeInput input;
    input.sizeCheck = DataSizeCheck::ByReader;
    input.makeReader = MakeSeriesImageIO;
    input.readChoice = ReadSeriesHeader;
    input.getMemory = GetSeriesMemory;
    return VolumeFormat{ "series of slices", {}, input, std::nullopt };
  }();
  return series;
}

const VolumeFormat &
FindInputFormat(const std::filesystem::path & fileName)
{
  std::error_code error;
  const auto      status = std::filesystem::status(fileName, error);
  for (const VolumeFormat & format : GetFormats())
  {
    const bool isNamed = std::filesystem::is_directory(status) && FindExtension(format, fileName);
    if (format.IsFolder() && (isNamed || format.input.isFolder(fileName)))
    {
      return format;
    }
  }
  // A folder with the name of a file is more likely a mistake than a series.
  const bool hasNameOfFile = std::any_of(GetFormats().begin(), GetFormats().end(), [&](const VolumeFormat & format) {
    return std::filesystem::is_directory(status) && FindExtension(format, fileName);
  });
  if (NamesSlices(fileName) && !hasNameOfFile)
  {
    return GetSeriesFormat();
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    OpenRegularFile(fileName); // tells what it is
  }
  for (const VolumeFormat & format : GetFormats())
  {
    if (FindExtension(format, fileName))
    {
      return format;
    }
  }
  if (!std::filesystem::exists(status))
  {
    Fail(ExitStatus::Failure, "cannot open ", fileName.string(), ": no such file or folder");
  }
  const SliceFormat * const ofSlices = FindSliceFormat(fileName);
  if (ofSlices && ofSlices->isInput)
  {
    return GetSeriesFormat();
  }
  RefuseExtension(
    fileName,
    JoinExtensions(ListInputExtensions(), ", ") +
      " are read, series of slices by their folder or a pattern such as 'scan/*.png', and headerless files "
      "with --raw-size and --raw-type");
}

OutputFormat
FindOutputFormat(const std::filesystem::path & fileName)
{
  for (const VolumeFormat & format : GetFormats())
  {
    const VolumeExtension * const extension = FindExtension(format, fileName);
    if (extension && format.writer)
    {
      return { format, *extension };
    }
  }
  RefuseExtension(fileName, "volumes are written as " + JoinExtensions(ListOutputExtensions(), " or "));
}

std::vector<std::string>
ListInputExtensions()
{
  std::vector<std::string> extensions;
  for (const VolumeFormat & format : GetFormats())
  {
    for (const VolumeExtension & extension : format.extensions)
    {
      extensions.emplace_back(extension.text);
    }
  }
  return extensions;
}

std::vector<std::string>
ListInputFormats()
{
  std::vector<std::string> names;
  for (const VolumeFormat & format : GetFormats())
  {
    if (names.empty() || names.back() != format.name) // some have several rows
    {
      names.emplace_back(format.name);
    }
  }
  return names;
}

std::vector<std::string>
ListOutputExtensions(unsigned int components)
{
  std::vector<std::string> extensions;
  for (const VolumeFormat & format : GetFormats())
  {
    for (const VolumeExtension & extension : format.extensions)
    {
      if (format.writer && (components == 1 || format.writer->hasComponents))
      {
        extensions.emplace_back(extension.text);
      }
    }
  }
  return extensions;
}

bool
IsPackedVolume(const std::filesystem::path & fileName, bool compress)
{
  const VolumeExtension & extension = FindOutputFormat(fileName).extension;
  return extension.isPacked || (compress && extension.canPack);
}

bool
IsPackedInAnyWay(const std::filesystem::path & fileName, const JobOptions & options)
{
  const bool packsChunks = FindOutputFormat(fileName).format.writer->packsChunks;
  return IsPackedVolume(fileName, options.compress) ||
         (packsChunks && options.zarrCompression != ZarrCompression::None);
}

void
CheckOutputFormat(const std::filesystem::path & fileName,
                  const VolumeGeometry &        geometry,
                  const VoxelLayout &           layout,
                  bool                          compress)
{
  const auto [format, extension] = FindOutputFormat(fileName);
  if (compress && !extension.canPack && *extension.remedy != '\0')
  {
    Fail(ExitStatus::Usage, fileName.string(), " cannot be packed: ", extension.remedy);
  }
  if (layout.components > 1 && !format.writer->hasComponents)
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": vectors are not written as ",
         extension.text,
         ", which keeps their components apart; they are written as ",
         JoinExtensions(ListOutputExtensions(layout.components), " or "));
  }
  const std::uint64_t largest = *std::max_element(geometry.size.begin(), geometry.size.end());
  if (format.writer->largestSize > 0 && largest > format.writer->largestSize)
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": the volume has ",
         largest,
         " voxels along an axis, ",
         format.name,
         " has up to ",
         format.writer->largestSize);
  }
}

std::uint64_t
GetOutputMemory(const std::filesystem::path & fileName,
                const VolumeGeometry &        geometry,
                const VoxelLayout &           layout,
                const JobOptions &            options)
{
  const VolumeWriter & writer = *FindOutputFormat(fileName).format.writer;
  return (IsPackedVolume(fileName, options.compress) ? PackedVolume::GetMemoryBytes() : 0) +
         (writer.getMemory ? writer.getMemory(geometry, layout, options) : 0);
}

std::uint64_t
GetOutputBytes(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  const VolumeWriter & writer = *FindOutputFormat(fileName).format.writer;
  return geometry.GetNumberOfVoxels() * layout.GetBytes() +
         (writer.getFurtherBytes ? writer.getFurtherBytes(geometry, layout) : 0);
}

std::uint64_t
GetSlicesOfLayer(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  const VolumeWriter & writer = *FindOutputFormat(fileName).format.writer;
  return writer.getSlicesOfLayer ? writer.getSlicesOfLayer(geometry, layout) : 1;
}

std::uint64_t
GetRowsOfLayer(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  const VolumeWriter & writer = *FindOutputFormat(fileName).format.writer;
  return writer.getRowsOfLayer ? writer.getRowsOfLayer(geometry, layout) : 0;
}

} // end namespace medialvoxel
