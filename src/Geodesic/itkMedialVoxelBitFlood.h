// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef itkMedialVoxelBitFlood_h
#define itkMedialVoxelBitFlood_h

#include "itkMedialVoxelBits.h"
#include "itkMedialVoxelDualCell.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace itk
{

/** \class MedialVoxelBitFlood
 * \brief Decides whether two boundary points are nearer than a small threshold, by bit operations alone.
 *
 * For volumes with equal spacings and thresholds above the longest edge and below 8 voxels. The points that a path
 * below the threshold can use fit a box that depends on the difference of the two points alone; the boxes of all
 * differences are known beforehand. Most boxes fit one machine word, the others one word per slice. In them the
 * boundary is flooded one edge per step: the number of edges decides most pairs. The others are flooded once for each
 * set of edge counts below the threshold, in the order of the lengths, which is exact. A threshold that a path length
 * meets within rounding is left to MedialVoxelBoundedGeodesic.
 * \ingroup MedialVoxel
 */
class MedialVoxel_EXPORT MedialVoxelBitFlood
{
public:
  enum class Result : std::uint8_t
  {
    Bounded,    // the free-space length reaches the threshold, and so does every path
    Reaches,    // every path reaches the threshold, or none exists
    FallsShort, // a path is shorter than the threshold
    Undecided   // not for this class to say
  };

  /** True for solid volumes with equal spacings and thresholds in the range of this class. */
  static bool
  Covers(const MedialVoxelGrid & grid, double epsilon);

  /** \a epsilon is the threshold in physical units, positive and finite. */
  MedialVoxelBitFlood(const MedialVoxelGrid & grid, double epsilon);

  /** False when every pair is undecided: for unsupported grids and thresholds, and for thresholds that equal a path
   * length. */
  bool
  IsAvailable() const
  {
    return !m_WindowOf.empty();
  }

  /** The threshold in physical units; 0 when every pair is undecided. */
  double
  GetThreshold() const
  {
    return m_Epsilon;
  }

  /** Judge the boundary points \a a and a - \a difference; undecided too when \a boundary does not hold the points that
   * a path below the threshold can use. */
  Result
  Decide(const MedialVoxelBits &         boundary,
         const MedialVoxelIndex &        a,
         const MedialVoxelDisplacement & difference) const;

  /** Length of the shortest path between different points \a a and a - \a difference, rounded; infinite when it reaches
   * the threshold, or when there is no path. Nothing where Decide() is undecided. */
  std::optional<double>
  FindLength(const MedialVoxelBits &         boundary,
             const MedialVoxelIndex &        a,
             const MedialVoxelDisplacement & difference) const;

private:
  using WordType = MedialVoxelBits::WordType;

  /** Largest difference along an axis of points whose free-space length is below 8 voxels. */
  static constexpr std::int64_t Reach = 7;

  /** More than there are for thresholds below 8 voxels. */
  static constexpr std::size_t MostLengths = 128;

  static constexpr std::uint8_t  NoLength = 255;
  static constexpr std::uint16_t BoundedWindow = 65535;

  /** The voxels around a and b, relative to a, that paths below the threshold can use. */
  struct Window
  {
    std::array<std::int8_t, 3>  lower;
    std::array<std::uint8_t, 3> size;
    std::uint8_t                shape;
    bool                        fitsWord;
    std::uint16_t               bitOfA;
    std::uint16_t               bitOfB;
  };

  /** A window size that fits a word, x fastest, and the bits of it that have a neighbor along x and y. */
  struct Shape
  {
    std::array<std::uint8_t, 3> size;
    WordType                    hasNextX{ 0 };
    WordType                    hasPreviousX{ 0 };
    WordType                    hasNextY{ 0 };
    WordType                    hasPreviousY{ 0 };
  };

  /** Numbers of edges that change one, two and three axes, with the entries that have one edge less of each class. */
  struct Length
  {
    double                      length;
    std::array<int, 3>          counts;
    std::array<std::uint8_t, 3> shorter;
  };

  struct WordLayout;

  bool
  FindLengths(const MedialVoxelGrid & grid, double epsilon);

  void
  FindWindows(const MedialVoxelGrid & grid, double epsilon);

  void
  AddWindow(const MedialVoxelDisplacement & difference,
            const std::array<int, 3> &      lower,
            const std::array<int, 3> &      upper);

  std::uint8_t
  ShapeOf(const std::array<std::uint8_t, 3> & size);

  const Window *
  FindWindow(const MedialVoxelBits &         boundary,
             const MedialVoxelIndex &        a,
             const MedialVoxelDisplacement & difference,
             MedialVoxelIndex &              lower,
             bool &                          isUndecided) const;

  template <typename TVisitor>
  auto
  WithDomain(const MedialVoxelBits &  boundary,
             const Window &           window,
             const MedialVoxelIndex & lower,
             TVisitor &&              visit) const;

  template <typename TLayout>
  std::int64_t
  CountEdges(const TLayout & layout, const Window & window, const typename TLayout::Set & domain) const;

  template <typename TLayout>
  Result
  Flood(const TLayout & layout, const Window & window, const typename TLayout::Set & domain) const;

  template <typename TLayout>
  double
  FloodByLength(const TLayout & layout, const Window & window, const typename TLayout::Set & domain) const;

  static std::size_t
  IndexOf(const MedialVoxelDisplacement & difference)
  {
    constexpr std::int64_t edge = 2 * Reach + 1;
    return static_cast<std::size_t>(((difference[2] + Reach) * edge + difference[1] + Reach) * edge + difference[0] +
                                    Reach);
  }

  double                     m_Epsilon{ 0.0 };
  std::int64_t               m_MostEdges{ 0 };
  std::int64_t               m_ShortEdges{ 0 };
  std::vector<std::uint16_t> m_WindowOf;
  std::vector<Window>        m_Windows;
  std::vector<Shape>         m_Shapes;
  std::vector<Length>        m_Lengths;
};

} // end namespace itk

#endif
