// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelComplexDivision.h"

#include "MedialVoxelTestElements.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

using Index = itk::MedialVoxelSheet::Index;

TEST(MedialVoxelSheetDivision, PartsHaveEachTriangleOnce)
{
  const itk::MedialVoxelSheet sheet = FlatSquare(30, 2.0f);
  for (const std::size_t most : { std::size_t{ 1 }, std::size_t{ 100 }, std::size_t{ 1800 } })
  {
    const auto                   division = itk::MedialVoxelDivideSheet(sheet, most);
    std::set<Index>              found;
    std::vector<std::set<Index>> partsOf(sheet.points.size());
    for (Index part = 0; part < division.parts.size(); ++part)
    {
      EXPECT_LE(division.parts[part].size(), most);
      for (const Index triangle : division.parts[part])
      {
        EXPECT_TRUE(found.insert(triangle).second);
        for (const Index corner : sheet.triangles[triangle])
        {
          partsOf[corner].insert(part);
        }
      }
    }
    EXPECT_EQ(found.size(), sheet.triangles.size());
    EXPECT_EQ(division.parts.size() == 1, most == 1800);
    for (std::size_t point = 0; point < sheet.points.size(); ++point)
    {
      EXPECT_EQ(division.isShared[point], partsOf[point].size() > 1);
    }
  }
}

TEST(MedialVoxelSheetDivision, NothingHasNoTriangles)
{
  const auto division = itk::MedialVoxelDivideSheet({}, 10);
  EXPECT_TRUE(division.isShared.empty());
  for (const auto & part : division.parts)
  {
    EXPECT_TRUE(part.empty());
  }
}
} // namespace
