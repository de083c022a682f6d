// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelComplexDivision.h"

#include "MedialVoxelTestElements.h"

#include <gtest/gtest.h>

#include <numeric>

namespace
{
using namespace MedialVoxelTest;

using Complex = itk::MedialVoxelTriangleComplex;
using Index = Complex::Index;

Complex
MakeComplex(const itk::MedialVoxelSheet & sheet)
{
  Complex complex;
  for (const auto & point : sheet.points)
  {
    complex.AddVertex(point);
  }
  for (const auto & corners : sheet.triangles)
  {
    complex.AddTriangle(corners, 0);
  }
  return complex;
}

TEST(MedialVoxelComplexDivision, PartsHaveEachTriangleOnce)
{
  Complex complex = MakeComplex(FlatSquare(30, 2.0f));
  complex.RemoveTriangle(17);
  for (const std::size_t most : { std::size_t{ 1 }, std::size_t{ 100 }, std::size_t{ 1800 } })
  {
    for (const double share : { 0.01, 0.4, 0.5 })
    {
      const auto                   division = itk::MedialVoxelDivideComplex(complex, most, share);
      std::set<Index>              found;
      std::vector<std::set<Index>> partsOf(complex.GetNumberOfVertices());
      for (Index part = 0; part < division.parts.size(); ++part)
      {
        EXPECT_LE(division.parts[part].size(), most);
        EXPECT_FALSE(division.parts[part].empty());
        for (const Index triangle : division.parts[part])
        {
          EXPECT_TRUE(found.insert(triangle).second);
          for (const Index corner : complex.GetTriangle(triangle))
          {
            partsOf[corner].insert(part);
          }
        }
      }
      EXPECT_EQ(found.size(), std::size_t{ 1799 });
      EXPECT_EQ(found.count(17), std::size_t{ 0 });
      EXPECT_EQ(division.parts.size() == 1, most == 1800);
      for (Index vertex = 0; vertex < partsOf.size(); ++vertex)
      {
        EXPECT_EQ(division.isShared[vertex], partsOf[vertex].size() > 1);
      }
    }
  }
}

TEST(MedialVoxelComplexDivision, SharesCutAtOtherPlaces)
{
  const Complex complex = MakeComplex(FlatSquare(30, 2.0f));
  const auto    halves = itk::MedialVoxelDivideComplex(complex, 300, 0.5);
  const auto    others = itk::MedialVoxelDivideComplex(complex, 300, 0.4);
  std::size_t   shared = 0;
  std::size_t   sharedTwice = 0;
  for (std::size_t vertex = 0; vertex < halves.isShared.size(); ++vertex)
  {
    shared += halves.isShared[vertex] ? 1 : 0;
    sharedTwice += halves.isShared[vertex] && others.isShared[vertex] ? 1 : 0;
  }
  EXPECT_GT(shared, std::size_t{ 90 });
  EXPECT_LT(sharedTwice, shared / 3);
}

TEST(MedialVoxelComplexDivision, NothingHasNoTriangles)
{
  const auto division = itk::MedialVoxelDivideComplex({}, 10, 0.5);
  EXPECT_TRUE(division.isShared.empty());
  for (const auto & part : division.parts)
  {
    EXPECT_TRUE(part.empty());
  }
}
} // namespace
