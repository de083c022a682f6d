// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelFoldedElements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>


namespace
{
using Quadrilateral = std::array<itk::MedialVoxelVector3, 4>;

struct Case
{
  Quadrilateral corners;
  double        refused; ///< from this thickness on, CalculiX 2.20 refuses it as an S4 (found by bisection)
};

/** The first four are of a mesh of a die-cast cover that CalculiX refused. */
const std::array<Case, 7> Cases{ {
  { { { { { -0.31, 0.77, -0.54 } },
        { { -2.26, -1.16, -0.21 } },
        { { -0.13, -1.26, 1.32 } },
        { { 2.69, 1.66, -0.57 } } } },
    6.949 },
  { { { { { 1.23, 0.93, -0.62 } }, { { -0.33, -0.03, -0.4 } }, { { -1.08, -1.02, 0.55 } }, { { 0.18, 0.11, 0.48 } } } },
    5.603 },
  { { { { { 1.14, -0.42, -0.39 } }, { { 0.42, 0.39, -0.25 } }, { { -1.76, 1.26, 0.89 } }, { { 0.2, -1.22, -0.25 } } } },
    4.578 },
  { { { { { -0.01, 0.05, -1.75 } },
        { { -0.12, 0.42, 0.17 } },
        { { 0.19, 0.03, 1.86 } },
        { { -0.06, -0.51, -0.28 } } } },
    3.892 },
  { { { { { 0, 0, 0.5 } }, { { 2, 0, -0.5 } }, { { 2, 2, 0.5 } }, { { 0, 2, -0.5 } } } }, 8.485 },
  { { { { { 0, 0, 0 } }, { { 3, 0, 0 } }, { { 3, 1, 1 } }, { { 0, 1, 0 } } } }, 12.695 },
  { { { { { 0, 0, 0 } }, { { 3, 0, 0 } }, { { 2, 1, 0.6 } }, { { 0, 1, 0 } } } }, 8.383 },
} };

itk::MedialVoxelRemeshedSheet
MakeSheet(const Quadrilateral & corners, const double thickness)
{
  itk::MedialVoxelRemeshedSheet sheet;
  sheet.points.assign(corners.begin(), corners.end());
  sheet.thickness.assign(4, thickness);
  sheet.thickness[2] = 0.0; // is not known
  itk::MedialVoxelShellElement element;
  element.corners = { { 0, 1, 2, 3 } };
  element.numberOfCorners = 4;
  element.rimSides = 0b0101;
  element.junctionSides = 0b1000;
  element.wall = 7;
  sheet.elements.push_back(element);
  return sheet;
}

TEST(MedialVoxelFoldedElements, FoldWhereCalculixRefuses)
{
  for (const Case & one : Cases)
  {
    EXPECT_FALSE(itk::MedialVoxelIsFolded(one.corners, 0.999 * one.refused)) << one.refused;
    EXPECT_TRUE(itk::MedialVoxelIsFolded(one.corners, 1.001 * one.refused)) << one.refused;
  }
}

TEST(MedialVoxelFoldedElements, FlatOnesNeverFold)
{
  const Quadrilateral flat{ { { { 0, 0, 0 } }, { { 2, 0, 0 } }, { { 2, 1, 0 } }, { { 0, 1, 0 } } } };
  EXPECT_FALSE(itk::MedialVoxelIsFolded(flat, 1e6));
}

TEST(MedialVoxelFoldedElements, AreSplitWithTheMarksOfTheirSides)
{
  for (const Case & one : Cases)
  {
    auto thin = MakeSheet(one.corners, 0.6 * one.refused);
    itk::MedialVoxelSplitFolded(thin);
    EXPECT_EQ(thin.elements.size(), 1u);

    auto sheet = MakeSheet(one.corners, 0.7 * one.refused);
    itk::MedialVoxelSplitFolded(sheet);
    ASSERT_EQ(sheet.elements.size(), 2u);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto & element : sheet.elements)
    {
      ASSERT_EQ(element.numberOfCorners, 3);
      EXPECT_EQ(element.wall, 7u);
      EXPECT_EQ(element.corners[0], *std::min_element(element.corners.begin(), element.corners.begin() + 3));
      for (unsigned int k = 0; k < 3; ++k)
      {
        const std::uint32_t a = element.corners[k];
        const std::uint32_t b = element.corners[(k + 1) % 3];
        EXPECT_EQ(++sides[std::make_pair(a, b)], 1); // both go round as the quadrilateral did
        EXPECT_EQ(element.rimSides >> k & 1, b == (a + 1) % 4 && a % 2 == 0 ? 1 : 0);
        EXPECT_EQ(element.junctionSides >> k & 1, a == 3 && b == 0 ? 1 : 0);
      }
    }
    for (std::uint32_t k = 0; k < 4; ++k)
    {
      EXPECT_EQ(sides.count(std::make_pair(k, (k + 1) % 4)), 1u);
    }
    itk::MedialVoxelSplitFolded(sheet);
    EXPECT_EQ(sheet.elements.size(), 2u);
  }
}

} // namespace
