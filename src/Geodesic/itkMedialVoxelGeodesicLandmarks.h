// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelGeodesicLandmarks_h
#define itkMedialVoxelGeodesicLandmarks_h

#include "itkMedialVoxelBoundaryDistances.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class MedialVoxelGeodesicLandmarks
 * \brief Bounds of geodesic distances by the triangle inequality, from the lengths that earlier searches found.
 *
 * With the distances of two points from a third one, their own distance is at most the sum and at least the
 * difference. The sources of the last searches serve as third points.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelGeodesicLandmarks
{
public:
  using NodeType = MedialVoxelBoundaryGraph::NodeType;

  enum class Result : std::uint8_t
  {
    Longer,   // than the upper limit
    Shorter,  // than the lower limit
    Undecided // not for the landmarks to say
  };

  /** Bytes of memory for each point of the graph. */
  static constexpr std::uint64_t BytesPerNode = 16 * sizeof(float);

  /** Forget all landmarks, as when the graph changes. */
  void
  Clear();

  /** Keep \a lengths, which hold every point within \a radius, in the place of the landmark that helped least lately.
   */
  void
  Add(const std::vector<double> & lengths, double radius);

  /** Compare the distance of two points of the graph with the limits, which are at most the radius. */
  Result
  Compare(NodeType a, NodeType b, double lower, double upper);

private:
  static constexpr std::size_t MostLandmarks = BytesPerNode / sizeof(float);

  struct Landmark
  {
    std::vector<float> lengths;
    double             radius{ 0.0 };
  };

  std::array<Landmark, MostLandmarks>    m_Landmarks;
  std::array<std::size_t, MostLandmarks> m_Order{}; // the one that helped last comes first
  std::size_t                            m_NumberOfLandmarks{ 0 };
};

} // end namespace itk

#endif
