// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayNormals.h"

#include "itkMedialVoxelEigenvectors.h"
#include "itkMedialVoxelLanes.h"
#include "itkMedialVoxelNormalDistribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

using Vector = MedialVoxelVector3;

/** Extent of the window of the structure tensor to both sides, and its standard deviation. */
constexpr std::int64_t WindowReach = 4;
constexpr double       WindowSigma = 1.5;

/** Voxels along the axes of a block, and of the values that its gradients depend on. */
constexpr std::size_t Inner = 8;
constexpr std::size_t Outer = 14;

/** Blocks that are kept: blocks with the same index modulo these numbers take turns. A window has at most two along
 * each axis; both sides of a wall may be 16 voxels from its cell. */
constexpr std::int64_t Kept[3] = { 10, 6, 4 };

/** The blocks that a voxel is in, along an axis. */
std::int64_t
BlockOf(const std::int64_t voxel)
{
  constexpr auto extent = static_cast<std::int64_t>(Inner);
  return voxel >= 0 ? voxel / extent : -1 - (-1 - voxel) / extent;
}

/** Shortens an axis of values to its inner places, where it puts operation(place, VStride).
 *
 * \tparam VStride  from one value to the next along the axis
 * \tparam VNumber  of times that the axis is there */
template <std::size_t VStride, std::size_t VNumber, typename TOperation>
MEDIALVOXEL_INLINE void
Shorten(const float * const from, float * const to, TOperation operation)
{
  for (std::size_t n = 0; n < VNumber; ++n)
  {
    const float * const inner = from + (n * Outer + (Outer - Inner) / 2) * VStride;
    float * const       place = to + n * Inner * VStride;
    for (std::size_t i = 0; i < Inner * VStride; ++i)
    {
      place[i] = operation(inner + i, VStride);
    }
  }
}

/** (1 2 1) / 4 */
MEDIALVOXEL_INLINE float
GetSmooth(const float * const value, const std::size_t stride)
{
  return 0.25F * (*(value - stride) + value[stride]) + 0.5F * *value;
}

/** 240 times the derivative of values that are smoothed by (1 2 1) / 4, right to the sixth power of the frequency: the
 * components of a gradient must fit together, or normals would turn to the axes. */
MEDIALVOXEL_INLINE float
GetDifference(const float * const value, const std::size_t stride)
{
  return 95.0F * (value[stride] - *(value - stride)) +
         (14.0F * (value[2 * stride] - *(value - 2 * stride)) - (value[3 * stride] - *(value - 3 * stride)));
}

/** The eigenvector of the largest eigenvalue of a symmetric matrix with the trace 1. */
Vector
FindFirstEigenvector(MedialVoxelMatrix3 matrix)
{
  constexpr double         negligible = 1e-15;
  const MedialVoxelMatrix3 vectors = MedialVoxelFindEigenvectors(matrix, negligible);
  unsigned int             largest = 0;
  for (unsigned int i = 1; i < 3; ++i)
  {
    largest = matrix[i][i] > matrix[largest][largest] ? i : largest;
  }
  return vectors[largest];
}

/** exp(-d^2 / (2 sigma^2)), but for a factor. */
float
GetWindowWeight(const double d)
{
  return static_cast<float>(MedialVoxelNormalDistribution::Get().Density(d / WindowSigma));
}

/** The gradients of a block from its values and those around it, x fastest, which get other levels first. */
MEDIALVOXEL_INLINE void
FindGradients(float * const values,
              const double  background,
              const double  scale,
              float * const x,
              float * const y,
              float * const z)
{
  for (std::size_t i = 0; i < Outer * Outer * Outer; ++i)
  {
    values[i] = static_cast<float>((static_cast<double>(values[i]) - background) * scale);
  }
  // Smoothed along one axis, and along two.
  std::array<float, Inner * Outer * Outer> once;
  std::array<float, Inner * Inner * Outer> twice;
  Shorten<Outer, Outer>(values, once.data(), [](const auto... at) { return GetSmooth(at...); });
  Shorten<Outer * Inner, 1>(once.data(), twice.data(), [](const auto... at) { return GetSmooth(at...); });
  Shorten<1, Inner * Inner>(twice.data(), x, [](const auto... at) { return GetDifference(at...); });
  Shorten<1, Inner * Outer>(once.data(), twice.data(), [](const auto... at) { return GetSmooth(at...); });
  Shorten<Inner * Inner, 1>(twice.data(), z, [](const auto... at) { return GetDifference(at...); });
  Shorten<Outer * Outer, 1>(values, once.data(), [](const auto... at) { return GetSmooth(at...); });
  Shorten<1, Outer * Inner>(once.data(), twice.data(), [](const auto... at) { return GetSmooth(at...); });
  Shorten<Inner, Inner>(twice.data(), y, [](const auto... at) { return GetDifference(at...); });
}

/** xx, xy, xz, yy, yz, zz of tensors at the places of a row. */
using Lanes = MedialVoxelLanes;
using RowSums = std::array<Lanes, 6>;
static_assert(MedialVoxelNumberOfLanes == Inner, "a row of a block has a lane for each voxel");

/** Rows of a block that are in a window, with the weights of their places along y and z. */
struct Rows
{
  std::array<const float *, 3> gradients; // of the first row
  std::array<const float *, 2> weights;
  std::array<std::size_t, 2>   numbers;
};

/** Adds the products of gradients. Those before and after the window along x do not count in the end. */
MEDIALVOXEL_INLINE void
AddRows(const Rows & rows, RowSums & sums)
{
  Lanes xx = sums[0];
  Lanes xy = sums[1];
  Lanes xz = sums[2];
  Lanes yy = sums[3];
  Lanes yz = sums[4];
  Lanes zz = sums[5];
  for (std::size_t j = 0; j < rows.numbers[1]; ++j)
  {
    for (std::size_t i = 0; i < rows.numbers[0]; ++i)
    {
      const std::size_t row = (j * Inner + i) * Inner;
      const float       weight = rows.weights[0][i] * rows.weights[1][j];
      const Lanes       x = MedialVoxelLoad(rows.gradients[0] + row);
      const Lanes       y = MedialVoxelLoad(rows.gradients[1] + row);
      const Lanes       z = MedialVoxelLoad(rows.gradients[2] + row);
      const Lanes       weightedX = weight * x;
      const Lanes       weightedY = weight * y;
      const Lanes       weightedZ = weight * z;
      xx += weightedX * x;
      xy += weightedX * y;
      xz += weightedX * z;
      yy += weightedY * y;
      yz += weightedY * z;
      zz += weightedZ * z;
    }
  }
  sums = { { xx, xy, xz, yy, yz, zz } };
}

} // namespace

/** The voxels around a place that count, and their weights along each axis. */
struct MedialVoxelGrayNormals::Window
{
  MedialVoxelBox  box;
  const Weights & weights;

  /** Adds the rows of a block that are in the window. */
  void
  Add(const Block & block, const MedialVoxelIndex & origin, RowSums & sums) const
  {
    Rows        rows;
    std::size_t first = 0;
    std::size_t pitch = Inner;
    for (const unsigned int axis : { 1u, 2u })
    {
      const std::int64_t begin = std::max(box.lower[axis], origin[axis]);
      const std::int64_t end = std::min(box.upper[axis], origin[axis] + Extent);
      rows.numbers[axis - 1] = static_cast<std::size_t>(end - begin);
      rows.weights[axis - 1] = weights[axis].data() + (begin - box.lower[axis]);
      first += static_cast<std::size_t>(begin - origin[axis]) * pitch;
      pitch *= Inner;
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      rows.gradients[axis] = block.gradient[axis].data() + first;
    }
    MedialVoxelKernel<AddRows>::Run(rows, sums);
  }
};

std::uint64_t
MedialVoxelGrayNormals::GetBytes()
{
  return static_cast<std::uint64_t>(Kept[0] * Kept[1] * Kept[2]) * sizeof(Block);
}

double
MedialVoxelGrayNormals::FindLargestValue(const MedialVoxelGray & gray)
{
  const MedialVoxelBox & box = gray.GetBox();
  float                  largest = 0.0F;
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      const float * const row = gray.GetRow(y, z);
      for (std::int64_t x = 0; x < box.Extent(0); ++x)
      {
        const float value = std::abs(row[x]);
        largest = value > largest && value <= std::numeric_limits<float>::max() ? value : largest;
      }
    }
  }
  return largest > 0.0F ? static_cast<double>(largest) : 1.0;
}

MedialVoxelGrayNormals::MedialVoxelGrayNormals(const MedialVoxelGrid & grid,
                                               const double            background,
                                               const double            material)
  : m_Grid(grid)
  , m_Background(background)
  , m_Scale(1.0 / (material - background))
  , m_Blocks(static_cast<std::size_t>(Kept[0] * Kept[1] * Kept[2]))
{
  static_assert(Extent == Inner && Extent + 2 * Margin == Outer, "extents of blocks");
}

void
MedialVoxelGrayNormals::Compute(const MedialVoxelGray & gray, const MedialVoxelIndex & origin, Block & block) const
{
  std::array<MedialVoxelIndex, Outer> places;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t lower = gray.GetBox().lower[axis];
    const std::int64_t upper = gray.GetBox().upper[axis];
    for (std::size_t i = 0; i < Outer; ++i)
    {
      places[i][axis] = std::clamp(origin[axis] - Margin + static_cast<std::int64_t>(i), lower, upper - 1);
    }
    const std::int64_t end = origin[axis] + Extent;
    block.known.lower[axis] = lower == 0 ? origin[axis] : std::max(origin[axis], lower + Margin);
    block.known.upper[axis] = upper == m_Grid.GetSize()[axis] ? end : std::min(end, upper - Margin);
  }
  std::array<float, Outer * Outer * Outer> values;
  float *                                  value = values.data();
  const std::int64_t                       beginX = gray.GetBox().lower[0];
  const std::int64_t                       firstX = origin[0] - Margin - beginX;
  const bool isInside = firstX >= 0 && firstX + static_cast<std::int64_t>(Outer) <= gray.GetBox().Extent(0);
  for (std::size_t z = 0; z < Outer; ++z)
  {
    for (std::size_t y = 0; y < Outer; ++y)
    {
      const float * const row = gray.GetRow(places[y][1], places[z][2]);
      for (std::size_t x = 0; x < Outer; ++x)
      {
        value[x] = isInside ? row[firstX + static_cast<std::int64_t>(x)] : row[places[x][0] - beginX];
      }
      value += Outer;
    }
  }
  MedialVoxelKernel<FindGradients>::Run(
    values.data(), m_Background, m_Scale, block.gradient[0].data(), block.gradient[1].data(), block.gradient[2].data());
}

auto
MedialVoxelGrayNormals::GetBlock(const MedialVoxelGray &  gray,
                                 const MedialVoxelIndex & index,
                                 const MedialVoxelBox &   box) -> const Block &
{
  std::int64_t     at = 0;
  MedialVoxelIndex origin;
  MedialVoxelBox   whole;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    at = at * Kept[axis] + (((index[axis] % Kept[axis]) + Kept[axis]) % Kept[axis]);
    origin[axis] = index[axis] * Extent;
    whole.lower[axis] = origin[axis];
    whole.upper[axis] = origin[axis] + Extent;
  }
  std::unique_ptr<Block> & place = m_Blocks[static_cast<std::size_t>(at)];
  if (!place)
  {
    place.reset(new Block); // its gradients are undefined
  }
  Block &              block = *place;
  const MedialVoxelBox needed = box.Intersection(whole);
  if (!block.known.Contains(needed))
  {
    this->Compute(gray, origin, block);
  }
  assert(block.known.Contains(needed));
  return block;
}

/** Products of gradients, with the weights of their voxels. The order of the sums depends on the place alone. */
auto
MedialVoxelGrayNormals::GetTensor(const MedialVoxelGray & gray, const Window & window) -> Components
{
  MedialVoxelIndex first;
  MedialVoxelIndex last;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    first[axis] = BlockOf(window.box.lower[axis]);
    last[axis] = BlockOf(window.box.upper[axis] - 1);
  }
  Components       tensor{};
  MedialVoxelIndex index;
  for (index[0] = first[0]; index[0] <= last[0]; ++index[0])
  {
    RowSums sums{};
    for (index[2] = first[2]; index[2] <= last[2]; ++index[2])
    {
      for (index[1] = first[1]; index[1] <= last[1]; ++index[1])
      {
        const MedialVoxelIndex origin{ { Extent * index[0], Extent * index[1], Extent * index[2] } };
        window.Add(this->GetBlock(gray, index, window.box), origin, sums);
      }
    }
    for (std::int64_t i = 0; i < Extent; ++i)
    {
      const std::int64_t x = Extent * index[0] + i;
      if (x >= window.box.lower[0] && x < window.box.upper[0])
      {
        const auto weight = static_cast<double>(window.weights[0][static_cast<std::size_t>(x - window.box.lower[0])]);
        for (std::size_t k = 0; k < tensor.size(); ++k)
        {
          tensor[k] += weight * static_cast<double>(sums[k][static_cast<std::size_t>(i)]);
        }
      }
    }
  }
  return tensor;
}

MedialVoxelBox
MedialVoxelGrayNormals::MoveWindow(const Vector & place)
{
  MedialVoxelBox box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const bool isActive = m_Grid.IsActive(axis);
    box.lower[axis] = isActive ? MedialVoxelCeil(place[axis] - WindowReach) : 0;
    box.upper[axis] = isActive ? MedialVoxelFloor(place[axis] + WindowReach) + 1 : 1;
    // Windows around cells have the same weights.
    const double first = isActive ? static_cast<double>(box.lower[axis]) - place[axis] : 0.0;
    for (std::size_t i = 0; i < m_Weights[axis].size() && first != m_FirstDistances[axis]; ++i)
    {
      m_Weights[axis][i] = isActive ? GetWindowWeight(first + static_cast<double>(i)) : 1.0F;
    }
    m_FirstDistances[axis] = first;
  }
  return box;
}

bool
MedialVoxelGrayNormals::Find(const MedialVoxelGray & gray, const Vector & place, Vector & normal)
{
  const auto [xx, xy, xz, yy, yz, zz] = this->GetTensor(gray, Window{ this->MoveWindow(place), m_Weights });
  const double trace = (xx + yy) + zz;
  if (!(trace > 0.0) || !std::isfinite(trace))
  {
    return false;
  }
  const double scale = 1.0 / trace;
  normal = FindFirstEigenvector({ { { { xx * scale, xy * scale, xz * scale } },
                                    { { xy * scale, yy * scale, yz * scale } },
                                    { { xz * scale, yz * scale, zz * scale } } } });
  const double length = MedialVoxelNorm(normal);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = m_Grid.IsActive(axis) ? normal[axis] / length : 0.0;
  }
  return true;
}

} // end namespace itk
