// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The library's reader of NRRD headers, the ImageIO on top of it, and the program's use of it.

#include "FuzzVolume.h"
#include "NrrdSegments.h"

#include "itkMedialVoxelHeaderText.h"
#include "itkMedialVoxelNrrdHeader.h"
#include "itkStreamingNrrdImageIO.h"

namespace
{

using namespace MedialVoxelFuzz;

/** What a header says survives being written and read again. */
void
CheckRoundTrip(itk::MedialVoxelNrrdHeader header)
{
  static const InputFile copy("copy.nrrd");
  header.fileName = copy.GetPath();
  header.dataFiles.clear();
  const std::string text = MakeMedialVoxelNrrdText(header);
  copy.Write(reinterpret_cast<const std::uint8_t *>(text.data()), text.size());
  const itk::MedialVoxelNrrdHeader again = itk::ReadMedialVoxelNrrdHeader(copy.GetPath());
  Require(again.size == header.size && again.numberOfComponents == header.numberOfComponents &&
            again.componentType == header.componentType && again.bigEndian == header.bigEndian &&
            again.keyValues == header.keyValues,
          "another header after writing and reading it:\n" + text);
}

/** The names of segments survive being written and read again. */
void
CheckSegments(const itk::MedialVoxelNrrdHeader & header)
{
  using namespace medialvoxel;
  const std::vector<Segment> segments = ParseNrrdSegments(header.fileName, header.keyValues).GetSegments();
  SegmentTable               table;
  for (const Segment & segment : segments)
  {
    Require(table.Add(segment), "a label is there twice");
  }
  const std::vector<Segment> again =
    ParseNrrdSegments(header.fileName, MakeNrrdSegments(table, header.size)).GetSegments();
  Require(again.size() == segments.size(), "another number of segments");
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const bool hasName = !segments[i].name.empty();
    Require(again[i].label == segments[i].label && again[i].color == segments[i].color &&
              (!hasName || again[i].name == segments[i].name),
            "another segment after writing and reading it");
  }
}

void
ReadByLibrary(const InputFile & file)
try
{
  const itk::MedialVoxelNrrdHeader header = itk::ReadMedialVoxelNrrdHeader(file.GetPath());
  Require(itk::CheckedFileSize({ header.GetNumberOfBytes() }) > 0, "no valid number of bytes");
  Require(!header.dataFiles.empty(), "no data file");
  CheckRoundTrip(header);
  CheckSegments(header);
  LocateMedialVoxelNrrdVoxels(header);
}
catch (const itk::MedialVoxelText::HeaderError & error)
{
  file.RequireClearError(error.what());
}

void
ReadByImageIO(const InputFile & file)
try
{
  auto io = itk::StreamingNrrdImageIO::New();
  if (!io->CanReadFile(file.GetPath().c_str()))
  {
    return;
  }
  io->SetFileName(file.GetPath().string());
  io->ReadImageInformation();
  constexpr itk::ImageIOBase::SizeType maximumBytes = 1 << 20;
  if (io->GetImageSizeInBytes() <= maximumBytes)
  {
    itk::ImageIORegion region(io->GetNumberOfDimensions());
    for (unsigned int axis = 0; axis < io->GetNumberOfDimensions(); ++axis)
    {
      region.SetSize(axis, io->GetDimensions(axis));
    }
    io->SetIORegion(region);
    std::vector<char> voxels(static_cast<std::size_t>(io->GetImageSizeInBytes()));
    io->Read(voxels.data());
  }
}
catch (const itk::ExceptionObject & error)
{
  file.RequireClearError(error.GetDescription());
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const InputFile file("in.nrrd");
  file.Write(data, size);
  ReadByLibrary(file);
  ReadByImageIO(file);
  ReadVolume(file);
  return 0;
}
