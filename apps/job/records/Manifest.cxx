// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Manifest.h"

#include "FileNames.h"
#include "ManifestValues.h"
#include "Options.h"
#include "Outputs.h"
#include "SealedJson.h"
#include "Version.h"
#include "VolumeHeader.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace medialvoxel
{
namespace
{

/** To be raised with every change of what the files of a job mean. */
constexpr int ManifestFormat = 11;

constexpr const char * OverwriteName = "overwrite";

using NumberOption = std::pair<const char *, std::optional<double> ExtractOptions::*>;
using LimitOption = std::pair<const char *, std::optional<itk::MedialVoxelLimit> ExtractOptions::*>;

const std::array<NumberOption, 7> NumberOptions{
  { { "thickness", &ExtractOptions::thickness },
    { "minimum_thickness", &ExtractOptions::minimumThickness },
    { "maximum_thickness", &ExtractOptions::maximumThickness },
    { "default_maximum_thickness", &ExtractOptions::defaultMaximumThickness },
    { "maximum_local_thickness", &ExtractOptions::maximumLocalThickness },
    { "resample", &ExtractOptions::resample },
    { "smallest_place", &ExtractOptions::smallestPlace } }
};

const std::array<LimitOption, 2> LimitOptions{ { { "lower", &ExtractOptions::lowerThreshold },
                                                 { "upper", &ExtractOptions::upperThreshold } } };

constexpr std::array<itk::MedialVoxelBoundary, 2> Boundaries{ { itk::MedialVoxelBoundary::Object,
                                                                itk::MedialVoxelBoundary::Background } };

constexpr std::array<LocalThicknessMethod, 2> LocalThicknessMethods{ { LocalThicknessMethod::Sphere,
                                                                       LocalThicknessMethod::Wall } };

constexpr std::array<ZarrCompression, 3> Compressions{
  { ZarrCompression::None, ZarrCompression::Gzip, ZarrCompression::BloscZstd }
};

constexpr std::array<Smoothing, 3> Smoothings{ { Smoothing::Off, Smoothing::On, Smoothing::Automatic } };

template <typename TEnum, std::size_t VSize>
TEnum
EnumFromJson(const Json & name, const std::array<TEnum, VSize> & values)
{
  for (const TEnum value : values)
  {
    if (name == GetName(value))
    {
      return value;
    }
  }
  throw std::invalid_argument("it has the unknown choice " + name.dump());
}

Json
OptionsToJson(const ExtractOptions & options)
{
  Json json = Json::object();
  json["input"] = options.input;
  for (const auto & kind : ListOutputKinds(options))
  {
    if (kind.parameter)
    {
      json[kind.parameter] = options.*kind.option;
    }
  }
  for (const auto & [name, member] : NumberOptions)
  {
    json[name] = NumberToJson(options.*member);
  }
  for (const auto & [name, member] : LimitOptions)
  {
    json[name] = LimitToJson(options.*member);
  }
  json["maximum_pore_size"] = OptionalToJson(options.maximumPoreSize);
  json["smooth"] = options.smoothing ? Json(GetName(*options.smoothing)) : Json(nullptr);
  json["roughness"] = RoughnessToJson(options.roughness);
  json["vector_boundary"] = GetName(options.vectorBoundary);
  json["local_thickness_method"] = GetName(options.localThicknessMethod);
  json["zarr_compression"] = GetName(options.zarrCompression);
  json["lower_otsu"] = options.lowerIsOtsu;
  json["label"] = options.label ? Json(FormatLabel(*options.label)) : Json(nullptr);
  json["voxel_units"] = options.voxelUnits;
  json["sub_voxel"] = options.subVoxel ? Json(*options.subVoxel) : Json(nullptr);
  json["levels"] = LevelsToJson(options.levels);
  json["measure"] = MeasureToJson(options.measure);
  json["thin_below"] = PlacesToJson(options.thinBelow);
  json["thick_above"] = PlacesToJson(options.thickAbove);
  json["fail_if_thin"] = options.failsIfThin;
  json[OverwriteName] = options.overwrite;
  json["level"] = options.level;
  json["spacing"] = options.spacing;
  json["series"] = options.slices.series;
  json["slices"] = options.slices.range;
  json["raw"] = RawToJson(options.raw);
  return json;
}

ExtractOptions
OptionsFromJson(const Json & json)
{
  ExtractOptions options;
  json.at("input").get_to(options.input);
  for (const auto & kind : ListOutputKinds(options))
  {
    if (kind.parameter)
    {
      json.at(kind.parameter).get_to(options.*kind.option);
    }
  }
  for (const auto & [name, member] : NumberOptions)
  {
    options.*member = NumberFromJson(json.at(name));
  }
  for (const auto & [name, member] : LimitOptions)
  {
    options.*member = LimitFromJson(json.at(name));
  }
  ReadWhole(json.at("maximum_pore_size"), options.maximumPoreSize);
  if (!json.at("smooth").is_null())
  {
    options.smoothing = EnumFromJson(json.at("smooth"), Smoothings);
  }
  options.roughness = RoughnessFromJson(json.at("roughness"));
  options.vectorBoundary = EnumFromJson(json.at("vector_boundary"), Boundaries);
  options.localThicknessMethod = EnumFromJson(json.at("local_thickness_method"), LocalThicknessMethods);
  options.zarrCompression = EnumFromJson(json.at("zarr_compression"), Compressions);
  json.at("lower_otsu").get_to(options.lowerIsOtsu);
  options.label = LabelFromJson(json.at("label"));
  json.at("voxel_units").get_to(options.voxelUnits);
  if (!json.at("sub_voxel").is_null())
  {
    options.subVoxel = json.at("sub_voxel").get<bool>();
  }
  options.levels = LevelsFromJson(json.at("levels"));
  options.measure = MeasureFromJson(json.at("measure"));
  options.thinBelow = PlacesFromJson(json.at("thin_below"));
  options.thickAbove = PlacesFromJson(json.at("thick_above"));
  json.at("fail_if_thin").get_to(options.failsIfThin);
  json.at(OverwriteName).get_to(options.overwrite);
  ReadWhole(json.at("level"), options.level);
  json.at("spacing").get_to(options.spacing);
  json.at("series").get_to(options.slices.series);
  for (const Json & slice : json.at("slices"))
  {
    ReadWhole(slice, options.slices.range.emplace_back());
  }
  if (options.slices.range.size() != 0 && options.slices.range.size() != 2)
  {
    throw std::invalid_argument("its range of slices has " + std::to_string(options.slices.range.size()) + " numbers");
  }
  options.raw = RawFromJson(json.at("raw"));
  return options;
}

Json
InputToJson(const std::vector<FileIdentity> & files)
{
  Json json = Json::array();
  for (const FileIdentity & file : files)
  {
    json.push_back(
      { { "file", file.fileName.string() }, { "bytes", file.numberOfBytes }, { "modified_ns", file.modified } });
  }
  return json;
}

std::vector<FileIdentity>
InputFromJson(const Json & json)
{
  std::vector<FileIdentity> files;
  for (const Json & file : json)
  {
    FileIdentity & identity = files.emplace_back();
    identity.fileName = file.at("file").get<std::string>();
    ReadWhole(file.at("bytes"), identity.numberOfBytes);
    ReadWhole(file.at("modified_ns"), identity.modified);
  }
  return files;
}

Manifest
FromJson(const Json & json)
{
  Manifest manifest;
  json.at("version").get_to(manifest.version);
  json.at("job").get_to(manifest.jobId);
  manifest.folder = json.at("folder").get<std::string>();
  manifest.fromJob = json.at("folder_from_job").get<std::string>();
  manifest.options = OptionsFromJson(json.at("parameters"));
  ReadWhole(json.at("run").at("memory_bytes"), manifest.options.memoryBytes);
  ReadWhole(json.at("run").at("threads"), manifest.options.threads);
  json.at("run").at("scratch").get_to(manifest.options.scratchFolder);
  manifest.input = InputFromJson(json.at("input"));
  ReadWhole(json.at("clusters").at("slices"), manifest.numberOfSlices);
  ReadWhole(json.at("clusters").at("number"), manifest.numberOfClusters);
  ReadWhole(json.at("clusters").at("bytes_per_slice"), manifest.bytesPerSlice);
  manifest.options.divisions = manifest.numberOfClusters;
  ReadWhole(json.at("clusters").at("slice_unit"), manifest.sliceUnit);
  const bool isId =
    manifest.jobId.size() == 16 && manifest.jobId.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!isId || manifest.sliceUnit == 0 || manifest.numberOfClusters == 0 ||
      manifest.numberOfClusters > manifest.GetMostClusters())
  {
    throw std::invalid_argument("its identity or its clusters are out of range");
  }
  return manifest;
}

/** True when a volume of the job is in its folder under its temporary name, which no other job gives. */
bool
HasVolumes(const Manifest & manifest, const std::filesystem::path & folder)
{
  const std::string              suffix = manifest.GetSuffix();
  const std::vector<std::string> volumes = ListVolumeNames(WithAbsoluteNames(manifest.options, folder));
  return std::any_of(volumes.begin(), volumes.end(), [&suffix](const std::filesystem::path & volume) {
    std::error_code                           error;
    const std::filesystem::directory_iterator entries(FolderOf(FollowLinks(volume)), error);
    return !error && std::any_of(begin(entries), end(entries), [&suffix](const auto & entry) {
      const std::string name = entry.path().filename().string();
      return name.size() > suffix.size() && name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
    });
  });
}

} // namespace

JobPlan
Manifest::GetPlan() const
{
  JobPlan plan;
  plan.numberOfSlices = numberOfSlices;
  plan.sliceUnit = sliceUnit;
  plan.divisions = numberOfClusters;
  return plan;
}

SliceRange
Manifest::GetCluster(std::uint64_t cluster) const
{
  return this->GetPlan().GetPiece(cluster);
}

std::string
Manifest::GetSuffix() const
{
  return "." + jobId + ".partial";
}

void
WriteManifest(const std::filesystem::path & fileName, const Manifest & manifest)
{
  Json json;
  json["format"] = ManifestFormat;
  json["version"] = manifest.version;
  json["job"] = manifest.jobId;
  json["folder"] = manifest.folder.string();
  json["folder_from_job"] = manifest.fromJob.string();
  json["parameters"] = OptionsToJson(manifest.options);
  json["run"] = { { "memory_bytes", OptionalToJson(manifest.options.memoryBytes) },
                  { "threads", OptionalToJson(manifest.options.threads) },
                  { "scratch", manifest.options.scratchFolder } };
  json["input"] = InputToJson(manifest.input);
  json["clusters"] = { { "number", manifest.numberOfClusters },
                       { "slices", manifest.numberOfSlices },
                       { "slice_unit", manifest.sliceUnit },
                       { "bytes_per_slice", manifest.bytesPerSlice } };
  WriteSealed(fileName, json);
}

std::optional<Manifest>
ReadManifest(const std::filesystem::path & fileName)
{
  const std::optional<Json> json = ReadSealed(fileName);
  if (!json)
  {
    return std::nullopt;
  }
  try
  {
    int format = 0;
    ReadWhole(json->value("format", Json(format)), format);
    if (json->value("version", "") != GetVersion() || format != ManifestFormat)
    {
      Fail(ExitStatus::Failure,
           fileName.string(),
           " is of version ",
           json->value("version", "unknown"),
           " of medialvoxel (format ",
           format,
           "), this is version ",
           GetVersion(),
           " (format ",
           ManifestFormat,
           "); continue the job with that version, or plan it again");
    }
    return FromJson(*json);
  }
  catch (const Json::exception & error)
  {
    Fail(ExitStatus::Failure, fileName.string(), " is not a manifest: ", error.what());
  }
  catch (const std::invalid_argument & error)
  {
    Fail(ExitStatus::Failure, fileName.string(), " is not a manifest: ", error.what());
  }
}

std::filesystem::path
FindFolder(const Manifest & manifest, const std::filesystem::path & jobFolder)
{
  std::error_code             error;
  const std::filesystem::path now = std::filesystem::weakly_canonical(jobFolder, error);
  const std::filesystem::path beside = (now / manifest.fromJob).lexically_normal();
  if (error || manifest.fromJob.empty() || std::filesystem::equivalent(beside, manifest.folder, error))
  {
    return manifest.folder;
  }
  if (HasVolumes(manifest, beside))
  {
    return beside;
  }
  // A job that is finished has no temporary names.
  const bool isGone = !std::filesystem::is_directory(manifest.folder, error);
  return isGone && std::filesystem::exists(beside / manifest.options.output, error) ? beside : manifest.folder;
}

ExtractOptions
WithAbsoluteNames(ExtractOptions options, const std::filesystem::path & folder)
{
  const auto makeAbsolute = [&folder](std::string & name) {
    name = name.empty() ? "" : (folder / name).lexically_normal().string();
  };
  makeAbsolute(options.input);
  for (const auto & kind : ListOutputKinds(options))
  {
    if (kind.parameter && !kind.GetFileName(options).empty())
    {
      makeAbsolute(options.*kind.option);
    }
  }
  return options;
}

std::string
FindDifference(const ExtractOptions & wanted, const ExtractOptions & present)
{
  const Json a = OptionsToJson(wanted);
  const Json b = OptionsToJson(present);
  // A name that is not UTF-8 is to be shown, too.
  const auto show = [](const Json & value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); };
  for (const auto & [name, value] : a.items())
  {
    if (name != OverwriteName && value != b.at(name))
    {
      return name + " is " + show(value) + ", not " + show(b.at(name));
    }
  }
  if (wanted.divisions && wanted.divisions != present.divisions)
  {
    return "divisions is " + std::to_string(*wanted.divisions) + ", not " + OptionalToJson(present.divisions).dump();
  }
  return "";
}

} // end namespace medialvoxel
