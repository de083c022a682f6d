// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelWallFitting_h
#define itkMedialVoxelWallFitting_h

#include "itkMedialVoxelRemeshedSheet.h"

#include <memory>
#include <vector>

namespace itk
{

/** \class MedialVoxelWallFitting
 * \brief Moves nodes of elements to where the fine sheet is in the mean, so that flat walls are flat.
 *
 * The fine sheet has the steps of voxels, and nodes lie on it. Each element sums the points of the fine sheet that are
 * nearest to it; any part of the sheet may be given at a time. Planes and quadrics are fitted to the sums of the
 * elements round a node, on its wall, as far round as they fit. A node at a junction goes to where its walls meet.
 * \ingroup MedialVoxel
 */
class MedialVoxelWallFitting
{
public:
  /** Points that are nearest to an element. */
  struct Sums
  {
    std::uint32_t         element{ 0 };
    double                number{ 0 };
    MedialVoxelVector3    places{};   ///< from the middle of the element
    std::array<double, 6> products{}; ///< of the same: xx, xy, xz, yy, yz, zz
  };

  /** \param sheet stays as long as this
   * \param noise how far the fine sheet may be off */
  MedialVoxelWallFitting(const MedialVoxelRemeshedSheet & sheet, double noise);

  /** Of a part of the fine sheet. Several threads may call it. */
  std::vector<Sums>
  Measure(const MedialVoxelSheet & part) const;

  /** Their last digits depend on the order of the parts. */
  void
  Add(const std::vector<Sums> & sums);

  /** Where the nodes are to be: by two noises away at most. No element becomes worse than 0.4 by that. */
  std::vector<MedialVoxelVector3>
  FindPlaces(const MedialVoxelRunTasks & runTasks) const;

private:
  using Index = std::uint32_t;
  using Point = MedialVoxelVector3;

  /** At a node. */
  struct Frame
  {
    Point                place;
    Point                normal;
    std::array<Point, 2> axes;
    double               size; ///< of elements
  };

  /** Of a fit, at the node. */
  struct Height
  {
    bool   isSolved{ false };
    double height{ 0 };
    double rest{ 0 }; ///< root of the mean square of what it leaves
  };

  /** Least squares of heights by 1, u, v, uu, uv and vv. */
  struct Equations
  {
    void
    Add(const std::array<double, 6> & means, double height, double weight);

    Height
    Solve(std::size_t numbers) const;

    std::array<std::array<double, 6>, 6> matrix{}; ///< its lower triangle
    std::array<double, 6>                values{};
    double                               square{ 0 }; ///< of the heights
    double                               weights{ 0 };
    std::size_t                          number{ 0 };
  };

  /** Elements around a node. */
  struct Region
  {
    std::vector<Index> elements;
    std::vector<bool>  isIn; ///< of each element
  };

  void
  FindNeighbors();

  double
  GetSize(Index node) const;

  bool
  GrowAround(const Frame & frame, double radius, Region & region) const;

  void
  AddElement(Index element, const Frame & frame, Equations & equations) const;

  bool
  FindHeight(const Frame & frame, const std::vector<Index> & start, bool isInside, Region & region, double & height)
    const;

  Point
  FindPlace(Index node, Region & region) const;

  void
  TakeBack(std::vector<Point> & places) const;

  const MedialVoxelRemeshedSheet &      m_Sheet;
  double                                m_Noise;
  std::unique_ptr<MedialVoxelSheetTree> m_Triangles;
  std::vector<Index>                    m_ElementOf;  ///< of each triangle
  std::vector<Point>                    m_Middles;    ///< of the elements
  std::vector<Point>                    m_Normals;    ///< of the elements, of length 1
  std::vector<Sums>                     m_Sums;       ///< of each element
  std::vector<std::array<Index, 4>>     m_Neighbors;  ///< over sides of two
  std::vector<std::vector<Index>>       m_ElementsOf; ///< of each node
};

} // end namespace itk

#endif
