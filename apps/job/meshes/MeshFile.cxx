// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "MeshFile.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace medialvoxel
{
namespace
{

struct Format
{
  const char *     extension;
  MeshFileReader * reader;
};

constexpr std::array<Format, 7> Formats{ { { ".inp", ReadAbaqusMesh },
                                           { ".bdf", ReadNastranMesh },
                                           { ".k", ReadLsDynaMesh },
                                           { ".vtp", ReadVtkMesh },
                                           { ".vtu", ReadVtkMesh },
                                           { ".ply", ReadPlyMesh },
                                           { ".stl", ReadStlMesh } } };

/** Products of six coordinates are still numbers. */
constexpr double LargestCoordinate = 1e30;

/** Bytes; a longer one is no text. */
constexpr std::size_t LongestLine = std::size_t{ 1 } << 20;

/** Opens a file without waiting for another process to write it. */
std::ifstream
Open(const std::string & fileName)
{
  std::error_code                    error;
  const std::filesystem::file_status status = std::filesystem::status(fileName, error);
  const bool                         isThere = std::filesystem::exists(status);
  if (isThere && !std::filesystem::is_regular_file(status))
  {
    const char * const kind = std::filesystem::is_directory(status) ? "it is a folder" : "it is not a regular file";
    Fail(ExitStatus::Refused, "cannot open ", fileName, ": ", kind);
  }
  errno = 0;
  std::ifstream input(fileName, std::ios::binary);
  if (!input)
  {
    Fail(ExitStatus::Refused, "cannot open ", fileName, ": ", std::strerror(errno));
  }
  return input;
}

} // namespace

bool
ReadMeshLine(std::istream & input, std::string & line, const std::string & fileName)
{
  constexpr int    end = std::istream::traits_type::eof();
  std::streambuf & buffer = *input.rdbuf();
  int              byte = end;
  for (line.clear(); (byte = buffer.sbumpc()) != end && byte != '\n';)
  {
    line.push_back(static_cast<char>(byte));
    if (line.size() > LongestLine)
    {
      Fail(ExitStatus::CorruptInput, fileName, ": has a line of more than ", LongestLine, " bytes; it is not a mesh");
    }
  }
  const bool isRead = byte != end || !line.empty();
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  return isRead;
}

void
MeshFileBuilder::AddNode(const std::uint64_t number, const itk::MedialVoxelVector3 & point)
{
  for (const double coordinate : point)
  {
    if (!(std::abs(coordinate) <= LargestCoordinate))
    {
      Fail(ExitStatus::CorruptInput,
           m_FileName,
           ": node ",
           number,
           " has the coordinate ",
           FormatNumber(coordinate),
           "; it must be finite and not beyond 1e30");
    }
  }
  if (!m_Places.emplace(number, static_cast<std::uint32_t>(m_Mesh.points.size())).second)
  {
    Fail(ExitStatus::CorruptInput, m_FileName, ": node ", number, " comes twice");
  }
  m_Mesh.points.push_back(point);
}

void
MeshFileBuilder::AddElement(const std::uint64_t number, const std::vector<std::uint64_t> & nodes)
{
  MeshFile::Element element;
  element.number = number;
  element.numberOfCorners = static_cast<unsigned int>(nodes.size());
  m_Mesh.elements.push_back(element);
  m_Nodes.push_back(nodes);
}

MeshFile
MeshFileBuilder::Finish()
{
  if (m_Mesh.elements.empty())
  {
    Fail(ExitStatus::CorruptInput, m_FileName, ": has no shell elements of three or four nodes");
  }
  for (std::size_t k = 0; k < m_Nodes.size(); ++k)
  {
    for (std::size_t corner = 0; corner < m_Nodes[k].size(); ++corner)
    {
      const auto place = m_Places.find(m_Nodes[k][corner]);
      if (place == m_Places.end())
      {
        Fail(ExitStatus::CorruptInput,
             m_FileName,
             ": element ",
             m_Mesh.elements[k].number,
             " names node ",
             m_Nodes[k][corner],
             ", which is missing");
      }
      m_Mesh.elements[k].corners[corner] = place->second;
    }
  }
  return std::move(m_Mesh);
}

std::vector<std::string>
ListMeshFileExtensions()
{
  std::vector<std::string> extensions;
  for (const Format & format : Formats)
  {
    extensions.emplace_back(format.extension);
  }
  return extensions;
}

MeshFile
ReadMeshFile(const std::string & fileName)
{
  const std::string extension = ToLower(std::filesystem::path(fileName).extension().string());
  const auto *      format =
    std::find_if(Formats.begin(), Formats.end(), [&](const Format & known) { return known.extension == extension; });
  if (format == Formats.end())
  {
    const std::string known = Join(ListMeshFileExtensions(), ", ", [](const std::string & name) { return name; });
    Fail(ExitStatus::Usage, "the extension of the mesh ", fileName, " is not one of ", known);
  }
  std::ifstream   input = Open(fileName);
  MeshFileBuilder builder(fileName);
  format->reader(input, builder);
  return builder.Finish();
}

} // end namespace medialvoxel
