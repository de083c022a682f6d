// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkMedialVoxelGrayLocal.h"

#include "itkMedialVoxelNormalDistribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace itk
{
namespace
{

using Index = MedialVoxelIndex;
using Vector = MedialVoxelVector3;

/** Extent of the window of the structure tensor to both sides, and its standard deviation. */
constexpr std::int64_t WindowReach = 4;
constexpr double       WindowSigma = 1.5;

/** Extents of the values that the normal depends on: of the window, and three more to each side for differences. A
 * window around a place between voxels has at most 9 of them along an axis. */
constexpr std::int64_t WindowExtent = 2 * WindowReach + 1;
constexpr std::size_t  BlockMargin = 3;
constexpr std::size_t  BlockExtent = WindowExtent + 2 * BlockMargin;

/** Values of a box, x fastest. */
struct Block
{
  std::array<double, BlockExtent * BlockExtent * BlockExtent> values;

  static std::size_t
  At(const std::size_t x, const std::size_t y, const std::size_t z)
  {
    return (z * BlockExtent + y) * BlockExtent + x;
  }
};

constexpr std::size_t BlockStrides[3] = { 1, BlockExtent, BlockExtent * BlockExtent };

/** (1 2 1) / 4 along an axis, from the second value on; as often as there are two neighbors. */
void
Smooth(Block & block, const std::size_t (&extent)[3], const unsigned int axis)
{
  const std::size_t stride = BlockStrides[axis];
  const auto        u = static_cast<std::size_t>((axis + 1) % 3);
  const auto        v = static_cast<std::size_t>((axis + 2) % 3);
  for (std::size_t j = 0; j < extent[v]; ++j)
  {
    for (std::size_t i = 0; i < extent[u]; ++i)
    {
      double * value = block.values.data() + i * BlockStrides[u] + j * BlockStrides[v];
      double   before = *value;
      for (std::size_t k = 1; k + 1 < extent[axis]; ++k)
      {
        value += stride;
        const double own = *value;
        *value = 0.25 * before + (0.5 * own + 0.25 * value[stride]);
        before = own;
      }
    }
  }
}

/** 240 times the derivative of values that are smoothed by (1 2 1) / 4, right to the sixth power of the frequency: the
 * components of a gradient must fit together, or normals would turn to the axes. */
double
GetDifference(const double * const value, const std::size_t stride)
{
  const auto across = [&](const std::size_t steps) { return value[steps * stride] - *(value - steps * stride); };
  return 95.0 * across(1) + (14.0 * across(2) - across(3));
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

double
MedialVoxelGrayLocal::GetEffectiveNumber(const unsigned int numberOfActiveAxes)
{
  // The weight is 1 - r^2 / R^2, over a disc or over the line across.
  return numberOfActiveAxes == 3 ? 0.75 * 3.14159265358979323846 * Radius * Radius : 5.0 / 3.0 * Radius;
}

MedialVoxelGrayLocal::MedialVoxelGrayLocal(const MedialVoxelGrid & grid, const double background, const double material)
  : m_Grid(grid)
  , m_Background(background)
  , m_Scale(1.0 / (material - background))
{}

double
MedialVoxelGrayLocal::GetValue(const MedialVoxelGray & gray, const Index & voxel) const
{
  Index inside = voxel;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    inside[axis] = std::clamp<std::int64_t>(voxel[axis], 0, m_Grid.GetSize()[axis] - 1);
  }
  return (static_cast<double>(gray.Get(inside)) - m_Background) * m_Scale;
}

bool
MedialVoxelGrayLocal::FindNormal(const MedialVoxelGray & gray, const Vector & place, Vector & normal) const
{
  Index       first{};
  std::size_t window[3];
  std::size_t extent[3];
  std::size_t margin[3];
  double      weights[3][WindowExtent];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const bool isActive = m_Grid.IsActive(axis);
    const auto begin = isActive ? static_cast<std::int64_t>(std::ceil(place[axis] - WindowReach)) : 0;
    const auto end = isActive ? static_cast<std::int64_t>(std::floor(place[axis] + WindowReach)) + 1 : 1;
    margin[axis] = isActive ? BlockMargin : 0;
    window[axis] = static_cast<std::size_t>(end - begin);
    extent[axis] = window[axis] + 2 * margin[axis];
    first[axis] = begin - static_cast<std::int64_t>(margin[axis]);
    for (std::size_t i = 0; i < window[axis]; ++i)
    {
      weights[axis][i] = GetWindowWeight(static_cast<double>(begin) + static_cast<double>(i) - place[axis]);
    }
  }
  std::array<Block, 3> blocks; // for the derivative along each axis
  for (std::size_t z = 0; z < extent[2]; ++z)
  {
    for (std::size_t y = 0; y < extent[1]; ++y)
    {
      for (std::size_t x = 0; x < extent[0]; ++x)
      {
        const Index  voxel{ { first[0] + static_cast<std::int64_t>(x),
                              first[1] + static_cast<std::int64_t>(y),
                              first[2] + static_cast<std::int64_t>(z) } };
        const double value = this->GetValue(gray, voxel);
        for (Block & block : blocks)
        {
          block.values[Block::At(x, y, z)] = value;
        }
      }
    }
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    Smooth(blocks[axis], extent, (axis + 1) % 3);
    Smooth(blocks[axis], extent, (axis + 2) % 3);
  }
  Matrix tensor{};
  for (std::size_t z = 0; z < window[2]; ++z)
  {
    for (std::size_t y = 0; y < window[1]; ++y)
    {
      const double ofRow = weights[1][y] * weights[2][z];
      for (std::size_t x = 0; x < window[0]; ++x)
      {
        const std::size_t at = Block::At(x + margin[0], y + margin[1], z + margin[2]);
        double            gradient[3];
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const double * const value = blocks[axis].values.data() + at;
          gradient[axis] = margin[axis] == 0 ? 0.0 : GetDifference(value, BlockStrides[axis]);
        }
        const double weight = weights[0][x] * ofRow;
        for (unsigned int i = 0; i < 3; ++i)
        {
          for (unsigned int j = i; j < 3; ++j)
          {
            tensor[i][j] += weight * (gradient[i] * gradient[j]);
          }
        }
      }
    }
  }
  const double trace = (tensor[0][0] + tensor[1][1]) + tensor[2][2];
  if (!(trace > 0.0) || !std::isfinite(trace))
  {
    return false;
  }
  for (unsigned int i = 0; i < 3; ++i)
  {
    for (unsigned int j = i; j < 3; ++j)
    {
      tensor[i][j] /= trace;
      tensor[j][i] = tensor[i][j];
    }
  }
  normal = FindFirstEigenvector(tensor);
  const double length = MedialVoxelNorm(normal);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    normal[axis] = m_Grid.IsActive(axis) ? normal[axis] / length : 0.0;
  }
  return true;
}

void
MedialVoxelGrayLocal::FindSamples(const MedialVoxelGray & gray,
                                  const Vector &          place,
                                  const Vector &          direction,
                                  const double            reach,
                                  std::vector<Sample> &   samples) const
{
  samples.clear();
  unsigned int steepest = 0;
  for (unsigned int axis = 1; axis < 3; ++axis)
  {
    steepest = std::abs(direction[axis]) > std::abs(direction[steepest]) ? axis : steepest;
  }
  const unsigned int u = (steepest + 1) % 3;
  const unsigned int v = (steepest + 2) % 3;
  const double       steep = std::abs(direction[steepest]);
  const double       slices = reach * steep + Radius * std::sqrt(std::max(0.0, 1.0 - steep * steep));
  // Extents of the slice of a cylinder.
  const auto extentOf = [&](const unsigned int axis) {
    return m_Grid.IsActive(axis) ? Radius * std::sqrt(steep * steep + direction[axis] * direction[axis]) / steep : 0.0;
  };
  const double extentU = extentOf(u);
  const double extentV = extentOf(v);
  const double inverse = 1.0 / (Radius * Radius);
  const auto   begin = static_cast<std::int64_t>(std::ceil(place[steepest] - slices));
  const auto   end = static_cast<std::int64_t>(std::floor(place[steepest] + slices));
  Index        voxel{};
  Vector       d{};
  for (voxel[steepest] = begin; voxel[steepest] <= end; ++voxel[steepest])
  {
    d[steepest] = static_cast<double>(voxel[steepest]) - place[steepest];
    const double times = d[steepest] / direction[steepest];
    const double centerU = place[u] + times * direction[u];
    const double centerV = place[v] + times * direction[v];
    const auto   endU = static_cast<std::int64_t>(std::floor(centerU + extentU));
    const auto   endV = static_cast<std::int64_t>(std::floor(centerV + extentV));
    for (voxel[v] = static_cast<std::int64_t>(std::ceil(centerV - extentV)); voxel[v] <= endV; ++voxel[v])
    {
      d[v] = static_cast<double>(voxel[v]) - place[v];
      for (voxel[u] = static_cast<std::int64_t>(std::ceil(centerU - extentU)); voxel[u] <= endU; ++voxel[u])
      {
        d[u] = static_cast<double>(voxel[u]) - place[u];
        const double along = MedialVoxelDot(d, direction);
        const double weight = 1.0 - (MedialVoxelDot(d, d) - along * along) * inverse;
        if (weight > 0.0 && std::abs(along) <= reach)
        {
          samples.push_back({ along, weight, this->GetValue(gray, voxel) });
        }
      }
    }
  }
}

} // end namespace itk
