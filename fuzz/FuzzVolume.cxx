// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FuzzVolume.h"

#include "ReadVolumeHeader.h"
#include "ValueReader.h"
#include "VolumeFormats.h"
#include "VolumeText.h"
#include "VoxelSource.h"

#include "itkStreamingRawImageIO.h"

#include <cmath>

namespace MedialVoxelFuzz
{
namespace
{

using namespace medialvoxel;

/** No way of packing that is read makes one byte out of more than this many. */
constexpr std::uint64_t MaximumRatio = 32768;

constexpr std::uint64_t MaximumBytesToRead = 1 << 20;

/** Each voxel may be a chunk, which is looked for. */
constexpr std::uint64_t MaximumBytesOfChunks = 1 << 12;

/** Of a chunk, while it is unpacked, and what a codec takes for itself. */
constexpr std::uint64_t MaximumCopies = 16;

void
CheckHeader(const VolumeHeader & header)
{
  const VolumeGeometry & geometry = header.geometry;
  const std::size_t      dimension = geometry.size.size();
  Require(dimension == 2 || dimension == 3, "the dimension is neither 2 nor 3");
  Require(geometry.spacing.size() == dimension && geometry.origin.size() == dimension &&
            geometry.direction.size() == dimension,
          "the geometry does not fit the dimension");
  for (std::size_t axis = 0; axis < dimension; ++axis)
  {
    Require(geometry.size[axis] > 0, "a size is 0");
    Require(geometry.spacing[axis] > 0 && std::isfinite(geometry.spacing[axis]), "a spacing is no length");
    Require(std::isfinite(geometry.origin[axis]), "an origin is not finite");
    Require(geometry.direction[axis].size() == dimension, "a direction does not fit the dimension");
  }
}

/** The voxels are in the files, or could be. */
void
CheckFiles(const VolumeHeader & header)
{
  std::uint64_t available = 0;
  for (const auto & [fileName, bytes] : GetNeededFileSizes(header))
  {
    available += std::filesystem::file_size(fileName);
    Require(header.compressed || bytes <= std::filesystem::file_size(fileName), "a file is shorter than its voxels");
  }
  // Several headers of slices may share their voxels.
  const std::uint64_t places = std::max<std::uint64_t>(1, header.segments.size());
  Require(header.GetDataSize() / MaximumRatio <= available * places, "more voxels than the file can hold");
}

/** The header of an output has the geometry of the input, to the last bit. */
void
CheckOutputHeader(const VolumeHeader & header)
{
  static const InputFile copy("copy.mha");
  const std::string      text = MakeMetaImageText(header.geometry, { header.pixelType, 1 }, "");
  copy.Write(reinterpret_cast<const std::uint8_t *>(text.data()), text.size());
  const VolumeHeader again = FindInputFormat(copy.GetPath()).input.readHeader(copy.GetPath());
  Require(again.geometry.size == header.geometry.size && again.geometry.spacing == header.geometry.spacing &&
            again.geometry.origin == header.geometry.origin && again.pixelType == header.pixelType,
          "another geometry after writing and reading it:\n" + text);
}

/** As a whole, part by part, and with a reader that keeps chunks: always the same. */
void
ReadChunks(const VolumeHeader & header)
{
  const std::uint64_t bytes = header.GetDataSize();
  const auto &        chunk = header.chunks->size;
  if (bytes > MaximumBytesOfChunks || chunk[0] * chunk[1] * chunk[2] > MaximumBytesToRead ||
      header.chunks->bytesPerThread > MaximumBytesToRead * MaximumCopies)
  {
    return;
  }
  itk::MedialVoxelBox box{ { { 0, 0, 0 } }, { { 1, 1, 1 } } };
  std::copy(header.geometry.size.begin(), header.geometry.size.end(), box.upper.begin());
  std::vector<char> whole(bytes);
  const auto        reader = MakeValueReader(header);
  reader->Read(box, whole.data());
  const auto keeping = MakeValueReader(header, Interpolation::Linear, MaximumBytesToRead)->MakeAnother();
  const auto valueBytes = static_cast<std::int64_t>(GetTraits(header.pixelType).bytes);
  for (std::int64_t z = 0; z < box.upper[2]; ++z)
  {
    itk::MedialVoxelBox slice = box;
    slice.lower[2] = z;
    slice.upper[2] = z + 1;
    std::vector<char> voxels(static_cast<std::size_t>(slice.NumberOfVoxels() * valueBytes));
    keeping->Read(slice, voxels.data());
    Require(std::equal(voxels.begin(), voxels.end(), whole.begin() + box.OffsetOf(slice.lower) * valueBytes),
            "slices differ from the whole");
  }
}

/** The program's way into slices. */
void
ReadSlices(const VolumeHeader & header)
{
  if (header.GetDataSize() <= MaximumBytesToRead)
  {
    itk::MedialVoxelBox box{ { { 0, 0, 0 } }, { { 1, 1, 1 } } };
    std::copy(header.geometry.size.begin(), header.geometry.size.end(), box.upper.begin());
    std::vector<char> voxels(header.GetDataSize());
    MakeValueReader(header)->Read(box, voxels.data());
  }
}

/** A reader of a part of voxels, as the program has it. */
itk::StreamingRawImageIO::Pointer
MakeReader(const VolumeHeader & header)
{
  const auto         imageIO = header.format->input.makeReader(header);
  const unsigned int dimension = header.geometry.GetDimension();
  imageIO->SetNumberOfDimensions(dimension);
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    imageIO->SetDimensions(axis, header.geometry.size[axis]);
  }
  imageIO->SetComponentType(DispatchPixelType(
    header.pixelType, [](auto zero) { return itk::ImageIOBase::MapPixelType<decltype(zero)>::CType; }));
  imageIO->SetFileName(header.dataFile.string());
  imageIO->SetHeaderSize(static_cast<itk::ImageIOBase::SizeType>(header.dataOffset));
  imageIO->SetRefuseTrailingBytes(false);
  imageIO->SetSegments(header.segments);
  imageIO->SetByteOrder(header.bigEndian ? itk::IOByteOrderEnum::BigEndian : itk::IOByteOrderEnum::LittleEndian);
  imageIO->ReadImageInformation();
  return imageIO;
}

/** The voxels from \a first along the slowest axis. */
std::vector<char>
ReadFrom(itk::StreamingRawImageIO & imageIO, const VolumeHeader & header, std::uint64_t first)
{
  const unsigned int dimension = header.geometry.GetDimension();
  itk::ImageIORegion region(dimension);
  std::uint64_t      bytes = GetTraits(header.pixelType).bytes;
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    const bool          isSlowest = axis + 1 == dimension;
    const std::uint64_t begin = isSlowest ? first : 0;
    region.SetIndex(axis, static_cast<itk::IndexValueType>(begin));
    region.SetSize(axis, header.geometry.size[axis] - begin);
    bytes *= header.geometry.size[axis] - begin;
  }
  std::vector<char> voxels(bytes);
  imageIO.SetIORegion(region);
  imageIO.Read(voxels.data());
  return voxels;
}

void
ReadVoxels(const VolumeHeader & header)
{
  const std::uint64_t bytes = header.GetDataSize();
  if (bytes > MaximumBytesToRead)
  {
    return;
  }
  if (header.compressed)
  {
    std::vector<unsigned char> voxels(bytes);
    OpenVoxelSource(header)->Read(0, voxels.data(), bytes);
    return;
  }
  const auto              imageIO = MakeReader(header);
  const std::vector<char> whole = ReadFrom(*imageIO, header, 0);
  const std::vector<char> end = ReadFrom(*imageIO, header, header.geometry.size.back() - 1);
  Require(std::equal(end.rbegin(), end.rend(), whole.rbegin()), "a part of the voxels differs from the whole");
}

} // namespace

void
ReadVolume(const InputFile & file, const std::optional<RawDescription> & raw)
try
{
  const VolumeHeader header = ReadVolumeHeader(file.GetPath(), raw);
  CheckHeader(header);
  CheckOutputHeader(header);
  if (header.chunks)
  {
    ReadChunks(header);
    return;
  }
  if (header.series)
  {
    ReadSlices(header);
    return;
  }
  CheckFiles(header);
  ReadVoxels(header);
}
catch (const JobError & error)
{
  Require(error.GetStatus() == ExitStatus::CorruptInput || error.GetStatus() == ExitStatus::Failure,
          "an unexpected status");
  file.RequireClearError(error.what());
}

} // namespace MedialVoxelFuzz
