// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef medialvoxelSurfaceSpool_h
#define medialvoxelSurfaceSpool_h

#include "ScratchFile.h"
#include "SurfaceSink.h"

#include <filesystem>

namespace medialvoxel
{

/** \class SurfaceSpool
 * \brief A surface in two scratch files, whatever its size: 32 bytes per vertex, 40 per face, and a few MB of memory.
 *
 * Writers of files read it as often as they need, one surface may go to several files. */
class SurfaceSpool : public SurfaceSink
{
public:
  /** In the scratch files. */
  static constexpr std::uint64_t BytesPerVertex = 32;
  static constexpr std::uint64_t BytesPerFace = 40;

  /** Numbers of a vertex as files have them. */
  struct Vertex
  {
    std::array<double, 3> position;  ///< rounded to the precision of the surface
    float                 thickness; ///< as in SurfaceVertex
    std::uint32_t         object;    ///< as in SurfaceVertex
  };

  /** \param folder where the scratch files are, without a name
   * \param precision of the coordinates that files will have
   * \throw JobError Refused when the folder is missing or cannot be written. */
  explicit SurfaceSpool(const std::filesystem::path & folder, SurfacePrecision precision = SurfacePrecision::Single);

  void
  AddVertices(const std::vector<SurfaceVertex> & vertices) override;
  void
  AddFaces(const std::vector<SurfaceFace> & faces) override;

  /** Vertices in any order: those from number \a first on. All numbers up to the largest must come, each once. */
  void
  PutVertices(std::uint64_t first, const std::vector<Vertex> & vertices);

  /** The same for faces. */
  void
  PutFaces(std::uint64_t first, const std::vector<SurfaceFace> & faces);

  SurfacePrecision
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

  /** Reads \a count vertices from number \a first on, which exist. \throw JobError Failure. */
  void
  ReadVertices(std::uint64_t first, std::uint64_t count, std::vector<Vertex> & vertices) const;

  /** Reads \a count faces from number \a first on, which exist. \throw JobError Failure. */
  void
  ReadFaces(std::uint64_t first, std::uint64_t count, std::vector<SurfaceFace> & faces) const;

private:
  ScratchFile      m_VertexFile;
  ScratchFile      m_FaceFile;
  SurfacePrecision m_Precision;
  std::uint64_t    m_NumberOfVertices{ 0 };
  std::uint64_t    m_NumberOfTriangles{ 0 };
  std::uint64_t    m_NumberOfQuads{ 0 };
  std::uint64_t    m_NumberOfNeededVertices{ 0 };
};

} // end namespace medialvoxel

#endif
