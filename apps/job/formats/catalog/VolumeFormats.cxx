// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeFormats.h"

#include "FormatRows.h"
#include "HeaderParsing.h"
#include "PackedVolume.h"
#include "RawImageIO.h"
#include "Text.h"

#include <algorithm>
#include <fstream>
#include <regex>

namespace medialvoxel
{
namespace
{

// The formats that CMake has built. The rest of the program does not know.
#ifdef MEDIALVOXEL_FORMAT_SLICES
constexpr const char * TiffRemedy = "libtiff 4.5 or later";
#else
constexpr const char * TiffRemedy = "MedialVoxel_FORMAT_SLICES=ON and libtiff 4.5 or later";
#endif

/** The remains of a format that the program was built without: its name, and the option of the build that adds it. */
[[maybe_unused]] VolumeFormat
LeaveOut(const char * name, const std::vector<VolumeExtension> & extensions, const char * remedy)
{
  return { name, extensions, {}, std::nullopt, remedy };
}

[[maybe_unused]] VolumeFormat
LeaveOutZarr()
{
  VolumeFormat format = LeaveOut("Zarr", { { ".zarr" } }, "MedialVoxel_FORMAT_ZARR=ON");
  format.input.isFolder = [](const std::filesystem::path & folder) {
    std::error_code error;
    return std::filesystem::exists(folder / ".zgroup", error) || std::filesystem::exists(folder / ".zarray", error) ||
           std::filesystem::exists(folder / "zarr.json", error);
  };
  format.writer = VolumeWriter();
  return format;
}

/** Folders and patterns of slices, images that are one, and files that begin as DICOM does. */
[[maybe_unused]] VolumeFormat
LeaveOutSeries()
{
  VolumeFormat format =
    LeaveOut("series of slices",
             { { ".dcm" }, { ".dicom" }, { ".ima" }, { ".png" }, { ".jpg" }, { ".jpeg" }, { ".bmp" } },
             "MedialVoxel_FORMAT_SLICES=ON");
  format.input.isKnown = [](const std::filesystem::path & input) {
    std::error_code error;
    if (!std::filesystem::exists(input, error))
    {
      return std::regex_search(input.filename().string(), std::regex("[*?]|%[0-9]{0,2}d"));
    }
    if (!std::filesystem::is_regular_file(input, error))
    {
      return std::filesystem::is_directory(input, error);
    }
    std::string start(132, '\0');
    std::ifstream(input, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
    return start.substr(128) == "DICM";
  };
  return format;
}

/** The one place that knows all formats, in the order in which messages list them. */
const std::vector<VolumeFormat> &
GetFormats()
{
  static const std::vector<VolumeFormat> formats{
    MakeMetaImageFormat(), MakeNrrdFormat(),  MakeNiftiFormat(), MakeNiftiPairFormat(),
#ifdef MEDIALVOXEL_FORMAT_ZARR
    MakeZarrFormat(),
#else
    LeaveOutZarr(),
#endif
#ifdef MEDIALVOXEL_WITH_TIFF
    MakeTiffFormat(),
#else
    LeaveOut("TIFF", { { ".tif" }, { ".tiff" } }, TiffRemedy),
#endif
#ifdef MEDIALVOXEL_FORMAT_TEXT
    MakeMrcFormat(),       MakeKeyedFormat(),
#else
    LeaveOut("MRC", { { ".mrc" }, { ".map" }, { ".rec" } }, "MedialVoxel_FORMAT_TEXT=ON"),
    LeaveOut("VOL", { { ".vol" }, { ".vol.info" }, { ".vgi" }, { ".pcr" } }, "MedialVoxel_FORMAT_TEXT=ON"),
#endif
  };
  return formats;
}

/** The format of folders and patterns of images, each of which is a slice. */
const VolumeFormat &
GetSeriesFormat()
{
#ifdef MEDIALVOXEL_FORMAT_SLICES
  static const VolumeFormat series = MakeSeriesFormat();
#else
  static const VolumeFormat series = LeaveOutSeries();
#endif
  return series;
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

/** Fails with a message about the name; \a remedy lists the alternatives. */
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

/** Extensions of the built formats for which isWanted(format) is true. */
template <typename TIsWanted>
std::vector<std::string>
ListExtensions(TIsWanted && isWanted)
{
  std::vector<std::string> extensions;
  for (const VolumeFormat & format : GetFormats())
  {
    for (const VolumeExtension & extension : format.extensions)
    {
      if (format.remedy.empty() && isWanted(format))
      {
        extensions.emplace_back(extension.text);
      }
    }
  }
  return extensions;
}

/** The first format with the extension of the name; null when none has it. */
const VolumeFormat *
FindNamedFormat(const std::filesystem::path & fileName)
{
  const std::vector<VolumeFormat> & formats = GetFormats();
  const auto                        found = std::find_if(
    formats.begin(), formats.end(), [&](const VolumeFormat & format) { return FindExtension(format, fileName); });
  return found == formats.end() ? nullptr : &*found;
}

/** The result of FindInputFormat(), built or not. */
const VolumeFormat &
FindReadFormat(const std::filesystem::path & fileName)
{
  std::error_code            error;
  const auto                 status = std::filesystem::status(fileName, error);
  const VolumeFormat * const named = FindNamedFormat(fileName);
  const bool                 isNamedFolder = named && std::filesystem::is_directory(status);
  for (const VolumeFormat & format : GetFormats())
  {
    if (format.IsFolder() && ((isNamedFolder && named == &format) || format.input.isFolder(fileName)))
    {
      return format;
    }
  }
  // A folder with the name of a file is more likely a mistake than a series.
  const VolumeFormat & series = GetSeriesFormat();
  if (!(named && std::filesystem::exists(status)) && series.input.isKnown(fileName))
  {
    return series;
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    OpenRegularFile(fileName); // its error names the kind of the file
  }
  if (named)
  {
    return *named;
  }
  if (!std::filesystem::exists(status))
  {
    Fail(ExitStatus::Failure, "cannot open ", fileName.string(), ": no such file or folder");
  }
  if (FindExtension(series, fileName))
  {
    return series;
  }
  RefuseExtension(
    fileName,
    "headerless files are read with --raw-size and --raw-type, series of slices by their folder or a pattern such as "
    "'scan/*.png', and files that end with " +
      JoinExtensions(ListInputExtensions(), ", "));
}

void
RequireFormat(const VolumeFormat & format, const std::filesystem::path & fileName)
{
  if (!format.remedy.empty())
  {
    RefuseMissingFormat(fileName, format.name, format.remedy);
  }
}

} // namespace

const VolumeFormat &
GetRawFormat()
{
  static const VolumeFormat raw{ "raw", {}, { nullptr, DataSizeCheck::Exactly, nullptr, MakeRawImageIO } };
  return raw;
}

const VolumeFormat &
FindInputFormat(const std::filesystem::path & fileName)
{
  const VolumeFormat & format = FindReadFormat(fileName);
  RequireFormat(format, fileName);
  return format;
}

OutputFormat
FindOutputFormat(const std::filesystem::path & fileName)
{
  const VolumeFormat * const format = FindNamedFormat(fileName);
  if (!format || !format->writer)
  {
    RefuseExtension(fileName, "volumes are written as " + JoinExtensions(ListOutputExtensions(), " or "));
  }
  RequireFormat(*format, fileName);
  return { *format, *FindExtension(*format, fileName) };
}

std::vector<std::string>
ListInputExtensions()
{
  return ListExtensions([](const VolumeFormat &) { return true; });
}

std::vector<std::string>
ListInputFormats()
{
  std::vector<std::string> names;
  for (const VolumeFormat & format : GetFormats())
  {
    if (format.remedy.empty() && (names.empty() || names.back() != format.name)) // some have several rows
    {
      names.emplace_back(format.name);
    }
  }
  return names;
}

std::vector<std::string>
ListOutputExtensions(unsigned int components)
{
  return ListExtensions([components](const VolumeFormat & format) {
    return format.writer && (components == 1 || format.writer->hasComponents);
  });
}

bool
IsPackedVolume(const std::filesystem::path & fileName, Compression compression)
{
  const VolumeExtension & extension = FindOutputFormat(fileName).extension;
  const bool              isWanted = compression == Compression::On || compression == Compression::Gzip;
  return extension.isPacked || (isWanted && extension.canPack);
}

bool
IsPackedInAnyWay(const std::filesystem::path & fileName, const JobOptions & options)
{
  const bool packsChunks = FindOutputFormat(fileName).format.writer->packsChunks;
  return IsPackedVolume(fileName, options.compression) ||
         (packsChunks && GetZarrCompression(options.compression) != ZarrCompression::None);
}

/** How volumes of a format can be packed. */
static std::vector<Compression>
ListCompressions(const VolumeWriter & writer, const VolumeExtension & extension)
{
  const bool               packs = extension.canPack || writer.packsChunks;
  std::vector<Compression> list;
  packs ? list.push_back(Compression::On) : void();
  packs && !writer.packsAsZlib ? list.push_back(Compression::Gzip) : void();
  writer.packsChunks ? list.push_back(Compression::BloscZstd) : void();
  !extension.isPacked ? list.push_back(Compression::None) : void();
  return list;
}

void
CheckOutputFormat(const std::filesystem::path & fileName,
                  const VolumeGeometry &        geometry,
                  const VoxelLayout &           layout,
                  Compression                   compression)
{
  const auto [format, extension] = FindOutputFormat(fileName);
  const std::vector<Compression> known = ListCompressions(*format.writer, extension);
  if (compression != Compression::Default && std::find(known.begin(), known.end(), compression) == known.end())
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": --compress ",
         GetName(compression),
         " is not for ",
         extension.text,
         ", which has ",
         Join(known, " or ", [](Compression one) { return GetName(one); }),
         *extension.remedy != '\0' ? "; " : "",
         extension.remedy);
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
  return (IsPackedVolume(fileName, options.compression) ? PackedVolume::GetMemory() : 0) +
         (writer.getMemory ? writer.getMemory(geometry, layout, options) : 0);
}

std::uint64_t
GetOutputSize(const std::filesystem::path & fileName, const VolumeGeometry & geometry, const VoxelLayout & layout)
{
  const VolumeWriter & writer = *FindOutputFormat(fileName).format.writer;
  return geometry.GetNumberOfVoxels() * layout.GetBytes() +
         (writer.getFurtherSize ? writer.getFurtherSize(geometry, layout) : 0);
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
