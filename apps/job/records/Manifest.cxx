// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Manifest.h"

#include "FileNames.h"
#include "ManifestValues.h"
#include "OptionTable.h"
#include "Outputs.h"
#include "SealedJson.h"
#include "Version.h"
#include "VolumeHeader.h"

#include <algorithm>
#include <stdexcept>

namespace medialvoxel
{
namespace
{

/** Raise with every change of the meaning of the files of a job. */
constexpr int ManifestFormat = 15;

/** Calls use(row) for the options that a job keeps in this way. */
template <typename TUse>
void
ForEachKept(const Kept kept, TUse && use)
{
  for (const OptionRow & row : ListOptions())
  {
    if (row.kept == kept && (row.commands & Commands::Plan) != 0)
    {
      use(row);
    }
  }
}

/** Options as they would be typed, by their names; null: not given. */
Json
KeptToJson(const Kept kept, ExtractOptions options)
{
  Json               json = Json::object();
  const OptionTarget target = MakeTarget(options);
  ForEachKept(kept, [&](const OptionRow & row) { json[row.name] = OptionalToJson(row.value.get(target)); });
  return json;
}

void
KeptFromJson(const Kept kept, const Json & json, ExtractOptions & options)
{
  const OptionTarget target = MakeTarget(options);
  ForEachKept(kept, [&](const OptionRow & row) {
    const Json & text = json.at(row.name);
    text.is_null() ? void() : row.value.set(target, text.get<std::string>());
  });
}

/** Everything that decides a byte: options, and the findings in the volume before. */
Json
ParametersToJson(const ExtractOptions & options)
{
  Json json = KeptToJson(Kept::Result, options);
  json["lower_otsu"] = options.lowerIsOtsu;
  json["roughness"] = RoughnessToJson(options.roughness);
  json["smoothing_level"] = SmoothingLevelToJson(options.smoothingLevel);
  json["measure"] = MeasureToJson(options.measure);
  json["needed_maximum"] = options.neededMaximum ? Json(*options.neededMaximum) : Json(nullptr);
  return json;
}

void
ParametersFromJson(const Json & json, ExtractOptions & options)
{
  KeptFromJson(Kept::Result, json, options);
  json.at("lower_otsu").get_to(options.lowerIsOtsu);
  options.roughness = RoughnessFromJson(json.at("roughness"));
  options.smoothingLevel = SmoothingLevelFromJson(json.at("smoothing_level"));
  options.measure = MeasureFromJson(json.at("measure"));
  const Json & maximum = json.at("needed_maximum");
  options.neededMaximum = maximum.is_null() ? std::nullopt : std::optional(maximum.get<double>());
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
  ParametersFromJson(json.at("parameters"), manifest.options);
  KeptFromJson(Kept::Run, json.at("run"), manifest.options);
  manifest.input = InputFromJson(json.at("input"));
  ReadWhole(json.at("clusters").at("slices"), manifest.numberOfSlices);
  ReadWhole(json.at("clusters").at("number"), manifest.numberOfClusters);
  ReadWhole(json.at("clusters").at("bytes_per_slice"), manifest.perSlice);
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
  json["parameters"] = ParametersToJson(manifest.options);
  json["run"] = KeptToJson(Kept::Run, manifest.options);
  json["input"] = InputToJson(manifest.input);
  json["clusters"] = { { "number", manifest.numberOfClusters },
                       { "slices", manifest.numberOfSlices },
                       { "slice_unit", manifest.sliceUnit },
                       { "bytes_per_slice", manifest.perSlice } };
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
    if (!kind.refusal && !kind.GetFileName(options).empty())
    {
      makeAbsolute(options.*kind.option);
    }
  }
  return options;
}

std::string
FindDifference(const ExtractOptions & wanted, const ExtractOptions & present)
{
  const Json a = ParametersToJson(wanted);
  const Json b = ParametersToJson(present);
  // A name that is not UTF-8 is to be shown, too.
  const auto show = [](const Json & value) {
    return value.is_null()     ? "unset"
           : value.is_string() ? value.get<std::string>()
                               : value.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  for (const auto & [name, value] : a.items())
  {
    if (value != b.at(name))
    {
      return name + " is " + show(value) + ", not " + show(b.at(name));
    }
  }
  if (wanted.divisions && wanted.divisions != present.divisions)
  {
    return "--divisions is " + std::to_string(*wanted.divisions) + ", not " +
           std::to_string(present.divisions.value_or(0));
  }
  return "";
}

} // end namespace medialvoxel
