// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ReadVolumeHeader.h"

#include "HeaderParsing.h"
#include "Resampling.h"
#include "Text.h"
#include "ZarrMetadata.h"

#include "itkMedialVoxelLimits.h"

#include <vnl/vnl_det.h>
#include <vnl/vnl_matrix_fixed.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

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
  header.format = "raw";
  header.geometry.size = raw.size;
  header.pixelType = raw.pixelType;
  header.bigEndian = raw.bigEndian;
  header.dataFile = fileName;
  header.dataFileSize = GetDataFileSize(fileName, fileName);
  header.dataOffset = raw.headerBytes;

  const size_t dimension = raw.size.size();
  header.geometry.spacing = raw.spacing.empty() ? std::vector<double>(dimension, 1.0) : raw.spacing;
  header.geometry.origin.assign(dimension, 0.0);
  header.geometry.SetIdentityDirection();
  return header;
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
  const std::string problem = itk::MedialVoxelLimits::FindProblem(geometry.size, geometry.spacing, geometry.origin);
  if (!problem.empty())
  {
    Fail(ExitStatus::CorruptInput, header.fileName.string(), ": ", problem);
  }
  const unsigned int             dimension = header.geometry.GetDimension();
  vnl_matrix_fixed<double, 3, 3> matrix;
  matrix.set_identity();
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    CheckDirection(header, axis);
    for (unsigned int row = 0; row < dimension; ++row)
    {
      matrix(row, axis) = header.geometry.direction[axis][row];
    }
  }
  const double determinant = vnl_det(matrix);
  if (!(std::abs(determinant) > 1e-6))
  {
    Fail(ExitStatus::CorruptInput,
         header.fileName.string(),
         ": the directions of its axes lie in one plane (determinant ",
         determinant,
         "); it must not be 0");
  }
}

void
ReplaceSpacing(VolumeHeader & header, const std::vector<double> & spacing)
{
  if (spacing.size() != header.geometry.GetDimension())
  {
    Fail(ExitStatus::Usage,
         header.fileName.string(),
         ": the spacing ",
         FormatNumbers(spacing, ","),
         " has ",
         spacing.size(),
         " values; the volume has ",
         header.geometry.GetDimension(),
         " axes");
  }
  header.geometry.spacing = spacing;
}

/** The voxels must be in the data file, or packed voxels could be. */
void
CheckDataSize(const VolumeHeader & header)
{
  if (!header.segments.empty() || header.format == TiffFormat || header.format == ZarrFormat)
  {
    return; // each stretch was compared with its file when it was located; each chunk is when it is read
  }
  const std::uint64_t voxelBytes = header.GetVoxelBytes();
  const std::uint64_t available = header.dataFileSize < header.dataOffset ? 0 : header.dataFileSize - header.dataOffset;
  const bool          exact = header.format == "raw";
  const bool          fits = header.compressed ? voxelBytes / MaximumDeflateRatio <= available
                                               : voxelBytes <= available && (!exact || voxelBytes == available);
  if (fits)
  {
    return;
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
       header.compressed ? "" : std::to_string(voxelBytes) + " after ",
       header.dataOffset,
       header.compressed ? " bytes of header" : (exact ? " bytes of header, no more and no less" : " bytes of header"));
}

using HeaderReader = VolumeHeader (*)(const std::filesystem::path &);

using Format = std::pair<const char *, HeaderReader>;

constexpr std::array Formats{
  Format{ ".mha", ReadMetaImageHeader }, Format{ ".mhd", ReadMetaImageHeader }, Format{ ".nrrd", ReadNrrdHeader },
  Format{ ".nhdr", ReadNrrdHeader },     Format{ ".nii", ReadNiftiHeader },     Format{ ".nii.gz", ReadNiftiHeader },
  Format{ ".zarr", ReadZarrHeader },
#ifdef MEDIALVOXEL_WITH_TIFF
  Format{ ".tif", ReadTiffHeader },      Format{ ".tiff", ReadTiffHeader },
#endif
};

HeaderReader
FindHeaderReader(const std::filesystem::path & fileName)
{
  std::error_code error;
  const auto      status = std::filesystem::status(fileName, error);
  const bool      isNamedZarr = ToLower(fileName.extension().string()) == ".zarr";
  if (IsZarrFolder(fileName) || (isNamedZarr && std::filesystem::is_directory(status)))
  {
    return ReadZarrHeader;
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    OpenRegularFile(fileName); // tells what it is
  }
  const std::string name = ToLower(fileName.filename().string());
  std::string       known;
  for (const auto & [extension, reader] : Formats)
  {
    const std::string end = extension;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
    {
      return reader;
    }
    known += (known.empty() ? "" : ", ") + end;
  }
  Fail(ExitStatus::Usage,
       fileName.string(),
       ": unknown format",
       fileName.has_extension() ? " '" + ToLower(fileName.extension().string()) + "'" : ", its name has no extension",
       "; ",
       known,
       " are read, and headerless files with --raw-size and --raw-type");
}

} // namespace

VolumeHeader
ReadVolumeHeader(const std::filesystem::path &         fileName,
                 const std::optional<RawDescription> & raw,
                 const std::vector<double> &           spacing)
try
{
  VolumeHeader header = raw ? DescribeRawVolume(fileName, *raw) : FindHeaderReader(fileName)(fileName);
  if (!spacing.empty())
  {
    ReplaceSpacing(header, spacing);
  }
  CheckDataSize(header);
  CheckGeometry(header);
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
  const VolumeHeader header = ReadVolumeHeader(options.input, options.raw, options.spacing);
  return options.resample ? ResampleHeader(header, *options.resample) : header;
}

} // end namespace medialvoxel
