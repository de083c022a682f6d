// SPDX-FileCopyrightText: MedialVoxel contributors
// SPDX-License-Identifier: Apache-2.0

// Images of any spacing: measured alike in all units, or refused in words.

#include "MedialVoxelTestRuns.h"

#include "itkMedialVoxelBoxComponents.h"
#include "itkMedialVoxelGridLimits.h"

#include "gtest/gtest.h"

#include <cmath>
#include <limits>
#include <string>

namespace
{

using namespace MedialVoxelTest;
using itk::MedialVoxelGridLimits;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

std::string
ProblemOfSpacing(double x, double y, double z)
{
  return MedialVoxelGridLimits::FindProblem({ 10, 11, 12 }, { x, y, z }, { 0.0, 0.0, 0.0 });
}

void
ExpectPart(const std::string & text, const std::string & part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text << " has no '" << part << "'";
}

Volume
Scaled(Volume volume, double scale)
{
  for (double & spacing : volume.spacing)
  {
    spacing *= scale;
  }
  return volume;
}

/** An image with a spacing that itk::Image itself takes. */
MaskImage<3>::Pointer
ImageWith(double spacing, double origin = 0.0)
{
  auto image = MakeImage<MaskImage<3>>(RandomBoxes({ { 9, 8, 7 } }, UnitSpacing, 5, 3), 0);
  image->SetSpacing(itk::Vector<double, 3>(spacing));
  image->SetOrigin(itk::Point<double, 3>(origin));
  return image;
}

template <typename TFilter>
std::string
MessageOf(const MaskImage<3> * image)
{
  auto filter = TFilter::New();
  filter->SetInput(image);
  try
  {
    filter->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return {};
}

} // namespace

TEST(MedialVoxelGridLimits, SpacingsOutOfRangeAreNamed)
{
  EXPECT_EQ(ProblemOfSpacing(1.0, 1.0, 1.0), "");
  EXPECT_EQ(ProblemOfSpacing(1e-12, 1e-12, 1e-12), "");
  EXPECT_EQ(ProblemOfSpacing(1e12, 1e12, 1e12), "");
  EXPECT_EQ(ProblemOfSpacing(1.0, 1000.0, 1.0), "");
  EXPECT_EQ(ProblemOfSpacing(1.0, 0.0, 1.0), "its spacing along axis 1 is 0; it must be a number from 1e-12 to 1e+12");
  for (const double bad : { -1.0, NotANumber, Infinity, 5e-324, 1e-300, 1e-13, 1e13, 1e103 })
  {
    ExpectPart(ProblemOfSpacing(1.0, 1.0, bad), "spacing along axis 2 is ");
  }
  ExpectPart(ProblemOfSpacing(1.0, 1.0, 1001.0), "ratio of its largest spacing to its smallest is 1001");
}

TEST(MedialVoxelGridLimits, SizesExtentsAndOriginsAreNamed)
{
  const std::uint64_t most = MedialVoxelGridLimits::LargestSize;
  EXPECT_EQ(MedialVoxelGridLimits::FindProblem({ most, 1 }, { 1.0, 1e-9 }, { 0.0, 0.0 }), "");
  ExpectPart(MedialVoxelGridLimits::FindProblem({ most + 1, 1 }, { 1.0, 1.0 }, { 0.0, 0.0 }), "size along axis 0");
  ExpectPart(MedialVoxelGridLimits::FindProblem({ most, most, 1 }, { 1.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 }),
             "2^59 voxels");
  ExpectPart(MedialVoxelGridLimits::FindProblem({ most, 1 }, { 1e10, 1.0 }, { 0.0, 0.0 }), "extent along axis 0");
  for (const double bad : { 1e19, -1e19, NotANumber, Infinity })
  {
    ExpectPart(MedialVoxelGridLimits::FindProblem({ 2, 2 }, { 1.0, 1.0 }, { 0.0, bad }), "origin along axis 1");
  }
}

TEST(MedialVoxelGridLimits, AxesThatAreNotAtRightAnglesAreNamed)
{
  const auto problem = [](const double degrees) {
    const double radians = degrees * 3.14159265358979 / 180.0;
    return itk::MedialVoxelGridLimits::FindShear(
      { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, std::cos(radians), std::sin(radians) } });
  };
  EXPECT_EQ(problem(90.0), "");
  EXPECT_EQ(problem(90.5), "");
  EXPECT_NE(problem(91.0).find("axes y and z are at 91 degrees"), std::string::npos) << problem(91.0);
  EXPECT_NE(problem(65.0).find("axes y and z are at 65 degrees"), std::string::npos) << problem(65.0);
}

TEST(MedialVoxelGridLimits, OnlyAxesLongerThanOneCount)
{
  EXPECT_EQ(MedialVoxelGridLimits::RatioOf({ { { 5, 5, 1 } }, { { 1.0, 3.0, 99.0 } } }), 3.0);
  EXPECT_EQ(MedialVoxelGridLimits::RatioOf({ { { 1, 1, 1 } }, { { 1.0, 3.0, 99.0 } } }), 1.0);
  EXPECT_EQ(MedialVoxelGridLimits::LeastThickness({ { { 5, 5, 5 } }, { { 1.0, 4.0, 1.0 } } }), 0.0);
  EXPECT_EQ(MedialVoxelGridLimits::LeastThickness({ { { 5, 5, 5 } }, { { 1.0, 4.5, 1.0 } } }), 4.5);
  EXPECT_EQ(MedialVoxelGridLimits::FindInaccuracy({ { { 5, 5, 5 } }, { { 1.0, 4.0, 1.0 } } }), "");
  ExpectPart(MedialVoxelGridLimits::FindInaccuracy({ { { 5, 5, 5 } }, { { 0.4, 2.5, 0.4 } } }),
             "6.3 times the smallest");
}

TEST(MedialVoxelGridLimits, FiltersRefuseInWords)
{
  for (const double spacing : { 1e13, 1e78, 1e-13, 1e-80 })
  {
    const auto image = ImageWith(spacing);
    ExpectPart(MessageOf<MedialFilter<3>>(image), "spacing along axis 0 is ");
    ExpectPart(MessageOf<VectorFilter<3>>(image), "spacing along axis 0 is ");
  }
  ExpectPart(MessageOf<MedialFilter<3>>(ImageWith(1.0, 1e30)), "origin along axis 0 is 1e+30");
  EXPECT_EQ(MessageOf<MedialFilter<3>>(ImageWith(1e12, 1e18)), "");
}

TEST(MedialVoxelGridLimits, LabelsDoNotDependOnTheUnit)
{
  for (const Vector3 & spacing : { UnitSpacing, Vector3{ { 0.5, 0.7, 1.3 } }, Vector3{ { 0.4, 0.4, 2.5 } } })
  {
    const Volume volume = RandomBoxes({ { 25, 22, 20 } }, spacing, 14, 5);
    for (const auto bound : { Bound::FreeSpace, Bound::Paper, Bound::Off })
    {
      const auto expected = RunMedialFilter<3>(volume, 2.3, bound);
      for (const double scale : { 0x1p-38, 0x1p-3, 0x1p9, 0x1p38 })
      {
        const auto actual = RunMedialFilter<3>(Scaled(volume, scale), 2.3 * scale, bound);
        EXPECT_TRUE(AreEqual(actual.labels, expected.labels)) << scale;
        EXPECT_EQ(actual.counts, expected.counts) << scale;
      }
    }
  }
}

TEST(MedialVoxelGridLimits, SurfacesAlongALongAxisAreNotMedial)
{
  // A plate across x, with slices ten times as far apart as its voxels: one cell for each column of cells.
  const Volume plate =
    MakeVolume({ { 30, 20, 8 } }, { { 0.3, 0.3, 3.0 } }, [](const Index3 & v) { return v[0] >= 12 && v[0] < 17; });
  for (const double thickness : { 0.3, 1.5 })
  {
    const auto  labels = RunMedialFilter<3>(plate, thickness).labels;
    std::size_t medial = 0;
    for (const unsigned char label : labels)
    {
      medial += label >= 2 ? 1 : 0;
    }
    EXPECT_EQ(medial, 19u * 7u);
  }
}

TEST(MedialVoxelGridLimits, ComponentsRefuseWhatIsNoBoundaryPoint)
{
  const itk::MedialVoxelBox box{ { { 0, 0, 0 } }, { { 8, 4, 4 } } };
  itk::MedialVoxelBits      bits(box);
  bits.Set({ { 2, 1, 1 } });
  itk::MedialVoxelBoxComponents components;
  components.Label(bits, box);
  const itk::MedialVoxelIndex point{ { 2, 1, 1 } };
  EXPECT_TRUE(components.AreConnected(point, point));
  for (const itk::MedialVoxelIndex & other : { itk::MedialVoxelIndex{ { 3, 1, 1 } },
                                               itk::MedialVoxelIndex{ { 2, 3, 3 } },
                                               itk::MedialVoxelIndex{ { 2, 1, 9 } },
                                               itk::MedialVoxelIndex{ { -1, 0, 0 } } })
  {
    EXPECT_THROW(components.AreConnected(point, other), std::out_of_range);
  }
}
