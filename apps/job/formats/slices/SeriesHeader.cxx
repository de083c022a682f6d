// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "FormatRows.h"
#include "HeaderParsing.h"
#include "LengthUnits.h"
#include "SeriesGeometry.h"
#include "SeriesImageIO.h"
#include "SliceCache.h"
#include "SliceFormats.h"
#include "SliceNames.h"
#include "Text.h"

#include "itkMedialVoxelProgress.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace medialvoxel
{
namespace
{

using Files = std::vector<std::filesystem::path>;
using Slices = std::vector<SliceHeader>;

/** A file that the user named by a pattern must be a slice; others in a folder are left out. */
bool
IsFolder(const std::filesystem::path & input)
{
  std::error_code error;
  return std::filesystem::is_directory(input, error);
}

/** The files of the one format that they have. */
std::pair<const SliceFormat *, Files>
FindFormat(const std::filesystem::path & input, const Files & candidates)
{
  const SliceFormat * format = nullptr;
  Files               files;
  for (const std::filesystem::path & file : candidates)
  {
    itk::MedialVoxelCheckAbort();
    const SliceFormat * const own = FindSliceFormat(file);
    if (own && *own->remedy != '\0')
    {
      RefuseMissingFormat(file, own->name, own->remedy);
    }
    if (!own && IsFolder(input))
    {
      continue;
    }
    if (!own)
    {
      RefuseHeader(file, "it is not an image that can be a slice; those are " + DescribeSliceFormats());
    }
    if (format && own != format)
    {
      RefuseHeader(input,
                   files.front().string() + " is " + format->name + " and " + file.string() + " is " + own->name +
                     "; name the slices by a pattern such as " + (input / "*.tif").string());
    }
    format = own;
    files.push_back(file);
  }
  if (!format)
  {
    RefuseHeader(input, "there are no slices; those are images of " + DescribeSliceFormats());
  }
  return { format, files };
}

Slices
ReadHeaders(const std::filesystem::path & input, const SliceFormat & format, const Files & files)
{
  Slices slices;
  for (const std::filesystem::path & file : files)
  {
    itk::MedialVoxelCheckAbort();
    std::vector<SliceHeader> images = format.readHeaders(file);
    if (images.empty() && !IsFolder(input))
    {
      RefuseHeader(file, "it has no image");
    }
    std::move(images.begin(), images.end(), std::back_inserter(slices));
  }
  if (slices.empty())
  {
    RefuseHeader(input, "none of its " + std::to_string(files.size()) + " files has an image");
  }
  return slices;
}

/** "UID (108 slices of 512 x 512, 'description')" */
std::string
DescribeSeries(const Slices & slices)
{
  const SliceHeader & first = slices.front();
  return first.series + " (" + std::to_string(slices.size()) + (slices.size() == 1 ? " slice of " : " slices of ") +
         FormatSize({ first.size[0], first.size[1] }) +
         (first.description.empty() ? "" : ", '" + first.description + "'") + ")";
}

/** Slices of the series that is wanted, or of the only one. */
Slices
ChooseSeries(const std::filesystem::path & input, const Slices & slices, const std::string & wanted)
{
  std::map<std::string, Slices> series;
  for (const SliceHeader & slice : slices)
  {
    series[slice.series].push_back(slice);
  }
  const auto found = wanted.empty() ? series.begin() : series.find(wanted);
  if (found == series.end() || (wanted.empty() && series.size() > 1))
  {
    throw JobError(ExitStatus::Usage,
                   input.string() + ": " +
                     (wanted.empty()
                        ? "it has " + std::to_string(series.size()) + " series; choose one with --series UID: "
                        : "it has no series " + wanted + ", but ") +
                     Join(series, ", ", [](const auto & one) { return DescribeSeries(one.second); }));
  }
  return found->second;
}

void
CheckAlike(const std::filesystem::path & input, const Slices & slices)
{
  const SliceHeader & first = slices.front();
  const auto          describe = [](const SliceHeader & slice) {
    return slice.GetName() + " has " + FormatSize({ slice.size[0], slice.size[1] }) + " voxels of " +
           std::string(GetTraits(slice.pixelType).name);
  };
  const auto other = std::find_if(slices.begin(), slices.end(), [&first](const SliceHeader & slice) {
    const bool canConvert = slice.storedType && first.storedType;
    return slice.size != first.size || (slice.pixelType != first.pixelType && !canConvert);
  });
  if (other != slices.end())
  {
    RefuseHeader(input, "its slices differ: " + describe(first) + ", " + describe(*other));
  }
}

/** The slices from the first to the last one of the range, counted from 0. */
Slices
TakeRange(const std::filesystem::path & input, const Slices & slices, const std::vector<std::uint64_t> & range)
{
  if (range.empty())
  {
    return slices;
  }
  if (range[1] >= slices.size())
  {
    throw JobError(ExitStatus::Usage,
                   input.string() + ": slices " + std::to_string(range[0]) + " to " + std::to_string(range[1]) +
                     " are wanted; it has " + std::to_string(slices.size()) + ", counted from 0");
  }
  const auto begin = slices.begin();
  return { begin + static_cast<std::ptrdiff_t>(range[0]), begin + static_cast<std::ptrdiff_t>(range[1]) + 1 };
}

/** The smallest type that holds all values of both; reals of 64 bits hold all values of DICOM. */
PixelType
GetCommonType(PixelType a, PixelType b)
{
  const auto range = [](PixelType type) {
    return DispatchPixelType(type, [](auto zero) {
      using Limits = std::numeric_limits<decltype(zero)>;
      return std::make_tuple(
        Limits::is_integer, static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max()));
    });
  };
  const auto [isIntegerA, leastA, mostA] = range(a);
  const auto [isIntegerB, leastB, mostB] = range(b);
  if (isIntegerA && isIntegerB)
  {
    for (const PixelType type : { a, b, PixelType::Int16, PixelType::Int32, PixelType::UInt32, PixelType::Int64 })
    {
      const auto [isInteger, least, most] = range(type);
      if (isInteger && least <= std::min(leastA, leastB) && most >= std::max(mostA, mostB))
      {
        return type;
      }
    }
  }
  return a == b ? a : PixelType::Float64;
}

/** The scale of slices may differ, and with it the type of their values. */
void
UnifyTypes(Slices & slices)
{
  PixelType type = slices.front().pixelType;
  for (const SliceHeader & slice : slices)
  {
    type = slice.pixelType == type ? type : GetCommonType(type, slice.pixelType);
  }
  for (SliceHeader & slice : slices)
  {
    // Converted slices are in memory twice.
    slice.decoderMemory += slice.pixelType == type ? 0 : slice.GetDataSize();
    slice.pixelType = type;
  }
}

/** Slices without places, in the order of their numbers where these all differ. */
void
SortByNumber(const std::filesystem::path & input, Slices & slices, std::vector<Warning> & warnings)
{
  const auto isBefore = [](const SliceHeader & a, const SliceHeader & b) { return a.number < b.number; };
  Slices     sorted = slices;
  std::stable_sort(sorted.begin(), sorted.end(), isBefore);
  const auto isSame = [](const SliceHeader & a, const SliceHeader & b) { return a.number == b.number; };
  const bool differ = sorted.front().number && std::adjacent_find(sorted.begin(), sorted.end(), isSame) == sorted.end();
  warnings.push_back({ HeaderWarnings::UnknownSliceOrder,
                       std::string("the slices have no position; they are in the order of their ") +
                         (differ ? "instance numbers" : "file names"),
                       {} });
  if (!differ)
  {
    return;
  }
  slices = std::move(sorted);
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  for (std::size_t slice = 1; slice < slices.size(); ++slice)
  {
    step = std::min(step, *slices[slice].number - *slices[slice - 1].number);
  }
  for (std::size_t slice = 1; slice < slices.size(); ++slice)
  {
    if (*slices[slice].number - *slices[slice - 1].number != step)
    {
      RefuseHeader(input,
                   "slices are missing between " + slices[slice - 1].fileName.string() + " and " +
                     slices[slice].fileName.string() + ", which have the instance numbers " +
                     std::to_string(*slices[slice - 1].number) + " and " + std::to_string(*slices[slice].number));
    }
  }
}

/** In order along the normal where they have places, otherwise in that of their numbers or names, and without a gap. */
Slices
SortSlices(const std::filesystem::path & input, Slices slices, bool hasSpacing, std::vector<Warning> & warnings)
{
  const auto hasPlace = [](const SliceHeader & slice) { return slice.place.has_value(); };
  const auto without = std::find_if_not(slices.begin(), slices.end(), hasPlace);
  const auto with = std::find_if(slices.begin(), slices.end(), hasPlace);
  if (without != slices.end() && with != slices.end())
  {
    RefuseHeader(input, with->GetName() + " has a position and " + without->GetName() + " has none");
  }
  if (without == slices.end())
  {
    SortAlongNormal(input, slices, hasSpacing, warnings);
    return slices;
  }
  if (slices.front().storedType)
  {
    SortByNumber(input, slices, warnings);
    return slices;
  }
  Files files;
  std::transform(
    slices.begin(), slices.end(), std::back_inserter(files), [](const SliceHeader & slice) { return slice.fileName; });
  CheckNumbers(input, files);
  return slices;
}

VolumeHeader
ReadSeriesHeader(const std::filesystem::path & input, const SliceChoice & choice)
{
  const bool countsNumbers = IsNumberPattern(input);
  const auto [format, files] =
    FindFormat(input, ListSliceFiles(input, countsNumbers ? choice.range : std::vector<std::uint64_t>{}));
  Slices       slices = ReadHeaders(input, *format, files);
  VolumeHeader header;
  slices = SortSlices(input, ChooseSeries(input, slices, choice.series), choice.hasSpacing, header.warnings);
  slices = TakeRange(input, slices, countsNumbers ? std::vector<std::uint64_t>{} : choice.range);
  CheckAlike(input, slices);
  UnifyTypes(slices);

  header.fileName = input;
  header.dataFile = slices.front().fileName;
  header.pixelType = slices.front().pixelType;
  header.geometry = MakeSeriesGeometry(input, slices);
  const auto & last = slices.back();
  const bool   hasPlaces = slices.size() == 1 || (last.place && last.isDistanceKnown);
  if (!hasPlaces || !slices.front().isSpacingKnown)
  {
    WarnOfUnknownSpacing(header,
                         hasPlaces ? "the slices have no PixelSpacing (an ImagerPixelSpacing is not used)"
                                   : (slices.front().frameNumber > 0
                                        ? "the frames do not tell how far they are from each other"
                                        : "the slices do not tell how far they are from each other"));
  }
  std::error_code error;
  if (std::filesystem::is_regular_file(input, error) && slices.size() == 1 && slices.front().frameNumber == 0)
  {
    header.warnings.push_back(
      { HeaderWarnings::SingleSlice,
        "the file is one slice, read as an image of two axes; give its folder, " +
          itk::MedialVoxelText::MakePrintable(std::filesystem::absolute(input).parent_path().string()) +
          ", to read the series",
        {} });
  }
  const auto series = std::make_shared<SliceSeries>();
  series->format = format;
  series->slices = std::move(slices);
  series->cache = std::make_shared<SliceCache>();
  header.series = series;
  return header;
}

/** A folder, a pattern, or a file that may have several slices. */
bool
IsSeries(const std::filesystem::path & input)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(input, error))
  {
    return NamesSlices(input);
  }
  const SliceFormat * const format = FindSliceFormat(input);
  return format && format->isInput;
}

} // namespace

VolumeFormat
MakeSeriesFormat()
{
  VolumeInput input;
  input.sizeCheck = DataSizeCheck::ByReader;
  input.makeReader = MakeSeriesImageIO;
  input.isKnown = IsSeries;
  input.readChoice = ReadSeriesHeader;
  input.getMemory = GetSeriesMemory;
  return { "series of slices", {}, input };
}

} // end namespace medialvoxel
