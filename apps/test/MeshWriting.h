// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshWriting_h
#define medialvoxelMeshWriting_h

#include "Errors.h"
#include "MeshFormat.h"
#include "TestMeshes.h"
#include "TemporaryFolder.h"

#include <functional>
#include <sstream>

namespace medialvoxel
{

/** The bytes of the file that the surface becomes. */
inline std::string
WriteFile(const TestMesh &         surface,
          const std::string &      extension,
          const MeshWriteOptions & options = MeshWriteOptions(),
          size_t                   pieceSize = 1000,
          MeshPrecision            precision = MeshPrecision::Single)
{
  const TemporaryFolder folder;
  const std::string     name = "mesh" + extension;
  MeshSpool             spool(folder / "", precision);
  AddInPieces(surface, pieceSize, spool);
  OutputFile file(folder / name, false);
  file.Create(0, false);
  WriteMesh(GetMeshFormat(name), spool, options, file);
  file.Publish();
  return folder.Read(name);
}

/** One triangle and one quad; the quad's second diagonal is the shorter one. */
inline TestMesh
MakeTwoFaces()
{
  TestMesh surface;
  surface.vertices = {
    { { 0, 0, 0 }, 1.0 }, { { 4, 0, 0 }, 1.0 }, { { 5, 3, 0 }, 2.0 }, { { 1, 1.5, 0 }, 2.0 }, { { -2, 0, 1e-5 }, 1.5 }
  };
  surface.faces = { MakeFace({ 0, 1, 2, 3 }), MakeFace({ 0, 3, 4 }) };
  surface.faces[0].area = 3;
  surface.faces[1].area = 1;
  surface.faces[0].rimEdges = 7;
  surface.faces[1].junctionEdges = 2;
  return surface;
}

/** A row of squares, each with a thickness of its own. */
inline TestMesh
MakeSquares(const std::vector<double> & thicknesses)
{
  TestMesh surface;
  for (const double thickness : thicknesses)
  {
    const std::uint64_t first = surface.vertices.size();
    const auto          x = static_cast<double>(first);
    for (const auto & [dx, dy] : { std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1) })
    {
      surface.vertices.push_back({ { x + dx, static_cast<double>(dy), 0 }, thickness });
    }
    surface.faces.push_back(MakeFace({ first, first + 1, first + 2, first + 3 }));
  }
  CompleteFaces(surface);
  return surface;
}

/** Lines of the text after the lines that begin with \a begin. */
inline std::vector<std::string>
GetLinesAfter(const std::string & text, const std::string & begin)
{
  std::vector<std::string> lines;
  std::istringstream       stream(text);
  for (std::string line, previous; std::getline(stream, line); previous = line)
  {
    if (previous.rfind(begin, 0) == 0)
    {
      lines.push_back(line);
    }
  }
  return lines;
}

inline ExitStatus
GetStatusOf(const std::function<void()> & function)
{
  try
  {
    function();
  }
  catch (const JobError & error)
  {
    return error.GetStatus();
  }
  return ExitStatus::Done;
}

} // end namespace medialvoxel

#endif
