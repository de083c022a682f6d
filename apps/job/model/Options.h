// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelOptions_h
#define medialvoxelOptions_h

#include "PlaceSummary.h"
#include "VolumeHeader.h"
#include "Compression.h"

#include "itkMedialVoxelEnums.h"
#include "itkMedialVoxelExactNumber.h"
#include "itkMedialVoxelParameters.h"
#include "WallMeasure.h"

#include "itkMedialVoxelRoughness.h"
#include "itkMedialVoxelSmoothingLevel.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** A whole number of any integer type with up to 64 bits. */
using LabelValue = itk::MedialVoxelExactNumber;

/** Digits, with a minus sign for negative ones; nothing for other texts and below -2^63 or from 2^64 on. */
std::optional<LabelValue>
ParseLabel(const std::string & text);
std::string
FormatLabel(const LabelValue & label);

/** In place of a file name: write it to the standard output. */
constexpr const char * StandardOutput = "-";

/** Values of a label map that are objects of their own. */
struct LabelSelection
{
  bool                      all{ false }; ///< all but 0
  std::vector<std::int64_t> values;       ///< otherwise these, none of them 0
  std::vector<std::string>  names;        ///< names of further segments
};

/** "all", or labels from -2^63 to 2^63 - 1 other than 0, and names, with commas between them; nothing for other texts.
 */
std::optional<LabelSelection>
ParseLabelSelection(const std::string & text);

constexpr double KeepSpacing = -1.0;

/** Options of every job on a volume. An empty file name means: not wanted. */
struct JobOptions
{
  std::string                   input;
  std::optional<RawDescription> raw;    ///< set for headerless files
  SliceChoice                   slices; ///< of an input that is a series of images

  unsigned int        level{ 0 }; ///< of an input that is there in several sizes, 0 the largest
  std::vector<double> spacing;    ///< along each axis, in place of that of the input; empty: as the input has it

  /** Spacing that the input is brought to; 0: the smallest of its own; KeepSpacing: as it is; unset: the smallest where
   * sheets need it. */
  std::optional<double> resample;

  std::optional<itk::MedialVoxelExactNumber> lowerThreshold; ///< object: value >= lower; unset: no limit
  std::optional<itk::MedialVoxelExactNumber>
                            upperThreshold;       ///< object: value <= upper; neither set: object is value != 0
  bool                      lowerIsOtsu{ false }; ///< measure the lower threshold, unless it is set already
  std::optional<LabelValue> label;                ///< object: value == label, and no thresholds; unset: they decide

  std::optional<double> neededMaximum; ///< thickness that walls need in place of the default, once known

  std::string distanceFile; ///< signed distance, float32
  std::string reportFile;   ///< JSON; StandardOutput: the caller writes MakeReport() there
  std::string logFile;      ///< gets a line for each step; existing ones stay
  std::string command;      ///< that was typed, for the page; empty: not known

  std::string scratchFolder; ///< for a compressed volume whose values do not fit the memory; empty: none

  std::optional<std::uint64_t> memoryLimit;     ///< cap on the memory; unset: half of the free memory
  std::optional<unsigned int>  threads;         ///< 1 or more; unset: as ITK decides
  std::optional<std::uint64_t> divisions;       ///< pieces along the last axis, 1 or more; unset: chosen
  bool                         sparse{ false }; ///< blocks of zeros stay holes of the files, nothing is reserved
  Compression                  compression{ Compression::Default }; ///< of volumes
  bool                         overwrite{ false };                  ///< replace existing outputs
  bool                         dryRun{ false };                     ///< plan and check only
};

/** Largest value of ExtractOptions::maximumPoreSize. */
constexpr std::uint64_t LargestPoreSize = itk::MedialVoxelParameters::LargestMaximumPoreSize;

using Smoothing = itk::MedialVoxelSmoothing;
using LocalThicknessMethod = itk::MedialVoxelLocalThicknessMethod;

/** Lengths that colors span. */
struct ColorRange
{
  double low;
  double high; ///< greater than low
};

/** How long the sides of the faces of a mesh are. */
struct ElementSize
{
  enum class Kind
  {
    Voxel,     ///< one face for each cell
    Automatic, ///< as long as the wall is thick, at least two voxels
    Length     ///< as given, and as long as the wall is thick at least at junctions and bends
  };
  Kind   kind{ Kind::Voxel };
  double length{ 0 }; ///< physical units, > 0, with Kind::Length
};

/** Where formats of solvers have the thickness of their elements. */
enum class ThicknessPlace
{
  Sections, ///< elements of nearly the same thickness share a section
  Nodes     ///< each node, or each corner of an element where a format has them
};

/** Medial voxels. */
struct ExtractOptions : JobOptions
{
  std::string output; ///< labels, unsigned char

  /** Lengths > 0 and finite, in physical units. The limits belong to the automatic thickness. */
  std::optional<double> thickness;        ///< tau; unset: automatic
  std::optional<double> minimumThickness; ///< unset: 3 voxels of the smallest spacing
  std::optional<double> maximumThickness; ///< unset: 16 voxels of the smallest spacing, or what walls need

  /** Voxels of the largest pores and grains that are taken for noise, up to LargestPoreSize; unset: 32 with the
   * automatic thickness, otherwise 0, for none. */
  std::optional<std::uint64_t> maximumPoreSize;

  std::optional<Smoothing>                 smoothing; ///< unset: automatic with the automatic thickness, otherwise off
  std::optional<itk::MedialVoxelRoughness> roughness; ///< of the object, when it is known before

  std::optional<itk::MedialVoxelSmoothingLevel> smoothingLevel; ///< of smoothed values, when it is known before

  /** Measure on gray values, which needs a threshold; unset: where one threshold cuts the values. */
  std::optional<bool> subVoxel;

  std::optional<itk::MedialVoxelScanLevels> materials; ///< values of both materials; unset: from the scan
  std::optional<WallMeasure>                measure;   ///< how walls are measured, when it is known before

  std::optional<LabelSelection> labels;     ///< each of these values is an object of its own, without thresholds
  std::string                   objectFile; ///< label of the object of each cell, of the type of the input
  std::string segmentFile; ///< names and colors of the labels; empty: from the input, where it has some

  bool sameTopology{ false }; ///< add cells to the labels, so that they have the topology of the object

  std::string                vectorFile; ///< vectors to the nearest boundary point, float32
  itk::MedialVoxelBoundary   vectorBoundary{ itk::MedialVoxelBoundary::Object };
  std::string                thicknessFile;           ///< thickness at medial cells, float32
  std::string                uncertaintyFile;         ///< of the thickness at medial cells, float32
  std::string                importanceFile;          ///< geodesic distance of the pair of each cell, float32
  std::string                importanceThresholdFile; ///< what it is compared with, float32
  std::string                wallsFile;               ///< number of the wall of each cell, uint32
  std::string                wallTableFile;           ///< these walls, comma-separated values
  std::string                seamTableFile;           ///< where they meet, comma-separated values
  std::string                localThicknessFile;      ///< local thickness of the object voxels, float32
  LocalThicknessMethod       localThicknessMethod{ LocalThicknessMethod::Wall };
  std::optional<double>      largestBall; ///< largest of them, > 0; unset: 32 voxels of the largest spacing
  std::optional<PlaceLimits> thinBelow;   ///< places with thinner walls are listed; not with labels
  std::optional<PlaceLimits> thickAbove;  ///< places with thicker walls are listed; not with labels
  std::string                placesFile;  ///< these places, comma-separated values
  bool failsIfThin{ false };              ///< the program ends with ExitStatus::TooThin when there are thin ones

  std::string           previewFile;               ///< PNG
  std::string           htmlFile;                  ///< report as a page with the preview
  std::string           returnParameterFile;       ///< counts and seconds for 3D Slicer, a line each
  std::string           meshFile;                  ///< medial surface; then the labels may be empty too
  bool                  meshTriangles{ false };    ///< split its quadrilaterals
  double                minimumBranchLength{ 0 };  ///< of branches that stay in the mesh; physical units, 0: all stay
  std::uint64_t         minimumComponentSize{ 0 }; ///< quadrilaterals of components that stay in the mesh
  ElementSize           elementSize;               ///< of the mesh
  bool                  extendsRims{ false }; ///< of the mesh, to the free edges; not with ElementSize::Kind::Voxel
  ThicknessPlace        thicknessPlace{ ThicknessPlace::Sections }; ///< of a mesh for solvers
  bool                  meshWalls{ false };                         ///< faces of the mesh have the number of their wall
  std::optional<double> sectionWidth; ///< as MeshWriteOptions; unset: a quarter of the spacing

  std::optional<ColorRange> colorRange; ///< of page and picture; unset: as measured
};

/** Vector and signed distances. */
struct DistanceOptions : JobOptions
{
  std::string              output; ///< vectors, float32
  itk::MedialVoxelBoundary boundary{ itk::MedialVoxelBoundary::Object };
  itk::MedialVoxelRegion   region{ itk::MedialVoxelRegion::Both };
  std::optional<double>    maximumDistance; ///< > 0; vectors beyond are not a number
};

/** The surface of a part, with its thickness. */
struct PartOptions : JobOptions
{
  std::string                  output; ///< triangles
  LocalThicknessMethod         localThicknessMethod{ LocalThicknessMethod::Wall };
  std::optional<double>        largestBall;     ///< as ExtractOptions; longest ray too
  std::optional<std::uint64_t> maximumPoreSize; ///< as ExtractOptions, of the thickness alone
  std::optional<bool>          subVoxel; ///< place it and measure walls by gray values; unset: where these allow it
  bool                         isOpen{ false };       ///< where the volume cuts the part
  bool                         measuresRays{ false }; ///< thickness by rays too
};

/** The extraction that maps the local thickness of the part. */
ExtractOptions
GetThicknessOptions(const PartOptions & options);


/** Whether places with too thin or too thick walls are listed. */
bool
ListsPlaces(const ExtractOptions & options);

/** The file of the report; empty when it goes to the standard output. */
std::string
GetReportFile(const JobOptions & options);

/** The image of the header. */
itk::MedialVoxelGrid
GetGrid(const VolumeHeader & header);

/** Whether walls may be measured on gray values, unless these are a mask or a label map. */
bool
MayMeasureOnGrayValues(const ExtractOptions & options, const VolumeHeader & header);

/** Why the options have walls measured on the object. */
std::string
DescribeMeasureOnObject(const ExtractOptions & options, const VolumeHeader & header);

/** Whether values are cut off at one end alone; a threshold that no value of the type reaches does not count. */
bool
HasOneThreshold(const JobOptions & options, const VolumeHeader & header);

/** The values of the object, for measures on gray values. */
itk::MedialVoxelSheetExtraction::GrayRange
GetGrayRange(const JobOptions & options, const VolumeHeader & header);

/** The smoothing that is asked for. */
Smoothing
GetRequestedSmoothing(const ExtractOptions & options);

/** The same, on or off when the roughness is known. */
Smoothing
GetSmoothing(const ExtractOptions & options);

/** The parameters of the thickness, with the limits in effect on \a grid.
 * \throw JobError Usage when the limits contradict each other. */
itk::MedialVoxelParameters
GetParameters(const ExtractOptions & options, const itk::MedialVoxelGrid & grid);

/** The task to find the local thickness of the object; walls are measured on it.
 * \throw JobError Usage when its maximum is too large for \a grid. */
itk::MedialVoxelLocalThickness
GetLocalThickness(const ExtractOptions & options, const itk::MedialVoxelGrid & grid);

/** The maximum thickness that is raised where walls need it; none when it is given or known, or for labels. */
std::optional<double>
GetDefaultMaximumThickness(const ExtractOptions & options, const itk::MedialVoxelGrid & grid);

/** The limits of the automatic thickness in effect on \a grid. */
itk::MedialVoxelParameters::Limits
GetLimitsOfWalls(const ExtractOptions & options, const itk::MedialVoxelGrid & grid);

/** The automatic thickness, on the command line and in reports. */
constexpr const char * AutomaticThickness = "auto";

constexpr const char * AutomaticElementSize = "auto";
constexpr const char * VoxelElementSize = "voxel";

/** Stands for the smallest spacing of the input as the spacing to resample to. */
constexpr const char * AutomaticSpacing = "auto";

/** Keeps the spacing of the input. */
constexpr const char * UnchangedSpacing = "off";

/** The thickness and its unit for a reader. */
std::string
DescribeThickness(const ExtractOptions & options, const std::string & unit);

/** Names of the enumerators on the command line and in reports. */
std::string
GetName(itk::MedialVoxelBoundary boundary);
std::string
GetName(itk::MedialVoxelRegion region);
std::string
GetName(Smoothing smoothing);
std::string
GetName(LocalThicknessMethod method);

} // end namespace medialvoxel

#endif
