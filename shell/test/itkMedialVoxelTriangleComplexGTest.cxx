// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelTriangleComplex.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace
{
using Complex = itk::MedialVoxelTriangleComplex;
using Index = Complex::Index;

/** A ring of `around` x `along` squares, closed along both, or along the first only; with a fin on it where wanted. */
Complex
MakeRing(Index around, Index along, bool closed, bool hasFin)
{
  Complex     complex;
  const Index rows = closed ? along : along + 1;
  for (Index k = 0; k < around * rows; ++k)
  {
    complex.AddVertex({ { double(k % around), double(k / around), 0.0 } });
  }
  const auto at = [&](Index i, Index j) { return (i % around) + around * (j % rows); };
  for (Index j = 0; j < along; ++j)
  {
    for (Index i = 0; i < around; ++i)
    {
      complex.AddTriangle({ { at(i, j), at(i + 1, j), at(i + 1, j + 1) } }, 0);
      complex.AddTriangle({ { at(i, j), at(i + 1, j + 1), at(i, j + 1) } }, 0);
    }
  }
  for (Index i = 0; hasFin && i + 2 < around; ++i)
  {
    complex.AddTriangle({ { at(i, 2), at(i + 1, 2), complex.AddVertex({ { double(i), 2.0, 1.0 } }) } }, 1);
  }
  return complex;
}

long
GetEulerNumber(const Complex & complex)
{
  std::set<Index>           vertices;
  std::set<std::set<Index>> sides;
  std::set<std::set<Index>> triangles;
  long                      number = 0;
  for (Index k = 0; k < complex.GetNumberOfTriangles(); ++k)
  {
    if (complex.IsTriangle(k))
    {
      const auto & c = complex.GetTriangle(k);
      ++number;
      triangles.insert({ c[0], c[1], c[2] });
      vertices.insert(c.begin(), c.end());
      sides.insert({ { c[0], c[1] }, { c[1], c[2] }, { c[2], c[0] } });
    }
  }
  EXPECT_EQ(static_cast<long>(triangles.size()), number) << "a triangle is there twice";
  return static_cast<long>(vertices.size()) - static_cast<long>(sides.size()) + number;
}

TEST(MedialVoxelTriangleComplex, CollapsesKeepTheTopology)
{
  for (const bool closed : { false, true })
  {
    for (const bool hasFin : { false, true })
    {
      Complex      complex = MakeRing(7, 8, closed, hasFin);
      const long   euler = GetEulerNumber(complex);
      std::mt19937 generator(3);
      unsigned int collapses = 0;
      const Index  vertices = complex.GetNumberOfVertices();
      for (unsigned int k = 0; k < 4000; ++k)
      {
        const Index a = generator() % vertices;
        const Index b = generator() % vertices;
        if (a != b && complex.CountTriangles(a, b) > 0 && complex.CanCollapse(a, b))
        {
          complex.Collapse(a, b);
          ++collapses;
          ASSERT_EQ(GetEulerNumber(complex), euler);
        }
      }
      EXPECT_GT(collapses, vertices / 2);
    }
  }
}

TEST(MedialVoxelTriangleComplex, ARingOfThreeStaysOpen)
{
  const Complex complex = MakeRing(3, 2, false, false);
  for (Index row = 0; row < 3; ++row)
  {
    EXPECT_FALSE(complex.CanCollapse(3 * row, 3 * row + 1)) << row;
  }
}

TEST(MedialVoxelTriangleComplex, SplitsKeepTheTopology)
{
  Complex            complex = MakeRing(5, 4, true, true);
  const long         euler = GetEulerNumber(complex);
  std::vector<Index> halves;
  for (const Complex::Neighbor & neighbor : complex.FindNeighbors(12))
  {
    const Index        b = neighbor.vertex;
    const unsigned int triangles = complex.CountTriangles(12, b);
    const Index        middle = complex.Split(12, b, { { 0.5, 0.5, 0.0 } }, halves);
    EXPECT_EQ(halves.size(), triangles);
    EXPECT_EQ(complex.CountTriangles(12, middle), triangles);
    EXPECT_EQ(complex.CountTriangles(12, b), 0u);
    EXPECT_EQ(GetEulerNumber(complex), euler);
  }
}

TEST(MedialVoxelTriangleComplex, PlacesOfVertices)
{
  const Complex complex = MakeRing(7, 4, false, true);
  EXPECT_EQ(complex.GetPlace(1), Complex::Place::Rim);
  EXPECT_EQ(complex.GetPlace(8), Complex::Place::Wall);
  EXPECT_EQ(complex.GetPlace(14), Complex::Place::Corner);
  EXPECT_TRUE(complex.IsOnRim(15));
  EXPECT_FALSE(complex.IsOnRim(8));
}
} // namespace
