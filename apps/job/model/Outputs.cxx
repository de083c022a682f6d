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

using Result = itk::MedialVoxelTileResult;

/** Writes values that a method of the result gives. */
template <void (Result::*VWrite)(float *, const itk::MedialVoxelStrides &) const>
void
Write(const Result & tile, const TileTarget & target)
{
  (tile.*VWrite)(static_cast<float *>(target.first), target.strides);
}

void
WriteLabels(const Result & tile, const TileTarget & target)
{
  tile.WriteLabels(static_cast<std::uint8_t *>(target.first), target.strides);
}

void
WriteDistances(const Result & tile, const TileTarget & target)
{
  tile.WriteDistances({ target.spacing }, static_cast<float *>(target.first), target.strides);
}

template <unsigned int VDimension>
void
WriteVectorsOf(const Result & tile, const TileTarget & target)
{
  using WriterType = itk::MedialVoxelDisplacementWriter<VDimension, float>;
  typename WriterType::MatrixType matrix{};
  for (unsigned int row = 0; row < VDimension; ++row)
  {
    for (unsigned int axis = 0; axis < VDimension; ++axis)
    {
      matrix[row][axis] = target.geometry.direction[axis][row] * target.geometry.spacing[axis];
    }
  }
  tile.WriteVectors(WriterType(matrix), static_cast<float *>(target.first), target.strides);
}

void
WriteVectors(const Result & tile, const TileTarget & target)
{
  target.geometry.GetDimension() == 2 ? WriteVectorsOf<2>(tile, target) : WriteVectorsOf<3>(tile, target);
}

template <const VoxelLayout & VLayout>
VoxelLayout
GetLayout(const VolumeHeader &)
{
  return VLayout;
}

/** The kind of the values of the input. */
VoxelLayout
GetObjectLayout(const VolumeHeader & input)
{
  return { input.GetStored().GetValueType(), 1 };
}

// A task, of cells or voxels, the layout, and whether walls are measured for it.
using Filler = VolumeFiller;
constexpr VolumeKind Labels{ WriteLabels, Filler::Extraction, true, GetLayout<LabelLayout> };
constexpr VolumeKind Objects{ nullptr, Filler::Objects, true, GetObjectLayout };
constexpr VolumeKind CellVectors{ WriteVectors, Filler::Extraction, false, GetVectorLayout };
constexpr VolumeKind Vectors{ WriteVectors, Filler::Distance, false, GetVectorLayout };
constexpr VolumeKind Distances{ WriteDistances, Filler::Distance, false, GetLayout<DistanceLayout> };
constexpr VolumeKind Thicknesses{ Write<&Result::WriteThickness>,
                                  Filler::Extraction,
                                  true,
                                  GetLayout<ThicknessLayout>,
                                  true };
constexpr VolumeKind Uncertainties{ Write<&Result::WriteUncertainty>,
                                    Filler::Extraction,
                                    true,
                                    GetLayout<ThicknessLayout>,
                                    true };
constexpr VolumeKind Importances{ Write<&Result::WriteImportance>,
                                  Filler::Extraction,
                                  true,
                                  GetLayout<ThicknessLayout> };
constexpr VolumeKind ImportanceThresholds{ Write<&Result::WriteImportanceThreshold>,
                                           Filler::Extraction,
                                           true,
                                           GetLayout<ThicknessLayout> };
constexpr VolumeKind LocalThicknesses{ Write<&Result::WriteLocalThickness>,
                                       Filler::LocalThickness,
                                       false,
                                       GetLayout<ThicknessLayout> };

constexpr VolumeKind WallNumbers{ nullptr, Filler::Product, true, GetLayout<WallLayout> };

constexpr JobRefusal NoObjects{ "a map of objects", "run medialvoxel extract" };
constexpr JobRefusal NoMesh{ "a mesh, which joins what lies in all clusters,", "run medialvoxel mesh for it" };
constexpr JobRefusal NoWalls{ "walls, which join what lies in all clusters,",
                              "run medialvoxel extract without --resume" };
constexpr JobRefusal NoParameters{ "return parameters", "use the report" };

template <typename TOptions>
OutputKind<TOptions>
MakeReportKind()
{
  return { "report", &TOptions::reportFile, {}, {}, {}, nullptr, true };
}

} // namespace

const std::vector<OutputKind<ExtractOptions>> &
ListOutputKinds(const ExtractOptions &)
{
  using Options = ExtractOptions;
  static const std::vector<OutputKind<Options>> kinds{
    { "labels", &Options::output, Labels },
    { "objects", &Options::objectFile, Objects, NoObjects },
    { "vectors", &Options::vectorFile, CellVectors },
    { "distance", &Options::distanceFile, Distances },
    { "thickness_map", &Options::thicknessFile, Thicknesses },
    { "uncertainty_map", &Options::uncertaintyFile, Uncertainties },
    { "importance", &Options::importanceFile, Importances },
    { "importance_threshold", &Options::importanceThresholdFile, ImportanceThresholds },
    { "walls", &Options::wallsFile, WallNumbers, NoWalls },
    { "wall_table", &Options::wallTableFile, {}, NoWalls, { ".csv" }, "table of walls" },
    { "seam_table", &Options::seamTableFile, {}, NoWalls, { ".csv" }, "table of seams" },
    { "local_thickness", &Options::localThicknessFile, LocalThicknesses },
    { "places", &Options::placesFile, {}, {}, { ".csv" }, "list of places" },
    { "mesh", &Options::meshFile, {}, NoMesh },
    { "preview", &Options::previewFile, {}, {}, { ".png" }, "preview" },
    { "html", &Options::htmlFile, {}, {}, { ".html", ".htm" }, "page" },
    MakeReportKind<Options>(),
    { "return_parameters", &Options::returnParameterFile, {}, NoParameters },
  };
  return kinds;
}

const std::vector<OutputKind<DistanceOptions>> &
ListOutputKinds(const DistanceOptions &)
{
  static const std::vector<OutputKind<DistanceOptions>> kinds{
    { "vectors", &DistanceOptions::output, Vectors },
    { "distance", &DistanceOptions::distanceFile, Distances },
    MakeReportKind<DistanceOptions>(),
  };
  return kinds;
}

const std::vector<OutputKind<PartOptions>> &
ListOutputKinds(const PartOptions &)
{
  static const std::vector<OutputKind<PartOptions>> kinds{
    { "surface", &PartOptions::output },
    MakeReportKind<PartOptions>(),
  };
  return kinds;
}

bool
NumbersWalls(const ExtractOptions & options)
{
  return (options.meshWalls && !options.meshFile.empty()) || !options.wallsFile.empty() ||
         !options.wallTableFile.empty() || !options.seamTableFile.empty();
}

bool
FindsImportance(const ExtractOptions & options)
{
  return !options.importanceFile.empty() || !options.importanceThresholdFile.empty();
}

bool
MeasuresWalls(const ExtractOptions & options)
{
  const auto & kinds = ListOutputKinds(options);
  return ListsPlaces(options) || std::any_of(kinds.begin(), kinds.end(), [&options](const auto & kind) {
           return kind.volume && kind.volume->measuresWalls && !(options.*kind.option).empty();
         });
}

void
CheckExtensions(const ExtractOptions & options)
{
  for (const auto & kind : ListOutputKinds(options))
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
