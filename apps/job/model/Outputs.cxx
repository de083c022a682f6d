// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "Outputs.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace medialvoxel
{
namespace
{

using ExtractKind = OutputKind<ExtractOptions>;
using DistanceKind = OutputKind<DistanceOptions>;
using SurfaceKind = OutputKind<SurfaceOptions>;

VoxelLayout
GetLabelLayout(const VolumeHeader &)
{
  return LabelLayout;
}

void
WriteLabels(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  tile.WriteLabels(static_cast<std::uint8_t *>(target.first), target.strides);
}

/** What the values of the input are. */
VoxelLayout
GetObjectLayout(const VolumeHeader & input)
{
  const VolumeHeader & stored = input.GetStored();
  return { stored.GetValueType(), 1 };
}

VoxelLayout
GetThicknessLayout(const VolumeHeader &)
{
  return ThicknessLayout;
}

void
WriteThickness(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  tile.WriteThickness(static_cast<float *>(target.first), target.strides);
}

void
WriteUncertainty(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  tile.WriteUncertainty(static_cast<float *>(target.first), target.strides);
}

void
WriteLocalThickness(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  tile.WriteLocalThickness(static_cast<float *>(target.first), target.strides);
}

VoxelLayout
GetDistanceLayout(const VolumeHeader &)
{
  return DistanceLayout;
}

void
WriteDistances(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  tile.WriteDistances({ target.spacing }, static_cast<float *>(target.first), target.strides);
}

template <unsigned int VDimension>
void
WriteVectorsOf(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  using WriterType = itk::MedialVoxelDisplacementWriter<VDimension, float>;
  typename WriterType::MatrixType matrix{};
  for (unsigned int row = 0; row < VDimension; ++row)
  {
    for (unsigned int axis = 0; axis < VDimension; ++axis)
    {
      const double unit = row == axis ? 1.0 : 0.0;
      matrix[row][axis] =
        target.voxelUnits ? unit : target.geometry.direction[axis][row] * target.geometry.spacing[axis];
    }
  }
  tile.WriteVectors(WriterType(matrix), static_cast<float *>(target.first), target.strides);
}

void
WriteVectors(const itk::MedialVoxelTileResult & tile, const TileTarget & target)
{
  target.geometry.GetDimension() == 2 ? WriteVectorsOf<2>(tile, target) : WriteVectorsOf<3>(tile, target);
}

constexpr VolumeFiller Extraction = VolumeFiller::Extraction;
constexpr VolumeFiller Distance = VolumeFiller::Distance;

constexpr VolumeKind Labels{ WriteLabels, Extraction, true, GetLabelLayout };
constexpr VolumeKind Thicknesses{ WriteThickness, Extraction, true, GetThicknessLayout, true };
constexpr VolumeKind Uncertainties{ WriteUncertainty, Extraction, true, GetThicknessLayout, true };
constexpr VolumeKind Distances{ WriteDistances, Distance, false, GetDistanceLayout };

constexpr VolumeKind LocalThicknesses{ WriteLocalThickness, VolumeFiller::LocalThickness, false, GetThicknessLayout };

constexpr VolumeKind Objects{ nullptr, VolumeFiller::Objects, true, GetObjectLayout };

constexpr VolumeKind
MakeVectors(VolumeFiller filler)
{
  return { WriteVectors, filler, false, GetVectorLayout };
}

template <typename TOptions>
OutputKind<TOptions>
MakeReportKind()
{
  OutputKind<TOptions> kind{ "report", &TOptions::reportFile, "report" };
  kind.mayBeStandardOutput = true;
  return kind;
}

ExtractKind
MakeFileKind(const char * role,
             std::string ExtractOptions::* option,
             std::vector<std::string>      extensions,
             const char *                  name)
{
  return { role, option, role, std::nullopt, std::move(extensions), name };
}

/** Of volumes that a job of several processes does not make. */
ExtractKind
MakeObjectKind()
{
  ExtractKind kind{ "objects", &ExtractOptions::objectFile, nullptr, Objects };
  kind.refusal = { "a map of objects", "run medialvoxel extract" };
  return kind;
}

/** Of what a job of several processes does not make. */
ExtractKind
MakeRefusedKind(const char * role, std::string ExtractOptions::* option, const JobRefusal & refusal)
{
  ExtractKind kind{ role, option };
  kind.refusal = refusal;
  return kind;
}

template <typename TOptions>
std::vector<OutputRequest>
ListWanted(const TOptions & options, const VolumeHeader & input)
{
  std::vector<OutputRequest> outputs;
  for (const OutputKind<TOptions> & kind : ListOutputKinds(options))
  {
    const std::string fileName = kind.GetFileName(options);
    if (!fileName.empty())
    {
      outputs.push_back({ kind.role,
                          fileName,
                          kind.volume ? std::optional<VoxelLayout>(kind.volume->getLayout(input)) : std::nullopt });
    }
  }
  return outputs;
}

template <typename TOptions>
std::vector<VolumeRequest>
ListWantedVolumes(const TOptions & options, const VolumeHeader & input)
{
  std::vector<VolumeRequest> volumes;
  for (const OutputKind<TOptions> & kind : ListOutputKinds(options))
  {
    if (kind.volume && !(options.*kind.option).empty())
    {
      volumes.push_back({ kind.role,
                          options.*kind.option,
                          kind.volume->isOfCells ? GetCellGeometry(input.geometry) : input.geometry,
                          kind.volume->getLayout(input),
                          kind.volume->write,
                          kind.volume->filler });
    }
  }
  return volumes;
}

template <typename TOptions>
std::vector<std::string>
ListWantedVolumeNames(const TOptions & options)
{
  std::vector<std::string> names;
  for (const OutputKind<TOptions> & kind : ListOutputKinds(options))
  {
    if (kind.volume && !(options.*kind.option).empty())
    {
      names.push_back(options.*kind.option);
    }
  }
  return names;
}

} // namespace

const std::vector<OutputKind<ExtractOptions>> &
ListOutputKinds(const ExtractOptions &)
{
  static const std::vector<ExtractKind> kinds{
    { "labels", &ExtractOptions::output, "output", Labels },
    MakeObjectKind(),
    { "vectors", &ExtractOptions::vectorFile, "vectors", MakeVectors(Extraction) },
    { "distance", &ExtractOptions::distanceFile, "distance", Distances },
    { "thickness_map", &ExtractOptions::thicknessFile, "thickness_map", Thicknesses },
    { "uncertainty_map", &ExtractOptions::uncertaintyFile, "uncertainty_map", Uncertainties },
    { "local_thickness", &ExtractOptions::localThicknessFile, "local_thickness", LocalThicknesses },
    MakeFileKind("thickness_csv", &ExtractOptions::thicknessCsvFile, { ".csv" }, "histogram"),
    MakeFileKind("places", &ExtractOptions::placesFile, { ".csv" }, "list of places"),
    MakeRefusedKind("mesh",
                    &ExtractOptions::meshFile,
                    { "a mesh, which joins what lies in all clusters,", "run medialvoxel mesh for it" }),
    MakeFileKind("preview", &ExtractOptions::previewFile, { ".png" }, "preview"),
    MakeFileKind("html", &ExtractOptions::htmlFile, { ".html", ".htm" }, "page"),
    MakeReportKind<ExtractOptions>(),
    MakeRefusedKind(
      "return_parameters", &ExtractOptions::returnParameterFile, { "return parameters", "use the report" }),
  };
  return kinds;
}

const std::vector<OutputKind<DistanceOptions>> &
ListOutputKinds(const DistanceOptions &)
{
  static const std::vector<DistanceKind> kinds{
    { "vectors", &DistanceOptions::output, nullptr, MakeVectors(Distance) },
    { "distance", &DistanceOptions::distanceFile, nullptr, Distances },
    MakeReportKind<DistanceOptions>(),
  };
  return kinds;
}

const std::vector<OutputKind<SurfaceOptions>> &
ListOutputKinds(const SurfaceOptions &)
{
  static const std::vector<SurfaceKind> kinds{
    { "surface", &SurfaceOptions::output },
    MakeReportKind<SurfaceOptions>(),
  };
  return kinds;
}

std::vector<OutputRequest>
ListOutputs(const ExtractOptions & options, const VolumeHeader & input)
{
  return ListWanted(options, input);
}

std::vector<OutputRequest>
ListOutputs(const DistanceOptions & options, const VolumeHeader & input)
{
  return ListWanted(options, input);
}

std::vector<OutputRequest>
ListOutputs(const SurfaceOptions & options, const VolumeHeader & input)
{
  return ListWanted(options, input);
}

std::vector<VolumeRequest>
ListVolumes(const ExtractOptions & options, const VolumeHeader & input)
{
  return ListWantedVolumes(options, input);
}

std::vector<VolumeRequest>
ListVolumes(const DistanceOptions & options, const VolumeHeader & input)
{
  return ListWantedVolumes(options, input);
}

std::vector<VolumeRequest>
ListVolumes(const SurfaceOptions & options, const VolumeHeader & input)
{
  return ListWantedVolumes(options, input);
}

bool
MeasuresWalls(const ExtractOptions & options)
{
  const auto & kinds = ListOutputKinds(options);
  return ListsPlaces(options) || std::any_of(kinds.begin(), kinds.end(), [&options](const ExtractKind & kind) {
           return kind.volume && kind.volume->measuresWalls && !(options.*kind.option).empty();
         });
}

std::vector<std::string>
ListVolumeNames(const ExtractOptions & options)
{
  return ListWantedVolumeNames(options);
}

std::vector<std::string>
ListVolumeNames(const DistanceOptions & options)
{
  return ListWantedVolumeNames(options);
}

void
CheckExtensions(const ExtractOptions & options)
{
  for (const ExtractKind & kind : ListOutputKinds(options))
  {
    const std::string fileName = kind.GetFileName(options);
    const std::string extension = ToLower(std::filesystem::path(fileName).extension().string());
    if (!fileName.empty() && !kind.extensions.empty() &&
        std::find(kind.extensions.begin(), kind.extensions.end(), extension) == kind.extensions.end())
    {
      Fail(ExitStatus::Usage,
           fileName,
           ": unknown format '",
           extension,
           "'; the ",
           kind.name,
           " is written as ",
           Join(kind.extensions, " or ", [](const std::string & known) { return known; }));
    }
  }
}

} // end namespace medialvoxel
