// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterMarker.h"

#include "SealedJson.h"

#include <stdexcept>

namespace medialvoxel
{
namespace
{

Json
SumsToJson(const itk::MedialVoxelSums & sums)
{
  Json json;
  for (const NamedCount & count : NamedCounts)
  {
    json[count.name] = sums.counts.*count.member;
  }
  json["recomputed_voxels"] = sums.recomputedVoxels;
  json["voxels_at_maximum"] = sums.voxelsAtMaximum;
  json["voxels_without_wall"] = sums.voxelsWithoutWall;
  json["local_thickness"] = { { "voxels", sums.localThickness.voxels },
                              { "lengths", sums.localThickness.lengths },
                              { "low_squares", sums.localThickness.lowSquares },
                              { "high_squares", sums.localThickness.highSquares },
                              { "largest", sums.localThickness.largest } };
  return json;
}

itk::MedialVoxelSums
SumsFromJson(const Json & json)
{
  itk::MedialVoxelSums sums;
  for (const NamedCount & count : NamedCounts)
  {
    ReadWhole(json.at(count.name), sums.counts.*count.member);
  }
  ReadWhole(json.at("recomputed_voxels"), sums.recomputedVoxels);
  ReadWhole(json.at("voxels_at_maximum"), sums.voxelsAtMaximum);
  ReadWhole(json.at("voxels_without_wall"), sums.voxelsWithoutWall);
  const Json & localThickness = json.at("local_thickness");
  ReadWhole(localThickness.at("voxels"), sums.localThickness.voxels);
  ReadWhole(localThickness.at("lengths"), sums.localThickness.lengths);
  ReadWhole(localThickness.at("low_squares"), sums.localThickness.lowSquares);
  ReadWhole(localThickness.at("high_squares"), sums.localThickness.highSquares);
  localThickness.at("largest").get_to(sums.localThickness.largest);
  return sums;
}

ClusterMarker
FromJson(const Json & json)
{
  ClusterMarker marker;
  for (const auto & [role, checksum] : json.at("checksums").get<std::map<std::string, Json>>())
  {
    ReadWhole(checksum, marker.checksums[role]);
  }
  ReadWhole(json.at("survey"), marker.survey);
  marker.sums = SumsFromJson(json.at("counts"));
  const Json & seconds = json.at("seconds");
  seconds.at("distance").get_to(marker.seconds.distance);
  seconds.at("classification").get_to(marker.seconds.classification);
  seconds.at("tiles").get_to(marker.seconds.tiles);
  seconds.at("threads").get_to(marker.sums.threadSeconds);
  seconds.at("input_output").get_to(marker.seconds.inputOutput);
  seconds.at("total").get_to(marker.seconds.total);
  ReadWhole(json.at("bytes_read"), marker.bytesRead);
  ReadWhole(json.at("peak_memory_bytes"), marker.peakMemoryBytes);
  ReadWhole(json.at("planned_peak_bytes"), marker.plannedMemoryBytes);
  ReadWhole(json.at("memory_limit_bytes"), marker.memoryLimit);
  ReadWhole(json.at("threads"), marker.threads);
  return marker;
}

} // namespace

void
WriteMarker(const std::filesystem::path & fileName,
            const Manifest &              manifest,
            std::uint64_t                 cluster,
            const ClusterMarker &         marker)
{
  const SliceRange slices = manifest.GetCluster(cluster);
  Json             json;
  json["job"] = manifest.jobId;
  json["cluster"] = cluster;
  json["slices"] = { slices.begin, slices.end };
  json["checksums"] = marker.checksums;
  json["survey"] = marker.survey ? Json(*marker.survey) : Json(nullptr);
  json["counts"] = SumsToJson(marker.sums);
  json["seconds"] = { { "distance", marker.seconds.distance },
                      { "classification", marker.seconds.classification },
                      { "tiles", marker.seconds.tiles },
                      { "threads", marker.sums.threadSeconds },
                      { "input_output", marker.seconds.inputOutput },
                      { "total", marker.seconds.total } };
  json["bytes_read"] = marker.bytesRead;
  json["peak_memory_bytes"] = marker.peakMemoryBytes;
  json["planned_peak_bytes"] = marker.plannedMemoryBytes;
  json["memory_limit_bytes"] = marker.memoryLimit;
  json["threads"] = marker.threads;
  WriteSealed(fileName, json);
}

std::optional<ClusterMarker>
ReadMarker(const std::filesystem::path & fileName, const Manifest & manifest, std::uint64_t cluster)
{
  try
  {
    const std::optional<Json> json = ReadSealed(fileName);
    if (json && json->at("job") == manifest.jobId && json->at("cluster") == cluster)
    {
      return FromJson(*json);
    }
  }
  catch (const JobError &)
  {
    // Damaged: as if it were not there, which costs a cluster and never a byte.
  }
  catch (const Json::exception &)
  {
    // Of another form: the same.
  }
  catch (const std::invalid_argument &)
  {
    // With other numbers: the same.
  }
  return std::nullopt;
}

} // end namespace medialvoxel
