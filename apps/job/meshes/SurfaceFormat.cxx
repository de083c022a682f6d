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

constexpr std::uint64_t AbaqusLimit = 999'999'999;
constexpr std::uint64_t NastranLimit = 99'999'999;

constexpr std::array<FormatDescription, 8> Formats{
  { { SurfaceFormat::Vtp, ".vtp", WriteSurfaceVtp, Unlimited, "faces", CountFaces, Unlimited },
    { SurfaceFormat::Vtu, ".vtu", WriteSurfaceVtu, Unlimited, "faces", CountFaces, Unlimited },
    { SurfaceFormat::Vtk, ".vtk", WriteSurfaceVtk, Int32Limit, "numbers in faces", CountLegacyNumbers, Int32Limit },
    { SurfaceFormat::Ply, ".ply", WriteSurfacePly, Int32Limit, "faces", CountFaces, Int32Limit },
    { SurfaceFormat::Stl, ".stl", WriteSurfaceStl, Unlimited, "triangles", CountTriangles, UInt32Limit },
    { SurfaceFormat::Obj, ".obj", WriteSurfaceObj, Unlimited, "faces", CountFaces, Unlimited },
    { SurfaceFormat::Abaqus, ".inp", WriteSurfaceAbaqus, AbaqusLimit, "elements", CountFaces, AbaqusLimit },
    { SurfaceFormat::Nastran, ".bdf", WriteSurfaceNastran, NastranLimit, "elements", CountFaces, NastranLimit } }
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

SurfaceFormat
GetSurfaceFormat(const std::string & fileName)
{
  const std::string extension = ToLower(std::filesystem::path(fileName).extension().string());
  const auto *      found = std::find_if(
    Formats.begin(), Formats.end(), [&](const auto & description) { return description.extension == extension; });
  if (found == Formats.end())
  {
    const std::string known = Join(ListSurfaceExtensions(), ", ", [](const std::string & name) { return name; });
    Fail(ExitStatus::Usage, "the extension of the mesh ", fileName, " is not one of ", known);
  }
  return found->format;
}

bool
HoldsDouble(SurfaceFormat format)
{
  return format != SurfaceFormat::Stl;
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
