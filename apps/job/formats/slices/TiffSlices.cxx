// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "HeaderParsing.h"
#include "SliceFormats.h"
#include "TiffReaders.h"

#include "itkMedialVoxelFileRegion.h"

namespace medialvoxel
{
namespace
{

VolumeHeader
ReadImage(const std::filesystem::path & fileName)
{
  VolumeHeader image = ReadTiffSliceHeader(fileName);
  if (image.geometry.GetDimension() != 2)
  {
    RefuseHeader(fileName,
                 "it has " + std::to_string(image.geometry.size.back()) +
                   " slices; a file of a series has one, and a stack in one file is named by itself");
  }
  return image;
}

SliceHeader
MakeHeader(const VolumeHeader & image)
{
  SliceHeader header;
  header.fileName = image.fileName;
  header.size = { { image.geometry.size[0], image.geometry.size[1] } };
  header.pixelType = image.pixelType;
  header.spacing = { { image.geometry.spacing[0], image.geometry.spacing[1] } };
  header.inMillimeters = image.geometry.inMillimeters;
  header.decoderMemory = image.decoderMemory;
  return header;
}

std::vector<SliceHeader>
ReadHeaders(const std::filesystem::path & fileName)
{
  return { MakeHeader(ReadImage(fileName)) };
}

void
ReadVoxels(const SliceHeader & expected, void * voxels)
{
  const VolumeHeader image = ReadImage(expected.fileName);
  RequireSameSlice(expected, MakeHeader(image));
  const std::uint64_t bytes = expected.GetDataSize();
  if (image.compressed || !image.liesInRows)
  {
    OpenTiffStream(image)->Read(voxels, bytes);
  }
  else
  {
    itk::MedialVoxelFileRegion({ bytes }, { 0 }, { bytes }, 1).Read(image.segments, voxels);
  }
  if (image.bigEndian != itk::MachineIsBigEndian())
  {
    itk::SwapComponentBytes(voxels, bytes, GetTraits(image.pixelType).bytes);
  }
}

} // namespace

SliceFormat
MakeTiffSliceFormat()
{
  return { "TIFF", { ".tif", ".tiff" }, false, nullptr, ReadHeaders, ReadVoxels, 0 };
}

} // end namespace medialvoxel
