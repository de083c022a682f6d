// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshFormat_h
#define medialvoxelMeshFormat_h

#include "Options.h"
#include "OutputFile.h"
#include "VertexValues.h"
#include "MeshSpool.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace medialvoxel
{

/** Files that hold a surface. */
enum class MeshFormat
{
  Vtp,     ///< VTK XML PolyData, appended raw binary
  Vtu,     ///< VTK XML UnstructuredGrid, appended raw binary
  Vtk,     ///< VTK legacy PolyData, binary
  Ply,     ///< binary, little endian
  Stl,     ///< binary, triangles only, no thickness
  Obj,     ///< text, no thickness
  Abaqus,  ///< .inp, S3 and S4
  Nastran, ///< .bdf, CTRIA3 and CQUAD4
  LsDyna,  ///< .k, shells
  Gltf     ///< .glb, triangles with colors of the thickness
};

/** Extensions of all formats. */
std::vector<std::string>
ListMeshExtensions();

/** Extensions of the formats that hold all numbers of the surface of a part. */
std::vector<std::string>
ListPartExtensions();

/** The format that the extension stands for, in any case.
 * \throw JobError Usage for any other. */
MeshFormat
GetMeshFormat(const std::string & fileName);

/** The same, of the formats for the surface of a part. */
MeshFormat
GetPartFormat(const std::string & fileName);

/** Whether a format holds coordinates of 64 bits. */
bool
HoldsDouble(MeshFormat format);

/** Whether a format has a place for the wall of each face. */
bool
HoldsWalls(MeshFormat format);

/** Extensions of these formats. */
std::vector<std::string>
ListWallExtensions();

/** Least and greatest thickness that a color of its own stands for. */
struct ThicknessRange
{
  double low{ 0.0 };
  double high{ 0.0 };
};

/** Whether a format is that of a solver. */
bool
HoldsElements(MeshFormat format);

/** The settings of the writers. */
struct MeshWriteOptions
{
  /** Where formats of solvers have the thickness. */
  ThicknessPlace thicknessPlace{ ThicknessPlace::Sections };

  /** With ThicknessPlace::Sections: elements whose thickness has the same nearest multiple of this width share a
   * section, whose thickness is their mean by area. Physical units, > 0 and finite. The program takes a quarter of the
   * smallest spacing. */
  double thicknessClassWidth{ 1.0 };

  /** The labels of the objects of a label map, by their numbers from 1 on; the faces of an object follow each other.
   * Empty: the surface is that of one object, and nothing is written of it. */
  std::vector<std::int64_t> objectLabels;

  /** Faces have the number of their wall. */
  bool hasWalls{ false };

  /** The surface of a part, not its medial surface: its faces have no rims and junctions, but caps. */
  bool isOfPart{ false };

  /** The unit of lengths, for a reader. */
  std::string unit{ "units of the spacing" };

  /** Further numbers of all vertices, with their names; formats for the surface of a part have them. */
  std::vector<const VertexValues *> vertexArrays;

  /** For formats with colors; unset: from the least to the greatest thickness of the vertices. */
  std::optional<ThicknessRange> colorRange;

  /** Solvers: elements or nodes whose numbers or thickness, of 8 bytes, are kept at once; no other influence. */
  std::uint64_t keptNumbers{ std::uint64_t{ 1 } << 22 };

  /** Called with the share done, 0 to 1, some times per second; may throw to stop. */
  std::function<void(double)> progress;
};

/** \throw JobError Refused when the format cannot hold so many elements, naming its limit. */
void
CheckMeshFits(MeshFormat    format,
              std::uint64_t numberOfVertices,
              std::uint64_t numberOfTriangles,
              std::uint64_t numberOfQuads);

/** Writes the surface to a file that was created, and finishes it, so that it can be published.
 * \throw JobError Refused when the format cannot hold a surface of this size, naming its limit
 * \throw JobError Failure when the disk fails or a face names a vertex that is missing */
void
WriteMesh(MeshFormat format, const MeshSpool & surface, const MeshWriteOptions & options, OutputFile & file);

} // end namespace medialvoxel

#endif
