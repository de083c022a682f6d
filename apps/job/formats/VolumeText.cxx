// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeText.h"

#include "NiftiText.h"
#include "Text.h"

#include "itkByteSwapper.h"
#include "itkMedialVoxelNrrdHeader.h"

#include <array>

namespace medialvoxel
{
namespace
{

struct FormatOfName
{
  const char * extension;
  VolumeFormat format;
  bool         isPacked; ///< always
  bool         canPack;  ///< when asked for
  const char * remedy;   ///< what to name instead when it cannot
};

constexpr const char * DetachedRemedy = "its voxels are in a file of their own; .mha and .nrrd can be packed";

constexpr std::array<FormatOfName, 7> Formats{ {
  { ".mha", VolumeFormat::MetaImage, false, true, "" },
  { ".mhd", VolumeFormat::MetaImageDetached, false, false, DetachedRemedy },
  { ".nrrd", VolumeFormat::Nrrd, false, true, "" },
  { ".nhdr", VolumeFormat::NrrdDetached, false, false, DetachedRemedy },
  { ".nii", VolumeFormat::Nifti, false, false, "name it .nii.gz" },
  { ".nii.gz", VolumeFormat::Nifti, true, true, "" },
  { ".zarr", VolumeFormat::Zarr, false, false, "" },
} };

/** True when the components of a voxel may lie beside each other. */
bool
HasComponents(VolumeFormat format)
{
  return format != VolumeFormat::Nifti;
}

std::string
JoinExtensions(const std::vector<std::string> & extensions)
{
  return Join(extensions, " or ", [](const std::string & extension) { return extension; });
}

const FormatOfName &
FindFormat(const std::filesystem::path & fileName)
{
  const std::string name = ToLower(fileName.filename().string());
  for (const FormatOfName & known : Formats)
  {
    const std::string end = known.extension;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
    {
      return known;
    }
  }
  const std::string extension = ToLower(fileName.extension().string());
  Fail(ExitStatus::Usage,
       fileName.string(),
       ": unknown format",
       extension.empty() ? ", its name has no extension" : " '" + extension + "'",
       "; volumes are written as ",
       JoinExtensions(ListVolumeExtensions()));
}

std::string
SizeText(const VolumeGeometry & geometry)
{
  return Join(geometry.size, " ", [](std::uint64_t size) { return std::to_string(size); });
}

std::string
MakeMetaImageText(const VolumeGeometry &               geometry,
                  const VoxelLayout &                  layout,
                  const std::string &                  dataFile,
                  const std::optional<std::uint64_t> & packedBytes)
{
  const bool  bigEndian = itk::ByteSwapper<int>::SystemIsBigEndian();
  const auto  axisText = [](const std::vector<double> & axis) { return FormatNumbers(axis, " "); };
  std::string text = "ObjectType = Image\n";
  text += "NDims = " + std::to_string(geometry.GetDimension()) + "\n";
  text += "BinaryData = True\n";
  text += std::string("BinaryDataByteOrderMSB = ") + (bigEndian ? "True" : "False") + "\n";
  text += std::string("CompressedData = ") + (packedBytes ? "True" : "False") + "\n";
  if (packedBytes)
  {
    constexpr std::size_t digits = 20;
    const std::string     number = std::to_string(*packedBytes);
    text += "CompressedDataSize = " + std::string(digits - number.size(), '0') + number + "\n";
  }
  text += "TransformMatrix = " + Join(geometry.direction, " ", axisText) + "\n";
  text += "Offset = " + FormatNumbers(geometry.origin, " ") + "\n";
  text += "ElementSpacing = " + FormatNumbers(geometry.spacing, " ") + "\n";
  text += "DimSize = " + SizeText(geometry) + "\n";
  if (layout.components > 1)
  {
    text += "ElementNumberOfChannels = " + std::to_string(layout.components) + "\n";
  }
  text += "ElementType = " + std::string(GetTraits(layout.pixelType).metaName) + "\n";
  text += "ElementDataFile = " + (dataFile.empty() ? "LOCAL" : dataFile) + "\n";
  return text;
}

std::string
MakeNrrdText(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & dataFile, bool isPacked)
{
  itk::MedialVoxelNrrdHeader header;
  header.size = geometry.size;
  header.spacing = geometry.spacing;
  header.origin = geometry.origin;
  header.direction = geometry.direction;
  header.componentType = std::string(GetTraits(layout.pixelType).name);
  header.componentKind = layout.components > 1 ? "vector" : "";
  header.numberOfComponents = layout.components;
  header.bigEndian = itk::ByteSwapper<int>::SystemIsBigEndian();
  header.encoding = isPacked ? "gzip" : "raw";
  if (!dataFile.empty())
  {
    header.dataFiles = { dataFile };
  }
  return MakeMedialVoxelNrrdText(header);
}

} // namespace

VolumeFormat
GetVolumeFormat(const std::filesystem::path & fileName)
{
  return FindFormat(fileName).format;
}

std::vector<std::string>
ListVolumeExtensions(unsigned int components)
{
  std::vector<std::string> extensions;
  for (const FormatOfName & known : Formats)
  {
    if (components == 1 || HasComponents(known.format))
    {
      extensions.emplace_back(known.extension);
    }
  }
  return extensions;
}

bool
IsPackedVolume(const std::filesystem::path & fileName, bool compress)
{
  const FormatOfName & known = FindFormat(fileName);
  return known.isPacked || (compress && known.canPack);
}

void
CheckVolumeFormat(const std::filesystem::path & fileName,
                  const VolumeGeometry &        geometry,
                  const VoxelLayout &           layout,
                  bool                          compress)
{
  const FormatOfName & known = FindFormat(fileName);
  if (compress && !known.canPack && *known.remedy != '\0')
  {
    Fail(ExitStatus::Usage, fileName.string(), " cannot be packed: ", known.remedy);
  }
  if (layout.components > 1 && !HasComponents(known.format))
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": vectors are not written as ",
         known.extension,
         ", which keeps their components apart; they are written as ",
         JoinExtensions(ListVolumeExtensions(layout.components)));
  }
  if (known.format != VolumeFormat::Nifti)
  {
    return;
  }
  for (const std::uint64_t size : geometry.size)
  {
    if (size > LargestNiftiSize)
    {
      Fail(ExitStatus::Usage,
           fileName.string(),
           ": the volume has ",
           size,
           " voxels along an axis, NIfTI has up to ",
           LargestNiftiSize);
    }
  }
}

bool
HasDataFile(VolumeFormat format)
{
  return format == VolumeFormat::MetaImageDetached || format == VolumeFormat::NrrdDetached;
}

std::string
MakeHeaderText(VolumeFormat                         format,
               const VolumeGeometry &               geometry,
               const VoxelLayout &                  layout,
               const std::string &                  dataFile,
               const std::optional<std::uint64_t> & packedBytes)
{
  if (format == VolumeFormat::Nifti)
  {
    return MakeNiftiHeader(geometry, layout);
  }
  const bool isMetaImage = format == VolumeFormat::MetaImage || format == VolumeFormat::MetaImageDetached;
  return isMetaImage ? MakeMetaImageText(geometry, layout, dataFile, packedBytes)
                     : MakeNrrdText(geometry, layout, dataFile, packedBytes.has_value());
}

} // end namespace medialvoxel
