// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FormatRows.h"
#include "HeaderParsing.h"
#include "LengthUnits.h"
#include "NrrdSegments.h"
#include "VolumeText.h"

#include "itkMedialVoxelNrrdHeader.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

void
LocateVoxels(VolumeHeader & header, const itk::MedialVoxelNrrdHeader & nrrd)
{
  if (!header.compressed)
  {
    header.segments = LocateMedialVoxelNrrdVoxels(nrrd);
    header.dataOffset = header.segments.front().offset;
    return;
  }
  if (nrrd.byteSkip < 0)
  {
    RefuseHeader(header.fileName, "byte skip is '-1'; with compressed voxels it must be a whole number from 0 on");
  }
  header.dataOffset = SkipMedialVoxelNrrdLines(nrrd, header.dataFile);
  // Bytes are skipped in the unpacked data.
  header.skipAfterInflation = static_cast<std::uint64_t>(nrrd.byteSkip);
}

/** The texts between quotes of a field. */
std::vector<std::string>
ReadQuoted(const itk::MedialVoxelNrrdHeader & nrrd, const char * field)
{
  const auto               found = nrrd.fields.find(field);
  const std::string        text = found == nrrd.fields.end() ? "" : found->second;
  std::vector<std::string> texts;
  for (std::size_t begin = text.find('"'); begin != std::string::npos;)
  {
    const std::size_t end = std::min(text.find('"', begin + 1), text.size());
    texts.push_back(text.substr(begin + 1, end - begin - 1));
    begin = text.find('"', end + 1);
  }
  return texts;
}

VolumeHeader
ReadNrrdHeader(const std::filesystem::path & fileName)
{
  const itk::MedialVoxelNrrdHeader nrrd = itk::ReadMedialVoxelNrrdHeader(fileName);
  if (nrrd.componentKind == "list" && HasNrrdSegments(nrrd.keyValues))
  {
    RefuseHeader(
      fileName,
      "it is a segmentation with " + std::to_string(nrrd.numberOfComponents) +
        " layers, as its segments overlap; only one layer is read. In 3D Slicer, export a label map, or each "
        "layer's segments to a file of their own");
  }
  if (!nrrd.componentKind.empty())
  {
    RefuseHeader(fileName,
                 "an axis is of the kind '" + nrrd.componentKind +
                   "'; only one value per voxel is read, not vectors or colors");
  }
  if (nrrd.encoding != "raw" && nrrd.encoding != "gzip" && nrrd.encoding != "gz")
  {
    RefuseHeader(fileName, "encoding is '" + nrrd.encoding + "'; only raw and gzip are read");
  }
  if (nrrd.dataFiles.size() > 1 && nrrd.encoding != "raw")
  {
    RefuseHeader(fileName,
                 "data file is '" + nrrd.fields.at("datafile") +
                   "'; voxels spread over several files are read only with raw encoding, not with " + nrrd.encoding);
  }

  VolumeHeader header;
  header.fileName = fileName;
  header.geometry.size = nrrd.size;
  header.geometry.spacing = nrrd.spacing;
  header.geometry.origin = nrrd.origin;
  header.geometry.direction = nrrd.direction;
  const std::vector<std::string> unitsOfSpace = ReadQuoted(nrrd, "spaceunits");
  ApplyUnits(header, unitsOfSpace.empty() ? ReadQuoted(nrrd, "units") : unitsOfSpace);
  header.pixelType = *PixelTypeFromName(nrrd.componentType);
  header.bigEndian = nrrd.bigEndian;
  header.compressed = nrrd.encoding != "raw";
  header.dataFile = nrrd.dataFiles.front();
  header.dataFileSize = GetDataFileSize(fileName, header.dataFile);
  LocateVoxels(header, nrrd);
  return header;
}

} // namespace

VolumeFormat
MakeNrrdFormat()
{
  VolumeInput input = MakePlainInput(ReadNrrdHeader);
  input.readSegments = ReadNrrdSegments;
  VolumeWriter writer;
  writer.makeHeader = MakeNrrdText;
  return {
    "NRRD", { { ".nrrd", false, false, true }, { ".nhdr", true, false, false, DetachedRemedy } }, input, writer
  };
}

} // end namespace medialvoxel
