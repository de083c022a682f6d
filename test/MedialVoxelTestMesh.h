// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#ifndef MedialVoxelTestMesh_h
#define MedialVoxelTestMesh_h

// What a mesh of the filter holds.

#include "itkMesh.h"

#include <gtest/gtest.h>

#include <vector>

namespace MedialVoxelTest
{
using MeshType = itk::Mesh<float, 3>;

/** All that a mesh holds, as numbers: points with thickness, then faces with their value. */
inline std::vector<double>
NumbersOf(const MeshType & mesh)
{
  std::vector<double> numbers;
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    const auto point = mesh.GetPoint(i);
    float      thickness = -1.0f;
    EXPECT_TRUE(mesh.GetPointData(i, &thickness));
    numbers.insert(numbers.end(), { point[0], point[1], point[2], thickness });
  }
  for (itk::IdentifierType i = 0; i < mesh.GetNumberOfCells(); ++i)
  {
    MeshType::CellAutoPointer cell;
    EXPECT_TRUE(mesh.GetCell(i, cell));
    numbers.insert(numbers.end(), cell->PointIdsBegin(), cell->PointIdsEnd());
    float data = -1.0f;
    EXPECT_TRUE(mesh.GetCellData(i, &data));
    numbers.push_back(data);
  }
  return numbers;
}
} // namespace MedialVoxelTest

#endif // MedialVoxelTestMesh_h
