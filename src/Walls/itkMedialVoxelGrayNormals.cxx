// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayNormals.h"

#include "itkMedialVoxelNormalDistribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

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
 * each axis, and tiles seldom have more. */
constexpr std::int64_t Kept[3] = { 16, 8, 2 };

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
void
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
float
GetSmooth(const float * const value, const std::size_t stride)
{
  return 0.25F * (*(value - stride) + value[stride]) + 0.5F * *value;
}

/** 240 times the derivative of values that are smoothed by (1 2 1) / 4, right to the sixth power of the frequency: the
 * components of a gradient must fit together, or normals would turn to the axes. */
float
GetDifference(const float * const value, const std::size_t stride)
{
  const auto across = [&](const std::size_t steps) { return value[steps * stride] - *(value - steps * stride); };
  return 95.0F * across(1) + (14.0F * across(2) - across(3));
}

/** A symmetric matrix. */
using Matrix = std::array<std::array<double, 3>, 3>;

/** The eigenvector of the largest eigenvalue, by rotations of Jacobi in a fixed order. */
Vector
FindFirstEigenvector(Matrix a)
{
  Matrix vectors{ { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } } }; // columns
  for (int sweep = 0; sweep < 6; ++sweep)
  {
    for (unsigned int p = 0; p < 2; ++p)
    {
      for (unsigned int q = p + 1; q < 3; ++q)
      {
        if (a[p][q] == 0.0)
        {
          continue;
        }
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = (theta < 0.0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0);
        const double s = t * c;
        for (unsigned int i = 0; i < 3; ++i)
        {
          const double ip = a[i][p];
          const double iq = a[i][q];
          a[i][p] = c * ip - s * iq;
          a[i][q] = s * ip + c * iq;
        }
        for (unsigned int i = 0; i < 3; ++i)
        {
          const double pi = a[p][i];
          const double qi = a[q][i];
          a[p][i] = c * pi - s * qi;
          a[q][i] = s * pi + c * qi;
          const double ip = vectors[i][p];
          const double iq = vectors[i][q];
          vectors[i][p] = c * ip - s * iq;
          vectors[i][q] = s * ip + c * iq;
        }
      }
    }
  }
  unsigned int largest = 0;
  for (unsigned int i = 1; i < 3; ++i)
  {
    largest = a[i][i] > a[largest][largest] ? i : largest;
  }
  return { { vectors[0][largest], vectors[1][largest], vectors[2][largest] } };
}

/** exp(-d^2 / (2 sigma^2)), but for a factor. */
double
GetWindowWeight(const double d)
{
  return MedialVoxelNormalDistribution::Get().Density(d / WindowSigma);
}

} // namespace

/** The voxels around a place that count, and their weights along each axis. */
struct MedialVoxelGrayNormals::Window
{
  MedialVoxelBox                                         box;
  std::array<std::array<double, 2 * WindowReach + 1>, 3> weights{};

  Window(const MedialVoxelGrid & grid, const Vector & place)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      if (!grid.IsActive(axis))
      {
        box.upper[axis] = 1;
        weights[axis][0] = 1.0;
        continue;
      }
      box.lower[axis] = static_cast<std::int64_t>(std::ceil(place[axis] - WindowReach));
      box.upper[axis] = static_cast<std::int64_t>(std::floor(place[axis] + WindowReach)) + 1;
      for (std::int64_t i = 0; i < box.Extent(axis); ++i)
      {
        weights[axis][static_cast<std::size_t>(i)] =
          GetWindowWeight(static_cast<double>(box.lower[axis] + i) - place[axis]);
      }
    }
  }

  bool
  HasInside(const unsigned int axis, const std::int64_t voxel) const
  {
    return voxel >= box.lower[axis] && voxel < box.upper[axis];
  }
};

std::uint64_t
MedialVoxelGrayNormals::GetBytes()
{
  return static_cast<std::uint64_t>(Kept[0] * Kept[1] * Kept[2]) * sizeof(Block);
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
  for (std::size_t z = 0; z < Outer; ++z)
  {
    for (std::size_t y = 0; y < Outer; ++y)
    {
      for (std::size_t x = 0; x < Outer; ++x)
      {
        const double own = gray.Get({ { places[x][0], places[y][1], places[z][2] } });
        *value++ = static_cast<float>((own - m_Background) * m_Scale);
      }
    }
  }
  // Smoothed along one axis, and along two.
  std::array<float, Inner * Outer * Outer> once;
  std::array<float, Inner * Inner * Outer> twice;
  Shorten<Outer, Outer>(values.data(), once.data(), GetSmooth);
  Shorten<Outer * Inner, 1>(once.data(), twice.data(), GetSmooth);
  Shorten<1, Inner * Inner>(twice.data(), block.gradient[0].data(), GetDifference);
  Shorten<1, Inner * Outer>(once.data(), twice.data(), GetSmooth);
  Shorten<Inner * Inner, 1>(twice.data(), block.gradient[2].data(), GetDifference);
  Shorten<Outer * Outer, 1>(values.data(), once.data(), GetSmooth);
  Shorten<1, Outer * Inner>(once.data(), twice.data(), GetSmooth);
  Shorten<Inner, Inner>(twice.data(), block.gradient[1].data(), GetDifference);
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
  Block &              block = m_Blocks[static_cast<std::size_t>(at)];
  const MedialVoxelBox needed = box.Intersection(whole);
  if (!block.known.Contains(needed))
  {
    this->Compute(gray, origin, block);
  }
  assert(block.known.Contains(needed));
  return block;
}

/** Adds a row of gradients where it is inside the window. */
void
MedialVoxelGrayNormals::AddRow(const std::array<const float *, 3> & row,
                               const std::array<bool, Extent> &     isInside,
                               const double                         weight,
                               RowSums &                            sums)
{
  for (std::size_t i = 0; i < Inner; ++i)
  {
    const double x = isInside[i] ? static_cast<double>(row[0][i]) : 0.0;
    const double y = isInside[i] ? static_cast<double>(row[1][i]) : 0.0;
    const double z = isInside[i] ? static_cast<double>(row[2][i]) : 0.0;
    const double weightedX = weight * x;
    const double weightedY = weight * y;
    sums[0][i] += weightedX * x;
    sums[1][i] += weightedX * y;
    sums[2][i] += weightedX * z;
    sums[3][i] += weightedY * y;
    sums[4][i] += weightedY * z;
    sums[5][i] += weight * z * z;
  }
}

/** Adds the rows of a block that are in the window. */
void
MedialVoxelGrayNormals::AddBlock(const Block &            block,
                                 const MedialVoxelIndex & origin,
                                 const Window &           window,
                                 RowSums &                sums)
{
  std::array<bool, Inner> isInside;
  for (std::size_t i = 0; i < Inner; ++i)
  {
    isInside[i] = window.HasInside(0, origin[0] + static_cast<std::int64_t>(i));
  }
  const auto beginOf = [&](const unsigned int axis) { return std::max(window.box.lower[axis], origin[axis]); };
  const auto endOf = [&](const unsigned int axis) { return std::min(window.box.upper[axis], origin[axis] + Extent); };
  for (std::int64_t z = beginOf(2); z < endOf(2); ++z)
  {
    for (std::int64_t y = beginOf(1); y < endOf(1); ++y)
    {
      const auto row = static_cast<std::size_t>(((z - origin[2]) * Extent + (y - origin[1])) * Extent);
      AddRow({ { block.gradient[0].data() + row, block.gradient[1].data() + row, block.gradient[2].data() + row } },
             isInside,
             window.weights[1][static_cast<std::size_t>(y - window.box.lower[1])] *
               window.weights[2][static_cast<std::size_t>(z - window.box.lower[2])],
             sums);
    }
  }
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
        AddBlock(this->GetBlock(gray, index, window.box), origin, window, sums);
      }
    }
    for (std::int64_t i = 0; i < Extent; ++i)
    {
      const std::int64_t x = Extent * index[0] + i;
      if (x >= window.box.lower[0] && x < window.box.upper[0])
      {
        const double weight = window.weights[0][static_cast<std::size_t>(x - window.box.lower[0])];
        for (std::size_t k = 0; k < tensor.size(); ++k)
        {
          tensor[k] += weight * sums[k][static_cast<std::size_t>(i)];
        }
      }
    }
  }
  return tensor;
}

bool
MedialVoxelGrayNormals::Find(const MedialVoxelGray & gray, const Vector & place, Vector & normal)
{
  const auto [xx, xy, xz, yy, yz, zz] = this->GetTensor(gray, Window(m_Grid, place));
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
