// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "ClusterMarker.h"

#include "SealedJson.h"

#include <stdexcept>
#include <type_traits>

namespace medialvoxel
{
namespace
{

/** Calls use(json, name, number) for all numbers of a marker but the checksums. */
template <typename TMarker, typename TUse>
void
ForEachNumber(Json & json, TMarker & marker, TUse && use)
{
  auto & sums = marker.sums;
  for (const NamedCount & count : NamedCounts)
  {
    use(json["counts"], count.name, sums.counts.*count.member);
  }
  use(json["counts"], "recomputed_voxels", sums.recomputedVoxels);
  use(json["counts"], "voxels_at_maximum", sums.voxelsAtMaximum);
  use(json["counts"], "voxels_without_wall", sums.voxelsWithoutWall);
  use(json["counts"]["local_thickness"], "voxels", sums.localThickness.voxels);
  use(json["counts"]["local_thickness"], "lengths", sums.localThickness.lengths);
  use(json["counts"]["local_thickness"], "low_squares", sums.localThickness.lowSquares);
  use(json["counts"]["local_thickness"], "high_squares", sums.localThickness.highSquares);
  use(json["counts"]["local_thickness"], "largest", sums.localThickness.largest);
  use(json["seconds"], "distance", marker.seconds.distance);
  use(json["seconds"], "classification", marker.seconds.classification);
  use(json["seconds"], "tiles", marker.seconds.tiles);
  use(json["seconds"], "threads", sums.threadSeconds);
  use(json["seconds"], "input_output", marker.seconds.inputOutput);
  use(json["seconds"], "total", marker.seconds.total);
  use(json, "bytes_read", marker.bytesRead);
  use(json, "peak_memory_bytes", marker.peakMemory);
  use(json, "planned_peak_bytes", marker.plannedMemory);
  use(json, "memory_limit_bytes", marker.memoryLimit);
  use(json, "threads", marker.threads);
}

ClusterMarker
FromJson(Json json)
{
  ClusterMarker marker;
  for (const auto & [role, checksum] : json.at("checksums").get<std::map<std::string, Json>>())
  {
    ReadWhole(checksum, marker.checksums[role]);
  }
  ReadWhole(json.at("survey"), marker.survey);
  ForEachNumber(json, marker, [](const Json & section, const char * name, auto & number) {
    if constexpr (std::is_floating_point_v<std::remove_reference_t<decltype(number)>>)
    {
      section.at(name).get_to(number);
    }
    else
    {
      ReadWhole(section.at(name), number);
    }
  });
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
  ForEachNumber(json, marker, [](Json & section, const char * name, const auto & number) { section[name] = number; });
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
    // Another form is no marker either.
  }
  catch (const std::invalid_argument &)
  {
    // With other numbers: the same.
  }
  return std::nullopt;
}

} // end namespace medialvoxel
