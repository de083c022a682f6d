// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelSheetWitnesses_h
#define itkMedialVoxelSheetWitnesses_h

#include "itkMedialVoxelTriangleComplex.h"

namespace itk
{

/** \class MedialVoxelSheetWitnesses
 * \brief The points of the fine sheet, each kept with a triangle of the coarse one that is not farther than allowed.
 *
 * They bound the distance of the fine sheet to the coarse one through all steps.
 * \ingroup MedialVoxel
 */
class MedialVoxelSheetWitnesses
{
public:
  using Index = MedialVoxelTriangleComplex::Index;
  using Corners = std::array<MedialVoxelVector3, 3>;

  /** Memory for each triangle of the fine sheet, with that of the coarse one at its start. */
  static constexpr std::uint64_t BytesPerTriangle = 8;

  /** \param points stay as long as this, which are kept with no triangle yet */
  explicit MedialVoxelSheetWitnesses(const std::vector<MedialVoxelVector3> & points);

  /** Keeps a point, that none has, with a triangle. */
  void
  Add(Index point, Index triangle);

  /** Whether the points of some triangles are within \a tolerance of what the triangles are to become. */
  bool
  Fit(const std::vector<Index> & before, const std::vector<Corners> & after, double tolerance);

  /** After Fit(): gives the points to the triangles, which have these numbers now. */
  void
  Assign(const std::vector<Index> & before, const std::vector<Index> & after);

  /** Shares the points of a triangle that was cut. */
  void
  Share(Index triangle, Index half, const Corners & corners, const Corners & cornersOfHalf);

  /** Forgets the points of a triangle that is no more. */
  void
  LeaveOut(Index triangle);

  void
  AppendPoints(Index triangle, std::vector<Index> & points) const;

private:
  static constexpr Index None = MedialVoxelTriangleComplex::None;

  const std::vector<MedialVoxelVector3> * m_Given;
  std::vector<Index>                      m_First;  ///< of each triangle
  std::vector<Index>                      m_Next;   ///< of each point
  std::vector<Index>                      m_Points; ///< of the last Fit()
  std::vector<Index>                      m_Places;
};

} // end namespace itk

#endif
