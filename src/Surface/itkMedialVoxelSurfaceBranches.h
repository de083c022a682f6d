// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSurfaceBranches_h
#define itkMedialVoxelSurfaceBranches_h

#include "itkMedialVoxelDisjointSets.h"

#include "MedialVoxelExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace itk
{

/** \class MedialVoxelSurfaceFaces
 * \brief The quadrilaterals of a finished surface, to be walked over as often as needed.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceFaces
{
public:
  using VerticesType = std::array<std::uint64_t, 4>;
  using PointType = std::array<double, 3>;
  using Visitor = std::function<void(const VerticesType &, const std::array<PointType, 4> &)>;

  virtual ~MedialVoxelSurfaceFaces();

  /** Call \a visit for all faces in their order, or from the last to the first. */
  virtual void
  ForEachFace(bool backwards, const Visitor & visit) const = 0;
};

/** \class MedialVoxelSurfaceBranches
 * \brief Finds the short branches of a surface, and the surface without them.
 *
 * Sides of more than two faces, the junctions, cut the surface into sheets: faces that share a side with one other face
 * are of one sheet, but for sides at a vertex where a junction ends. Junctions mostly end a side before the rims of
 * their sheets, which are rough; that side would join them. The distance of a vertex is that to the nearest vertex of
 * any junction, along sides and diagonals of faces. A sheet is a branch when it has both junctions and rims, its
 * junctions are connected with each other, and all of its vertices are nearer than the length. All branches are found
 * on the surface as it is and removed together, so the result depends on no order:
 * - A sheet without a rim lies between junctions, one without a junction is all of its component: both stay.
 * - A sheet between junctions that do not touch connects them and stays, however narrow it is.
 * - Where all sheets of a junction are short, all go.
 *
 * Sheets that a branch parted are one afterwards; the search is not repeated.
 *
 * Memory is 7 bytes for each face, 5 for each vertex and 48 for each side of a face that is a junction; there can be
 * 2^32 - 1 faces and vertices.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelSurfaceBranches
{
public:
  using VerticesType = MedialVoxelSurfaceFaces::VerticesType;

  /** Sides of a face, as bits: side k is from vertex k to the next. */
  struct Marks
  {
    std::uint8_t rimSides{ 0 };
    std::uint8_t junctionSides{ 0 };
  };

  /** Bytes for a surface of so many vertices, faces, and sides that are junctions. */
  static std::uint64_t
  GetBytes(std::uint64_t vertices, std::uint64_t faces, std::uint64_t junctionSides);

  /** Further vertices.
   * \throw std::length_error when there are too many */
  void
  AddVertices(std::uint64_t number);

  /** The next face. */
  void
  AddFace(const VerticesType & vertices, const Marks & marks);

  /** Find the branches, after the last face.
   *
   * \param length  in the units of the points, greater than 0
   * \param faces   all added faces, in their order */
  void
  Find(double length, const MedialVoxelSurfaceFaces & faces);

  bool
  IsFaceKept(const std::uint64_t face) const
  {
    return (m_Flags[face] & IsBranch) == 0;
  }

  /** Marks of a kept face, among the kept faces. */
  Marks
  GetMarks(std::uint64_t face, const Marks & before) const;

  /** Whether a face that is kept has this vertex. */
  bool
  IsVertexKept(const std::uint64_t vertex) const
  {
    return m_Numbers[vertex] != NoNumber;
  }

  /** Number of a kept vertex among the kept vertices. */
  std::uint64_t
  NumberOf(const std::uint64_t vertex) const
  {
    return m_Numbers[vertex];
  }

private:
  using IndexType = std::uint32_t;
  using SideType = std::pair<IndexType, IndexType>; // its vertices, the smaller one first

  static constexpr IndexType NoNumber = ~IndexType{ 0 };

  enum Flag : std::uint8_t
  {
    HasRim = 1,
    HasJunction = 2,
    IsLong = 4,
    IsBridge = 8,
    IsBranch = 16,
    IsBesideEnd = 32 // a face alone: it has a side that would join sheets
  };

  struct SideHash
  {
    std::size_t
    operator()(const SideType & side) const
    {
      return (std::size_t{ side.first } * 0x9E3779B97F4A7C15u) ^ side.second;
    }
  };

  /** A side of a face that is a junction, or at the end of one. */
  struct JunctionSide
  {
    SideType     side;
    IndexType    face;
    std::uint8_t number;                 ///< of the side in the face
    std::uint8_t numberOfKeptFaces{ 0 }; ///< of all that have the side
  };

  static SideType
  SideOf(const VerticesType & vertices, unsigned int number);

  void
  JoinSheets(const MedialVoxelSurfaceFaces & faces);

  void
  MeasureDistances(float length, const MedialVoxelSurfaceFaces & faces, std::vector<float> & distances) const;

  void
  CollectFlags(const std::vector<float> & distances, const MedialVoxelSurfaceFaces & faces);

  void
  MarkBridges();

  void
  MarkBranches();

  void
  CountKeptFaces();

  void
  NumberVertices(const MedialVoxelSurfaceFaces & faces);

  /** Of vertices, whether exactly one side at it is a junction. */
  std::vector<bool>
  FindEndsOfJunctions();

  std::uint64_t                      m_NumberOfVertices{ 0 };
  std::vector<Marks>                 m_Marks;  // of faces
  MedialVoxelDisjointSets<IndexType> m_Sheets; // of faces; the first one stands for all, where paths lead to
  std::vector<std::uint8_t>          m_Flags;  // of faces, of sheets at their roots
  std::vector<JunctionSide>          m_Junctions;
  std::vector<JunctionSide>          m_EndSides; // of two faces, at the ends of junctions
  std::vector<IndexType>             m_Numbers;  // of vertices among the kept ones
};

} // end namespace itk

#endif
