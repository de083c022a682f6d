// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

#include "itkMedialVoxelThickness.h"

#include "itkMedialVoxelClassifier.h"

#include "MedialVoxelTestKernels.h"
#include "MedialVoxelTestPhantoms.h"

#include <gtest/gtest.h>

namespace
{
using namespace MedialVoxelTest;

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
  double                     m_Area{ 0.0 };
  std::array<std::size_t, 3> m_CellsAcross{ { 0, 0, 0 } };
};

bool
Everywhere(const itk::MedialVoxelIndex &)
{
  return true;
}

/** Cells further than the thickness of the walls from the faces of a cube. */
Measurement::Test
Inside(int size, int margin)
{
  return [=](const itk::MedialVoxelIndex & cell) {
    for (const auto index : cell)
    {
      if (index < margin || index >= size - 1 - margin)
      {
        return false;
      }
    }
    return true;
  };
}

/** Means over plates whose centers divide a voxel along the normal; where a plate lies between the voxels changes how
 * many of their layers it holds. */
struct PlateErrors
{
  double mean{ 0.0 };
  double deviation{ 0.0 };
};

PlateErrors
MeasureTiltedPlates(const Vector3 & normal, double thickness)
{
  constexpr int size = 44;
  constexpr int places = 8;
  const double  length = std::sqrt(Dot(normal, normal));
  PlateErrors   errors;
  for (int place = 0; place < places; ++place)
  {
    Vector3 center{ { 21.3, 21.6, 21.4 } };
    for (int axis = 0; axis < 3; ++axis)
    {
      center[axis] += normal[axis] / length * place / places;
    }
    const Measurement measured(TiltedPlate({ { size, size, size } }, center, normal, thickness), 3.0, Inside(size, 10));
    EXPECT_GT(measured.GetValues().size(), 300u);
    errors.mean += (measured.Mean() - thickness) / places;
    errors.deviation += measured.Deviation() / places;
  }
  return errors;
}
} // namespace

TEST(MedialVoxelThickness, PlatesAlongAnAxisAreExactUpToTheFacesOfTheImage)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int thickness = 1; thickness <= 8; ++thickness)
    {
      for (const double unit : { 1.0, 0.25 })
      {
        const Volume      volume = AxisPlate({ { 14, 14, 14 } }, { { unit, unit, unit } }, axis, 3, thickness);
        const Measurement measured(volume, 3.0 * unit, Everywhere);
        EXPECT_EQ(measured.GetValues().size(), 13u * 13u);
        for (const double value : measured.GetValues())
        {
          EXPECT_EQ(value, thickness * unit) << axis;
        }
      }
    }
  }
}

TEST(MedialVoxelThickness, PlatesWhoseBoundaryIsAtTheFaceOfTheImageAreExact)
{
  const Volume      volume = AxisPlate({ { 12, 12, 6 } }, UnitSpacing, 2, 1, 4);
  const Measurement measured(volume, 3.0, Everywhere);
  ASSERT_EQ(measured.GetValues().size(), 11u * 11u);
  for (const double value : measured.GetValues())
  {
    EXPECT_EQ(value, 4.0);
  }
}

TEST(MedialVoxelThickness, UnequalSpacingIsMeasuredInItsUnits)
{
  const Vector3 spacing{ { 0.5, 0.75, 1.5 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int thickness = 1; thickness <= 4; ++thickness)
    {
      const Volume      volume = AxisPlate({ { 16, 15, 14 } }, spacing, axis, 4, thickness);
      const Measurement measured(volume, 1.5, Everywhere);
      ASSERT_FALSE(measured.GetValues().empty());
      for (const double value : measured.GetValues())
      {
        EXPECT_NEAR(value, thickness * spacing[axis], 1e-6) << axis;
      }
    }
  }
}

TEST(MedialVoxelThickness, LinesInThePlaneAreExact)
{
  for (int axis = 0; axis < 2; ++axis)
  {
    const Volume      volume = AxisPlate({ { 20, 20, 1 } }, UnitSpacing, axis, 6, 5);
    const Measurement measured(volume, 3.0, Everywhere);
    ASSERT_EQ(measured.GetValues().size(), 19u);
    for (const double value : measured.GetValues())
    {
      EXPECT_EQ(value, 5.0);
    }
  }
}

TEST(MedialVoxelThickness, TiltedWallsAreRightInTheMean)
{
  struct Case
  {
    Vector3 normal;
    double  thickness;
    double  mean;
    double  deviation;
  };
  const double tangent = std::tan(3.14159265358979323846 / 12);
  for (const Case & c : { Case{ { { 0.0, tangent, 1.0 } }, 2, 0.05, 0.25 },
                          Case{ { { 0.0, tangent, 1.0 } }, 4, 0.05, 0.17 },
                          Case{ { { 0.0, tangent, 1.0 } }, 8, 0.08, 0.1 },
                          Case{ { { 1.0, 2.0, 5.0 } }, 2, 0.13, 0.15 },
                          Case{ { { 1.0, 2.0, 5.0 } }, 4, 0.13, 0.05 },
                          Case{ { { 1.0, 2.0, 5.0 } }, 8, 0.13, 0.05 },
                          Case{ { { 1.0, 1.0, 1.0 } }, 2, 0.14, 0.05 },
                          Case{ { { 1.0, 1.0, 1.0 } }, 4, 0.14, 0.05 },
                          Case{ { { 1.0, 1.0, 1.0 } }, 8, 0.14, 0.05 } })
  {
    const PlateErrors errors = MeasureTiltedPlates(c.normal, c.thickness);
    EXPECT_LT(std::abs(errors.mean), c.mean) << c.normal[0] << ' ' << c.normal[1] << ' ' << c.normal[2];
    EXPECT_LT(errors.deviation, c.deviation) << c.normal[0] << ' ' << c.normal[1] << ' ' << c.normal[2];
  }
}

TEST(MedialVoxelThickness, LayersAt45DegreesToTwoAxesHideLessThanHalfAVoxel)
{
  for (const double thickness : { 2.0, 3.0, 4.0, 6.0, 8.0 })
  {
    EXPECT_LT(std::abs(MeasureTiltedPlates({ { 1.0, 1.0, 0.0 } }, thickness).mean), 0.4) << thickness;
  }
}

TEST(MedialVoxelThickness, TiltedWallsInMillimetersAreRightInTheMean)
{
  // The phantoms measure in voxels: this one is a plate in millimeters.
  const Vector3 spacing{ { 0.5, 0.75, 0.6 } };
  const Vector3 normal{ { 0.3, 0.2, 0.933 } };
  for (const double thickness : { 1.5, 2.4, 4.8 })
  {
    const Volume      volume = MakeVolume({ { 48, 36, 40 } }, spacing, [&](const Index3 & v) {
      const Vector3 r{ { spacing[0] * v[0] - 12, spacing[1] * v[1] - 13.1, spacing[2] * v[2] - 12.2 } };
      return std::abs(Dot(r, normal)) / std::sqrt(Dot(normal, normal)) <= thickness / 2;
    });
    const Measurement measured(volume, 1.8, Inside(36, 9));
    EXPECT_GT(measured.GetValues().size(), 300u);
    EXPECT_NEAR(measured.Mean(), thickness, 0.2 * 0.6) << thickness;
  }
}

TEST(MedialVoxelThickness, AreasOfWallsAlongAnAxisAreExact)
{
  const Vector3 spacing{ { 0.5, 0.75, 1.5 } };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const Volume      volume = AxisPlate({ { 16, 15, 14 } }, spacing, static_cast<int>(axis), 4, 3);
    const Measurement measured(volume, 1.5, Everywhere);
    double            area = static_cast<double>(measured.GetValues().size());
    for (unsigned int other = 0; other < 3; ++other)
    {
      area *= other == axis ? 1.0 : spacing[other];
    }
    EXPECT_NEAR(measured.Area(), area, 1e-4);
    EXPECT_EQ(measured.CellsAcross()[axis], measured.GetValues().size());
  }
  // In the plane the area is a length.
  const Measurement line(AxisPlate({ { 20, 20, 1 } }, { { 0.5, 0.5, 7.0 } }, 1, 6, 5), 1.5, Everywhere);
  EXPECT_EQ(line.Area(), 19 * 0.5);
}

TEST(MedialVoxelThickness, AreasOfTiltedWallsAreRightInTheMean)
{
  for (const Vector3 & normal : { Vector3{ { 1, 2, 5 } }, Vector3{ { 1, 1, 1 } }, Vector3{ { 0, 0.268, 1 } } })
  {
    for (const double thickness : { 2.0, 4.0, 8.0 })
    {
      // The part of the plane above a square, seen along z.
      const Measurement measured(
        TiltedPlate({ { 60, 60, 100 } }, { { 30.2, 29.7, 50.3 } }, normal, thickness), 3.0, [](const auto & cell) {
          return cell[0] >= 14 && cell[0] < 44 && cell[1] >= 14 && cell[1] < 44;
        });
      const double area = 30.0 * 30.0 * std::sqrt(Dot(normal, normal)) / normal[2];
      EXPECT_NEAR(measured.Area() / area, 1.0, thickness < 6.0 ? 0.1 : 0.05)
        << normal[0] << ' ' << normal[1] << ' ' << normal[2];
    }
  }
  for (const double thickness : { 2.0, 4.0, 6.0 })
  {
    const Measurement measured(
      SphericalShell({ { 60, 60, 60 } }, { { 29.4, 29.7, 29.5 } }, 24.0, thickness), 3.0, Everywhere);
    const double area = 4.0 * 3.14159265358979323846 * 24.0 * 24.0;
    EXPECT_NEAR(measured.Area() / area, 1.0, thickness < 6.0 ? 0.1 : 0.05) << thickness;
  }
}

TEST(MedialVoxelThickness, ShellsAreRightInTheMean)
{
  for (const double thickness : { 2.0, 4.0 })
  {
    const Volume      shell = SphericalShell({ { 60, 60, 60 } }, { { 29.4, 29.7, 29.5 } }, 24.0, thickness);
    const Measurement measured(shell, 3.0, Everywhere);
    EXPECT_NEAR(measured.Mean(), thickness, 0.1);
    EXPECT_LT(measured.Deviation(), 0.2);
  }
}

TEST(MedialVoxelThickness, TheSpacingOfEqualVoxelsScalesAll)
{
  Volume            volume = RandomBoxes({ { 40, 30, 20 } }, UnitSpacing, 20, 77);
  const Measurement voxels(volume, 3.0, Everywhere);
  volume.spacing = { { 0.5, 0.5, 0.5 } };
  const Measurement millimeters(volume, 1.5, Everywhere);
  ASSERT_EQ(voxels.GetValues().size(), millimeters.GetValues().size());
  ASSERT_FALSE(voxels.GetValues().empty());
  for (std::size_t i = 0; i < voxels.GetValues().size(); ++i)
  {
    EXPECT_NEAR(millimeters.GetValues()[i], 0.5 * voxels.GetValues()[i], 1e-6);
  }
}

TEST(MedialVoxelThickness, PartsOfATileGiveTheSameBits)
{
  const Volume        volume = RandomBoxes({ { 70, 30, 24 } }, { { 1.0, 1.2, 1.5 } }, 25, 78);
  std::vector<double> whole = Measurement(volume, 3.0, Everywhere).GetValues();
  std::vector<double> parts;
  for (const auto & range : { Index3{ { 0, 5, 0 } }, Index3{ { 5, 24, 0 } } })
  {
    const auto values =
      Measurement(volume, 3.0, Everywhere, MakeBox({ { 0, 0, range[0] } }, { { 70, 30, range[1] } })).GetValues();
    parts.insert(parts.end(), values.begin(), values.end());
  }
  EXPECT_FALSE(whole.empty());
  EXPECT_EQ(whole, parts);
}

TEST(MedialVoxelThickness, CountsVoxelsAroundAPointAndContinuesTheImage)
{
  const Volume                    volume = RandomVolume({ { 130, 9, 8 } }, UnitSpacing, 0.5, 79);
  const itk::MedialVoxelGrid      grid = GridOf(volume);
  const itk::MedialVoxelBits      object = ObjectBits(volume, grid.GetVoxelBox());
  const itk::MedialVoxelThickness thickness(grid);
  ForEachVoxel(grid.GetVoxelBox(), [&](const itk::MedialVoxelIndex & point) {
    int expected = 0;
    ForEachVoxel(MakeBox({ { -1, -1, -1 } }, { { 2, 2, 2 } }), [&](const itk::MedialVoxelIndex & offset) {
      Index3 voxel;
      for (int axis = 0; axis < 3; ++axis)
      {
        voxel[axis] = std::clamp(static_cast<int>(point[axis] + offset[axis]), 0, volume.size[axis] - 1);
      }
      expected += volume.IsObject(voxel) ? 1 : 0;
    });
    EXPECT_EQ(thickness.CountObjectAround(object, point), expected) << point[0] << ' ' << point[1] << ' ' << point[2];
  });
}
