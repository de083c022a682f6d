// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "SurfaceFormat.h"

#include "Errors.h"
#include "SurfaceWriters.h"
#include "Text.h"

#include <algorithm>

namespace medialvoxel
{
namespace
{

constexpr std::uint64_t Unlimited = ~std::uint64_t{ 0 };
constexpr std::uint64_t Int32Limit = (std::uint64_t{ 1 } << 31) - 1;
constexpr std::uint64_t UInt32Limit = (std::uint64_t{ 1 } << 32) - 1;

struct Counts
{
  std::uint64_t vertices;
  std::uint64_t triangles;
  std::uint64_t quads;
};

/** What a format counts its faces by, and how many it holds. */
struct FormatDescription
{
  SurfaceFormat    format;
  std::string_view extension;
  SurfaceWriter *  writer;
  std::uint64_t    vertexLimit;
  const char *     unit;
  std::uint64_t (*countUnits)(const Counts & counts);
  std::uint64_t unitLimit;
  bool          isForParts{ false };   ///< holds all numbers of the surface of a part
  bool          isForSolvers{ false }; ///< holds elements with a thickness
};

std::uint64_t
CountFaces(const Counts & counts)
{
  return counts.triangles + counts.quads;
}

std::uint64_t
CountTriangles(const Counts & counts)
{
  return counts.triangles + 2 * counts.quads;
}

/** The legacy format counts a face as its corners and one number more. */
std::uint64_t
CountLegacyNumbers(const Counts & counts)
{
  return 4 * counts.triangles + 5 * counts.quads;
}

/** Numbers of 32 bits: place, color and thickness of a vertex, perhaps a further one, and the corners of a triangle. */
std::uint64_t
CountGltfNumbers(const Counts & counts)
{
  return 6 * counts.vertices + 3 * CountTriangles(counts);
}

constexpr std::uint64_t AbaqusLimit = 999'999'999;

/** Numbers have fields of eight characters. */
constexpr std::uint64_t FieldLimit = 99'999'999;

/** A file has a length of 32 bits, of which the header takes some. */
constexpr std::uint64_t GltfLimit = (std::uint64_t{ 1 } << 30) - (std::uint64_t{ 1 } << 12);

constexpr std::array<FormatDescription, 10> Formats{
  { { SurfaceFormat::Vtp, ".vtp", WriteSurfaceVtp, Unlimited, "faces", CountFaces, Unlimited, true },
    { SurfaceFormat::Vtu, ".vtu", WriteSurfaceVtu, Unlimited, "faces", CountFaces, Unlimited, true },
    { SurfaceFormat::Vtk, ".vtk", WriteSurfaceVtk, Int32Limit, "numbers in faces", CountLegacyNumbers, Int32Limit },
    { SurfaceFormat::Ply, ".ply", WriteSurfacePly, Int32Limit, "faces", CountFaces, Int32Limit, true },
    { SurfaceFormat::Stl, ".stl", WriteSurfaceStl, Unlimited, "triangles", CountTriangles, UInt32Limit },
    { SurfaceFormat::Obj, ".obj", WriteSurfaceObj, Unlimited, "faces", CountFaces, Unlimited },
    { SurfaceFormat::Abaqus,
      ".inp",
      WriteSurfaceAbaqus,
      AbaqusLimit,
      "elements",
      CountFaces,
      AbaqusLimit,
      false,
      true },
    { SurfaceFormat::Nastran,
      ".bdf",
      WriteSurfaceNastran,
      FieldLimit,
      "elements",
      CountFaces,
      FieldLimit,
      false,
      true },
    { SurfaceFormat::LsDyna, ".k", WriteSurfaceLsDyna, FieldLimit, "elements", CountFaces, FieldLimit, false, true },
    { SurfaceFormat::Gltf, ".glb", WriteSurfaceGltf, Int32Limit, "numbers", CountGltfNumbers, GltfLimit, true } }
};

const FormatDescription &
GetDescription(SurfaceFormat format)
{
  return *std::find_if(
    Formats.begin(), Formats.end(), [format](const auto & description) { return description.format == format; });
}

void
CheckLimit(const FormatDescription & description, const char * unit, std::uint64_t number, std::uint64_t limit)
{
  if (number > limit)
  {
    Fail(ExitStatus::Refused,
         "the mesh has ",
         number,
         " ",
         unit,
         ", ",
         description.extension,
         " holds ",
         limit,
         " at most; .vtp and .vtu have no such limit");
  }
}

} // namespace

std::vector<std::string>
ListSurfaceExtensions()
{
  std::vector<std::string> extensions;
  for (const auto & description : Formats)
  {
    extensions.emplace_back(description.extension);
  }
  return extensions;
}

std::vector<std::string>
ListPartExtensions()
{
  std::vector<std::string> extensions;
  for (const auto & description : Formats)
  {
    if (description.isForParts)
    {
      extensions.emplace_back(description.extension);
    }
  }
  return extensions;
}

namespace
{

/** The format of the extension, which is to be one of the known ones. */
SurfaceFormat
FindFormat(const std::string & fileName, const char * what, const std::vector<std::string> & known)
{
  const std::string extension = ToLower(std::filesystem::path(fileName).extension().string());
  if (std::find(known.begin(), known.end(), extension) == known.end())
  {
    Fail(ExitStatus::Usage,
         "the extension of the ",
         what,
         " ",
         fileName,
         " is not one of ",
         Join(known, ", ", [](const std::string & name) { return name; }));
  }
  return std::find_if(
           Formats.begin(), Formats.end(), [&](const auto & description) { return description.extension == extension; })
    ->format;
}

} // namespace

SurfaceFormat
GetSurfaceFormat(const std::string & fileName)
{
  return FindFormat(fileName, "mesh", ListSurfaceExtensions());
}

SurfaceFormat
GetPartFormat(const std::string & fileName)
{
  return FindFormat(fileName, "surface", ListPartExtensions());
}

bool
HoldsDouble(SurfaceFormat format)
{
  return format != SurfaceFormat::Stl && format != SurfaceFormat::Gltf;
}

bool
HoldsElements(SurfaceFormat format)
{
  return GetDescription(format).isForSolvers;
}

std::string
GetObjectName(std::int64_t label)
{
  const std::string digits = std::to_string(label);
  return label < 0 ? "OBJECT_MINUS_" + digits.substr(1) : "OBJECT_" + digits;
}

void
CheckSurfaceFits(SurfaceFormat format,
                 std::uint64_t numberOfVertices,
                 std::uint64_t numberOfTriangles,
                 std::uint64_t numberOfQuads)
{
  const FormatDescription & description = GetDescription(format);
  const Counts              counts{ numberOfVertices, numberOfTriangles, numberOfQuads };
  CheckLimit(description, "vertices", numberOfVertices, description.vertexLimit);
  CheckLimit(description, description.unit, description.countUnits(counts), description.unitLimit);
}

void
WriteSurface(SurfaceFormat format, const SurfaceSpool & surface, const SurfaceWriteOptions & options, OutputFile & file)
{
  if (surface.GetNumberOfNeededVertices() > surface.GetNumberOfVertices())
  {
    Fail(ExitStatus::Failure,
         "a face of the mesh names vertex ",
         surface.GetNumberOfNeededVertices() - 1,
         " of ",
         surface.GetNumberOfVertices());
  }
  CheckSurfaceFits(format, surface.GetNumberOfVertices(), surface.GetNumberOfTriangles(), surface.GetNumberOfQuads());
  SurfaceReader  reader(surface, options.progress);
  BufferedOutput output(file);
  GetDescription(format).writer(reader, options, output);
  output.Finish();
}

} // end namespace medialvoxel
