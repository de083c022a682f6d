// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterMarker.h"

#include "SealedJson.h"

namespace medialvoxel
{
namespace
{

Json
SumsToJson(const RunnerSums & sums)
{
  Json json;
  for (const NamedCount & count : NamedCounts)
  {
    json[count.name] = sums.counts.*count.member;
  }
  json["recomputed_voxels"] = sums.recomputedVoxels;
  return json;
}

RunnerSums
SumsFromJson(const Json & json)
{
  RunnerSums sums;
  for (const NamedCount & count : NamedCounts)
  {
    json.at(count.name).get_to(sums.counts.*count.member);
  }
  json.at("recomputed_voxels").get_to(sums.recomputedVoxels);
  return sums;
}

ClusterMarker
FromJson(const Json & json)
{
  ClusterMarker marker;
  json.at("checksums").get_to(marker.checksums);
  if (!json.at("survey").is_null())
  {
    marker.survey = json.at("survey").get<std::uint32_t>();
  }
  marker.sums = SumsFromJson(json.at("counts"));
  const Json & seconds = json.at("seconds");
  seconds.at("distance").get_to(marker.seconds.distance);
  seconds.at("classification").get_to(marker.seconds.classification);
  seconds.at("tiles").get_to(marker.seconds.tiles);
  seconds.at("threads").get_to(marker.sums.threadSeconds);
  seconds.at("input_output").get_to(marker.seconds.inputOutput);
  seconds.at("total").get_to(marker.seconds.total);
  json.at("bytes_read").get_to(marker.bytesRead);
  json.at("peak_memory_bytes").get_to(marker.peakMemoryBytes);
  json.at("planned_peak_bytes").get_to(marker.plannedMemoryBytes);
  json.at("memory_limit_bytes").get_to(marker.memoryLimit);
  json.at("threads").get_to(marker.threads);
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
  return std::nullopt;
}

} // end namespace medialvoxel
