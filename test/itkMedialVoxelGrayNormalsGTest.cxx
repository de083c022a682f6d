// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Normals from shared gradients, against a plain structure tensor and against normals that share nothing.

#include "itkMedialVoxelGrayNormals.h"
#include "itkMedialVoxelRandomSample.h"

#include "gtest/gtest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{
using Vector3 = itk::MedialVoxelVector3;
using Index3 = itk::MedialVoxelIndex;

constexpr double Background = 20.0;
constexpr double Material = 180.0;

/** Smooth values that change in all directions, with noise. */
float
ValueOf(const Index3 & v)
{
  const auto   x = static_cast<double>(v[0]);
  const auto   y = static_cast<double>(v[1]);
  const auto   z = static_cast<double>(v[2]);
  const double wave = std::sin(0.31 * x + 0.17 * y) + std::sin(0.23 * y - 0.29 * z) + std::sin(0.37 * z + 0.11 * x);
  const auto   noise = itk::MedialVoxelHash(static_cast<std::uint64_t>(v[0] + 1000 * v[1] + 1000000 * v[2])) % 1000;
  return static_cast<float>(100.0 + 40.0 * wave + 0.01 * static_cast<double>(noise));
}

itk::MedialVoxelGray
MakeGray(const itk::MedialVoxelBox & box, const float scale = 1.0F)
{
  itk::MedialVoxelGray gray;
  gray.Frame(box, box);
  for (std::int64_t z = box.lower[2]; z < box.upper[2]; ++z)
  {
    for (std::int64_t y = box.lower[1]; y < box.upper[1]; ++y)
    {
      for (std::int64_t x = box.lower[0]; x < box.upper[0]; ++x)
      {
        gray.GetRow(y, z)[x - box.lower[0]] = scale * ValueOf({ { x, y, z } });
      }
    }
  }
  return gray;
}

/** The structure tensor by its definition: J[i][j] is the windowed sum of the products of derivatives. */
class PlainTensor
{
public:
  PlainTensor(const itk::MedialVoxelGrid & grid, const Vector3 & place)
    : m_Grid(grid)
  {
    Index3 v;
    Index3 lower{};
    Index3 upper{ { 1, 1, 1 } };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      if (grid.IsActive(axis))
      {
        lower[axis] = static_cast<std::int64_t>(std::ceil(place[axis] - 4.0));
        upper[axis] = static_cast<std::int64_t>(std::floor(place[axis] + 4.0)) + 1;
      }
    }
    for (v[2] = lower[2]; v[2] < upper[2]; ++v[2])
    {
      for (v[1] = lower[1]; v[1] < upper[1]; ++v[1])
      {
        for (v[0] = lower[0]; v[0] < upper[0]; ++v[0])
        {
          double squared = 0.0;
          double gradient[3];
          for (unsigned int axis = 0; axis < 3; ++axis)
          {
            const double d = static_cast<double>(v[axis]) - place[axis];
            squared += grid.IsActive(axis) ? d * d : 0.0;
            gradient[axis] = this->Derive(v, axis);
          }
          const double weight = std::exp(-0.5 * squared / (1.5 * 1.5));
          for (unsigned int i = 0; i < 3; ++i)
          {
            for (unsigned int j = 0; j < 3; ++j)
            {
              m_Tensor[i][j] += weight * gradient[i] * gradient[j];
            }
          }
        }
      }
    }
  }

  /** n' J n over the trace of J: the share of the change along n. */
  double
  GetShare(const Vector3 & n) const
  {
    double share = 0.0;
    for (unsigned int i = 0; i < 3; ++i)
    {
      for (unsigned int j = 0; j < 3; ++j)
      {
        share += n[i] * m_Tensor[i][j] * n[j];
      }
    }
    return share / (m_Tensor[0][0] + m_Tensor[1][1] + m_Tensor[2][2]);
  }

private:
  double
  GetValue(Index3 v) const
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      v[axis] = std::clamp<std::int64_t>(v[axis], 0, m_Grid.GetSize()[axis] - 1);
    }
    return ValueOf(v);
  }

  double
  SmoothAcross(const Index3 & v, const unsigned int axis) const
  {
    const unsigned int u = (axis + 1) % 3;
    const unsigned int w = (axis + 2) % 3;
    double             sum = 0.0;
    for (int i = -1; i <= 1; ++i)
    {
      for (int j = -1; j <= 1; ++j)
      {
        Index3 at = v;
        at[u] += i;
        at[w] += j;
        sum += (2 - std::abs(i)) * (2 - std::abs(j)) / 16.0 * this->GetValue(at);
      }
    }
    return sum;
  }

  double
  Derive(const Index3 & v, const unsigned int axis) const
  {
    constexpr double weights[3] = { 95.0, 14.0, -1.0 };
    double           sum = 0.0;
    for (int step = 1; step <= 3; ++step)
    {
      Index3 before = v;
      Index3 after = v;
      before[axis] -= step;
      after[axis] += step;
      sum += weights[step - 1] * (this->SmoothAcross(after, axis) - this->SmoothAcross(before, axis));
    }
    return sum;
  }

  itk::MedialVoxelGrid m_Grid;
  double               m_Tensor[3][3] = {};
};

std::vector<Vector3>
MakePlaces(const itk::MedialVoxelGrid & grid, const std::size_t number)
{
  std::mt19937_64      random(7);
  std::vector<Vector3> places(number);
  for (Vector3 & place : places)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      // On voxels, between them, and anywhere.
      const auto last = static_cast<double>(grid.GetSize()[axis] - 1);
      const auto at = std::uniform_real_distribution<>(0.0, last)(random);
      place[axis] = random() % 3 == 0 ? at : random() % 2 == 0 ? std::floor(at) : std::min(std::floor(at) + 0.5, last);
    }
  }
  return places;
}

const Index3 Sizes[] = { { { 61, 45, 38 } }, { { 50, 1, 47 } }, { { 200, 60, 1 } }, { { 9, 300, 11 } } };
} // namespace

TEST(MedialVoxelGrayNormals, AreTheDirectionOfTheLargestChange)
{
  for (const Index3 & size : Sizes)
  {
    const itk::MedialVoxelGrid  grid(size, { { 1.0, 1.0, 1.0 } });
    const auto                  gray = MakeGray(grid.GetVoxelBox());
    itk::MedialVoxelGrayNormals normals(grid, Background, Material);
    for (const Vector3 & place : MakePlaces(grid, 60))
    {
      Vector3 normal;
      ASSERT_TRUE(normals.Find(gray, place, normal));
      EXPECT_NEAR(itk::MedialVoxelNorm(normal), 1.0, 1e-12);
      const PlainTensor tensor(grid, place);
      // No direction next to the normal has a larger share, so that it is that of the first eigenvector.
      const double share = tensor.GetShare(normal);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(grid.IsActive(axis) ? 0.0 : normal[axis], 0.0);
        for (const double turn : { -0.003, 0.003 })
        {
          Vector3 turned = normal;
          turned[axis] += grid.IsActive(axis) ? turn : 0.0;
          const double length = itk::MedialVoxelNorm(turned);
          EXPECT_LE(tensor.GetShare({ { turned[0] / length, turned[1] / length, turned[2] / length } }), share + 1e-7);
        }
      }
      EXPECT_GE(share, 1.0 / 3.0);
    }
  }
}

TEST(MedialVoxelGrayNormals, DoNotDependOnWhatWasAskedBeforeOrOnTheValuesAtHand)
{
  for (const Index3 & size : Sizes)
  {
    const itk::MedialVoxelGrid  grid(size, { { 1.0, 1.0, 1.0 } });
    const auto                  gray = MakeGray(grid.GetVoxelBox());
    itk::MedialVoxelGrayNormals shared(grid, Background, Material);
    constexpr auto              reach = itk::MedialVoxelGrayNormals::Reach;
    for (const Vector3 & place : MakePlaces(grid, 400))
    {
      itk::MedialVoxelBox around;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        around.lower[axis] = static_cast<std::int64_t>(std::ceil(place[axis])) - reach;
        around.upper[axis] = static_cast<std::int64_t>(std::floor(place[axis])) + reach + 1;
      }
      const auto                  few = MakeGray(around.Intersection(grid.GetVoxelBox()));
      itk::MedialVoxelGrayNormals fresh(grid, Background, Material);
      Vector3                     expected;
      ASSERT_TRUE(fresh.Find(gray, place, expected));
      // Values move with the place, as those of an engine do.
      Vector3 normal;
      ASSERT_TRUE(shared.Find(few, place, normal));
      EXPECT_EQ(normal, expected);
      ASSERT_TRUE(shared.Find(gray, place, normal));
      EXPECT_EQ(normal, expected);
    }
  }
}

TEST(MedialVoxelGrayNormals, DoNotDependOnTheUnitOfTheValues)
{
  const itk::MedialVoxelGrid  grid({ { 40, 36, 30 } }, { { 1.0, 1.0, 1.0 } });
  const auto                  gray = MakeGray(grid.GetVoxelBox());
  itk::MedialVoxelGrayNormals normals(grid, 0.0, 1.0);
  for (const float scale : { 1e-22F, 1e-3F, 1e18F })
  {
    const auto                  scaled = MakeGray(grid.GetVoxelBox(), scale);
    itk::MedialVoxelGrayNormals others(grid, 0.0, static_cast<double>(scale));
    for (const Vector3 & place : MakePlaces(grid, 30))
    {
      Vector3 expected;
      Vector3 normal;
      ASSERT_TRUE(normals.Find(gray, place, expected));
      ASSERT_TRUE(others.Find(scaled, place, normal)) << scale;
      EXPECT_NEAR(std::abs(itk::MedialVoxelDot(normal, expected)), 1.0, 1e-9) << scale;
    }
  }
}

TEST(MedialVoxelGrayNormals, ThereIsNoneWhereValuesAreTheSameOrNotFinite)
{
  const itk::MedialVoxelGrid  grid({ { 40, 40, 40 } }, { { 1.0, 1.0, 1.0 } });
  itk::MedialVoxelGrayNormals normals(grid, Background, Material);
  itk::MedialVoxelGray        gray;
  gray.Frame(grid.GetVoxelBox(), grid.GetVoxelBox());
  for (std::int64_t z = 0; z < 40; ++z)
  {
    for (std::int64_t y = 0; y < 40; ++y)
    {
      std::fill_n(gray.GetRow(y, z), 40, 7.0F);
    }
  }
  gray.GetRow(30, 30)[30] = std::numeric_limits<float>::quiet_NaN();
  Vector3 normal;
  EXPECT_FALSE(normals.Find(gray, { { 12.0, 12.5, 12.0 } }, normal));
  EXPECT_FALSE(normals.Find(gray, { { 26.5, 30.0, 30.0 } }, normal));
  // The block that knows the value is asked for its other gradients.
  gray.GetRow(20, 30)[20] = 8.0F;
  itk::MedialVoxelGrayNormals others(grid, Background, Material);
  EXPECT_FALSE(others.Find(gray, { { 26.0, 30.0, 30.0 } }, normal));
  EXPECT_TRUE(others.Find(gray, { { 22.0, 22.0, 30.0 } }, normal));
}
