// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// The manifest of a job and the marker of a cluster: first the bytes as they are, then as an object with the checksum
// that fits, without which no reader gets past the first step, then as changes of what the program writes.

#include "FuzzSupport.h"

#include "ClusterMarker.h"
#include "Errors.h"
#include "JsonLimits.h"
#include "SealedJson.h"
#include "Version.h"

#include "itkMedialVoxelHeaderText.h"

namespace
{

using namespace MedialVoxelFuzz;
using namespace medialvoxel;

/** With the identity that the markers of the corpus have. */
Manifest
MakeManifest()
{
  Manifest manifest;
  manifest.version = GetVersion();
  manifest.jobId = "0123456789abcdef";
  manifest.folder = "/f";
  manifest.options.input = "i.mha";
  manifest.options.output = "o.mha";
  manifest.options.raw.emplace().size = { 5, 4, 3 };
  manifest.input.emplace_back();
  manifest.numberOfSlices = 5;
  manifest.numberOfClusters = 2;
  return manifest;
}

void
CheckClusters(const Manifest & manifest)
{
  constexpr std::uint64_t most = 100;
  const std::uint64_t     number = manifest.numberOfClusters;
  std::uint64_t           end = 0;
  for (std::uint64_t cluster = 0; cluster < std::min(number, most); ++cluster)
  {
    const SliceRange slices = manifest.GetCluster(cluster);
    Require(slices.begin == end && slices.end > slices.begin, "clusters do not follow each other");
    end = slices.end;
  }
  Require(manifest.GetCluster(number - 1).end == manifest.numberOfSlices, "the clusters are not all slices");
}

/** What a manifest says survives being written and read again. */
void
CheckManifest(const Manifest & manifest, const InputFile & copy)
{
  CheckClusters(manifest);
  WriteManifest(copy.GetPath(), manifest);
  const std::optional<Manifest> again = ReadManifest(copy.GetPath());
  Require(again && FindDifference(manifest.options, again->options).empty(), "other options after writing them");
  Require(again->input.size() == manifest.input.size() && again->perSlice == manifest.perSlice,
          "another manifest after writing it");
}

void
ReadAsManifest(const InputFile & file)
try
{
  static const InputFile copy("copy.json");
  if (const std::optional<Manifest> manifest = ReadManifest(file.GetPath()))
  {
    CheckManifest(*manifest, copy);
  }
}
catch (const JobError & error)
{
  Require(error.GetStatus() == ExitStatus::Failure, "an unexpected status");
  file.RequireClearError(itk::MedialVoxelText::MakePrintable(error.what()));
}

/** One that is refused is none: there are no errors. */
void
ReadAsMarker(const InputFile & file)
{
  static const InputFile             copy("marker.json");
  const Manifest                     manifest = MakeManifest();
  const std::optional<ClusterMarker> marker = ReadMarker(file.GetPath(), manifest, 1);
  if (marker)
  {
    WriteMarker(copy.GetPath(), manifest, 1, *marker);
    const std::optional<ClusterMarker> again = ReadMarker(copy.GetPath(), manifest, 1);
    Require(again && again->checksums == marker->checksums && again->survey == marker->survey &&
              again->bytesRead == marker->bytesRead &&
              again->sums.counts.candidateCells == marker->sums.counts.candidateCells,
            "another marker after writing it");
  }
}

void
ReadSealedAs(const InputFile & file, const Json & json)
{
  WriteSealed(file.GetPath(), json);
  ReadAsManifest(file);
  ReadAsMarker(file);
}

/** A manifest and a marker as the program writes them. */
std::vector<Json>
WriteRecords()
{
  const InputFile file("record.json");
  const Manifest  manifest = MakeManifest();
  WriteManifest(file.GetPath(), manifest);
  std::vector<Json> records{ *ReadSealed(file.GetPath()) };
  WriteMarker(file.GetPath(), manifest, 1, {});
  records.push_back(*ReadSealed(file.GetPath()));
  Require(ReadMarker(file.GetPath(), manifest, 1).has_value(), "a marker cannot be read again");
  return records;
}

std::optional<Json>
ParseObject(const std::string & text)
try
{
  Json json = ParseJson<Json>(text, text.size());
  return json.is_object() ? std::optional<Json>(std::move(json)) : std::nullopt;
}
catch (const Json::exception &)
{
  return std::nullopt;
}
catch (const std::length_error &)
{
  return std::nullopt;
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const InputFile file("in.json");
  file.Write(data, size);
  ReadAsManifest(file);
  ReadAsMarker(file);
  if (const std::optional<Json> object = ParseObject({ reinterpret_cast<const char *>(data), size }))
  {
    static const std::vector<Json> records = WriteRecords();
    ReadSealedAs(file, *object);
    for (Json record : records)
    {
      record.merge_patch(*object);
      ReadSealedAs(file, record);
    }
  }
  return 0;
}
