// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshFile_h
#define medialvoxelMeshFile_h

#include "itkMedialVoxelVector3.h"

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <unordered_map>
#include <vector>

namespace medialvoxel
{

/** Triangles and quadrilaterals of a mesh that was read from a file. */
struct MeshFile
{
  struct Element
  {
    std::uint64_t                number{ 0 }; ///< that the file gives it
    std::array<std::uint32_t, 4> corners{};   ///< places in points
    unsigned int                 numberOfCorners{ 0 };
  };

  std::vector<itk::MedialVoxelVector3> points;
  std::vector<Element>                 elements;
};

/** \class MeshFileBuilder
 * \brief Puts together what a reader finds: nodes by their numbers, and elements, which may come first. */
class MeshFileBuilder
{
public:
  explicit MeshFileBuilder(std::string fileName)
    : m_FileName(std::move(fileName))
  {}

  const std::string &
  GetFileName() const
  {
    return m_FileName;
  }

  /** \throw JobError CorruptInput when the number comes twice, or a coordinate is not finite or beyond 1e30 */
  void
  AddNode(std::uint64_t number, const itk::MedialVoxelVector3 & point);

  /** \param nodes numbers of 3 or 4 nodes */
  void
  AddElement(std::uint64_t number, const std::vector<std::uint64_t> & nodes);

  /** \throw JobError CorruptInput when there is no element, or one names a node that is missing */
  MeshFile
  Finish();

private:
  std::string                                      m_FileName;
  MeshFile                                         m_Mesh;
  std::vector<std::vector<std::uint64_t>>          m_Nodes; ///< of each element
  std::unordered_map<std::uint64_t, std::uint32_t> m_Places;
};

/** Reads the next line without its end.
 * \return whether there is one
 * \throw JobError CorruptInput for a line that is too long for a text */
bool
ReadMeshLine(std::istream & input, std::string & line, const std::string & fileName);

/** Readers of the formats. Each leaves out what is neither a node nor a shell element.
 * \throw JobError CorruptInput naming the file and the line or number that it does not understand */
using MeshFileReader = void(std::istream & input, MeshFileBuilder & builder);
MeshFileReader ReadAbaqusMesh;
MeshFileReader ReadNastranMesh;
MeshFileReader ReadLsDynaMesh;
MeshFileReader ReadPlyMesh;
MeshFileReader ReadStlMesh; ///< binary or text; corners at one place are one node
MeshFileReader ReadVtkMesh; ///< .vtp and .vtu with appended raw data, as the program writes them

/** Extensions of files that are read. */
std::vector<std::string>
ListMeshFileExtensions();

/** \throw JobError Usage when the extension is of none of the formats
 * \throw JobError Refused when the file can not be opened, or is not a regular one
 * \throw JobError CorruptInput when it is not understood */
MeshFile
ReadMeshFile(const std::string & fileName);

} // end namespace medialvoxel

#endif
