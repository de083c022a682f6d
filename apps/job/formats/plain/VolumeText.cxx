// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "VolumeText.h"

#include "NrrdSegments.h"
#include "Text.h"

#include "itkByteSwapper.h"
#include "itkMedialVoxelNrrdHeader.h"

namespace medialvoxel
{
namespace
{

std::string
SizeText(const VolumeGeometry & geometry)
{
  return Join(geometry.size, " ", [](std::uint64_t size) { return std::to_string(size); });
}

} // namespace

std::string
MakeMetaImageText(const VolumeGeometry &               geometry,
                  const VoxelLayout &                  layout,
                  const std::string &                  dataFile,
                  const std::optional<std::uint64_t> & packedSize)
{
  const bool  bigEndian = itk::ByteSwapper<int>::SystemIsBigEndian();
  const auto  axisText = [](const std::vector<double> & axis) { return FormatNumbers(axis, " "); };
  std::string text = "ObjectType = Image\n";
  text += "NDims = " + std::to_string(geometry.GetDimension()) + "\n";
  text += "BinaryData = True\n";
  text += std::string("BinaryDataByteOrderMSB = ") + (bigEndian ? "True" : "False") + "\n";
  text += std::string("CompressedData = ") + (packedSize ? "True" : "False") + "\n";
  if (packedSize)
  {
    constexpr std::size_t digits = 20;
    const std::string     number = std::to_string(*packedSize);
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
MakeNrrdText(const VolumeGeometry &               geometry,
             const VoxelLayout &                  layout,
             const std::string &                  dataFile,
             const std::optional<std::uint64_t> & packedSize)
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
  header.encoding = packedSize ? "gzip" : "raw";
  if (layout.segments != nullptr)
  {
    header.keyValues = MakeNrrdSegments(*layout.segments, geometry.size);
  }
  if (!dataFile.empty())
  {
    header.dataFiles = { dataFile };
  }
  return MakeMedialVoxelNrrdText(header);
}

} // end namespace medialvoxel
