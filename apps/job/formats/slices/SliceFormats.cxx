// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SliceFormats.h"

#include "HeaderParsing.h"
#include "Text.h"

#include "itkMedialVoxelFileRegion.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

[[maybe_unused]] SliceFormat
LeaveOut(const char * name, const std::vector<const char *> & extensions, const char * library)
{
  return { name, extensions, false, nullptr, nullptr, nullptr, 0, library };
}

/** The one place that knows all formats of slices, in the order in which messages list them. */
const std::vector<SliceFormat> &
GetSliceFormats()
{
  static const std::vector<SliceFormat> formats{
    MakeDicomSliceFormat(),
#ifdef MEDIALVOXEL_WITH_TIFF
    MakeTiffSliceFormat(),
#else
    LeaveOut("TIFF", { ".tif", ".tiff" }, "libtiff 4.5 or later"),
#endif
#ifdef MEDIALVOXEL_WITH_PNG
    MakePngSliceFormat(),
#else
    LeaveOut("PNG", { ".png" }, "libpng"),
#endif
#ifdef MEDIALVOXEL_WITH_JPEG
    MakeJpegSliceFormat(),
#else
    LeaveOut("JPEG", { ".jpg", ".jpeg" }, "libjpeg"),
#endif
    MakeBmpSliceFormat(),
  };
  return formats;
}

} // namespace

const SliceFormat *
FindSliceFormat(const std::filesystem::path & fileName)
{
  const std::string extension = ToLower(fileName.extension().string());
  for (const SliceFormat & format : GetSliceFormats())
  {
    const bool isNamed =
      std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end();
    if (isNamed || (format.isKnown && format.isKnown(fileName)))
    {
      return &format;
    }
  }
  return nullptr;
}

std::string
DescribeSliceFormats()
{
  std::vector<SliceFormat> formats = GetSliceFormats();
  const auto               isMissing = [](const SliceFormat & format) { return *format.remedy != '\0'; };
  formats.erase(std::remove_if(formats.begin(), formats.end(), isMissing), formats.end());
  return Join(formats, ", ", [](const SliceFormat & format) { return std::string(format.name); });
}

void
CheckSliceSize(const SliceHeader & header, std::uint64_t fileSize, std::uint64_t ratio)
{
  const std::uint64_t bytes =
    itk::CheckedFileSize({ header.size[0], header.size[1], GetTraits(header.pixelType).bytes });
  if (bytes == 0 || bytes / ratio > fileSize)
  {
    RefuseHeader(header.fileName,
                 "its " + FormatSize({ header.size[0], header.size[1] }) + " voxels of " +
                   std::string(GetTraits(header.pixelType).name) + " cannot be in a file of " +
                   std::to_string(fileSize) + " bytes");
  }
}

void
RequireSameSlice(const SliceHeader & first, const SliceHeader & now)
{
  if (now.size != first.size || now.pixelType != first.pixelType)
  {
    RefuseHeader(first.fileName, "it changed its size or type while it was read");
  }
}

} // end namespace medialvoxel
