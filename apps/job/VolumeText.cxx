// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeText.h"

#include "Text.h"

#include "itkByteSwapper.h"
#include "itkMedialVoxelNrrdHeader.h"

#include <array>
#include <utility>

namespace medialvoxel
{
namespace
{

constexpr std::array<std::pair<const char *, VolumeFormat>, 5> Extensions{ {
  { ".mha", VolumeFormat::MetaImage },
  { ".mhd", VolumeFormat::MetaImageDetached },
  { ".nrrd", VolumeFormat::Nrrd },
  { ".nhdr", VolumeFormat::NrrdDetached },
  { ".zarr", VolumeFormat::Zarr },
} };

std::string
SizeText(const VolumeGeometry & geometry)
{
  return Join(geometry.size, " ", [](std::uint64_t size) { return std::to_string(size); });
}

std::string
MakeMetaImageText(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & dataFile)
{
  const bool  bigEndian = itk::ByteSwapper<int>::SystemIsBigEndian();
  const auto  axisText = [](const std::vector<double> & axis) { return FormatNumbers(axis, " "); };
  std::string text = "ObjectType = Image\n";
  text += "NDims = " + std::to_string(geometry.GetDimension()) + "\n";
  text += "BinaryData = True\n";
  text += std::string("BinaryDataByteOrderMSB = ") + (bigEndian ? "True" : "False") + "\n";
  text += "CompressedData = False\n";
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
MakeNrrdText(const VolumeGeometry & geometry, const VoxelLayout & layout, const std::string & dataFile)
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
  header.encoding = "raw";
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
  const std::string extension = ToLower(fileName.extension().string());
  for (const auto & [known, format] : Extensions)
  {
    if (extension == known)
    {
      return format;
    }
  }
  Fail(ExitStatus::Usage,
       fileName.string(),
       ": unknown format '",
       extension,
       "'; volumes are written as .mha, .mhd, .nrrd, .nhdr or .zarr");
}

bool
HasDataFile(VolumeFormat format)
{
  return format == VolumeFormat::MetaImageDetached || format == VolumeFormat::NrrdDetached;
}

std::string
MakeHeaderText(VolumeFormat           format,
               const VolumeGeometry & geometry,
               const VoxelLayout &    layout,
               const std::string &    dataFile)
{
  const bool isMetaImage = format == VolumeFormat::MetaImage || format == VolumeFormat::MetaImageDetached;
  return isMetaImage ? MakeMetaImageText(geometry, layout, dataFile) : MakeNrrdText(geometry, layout, dataFile);
}

} // end namespace medialvoxel
