// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshFormat.h"

#include "Errors.h"
#include "MeshWriters.h"
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

/** The unit in which a format counts faces, and its limit. */
struct FormatDescription
{
  MeshFormat       format;
  std::string_view extension;
  MeshWriter *     writer;
  std::uint64_t    vertexLimit;
  const char *     unit;
  std::uint64_t (*countUnits)(const Counts & counts);
  std::uint64_t unitLimit;
  bool          isForParts{ false };   ///< holds all numbers of the surface of a part
  bool          isForSolvers{ false }; ///< holds elements with a thickness
  bool          holdsWalls{ true };    ///< of faces
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
  { { MeshFormat::Vtp, ".vtp", WriteMeshVtp, Unlimited, "faces", CountFaces, Unlimited, true },
    { MeshFormat::Vtu, ".vtu", WriteMeshVtu, Unlimited, "faces", CountFaces, Unlimited, true },
    { MeshFormat::Vtk, ".vtk", WriteMeshVtk, Int32Limit, "numbers in faces", CountLegacyNumbers, Int32Limit },
    { MeshFormat::Ply, ".ply", WriteMeshPly, Int32Limit, "faces", CountFaces, Int32Limit, true },
    { MeshFormat::Stl, ".stl", WriteMeshStl, Unlimited, "triangles", CountTriangles, UInt32Limit, false, false, false },
    { MeshFormat::Obj, ".obj", WriteMeshObj, Unlimited, "faces", CountFaces, Unlimited },
    { MeshFormat::Abaqus, ".inp", WriteMeshAbaqus, AbaqusLimit, "elements", CountFaces, AbaqusLimit, false, true },
    { MeshFormat::Nastran, ".bdf", WriteMeshNastran, FieldLimit, "elements", CountFaces, FieldLimit, false, true },
    { MeshFormat::LsDyna, ".k", WriteMeshLsDyna, FieldLimit, "elements", CountFaces, FieldLimit, false, true },
    { MeshFormat::Gltf,
      ".glb",
      WriteMeshGltf,
      Int32Limit,
      "numbers",
      CountGltfNumbers,
      GltfLimit,
      true,
      false,
      false } }
};

const FormatDescription &
GetDescription(MeshFormat format)
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

namespace
{

template <typename TCondition>
std::vector<std::string>
ListExtensions(TCondition && isListed)
{
  std::vector<std::string> extensions;
  for (const auto & description : Formats)
  {
    if (isListed(description))
    {
      extensions.emplace_back(description.extension);
    }
  }
  return extensions;
}

/** The format of the extension, which is to be one of the known ones. */
MeshFormat
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

std::vector<std::string>
ListMeshExtensions()
{
  return ListExtensions([](const FormatDescription &) { return true; });
}

std::vector<std::string>
ListPartExtensions()
{
  return ListExtensions([](const FormatDescription & description) { return description.isForParts; });
}

std::vector<std::string>
ListWallExtensions()
{
  return ListExtensions([](const FormatDescription & description) { return description.holdsWalls; });
}

MeshFormat
GetMeshFormat(const std::string & fileName)
{
  return FindFormat(fileName, "mesh", ListMeshExtensions());
}

MeshFormat
GetPartFormat(const std::string & fileName)
{
  return FindFormat(fileName, "surface", ListPartExtensions());
}

bool
HoldsDouble(MeshFormat format)
{
  return format != MeshFormat::Stl && format != MeshFormat::Gltf;
}

bool
HoldsElements(MeshFormat format)
{
  return GetDescription(format).isForSolvers;
}

bool
HoldsWalls(MeshFormat format)
{
  return GetDescription(format).holdsWalls;
}

std::string
GetObjectName(std::int64_t label)
{
  const std::string digits = std::to_string(label);
  return label < 0 ? "OBJECT_MINUS_" + digits.substr(1) : "OBJECT_" + digits;
}

std::string
GetWallName(std::uint64_t wall)
{
  return "WALL_" + std::to_string(wall);
}

void
CheckMeshFits(MeshFormat    format,
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
WriteMesh(MeshFormat format, const MeshSpool & surface, const MeshWriteOptions & options, OutputFile & file)
{
  if (surface.GetNumberOfNeededVertices() > surface.GetNumberOfVertices())
  {
    Fail(ExitStatus::Failure,
         "a face of the mesh names vertex ",
         surface.GetNumberOfNeededVertices() - 1,
         " of ",
         surface.GetNumberOfVertices());
  }
  CheckMeshFits(format, surface.GetNumberOfVertices(), surface.GetNumberOfTriangles(), surface.GetNumberOfQuads());
  MeshReader     reader(surface, options.progress);
  BufferedOutput output(file);
  GetDescription(format).writer(reader, options, output);
  output.Finish();
}

} // end namespace medialvoxel
