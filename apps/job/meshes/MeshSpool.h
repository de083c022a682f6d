// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelMeshSpool_h
#define medialvoxelMeshSpool_h

#include "ScratchFile.h"
#include "MeshSink.h"

#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace medialvoxel
{

/** The fields of faces that are read; the others are undefined. Fewer are faster. */
enum class MeshFaceFields : std::uint8_t
{
  Corners = 1, ///< vertices and numberOfVertices
  Marks = 2,   ///< all but the vertices
  All = 3
};

/** The input of a MeshSpool. */
enum class MeshSpoolInput : std::uint8_t
{
  Any,
  Added ///< only MeshSpool::AddVertices(), whose rounded coordinates take less space
};

/** \class MeshSpool
 * \brief A surface in scratch files, whatever its size: at most 32 bytes per vertex and 40 per face, and a few
 * MB of memory.
 *
 * Writers of files read it as often as they need, one surface may go to several files. */
class MeshSpool : public MeshSink
{
public:
  /** In the scratch files, at most. */
  static constexpr std::uint64_t VertexSize = 32;
  static constexpr std::uint64_t FaceSize = 40;
  static constexpr std::uint64_t WallSize = sizeof(std::uint32_t); ///< of each face, where walls are set

  /** Numbers of a vertex as files have them. */
  struct Vertex
  {
    std::array<double, 3> position;  ///< rounded to the precision of the surface
    float                 thickness; ///< as in MeshVertex
    std::uint32_t         object;    ///< as in MeshVertex
  };

  /** \param folder where the scratch files are, without a name
   * \param precision of the coordinates that files will have
   * \throw JobError Refused when the folder is missing or cannot be written. */
  explicit MeshSpool(const std::filesystem::path & folder,
                     MeshPrecision                 precision = MeshPrecision::Single,
                     MeshSpoolInput                input = MeshSpoolInput::Any);

  void
  AddVertices(const std::vector<MeshVertex> & vertices) override;
  void
  AddFaces(const std::vector<MeshFace> & faces) override;

  /** Vertices in any order, from any threads: a run from number \a first on. All numbers up to the largest must come,
   * each once. */
  void
  PutVertices(std::uint64_t first, const std::vector<Vertex> & vertices);
  void
  PutVertices(std::uint64_t first, const std::vector<MeshVertex> & vertices);

  /** The same for faces. */
  void
  PutFaces(std::uint64_t first, const std::vector<MeshFace> & faces);

  MeshPrecision
  GetPrecision() const
  {
    return m_Precision;
  }

  std::uint64_t
  GetNumberOfVertices() const
  {
    return m_NumberOfVertices;
  }
  std::uint64_t
  GetNumberOfTriangles() const
  {
    return m_NumberOfTriangles;
  }
  std::uint64_t
  GetNumberOfQuads() const
  {
    return m_NumberOfQuads;
  }
  std::uint64_t
  GetNumberOfFaces() const
  {
    return m_NumberOfTriangles + m_NumberOfQuads;
  }

  /** Vertices that faces refer to at least: the largest number plus 1. */
  std::uint64_t
  GetNumberOfNeededVertices() const
  {
    return m_NumberOfNeededVertices;
  }

  /** Sets the walls of faces that are there, from number \a first on. */
  void
  PutWalls(std::uint64_t first, const std::vector<std::uint32_t> & walls);

  /** Reads \a count vertices from number \a first on, which exist. \throw JobError Failure. */
  void
  ReadVertices(std::uint64_t first, std::uint64_t count, std::vector<Vertex> & vertices) const;

  /** Reads \a count faces from number \a first on, which exist. \throw JobError Failure. */
  void
  ReadFaces(std::uint64_t           first,
            std::uint64_t           count,
            std::vector<MeshFace> & faces,
            MeshFaceFields          parts = MeshFaceFields::All) const;

private:
  /** Numbers of a file that is written only where one of them is not zero. */
  class RareNumbers
  {
  public:
    explicit RareNumbers(std::filesystem::path folder)
      : m_Folder(std::move(folder))
    {}

    void
    Write(std::uint64_t first, const std::vector<std::uint32_t> & numbers);

    /** Zeros where nothing was written. */
    std::vector<std::uint32_t>
    Read(std::uint64_t first, std::uint64_t count) const;

  private:
    std::filesystem::path      m_Folder;
    std::optional<ScratchFile> m_File;
    std::uint64_t              m_End{ 0 };
  };

  void
  ReadCorners(std::uint64_t first, std::vector<MeshFace> & faces) const;

  std::mutex    m_Mutex; // of all but the first three files
  ScratchFile   m_VertexFile;
  ScratchFile   m_CornerFile;
  ScratchFile   m_MarkFile;
  RareNumbers   m_Objects;      // of vertices
  RareNumbers   m_UpperCorners; // four of each face: the upper halves of the numbers of its vertices
  RareNumbers   m_Walls;        // of faces
  MeshPrecision m_Precision;
  bool          m_HoldsFloats; // in the records of vertices
  std::uint64_t m_NumberOfVertices{ 0 };
  std::uint64_t m_NumberOfTriangles{ 0 };
  std::uint64_t m_NumberOfQuads{ 0 };
  std::uint64_t m_NumberOfNeededVertices{ 0 };
};

} // end namespace medialvoxel

#endif
