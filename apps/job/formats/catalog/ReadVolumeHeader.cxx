// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ReadVolumeHeader.h"

#include "HeaderParsing.h"
#include "LengthUnits.h"
#include "Resampling.h"
#include "SliceSeries.h"
#include "Text.h"
#include "VolumeFormats.h"

#include "itkMedialVoxelGridLimits.h"

#include "itkMedialVoxelHeaderText.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace medialvoxel
{
namespace
{

/** Deflate packs at most this many bytes into one. */
constexpr std::uint64_t MaximumDeflateRatio = 1032;

VolumeHeader
DescribeRawVolume(const std::filesystem::path & fileName, const RawDescription & raw)
{
  OpenRegularFile(fileName);
  VolumeHeader header;
  header.fileName = fileName;
  header.geometry.size = raw.size;
  header.pixelType = raw.pixelType;
  header.bigEndian = raw.bigEndian;
  header.dataFile = fileName;
  header.dataFileSize = GetDataFileSize(fileName, fileName);
  header.dataOffset = raw.headerSize;

  const size_t dimension = raw.size.size();
  header.geometry.spacing.assign(dimension, 1.0);
  header.geometry.origin.assign(dimension, 0.0);
  header.geometry.SetIdentityDirection();
  return header;
}

VolumeHeader
ReadLevel(const VolumeFormat & format, const std::filesystem::path & fileName, unsigned int level)
{
  if (format.input.readLevel == nullptr)
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": it has no level ",
         level,
         "; ",
         format.name,
         " has one size of an image, level 0");
  }
  return format.input.readLevel(fileName, level);
}

/** Lengths are measured along the axes, so that a direction must not stretch them. */
void
CheckDirection(const VolumeHeader & header, unsigned int axis)
{
  constexpr double            tolerance = 0.01;
  const std::vector<double> & direction = header.geometry.direction[axis];
  const double                length = std::sqrt(
    std::inner_product(direction.begin(), direction.end(), direction.begin(), 0.0, std::plus<>(), std::multiplies<>()));
  if (!(std::abs(length - 1.0) <= tolerance))
  {
    Fail(ExitStatus::CorruptInput,
         header.fileName.string(),
         ": the directions of its axes must have the length 1; that of axis ",
         axis,
         " is (",
         FormatNumbers(direction, ","),
         ")");
  }
}

void
CheckGeometry(const VolumeHeader & header)
{
  const VolumeGeometry & geometry = header.geometry;
  const std::string problem = itk::MedialVoxelGridLimits::FindProblem(geometry.size, geometry.spacing, geometry.origin);
  if (!problem.empty())
  {
    Fail(ExitStatus::CorruptInput, header.fileName.string(), ": ", problem);
  }
  for (unsigned int axis = 0; axis < geometry.GetDimension(); ++axis)
  {
    CheckDirection(header, axis);
  }
  const std::string shear = itk::MedialVoxelGridLimits::FindShear(geometry.direction);
  if (!shear.empty())
  {
    Fail(ExitStatus::CorruptInput,
         header.fileName.string(),
         ": ",
         shear,
         "; resample the volume to a straight grid first");
  }
}

void
ReplaceSpacing(VolumeHeader & header, const std::vector<double> & spacing)
{
  if (spacing.size() != header.geometry.GetDimension())
  {
    Fail(ExitStatus::Usage,
         header.fileName.string(),
         ": --spacing ",
         FormatNumbers(spacing, ","),
         " has ",
         spacing.size(),
         " values; the volume has ",
         header.geometry.GetDimension(),
         " axes");
  }
  header.geometry.spacing = spacing;
  const auto isKnown = [](const Warning & warning) { return warning.code == HeaderWarnings::UnknownSpacing; };
  header.warnings.erase(std::remove_if(header.warnings.begin(), header.warnings.end(), isKnown), header.warnings.end());
}

/** A typing error is no fault of the file. */
void
CheckTypedSpacing(const VolumeHeader & header)
{
  const VolumeGeometry &    geometry = header.geometry;
  const std::vector<double> origin(geometry.size.size(), 0.0);
  const std::string         problem = itk::MedialVoxelGridLimits::FindProblem(geometry.size, geometry.spacing, origin);
  if (!problem.empty())
  {
    Fail(ExitStatus::Usage, "--spacing is ", FormatNumbers(geometry.spacing, ","), ": ", problem);
  }
}

/** The voxels must be in the data file, or packed voxels could be. */
void
CheckDataSize(const VolumeHeader & header)
{
  const DataSizeCheck check = header.format->input.sizeCheck;
  if (!header.segments.empty() || check == DataSizeCheck::ByReader)
  {
    return; // each segment was compared with its file when it was located
  }
  const std::uint64_t dataSize = header.GetDataSize();
  const std::uint64_t available = header.dataFileSize < header.dataOffset ? 0 : header.dataFileSize - header.dataOffset;
  const bool          exact = check == DataSizeCheck::Exactly;
  const bool          fits = header.compressed ? dataSize / MaximumDeflateRatio <= available
                                               : dataSize <= available && (!exact || dataSize == available);
  if (fits)
  {
    return;
  }
  std::string remedy;
  if (header.format == &GetRawFormat() && header.dataFileSize > dataSize)
  {
    const std::string bytes = std::to_string(header.dataFileSize - dataSize);
    remedy = "; a header of " + bytes + " bytes would fit, --raw-type " +
             std::string(GetTraits(header.pixelType).name) + ":" + bytes + (header.bigEndian ? ":big" : "");
  }
  Fail(ExitStatus::CorruptInput,
       header.dataFile.string(),
       " has ",
       header.dataFileSize,
       " bytes; ",
       FormatSize(header.geometry.size),
       " voxels of ",
       GetTraits(header.pixelType).name,
       header.compressed ? " cannot be packed into what follows " : " need ",
       header.compressed ? "" : std::to_string(dataSize) + " after ",
       header.dataOffset,
       exact ? " bytes of header, no more and no less" : " bytes of header",
       remedy);
}

/** "DICOM series UID, 108 files, a to b" */
std::string
DescribeSlices(const SliceSeries & series)
{
  const SliceHeader & first = series.slices.front();
  const SliceHeader & last = series.slices.back();
  const bool          isOneFile = first.fileName == last.fileName;
  const std::string   things = first.frameNumber > 0 ? " frame" : " file";
  return std::string(series.format->name) + (first.series.empty() ? "" : " series " + first.series) + ", " +
         std::to_string(series.slices.size()) + things + (series.slices.size() == 1 ? ", " : "s, ") +
         first.fileName.string() + (isOneFile ? "" : " to " + last.fileName.string());
}

} // namespace

VolumeHeader
ReadVolumeHeader(const std::filesystem::path &         fileName,
                 const std::optional<RawDescription> & raw,
                 const std::vector<double> &           spacing,
                 unsigned int                          level,
                 const SliceChoice &                   slices)
try
{
  const VolumeFormat & format = raw ? GetRawFormat() : FindInputFormat(fileName);
  if (slices.IsGiven() && !format.input.readChoice)
  {
    Fail(ExitStatus::Usage,
         fileName.string(),
         ": ",
         slices.series.empty() ? "--slices" : "--series",
         " needs a folder or a pattern of slices; this is ",
         format.name);
  }
  SliceChoice choice = slices;
  choice.hasSpacing = !spacing.empty();
  VolumeHeader header = raw                       ? DescribeRawVolume(fileName, *raw)
                        : level > 0               ? ReadLevel(format, fileName, level)
                        : format.input.readChoice ? format.input.readChoice(fileName, choice)
                                                  : format.input.readHeader(fileName);
  header.format = &format;
  if (!spacing.empty())
  {
    ReplaceSpacing(header, spacing);
    CheckTypedSpacing(header);
  }
  CheckDataSize(header);
  CheckGeometry(header);
  if (const std::uint64_t bytes = GetTrailingSize(header))
  {
    header.warnings.push_back(
      { HeaderWarnings::DataBehindVoxels,
        itk::MedialVoxelText::MakePrintable(header.dataFile.string()) + " goes on for " + std::to_string(bytes) +
          " bytes behind its last voxel; compare sizes and type of its header with what wrote it",
        { { "bytes", static_cast<double>(bytes) } } });
  }
  return header;
}
catch (const HeaderError & error)
{
  const bool isUnreadable = error.GetKind() == HeaderError::Kind::Unreadable;
  throw JobError(isUnreadable ? ExitStatus::Failure : ExitStatus::CorruptInput, error.what());
}

VolumeHeader
ReadInputHeader(const JobOptions & options)
{
  const VolumeHeader header =
    ReadVolumeHeader(options.input, options.raw, options.spacing, options.level, options.slices);
  const bool resamples = options.resample && *options.resample != KeepSpacing;
  return resamples ? ResampleHeader(header, *options.resample) : header;
}

VolumeHeader
ReadSheetInputHeader(const JobOptions & options)
{
  const VolumeHeader header = ReadInputHeader(options);
  if (options.resample || itk::MedialVoxelGridLimits::FindInaccuracy(GetGrid(header)).empty())
  {
    return header;
  }
  try
  {
    return ResampleHeader(header, 0.0);
  }
  catch (const JobError & error)
  {
    Fail(error.GetStatus(), error.what(), "; --resample off keeps the spacing of the file");
  }
}

std::uint64_t
GetTrailingSize(const VolumeHeader & header)
{
  if (header.compressed || header.format->input.sizeCheck != DataSizeCheck::AtLeast)
  {
    return 0;
  }
  if (header.segments.empty())
  {
    const std::uint64_t end = header.dataOffset + header.GetDataSize();
    return header.dataFileSize - std::min(header.dataFileSize, end);
  }
  std::uint64_t bytes = 0;
  for (const itk::MedialVoxelFileSegment & segment : header.segments)
  {
    const std::uint64_t size = itk::MedialVoxelText::GetDataFileSize(header.fileName, segment.fileName);
    bytes += size - std::min(size, segment.offset + segment.numberOfBytes);
  }
  return bytes;
}

TextTable
DescribeHeader(const VolumeHeader & seen)
{
  const VolumeHeader &         header = seen.GetStored();
  const VolumeGeometry * const resampled = seen.stored ? &seen.geometry : nullptr;
  TextTable                    table;
  table.emplace_back("file", header.fileName.string());
  table.emplace_back("format", header.format->name);
  if (header.numberOfLevels > 1)
  {
    table.emplace_back("level", std::to_string(header.level) + " of 0 to " + std::to_string(header.numberOfLevels - 1));
  }
  table.emplace_back("size", FormatSize(header.geometry.size));
  table.emplace_back("spacing", FormatNumbers(header.geometry.spacing, " x "));
  table.emplace_back("unit", header.geometry.inMillimeters ? "mm" : "not told");
  table.emplace_back("origin", FormatNumbers(header.geometry.origin, ", "));
  if (resampled)
  {
    table.emplace_back("resampled", FormatSize(resampled->size) + " at " + FormatNumbers(resampled->spacing, " x "));
  }
  table.emplace_back("type", std::string(GetTraits(header.pixelType).name));
  table.emplace_back("voxels", std::to_string(header.geometry.GetNumberOfVoxels()));
  table.emplace_back("bytes", std::to_string(header.GetDataSize()) + " (" + FormatBytes(header.GetDataSize()) + ")");
  if (const std::uint64_t behind = GetTrailingSize(header))
  {
    table.emplace_back("bytes behind them", std::to_string(behind) + ", which the header does not tell of");
  }
  if (header.series)
  {
    table.emplace_back("slices", itk::MedialVoxelText::MakePrintable(DescribeSlices(*header.series)));
  }
  else if (header.dataFile != header.fileName)
  {
    table.emplace_back("data file", itk::MedialVoxelText::MakePrintable(header.dataFile.string()));
  }
  table.emplace_back("reading", header.DescribeReading());
  return table;
}

} // end namespace medialvoxel
