// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelRemesher_h
#define itkMedialVoxelRemesher_h

#include "itkMedialVoxelFineSheet.h"
#include "itkMedialVoxelSheetWitnesses.h"
#include "itkMedialVoxelTasks.h"

#include <functional>
#include <memory>

namespace itk
{

/** \class MedialVoxelRemesher
 * \brief Makes elements of good shape of a coarse sheet, whose sides have the sizes of that.
 *
 * Long sides are cut, short ones are collapsed, sides are flipped and vertices are moved along that sheet. Rims stay on
 * rims and junctions on junctions. No such step may leave a point of that sheet, or the middle of a triangle, farther
 * away than 0.08 of the size there (or half a fine side, where that is more); repairs may by half the size. Walls that
 * are narrower than half an element, and bounded by a junction, are closed; others keep their width.
 * \ingroup MedialVoxel
 */
class MedialVoxelRemesher
{
public:
  using Complex = MedialVoxelTriangleComplex;
  using Index = Complex::Index;
  using Triangle = Complex::Triangle;
  using Point = Complex::Point;

  /** \param fine  stays as long as this
   * \param noise by how much the fine sheet may be off anywhere: steps keep this distance to it at least */
  MedialVoxelRemesher(MedialVoxelFineSheet & fine, double noise);

  MedialVoxelRemesher(const MedialVoxelRemesher &) = delete;
  MedialVoxelRemesher &
  operator=(const MedialVoxelRemesher &) = delete;

  /** Does all steps, part by part, in several divisions, so that what parts share in one is inside a part in another.
   * The result does not depend on the order of the parts.
   * \param progress called often with the share that is done; may throw to stop */
  void
  Run(const MedialVoxelRunTasks & runTasks, std::function<void(double)> progress);

  const Complex &
  GetComplex() const
  {
    return m_Complex;
  }

  /** Holes of three sides, of which one was next to nothing. */
  std::uint64_t
  GetNumberOfHolesClosed() const
  {
    return m_HolesClosed;
  }

  /** Triangles of strips and fins that were too narrow. */
  std::uint64_t
  GetNumberLeftOut() const
  {
    return m_LeftOut;
  }

private:
  using Parts = std::vector<std::unique_ptr<MedialVoxelRemesher>>;

  /** What is done in the parts of one division, and then in the whole. */
  struct Round
  {
    std::size_t  most;         ///< triangles of a part
    double       share;        ///< on the low side of cuts
    unsigned int steps;        ///< rounds of all steps
    bool         mergesAtOnce; ///< whether lines may become one in the first of these
    unsigned int repairs;      ///< rounds of repairs
    bool         raisesSizes;  ///< at bends, afterwards
    bool         cleans;       ///< afterwards
  };

  /** Of a part of the whole.
   * \param isShared of each vertex, whether it stays where it is, as other parts have it, too */
  MedialVoxelRemesher(const MedialVoxelRemesher & whole,
                      const std::vector<Index> &  triangles,
                      const std::vector<bool> &   isShared);

  void
  RunParts(const Round & round);
  void
  RunPart(const Round & round);

  /** Takes the complex and the points of the parts in place of its own. */
  void
  Join(const Parts & parts);

  /** What triangles of the complex are to become. */
  struct Step
  {
    std::vector<Index>    before;  ///< numbers of the triangles that it changes or removes
    std::vector<Index>    numbers; ///< of those that remain
    std::vector<Triangle> after;   ///< their corners then
    Index                 moved{ Complex::None };
    Point                 place{}; ///< of the vertex that is moved
  };

  /** What a step must keep. */
  struct Rules
  {
    double tolerance;        ///< of the distance
    double leastCosine;      ///< between the normal of a triangle and what it was
    double leastQuality;     ///< of triangles, unless they had less
    double improvement{ 0 }; ///< of the worst triangle
  };

  // One pass each over the complex.
  void
  SplitLongSides();
  void
  CollapseShortSides(bool merging);
  void
  FlipSides();
  void
  MoveVertices();
  void
  RepairTriangles();
  void
  RaiseSizesAtBends();
  void
  CleanUp();
  std::vector<Index>
  ListBelow(double limit, const std::function<double(Index)> & getValue) const;
  std::vector<Index>
  ListBad() const;
  std::vector<Index>
  ListRimVertices() const;
  void
  CloseSlits(const std::vector<Index> & onRims);
  void
  ZipRims(const std::vector<Index> & candidates);

  bool
  TryCollapse(Index from, Index to, bool merging);
  bool
  TryFlip(Index a, Index b, Index last);
  bool
  TryMove(Index vertex, Complex::Place kind);
  bool
  TryMoveTo(Index vertex, const MedialVoxelSheetTree::Nearest & nearest, const Rules & rules);
  bool
  TryRepair(Index triangle);
  bool
  TryShift(Index vertex);
  bool
  TryPassOver(Index a, Index b, Index c, double improvement);

  /** How bad triangles are: 0 where each has a good shape and is not folded onto another one. */
  double
  GetBadness(Index triangle) const;
  double
  GetBadness(const std::vector<Index> & vertices) const;
  double
  GetFolds(Index a, Index b) const;
  bool
  IsTiny(Index triangle) const;
  double
  GetGain(const Step & step);
  std::vector<Step>
  ListCleanSteps(Index triangle) const;
  bool
  TryClean(Index triangle);
  bool
  TryCloseSlit(Index triangle);
  bool
  TryZip(Index vertex, Index a, Index b);
  bool
  TryMerge(Index from, Index to);
  bool
  TryLeaveOut(Index triangle);
  bool
  IsEnd(Index triangle) const;
  bool
  IsInStrip(Index triangle) const;

  Step
  MakeCollapse(Index from, Index to) const;
  Step
  MakeShorterRim(Index triangle) const;
  Step
  MakePassOver(const Complex::Indices & triangles, Index a, Index b, Index c) const;
  Step
  MakeLid(Index vertex) const;
  Step
  MakeMove(Index vertex, const Point & place) const;

  bool
  Allows(const Step & step, const Rules & rules);
  bool
  IsNear(const Step & step, double tolerance);
  std::vector<Index>
  Apply(const Step & step);

  bool
  IsStuck(Index a, Index b) const;
  bool
  MayLeave(Index from, Index to, bool merging) const;
  bool
  KeepsLine(Index from, Index to, double tolerance) const;

  struct Worst
  {
    double quality;
    bool   keepsNormals;
  };
  Worst
  Judge(const Step & step, double leastCosine) const;

  std::array<Point, 3>
  GetCorners(const Step & step, std::size_t number) const;

  Complex::Indices
  FindLineNeighbors(Index vertex, Complex::Place kind) const;
  bool
  IsSharp(Index vertex, Complex::Place kind) const;

  /** The place of the fine sheet, or of its lines, nearest to a place for a vertex. */
  MedialVoxelSheetTree::Nearest
  Project(Index vertex, Complex::Place kind, const Point & place) const;

  MedialVoxelSheetTree::Nearest
  FindOnLine(Index vertex, Complex::Place kind, const Point & place, double within) const;

  double
  GetSize(Index a, Index b) const;
  double
  GetTolerance(Index vertex) const;
  double
  GetLength(Index a, Index b) const;
  double
  GetQuality(Index triangle) const;

  /** Passes that try the same with each side, or vertex, again. */
  enum class Pass : std::uint8_t
  {
    Collapse,
    Merge,
    Flip,
    Move
  };

  /** Begins a pass.
   * \return when the last one of this kind began: what no step has touched since then is as it was when it failed */
  Index
  BeginPass(Pass pass);

  /** Marks vertices of triangles that a step changes. */
  void
  Touch(const std::vector<Index> & triangles);

  struct LengthOfSide
  {
    double length;
    Index  a;
    Index  b;
  };
  std::vector<LengthOfSide>
  ListSides() const;

  void
  Proceed();

  MedialVoxelFineSheet &      m_Fine;
  MedialVoxelRunTasks         m_RunTasks{ MedialVoxelRunInOrder };
  std::function<void(double)> m_Progress;
  std::vector<Point>          m_Given;        ///< points of the fine sheet
  std::vector<Index>          m_NumbersGiven; ///< of these in the whole, of which this is a part
  std::vector<Index>          m_Numbers;      ///< of the first vertices in the whole
  Complex                     m_Complex;
  MedialVoxelSheetWitnesses   m_Witnesses;
  double                      m_Noise;
  std::vector<Index>          m_Touched; ///< of each vertex, the last pass in which its triangles changed
  Index                       m_NumberOfPasses{ 0 };
  std::array<Index, 4>        m_LastPasses{}; ///< of each kind
  bool                        m_HasShared{ false };
  std::uint64_t               m_HolesClosed{ 0 };
  std::uint64_t               m_LeftOut{ 0 };
  std::uint64_t               m_Steps{ 0 };
  double                      m_Share{ 0 };
};

} // end namespace itk

#endif
