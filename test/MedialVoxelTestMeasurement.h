// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MedialVoxelTestMeasurement_h
#define MedialVoxelTestMeasurement_h

#include "itkMedialVoxelClassifier.h"
#include "itkMedialVoxelThickness.h"

#include "MedialVoxelTestKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

namespace MedialVoxelTest
{

/** Thicknesses at the medial cells whose index passes a test. */
class Measurement
{
public:
  using Test = std::function<bool(const itk::MedialVoxelIndex &)>;

  Measurement(const Volume & volume, double tau, const Test & isWanted)
    : Measurement(volume, tau, isWanted, GridOf(volume).GetVoxelBox())
  {}

  Measurement(const Volume & volume, double tau, const Test & isWanted, const itk::MedialVoxelBox & tile)
  {
    const itk::MedialVoxelGrid grid = GridOf(volume);
    const itk::MedialVoxelBits object = ObjectBits(volume, grid.GetVoxelBox());
    const itk::MedialVoxelBits sites = SiteBits(BoundarySites(volume), grid.GetVoxelBox());
    itk::MedialVoxelParameters parameters;
    parameters.epsilon = itk::MedialVoxelParameters::EpsilonFromThickness(tau);
    const itk::MedialVoxelClassifier            classifier(grid, parameters);
    const itk::MedialVoxelFeatureTransform      transform(grid);
    itk::MedialVoxelFeatureTransform::Workspace transformWorkspace;
    itk::MedialVoxelFeatures                    features;
    const itk::MedialVoxelWindow                window{ &object, &sites };
    EXPECT_TRUE(transform.Compute(window, classifier.GetVoxelBox(tile), transformWorkspace, features).IsEmpty());
    itk::MedialVoxelClassifier::Workspace workspace;
    std::vector<std::uint8_t>             labels;
    itk::MedialVoxelCounts                counts;
    EXPECT_TRUE(
      classifier.Classify(window, tile, features, itk::MedialVoxelNoProgress{}, workspace, labels, counts).IsEmpty());

    const itk::MedialVoxelThickness thickness(grid);
    std::size_t                     i = 0;
    ForEachVoxel(tile, [&](const itk::MedialVoxelIndex & cell) {
      if (labels[i++] >= itk::MedialVoxelLabel::MedialByBound && isWanted(cell))
      {
        itk::MedialVoxelWallPoints wall;
        EXPECT_TRUE(classifier.GetWallPoints(features, cell, wall));
        const itk::MedialVoxelWall measured = thickness.Measure(object, wall);
        m_Values.push_back(static_cast<double>(measured.thickness));
        if (!measured.isUnpaired)
        {
          m_WallValues.push_back(m_Values.back());
        }
        m_Area += static_cast<double>(measured.area);
        ++m_CellsAcross[measured.axis];
      }
    });
  }

  const std::vector<double> &
  GetValues() const
  {
    return m_Values;
  }

  /** Sorted, without those at rims. */
  std::vector<double>
  GetWallValues() const
  {
    std::vector<double> values = m_WallValues;
    std::sort(values.begin(), values.end());
    return values;
  }

  /** Of all medial cells that are wanted. */
  double
  Area() const
  {
    return m_Area;
  }

  /** Numbers of cells by the axis that their wall is across. */
  const std::array<std::size_t, 3> &
  CellsAcross() const
  {
    return m_CellsAcross;
  }

  double
  Mean() const
  {
    double sum = 0.0;
    for (const double value : m_Values)
    {
      sum += value;
    }
    return sum / static_cast<double>(m_Values.size());
  }

  double
  Deviation() const
  {
    double sum = 0.0;
    for (const double value : m_Values)
    {
      sum += (value - this->Mean()) * (value - this->Mean());
    }
    return std::sqrt(sum / static_cast<double>(m_Values.size()));
  }

private:
  std::vector<double>        m_Values;
  std::vector<double>        m_WallValues;
  double                     m_Area{ 0.0 };
  std::array<std::size_t, 3> m_CellsAcross{ { 0, 0, 0 } };
};

} // namespace MedialVoxelTest

#endif
